//! The goal and the domain's own actions go in; what ends the changes comes out, and the actions as they are taken after that.

use lang::condition::Condition;
use lang::execute::Executor;
use lang::model::{
    Atom, Domain, Fact, ObjectId, PredicateId, Problem, Scope, Term, TypeId, Variable, VariableId,
};

use super::choices::Choices;
use super::task::{Draft, Task, also};
use crate::normalize::Unsupported;

/// The two parts of a plan.
pub(super) struct Phases {
    /// The initial state is being changed.
    pub(super) editing: PredicateId,
    /// It is changed.
    pub(super) acting: PredicateId,
}

/// Makes the facts that say which part of a plan it is.
pub(super) fn phases(task: &mut Task) -> Phases {
    if !task.domain.predicates.is_empty() {
        task.words.insert(PredicateId(0), "What the domain itself has.".to_owned());
    }
    let words = "The initial state may still be changed; after that, the domain's own actions may be taken.";
    let editing = task.predicate("editing", Vec::new(), words);
    let acting = task.predicate("acting", Vec::new(), "");
    task.init(editing, Vec::new());
    let atom = Atom { predicate: acting, arguments: Vec::new() };
    task.goal(vec![(atom, true)]);
    Phases { editing, acting }
}

/// A part of the goal that changes could make true, in which variables stand for objects that only the problem has.
struct Part {
    condition: Condition,
    parameters: Vec<Variable>,
    /// The name of its predicate, if it is an atom.
    name: Option<String>,
    /// What the variables stand for, each time that it occurs.
    rows: Vec<Vec<ObjectId>>,
}

/// Adds `begin`: an action for each part of the goal which says that this one does not hold yet, since a state that satisfies the goal is no excuse.
///
/// One action is enough, and asks nothing, if some part does not hold whatever is changed. The same if the goal holds already, for then no change is needed.
pub(super) fn add(
    task: &mut Task,
    phases: &Phases,
    choices: &Choices,
    domain: &Domain,
    problem: &Problem,
) -> Result<(), Unsupported> {
    let parts = parts(task, choices, domain, problem)?;
    let Some(parts) = parts else {
        let draft = begin(phases, "The initial state is as it shall be.".to_owned());
        task.action(draft);
        return Ok(());
    };
    for part in parts {
        let note = "The initial state is as it shall be, and does not satisfy the goal.";
        let mut draft = begin(phases, note.to_owned());
        let terms: Vec<Term> =
            part.parameters.iter().map(|one| draft.parameter(one.clone())).collect();
        if !terms.is_empty() {
            let name = format!("goal-{}", part.name.as_deref().unwrap_or("objects"));
            let table = task.predicate(&name, part.parameters, "What the goal asks for.");
            for row in part.rows {
                task.init(table, row);
            }
            draft.needs(table, terms);
        }
        draft.scope.variables.extend(task.variables(&problem.goal_scope.variables));
        draft.precondition.push(part.condition.not());
        task.action(draft);
    }
    Ok(())
}

fn begin(phases: &Phases, note: String) -> Draft {
    let mut draft = Draft::new("begin".to_owned(), note);
    draft.needs(phases.editing, Vec::new());
    draft.makes(phases.editing, Vec::new(), false);
    draft.makes(phases.acting, Vec::new(), true);
    draft
}

/// The parts of the goal that changes could make true; nothing if the goal does not hold whatever is changed, or holds already.
fn parts(
    task: &Task,
    choices: &Choices,
    domain: &Domain,
    problem: &Problem,
) -> Result<Option<Vec<Part>>, Unsupported> {
    let satisfied =
        Executor::new(domain, problem).is_ok_and(|executor| executor.goal(&executor.initial()));
    if satisfied {
        return Ok(None);
    }
    let span = task.span;
    let too_deep = || Unsupported { message: "a goal that is nested so deep".to_owned(), span };
    let goal = Condition::new(&problem.goal).ok_or_else(too_deep)?;
    let mut parts: Vec<Part> = Vec::new();
    for conjunct in goal.conjuncts() {
        match fixed(conjunct, choices, domain, problem) {
            Some(true) => continue,
            Some(false) => return Ok(None),
            None => {}
        }
        let (part, row) = part(task, conjunct, domain);
        let same = |other: &&mut Part| {
            let types = |part: &Part| -> Vec<Vec<TypeId>> {
                part.parameters.iter().map(|one| one.types.clone()).collect()
            };
            other.condition == part.condition && types(other) == types(&part)
        };
        match parts.iter_mut().find(same) {
            Some(other) if other.rows.contains(&row) => {}
            Some(other) => other.rows.push(row),
            None => parts.push(Part { rows: vec![row], ..part }),
        }
    }
    Ok(Some(parts))
}

/// Whether a part of the goal holds after any changes; nothing if that depends on them.
fn fixed(part: &Condition, choices: &Choices, domain: &Domain, problem: &Problem) -> Option<bool> {
    let Condition::Atom(atom, holds) = part else { return None };
    let object = |term: &Term| match term {
        Term::Object(object) => Some(*object),
        Term::Variable(_) => None,
    };
    let arguments: Option<Vec<ObjectId>> = atom.arguments.iter().map(object).collect();
    let fact = Fact { predicate: atom.predicate, arguments: arguments?.into() };
    let open = domain.predicates[atom.predicate.index()].derived || choices.touches(&fact);
    (!open).then(|| problem.init.contains(&fact) == *holds)
}

/// A part of the goal with variables for the objects that the domain cannot name, and what these stand for.
fn part(task: &Task, condition: &Condition, domain: &Domain) -> (Part, Vec<ObjectId>) {
    let mut row: Vec<ObjectId> = Vec::new();
    let mut parameters: Vec<Variable> = Vec::new();
    let mut name = None;
    condition.visit(&mut |leaf| {
        let declared = match leaf {
            Condition::Atom(atom, _) => Some(&task.domain.predicates[atom.predicate.index()]),
            _ => None,
        };
        for (at, term) in leaf.terms().into_iter().enumerate() {
            let Term::Object(object) = term else { continue };
            if object.index() < domain.constants.len() || row.contains(&object) {
                continue;
            }
            row.push(object);
            let types = &task.problem.objects[object.index()].types;
            parameters.push(match declared {
                Some(predicate) => predicate.parameters[at].clone(),
                None => task.variable("?object", types),
            });
        }
    });
    if let Condition::Atom(atom, _) = condition {
        name = Some(domain.predicates[atom.predicate.index()].name.text.clone());
    }
    let count = row.len() as u32;
    let moved = condition.clone().rename(&|VariableId(id)| Term::Variable(VariableId(id + count)));
    let condition = moved.substitute(&|term| match term {
        Term::Object(object) => match row.iter().position(|&other| other == object) {
            Some(at) => Term::Variable(VariableId(at as u32)),
            None => term,
        },
        Term::Variable(_) => term,
    });
    (Part { condition, parameters, name, rows: Vec::new() }, row)
}

/// Adds the domain's own actions, to be taken after `begin`, for nothing.
pub(super) fn own(task: &mut Task, phases: &Phases, domain: &Domain) {
    for (number, action) in domain.actions.iter().enumerate() {
        let mut action = action.clone();
        let scope = &mut action.scope;
        *scope = Scope { variables: task.variables(&scope.variables), ..*scope };
        let acting = Atom { predicate: phases.acting, arguments: Vec::new() };
        action.precondition = also(action.precondition, vec![(acting, true)], task.span);
        action.increases.clear();
        task.push(action);
        if number == 0 {
            let id = lang::model::ActionId(task.domain.actions.len() as u32 - 1);
            task.notes.insert(id, "What the domain itself has.".to_owned());
        }
    }
}
