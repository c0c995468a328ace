//! Predicates, facts and actions go in one by one; the compiled domain and problem come out.

use std::collections::{BTreeMap, BTreeSet};

use hashbrown::HashSet;

use super::{Compiled, Role};
use crate::condition::Condition;
use crate::model::{
    Action, ActionId, Atom, Doing, Domain, Effect, Fact, Formula, Function, FunctionId, Increase,
    Literal, Metric, Name, ObjectId, Predicate, PredicateId, Problem, Scope, Signature, Term,
    TypeId, Variable, VariableId,
};
use crate::source::Span;

/// A compiled domain and problem while they are put together.
pub(super) struct Assembly {
    pub(super) domain: Domain,
    pub(super) problem: Problem,
    pub(super) roles: Vec<Role>,
    pub(super) notes: BTreeMap<ActionId, String>,
    /// Where all that is new is said to stand.
    pub(super) span: Span,
}

/// An effect: what it binds, when it happens, and the facts that it adds or deletes.
pub(super) type Change = (Vec<VariableId>, Condition, Vec<(Atom, bool)>);

/// What tells one literal of an effect from another.
type Key = (Vec<VariableId>, String, PredicateId, Vec<Term>, bool);

/// An action that is put together.
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) scope: Scope,
    pub(super) precondition: Vec<Condition>,
    pub(super) effects: Vec<Change>,
    pub(super) increases: Vec<Increase>,
    pub(super) note: String,
}

impl Draft {
    pub(super) fn new(name: String, scope: Scope, note: String) -> Self {
        let (precondition, effects, increases) = (Vec::new(), Vec::new(), Vec::new());
        Self { name, scope, precondition, effects, increases, note }
    }

    /// Demands a fact, or its absence.
    pub(super) fn needs(&mut self, atom: Atom, holds: bool) {
        self.precondition.push(Condition::Atom(atom, holds));
    }

    /// Adds or deletes a fact.
    pub(super) fn makes(&mut self, atom: Atom, holds: bool) {
        self.effects.push((Vec::new(), Condition::TRUE, vec![(atom, holds)]));
    }
}

impl Assembly {
    /// The same world without actions.
    pub(super) fn new(domain: &Domain, problem: &Problem) -> Self {
        let mut compiled = domain.clone();
        compiled.actions.clear();
        compiled.signatures.clear();
        compiled.predicates.iter_mut().for_each(|predicate| predicate.owner = None);
        compiled.requirements.retain(|one| !one.is_of_agents());
        let mut problem = problem.clone();
        for object in compiled.constants.iter_mut().chain(&mut problem.objects) {
            object.holder = None;
        }
        let (roles, notes) = (Vec::new(), BTreeMap::new());
        let span = domain.name.span;
        Self { domain: compiled, problem, roles, notes, span }
    }

    fn name(&self, text: String) -> Name {
        Name { text, span: self.span }
    }

    /// A variable of a new action or predicate.
    pub(super) fn variable(&self, name: &str, types: &[TypeId]) -> Variable {
        Variable { name: self.name(name.to_owned()), types: types.to_vec() }
    }

    /// A new predicate, called `name` or nearly so.
    pub(super) fn predicate(&mut self, name: &str, parameters: Vec<Variable>) -> PredicateId {
        let predicates = &self.domain.predicates;
        let free =
            |name: &str| predicates.iter().all(|one| !one.name.text.eq_ignore_ascii_case(name));
        let name = self.name(unused(name, free));
        self.domain.predicates.push(Predicate { name, parameters, derived: false, owner: None });
        PredicateId(self.domain.predicates.len() as u32 - 1)
    }

    /// A fact that holds initially.
    pub(super) fn init(&mut self, predicate: PredicateId, arguments: &[ObjectId]) {
        self.problem.init.push(Fact { predicate, arguments: arguments.into() });
    }

    /// Adds to the goal.
    pub(super) fn goal(&mut self, atom: Atom) {
        let before = std::mem::replace(&mut self.problem.goal, Formula::truth(self.span));
        let added = Condition::Atom(atom, true).formula(self.span);
        self.problem.goal = crate::check::conjoin(vec![before, added], self.span);
    }

    /// The function that costs are counted in: a new one, which the metric asks for from now on.
    pub(super) fn count(&mut self) -> FunctionId {
        let functions = &self.domain.functions;
        let free =
            |name: &str| functions.iter().all(|one| !one.name.text.eq_ignore_ascii_case(name));
        let name = self.name(unused("total-cost", free));
        let (parameters, values) = (Vec::new(), None);
        self.domain.functions.push(Function {
            name,
            parameters,
            values,
            read: None,
            assigned: false,
        });
        let function = FunctionId(self.domain.functions.len() as u32 - 1);
        self.problem.metric = Some(Metric { function, span: self.span });
        self.problem.values.push(crate::model::FunctionValue {
            function,
            arguments: Box::default(),
            value: 0.into(),
            span: self.span,
        });
        function
    }

    /// Adds an action and what it stands for.
    pub(super) fn action(&mut self, draft: Draft, role: Role) {
        let Draft { name, mut scope, precondition, effects, increases, note } = draft;
        let actions = &self.domain.actions;
        let free = |name: &str| actions.iter().all(|one| !one.name.text.eq_ignore_ascii_case(name));
        let name = self.name(unused(&name, free));
        let mut bound = HashSet::new();
        let precondition = Condition::all(once(&Condition::all(precondition), &scope));
        let precondition = freshen(precondition, &mut scope, &mut bound);
        let mut written: BTreeSet<Key> = BTreeSet::new();
        let mut list = Vec::new();
        for (variables, condition, literals) in effects {
            let condition = freshen(condition, &mut scope, &mut bound);
            let key =
                if condition == Condition::TRUE { String::new() } else { format!("{condition:?}") };
            let literals: Vec<Literal> = literals
                .into_iter()
                .filter(|(atom, positive)| {
                    written.insert((
                        variables.clone(),
                        key.clone(),
                        atom.predicate,
                        atom.arguments.clone(),
                        *positive,
                    ))
                })
                .map(|(atom, positive)| Literal { positive, atom, span: self.span })
                .collect();
            if !literals.is_empty() {
                let condition = condition.formula(self.span);
                list.push(Effect { variables, condition, literals, span: self.span });
            }
        }
        let id = ActionId(self.domain.actions.len() as u32);
        self.domain.signatures.push(Signature {
            name: name.clone(),
            doing: Doing::Action(crate::ast::ActionKind::Instant),
            parameters: scope.variables[..scope.parameters as usize].to_vec(),
            agent: false,
            action: Some(id),
        });
        self.domain.actions.push(Action {
            name,
            scope,
            agent: false,
            precondition: precondition.formula(self.span),
            effects: list,
            increases,
            span: self.span,
        });
        self.roles.push(role);
        self.notes.insert(id, note);
    }

    pub(super) fn finish(self, complete: bool) -> Compiled {
        let Self { domain, problem, roles, notes, .. } = self;
        Compiled { domain, problem, roles, notes, complete }
    }
}

/// `name`, or with a number behind it if that is taken.
fn unused(name: &str, free: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    std::iter::once(name.to_owned())
        .chain(numbered)
        .find(|name| free(name))
        .expect("there are more numbers than names")
}

/// The parts of a conjunction without those that say the same in other variables.
fn once(condition: &Condition, scope: &Scope) -> Vec<Condition> {
    let mut seen = BTreeSet::new();
    let parts = condition.conjuncts().iter();
    parts.filter(|part| seen.insert(meaning(part, scope))).cloned().collect()
}

/// A text that is the same for conditions that differ only in which variables they bind.
fn meaning(condition: &Condition, scope: &Scope) -> String {
    let mut bound: Vec<VariableId> = Vec::new();
    condition.bound(&mut bound);
    let types: Vec<&[TypeId]> =
        bound.iter().map(|id| scope.variables[id.index()].types.as_slice()).collect();
    let new = |variable: VariableId| {
        let place = bound.iter().position(|&one| one == variable);
        Term::Variable(place.map_or(variable, |at| VariableId(u32::MAX - at as u32)))
    };
    format!("{:?} {types:?}", condition.clone().rename(&new))
}

/// The same condition, in which no quantifier binds a variable that another one has bound before.
fn freshen(condition: Condition, scope: &mut Scope, bound: &mut HashSet<VariableId>) -> Condition {
    let mut each = |parts: Vec<Condition>, scope: &mut Scope| {
        parts.into_iter().map(|part| freshen(part, scope, bound)).collect::<Vec<_>>()
    };
    let (all, variables, body) = match condition {
        Condition::All(parts) => return Condition::all(each(parts, scope)),
        Condition::Any(parts) => return Condition::any(each(parts, scope)),
        Condition::Forall(variables, body) => (true, variables, body),
        Condition::Exists(variables, body) => (false, variables, body),
        leaf => return leaf,
    };
    let mut renamed = Vec::new();
    for &variable in &variables {
        if bound.insert(variable) {
            continue;
        }
        scope.variables.push(scope.variables[variable.index()].clone());
        let new = VariableId(scope.variables.len() as u32 - 1);
        bound.insert(new);
        renamed.push((variable, new));
    }
    let new = |variable: VariableId| {
        renamed.iter().find(|(old, _)| *old == variable).map_or(variable, |&(_, new)| new)
    };
    let variables: Vec<VariableId> = variables.into_iter().map(new).collect();
    let body = body.rename(&|variable| Term::Variable(new(variable)));
    let body = freshen(body, scope, bound);
    if all { Condition::forall(variables, body) } else { Condition::exists(variables, body) }
}
