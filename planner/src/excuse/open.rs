//! A problem and a policy go in; the ground problem in which everything that may be changed is left open comes out.

use std::collections::BTreeSet;

use lang::group::Group;
use lang::model::{self, Domain, Name, Object, ObjectId, PredicateId, Problem, TypeId};

use super::policy::Policy;
use crate::ground::{self, Interrupted};
use crate::grounded::{FactId, Grounded, Literal};
use crate::limits::{Limits, Stop};
use crate::normal::{Atom, Condition, Filter, Normal, Term};
use crate::normalize::{self, Unsupported};

/// So many facts may be open at most.
const MOST_FACTS: usize = 2_000_000;

/// An object that may come into being.
#[derive(Debug, Clone)]
pub struct NewObject {
    /// In [`Open::problem`].
    pub id: ObjectId,
    /// The one of its type that has to be there before it, by its number among the new objects.
    pub after: Option<u32>,
}

/// A ground problem in which what may be changed is open.
#[derive(Debug)]
pub struct Open {
    /// The problem with all new objects.
    pub problem: Problem,
    /// The normal form.
    pub normal: Normal,
    /// The ground problem, nothing taken out.
    pub grounded: Grounded,
    /// The new objects. Each stands for a fact behind those of `grounded`: that it exists.
    pub objects: Vec<NewObject>,
    /// Which facts hold initially; with those that stand for new objects.
    pub initial: Vec<bool>,
    /// What it costs to make each fact true; 0 where that is not allowed.
    pub editable: Vec<u32>,
    /// Which facts may not be touched at all.
    pub locked: Vec<bool>,
    /// For each predicate whether some effect changes it.
    pub changes: Vec<bool>,
    /// Whether something was left out that takes more changes than the bound allows.
    pub narrow: bool,
    /// Where objects that the problem does not have begin.
    first_new: u32,
}

/// Why nothing was opened.
#[derive(Debug)]
pub enum Obstacle {
    /// The planner does not plan this.
    Unsupported(Unsupported),
    /// The goal is out of reach whatever is changed.
    Hopeless {
        /// Unless it takes more changes than the bound allows.
        narrow: bool,
    },
    /// There would be too many facts.
    Large,
    /// It was told to stop.
    Stopped(Stop),
}

impl Open {
    /// Opens all predicates of which a change costs `most` at most, and lets new objects come into being where they cost no more than that. Actions that need
    /// changes of what no action changes for more than `bound` are left out.
    ///
    /// # Errors
    /// Why that is not possible.
    pub fn new(
        domain: &Domain,
        problem: &Problem,
        policy: &Policy,
        most: u32,
        bound: u32,
        limits: &Limits,
    ) -> Result<Self, Obstacle> {
        let closed = normalize::normalize(domain, problem).map_err(Obstacle::Unsupported)?;
        let mut problem = problem.clone();
        let first_new = problem.objects.len() as u32;
        let objects = if policy.object_cost <= most {
            add_objects(domain, &mut problem, policy.objects)
        } else {
            Vec::new()
        };
        let changes: Vec<bool> = closed
            .predicates
            .iter()
            .map(|predicate| predicate.kind != crate::normal::Kind::Static)
            .collect();
        let asked = asked(&closed);
        let price = |number: usize| {
            let predicate = PredicateId(number as u32);
            let cost = policy.cost(domain, predicate, changes[number]);
            let declared =
                |group: &Group| group.atoms.iter().any(|atom| atom.predicate == predicate);
            // What no condition asks for may still be the opposite of what one does.
            let matters = asked[number]
                || changes[number]
                || domain.predicates[number].parameters.len() == 1
                || policy.declared.iter().any(declared);
            cost.filter(|&cost| cost <= most && matters)
        };
        let prices: Vec<Option<u32>> = (0..domain.predicates.len()).map(price).collect();
        let editable: Vec<PredicateId> = (0..prices.len())
            .filter(|&number| prices[number].is_some())
            .map(|number| PredicateId(number as u32))
            .collect();
        // What is declared to exclude something has to give way to it, even if it is too dear to be made true.
        let declared = policy.declared.iter().flat_map(|group| &group.atoms);
        let mut opened: Vec<PredicateId> = declared.map(|atom| atom.predicate).collect();
        opened.retain(|id| !domain.predicates[id.index()].derived);
        opened.extend(&editable);
        let normal =
            normalize::normalize_open(domain, &problem, &opened).map_err(Obstacle::Unsupported)?;
        // A fact that is too dear with the objects that it needs is of no use.
        let affordable = |predicate: PredicateId, arguments: &[ObjectId]| {
            let mut new: Vec<ObjectId> =
                arguments.iter().copied().filter(|object| object.0 >= first_new).collect();
            new.sort_unstable();
            new.dedup();
            let price = prices[predicate.index()].unwrap_or(0);
            let objects = policy.object_cost.saturating_mul(new.len() as u32);
            price.saturating_add(objects) <= bound
        };
        let (facts, dropped) =
            facts(domain, &problem, &normal, &editable, &affordable).ok_or(Obstacle::Large)?;
        // What some action changes may come about by itself, so that only what none changes has a price.
        let charged = |number: usize| prices[number].filter(|_| !changes[number]).unwrap_or(0);
        let charged: Vec<u32> = (0..prices.len()).map(charged).collect();
        let new = if objects.is_empty() { u32::MAX } else { first_new };
        let choice = ground::Open {
            facts: &facts,
            prices: &charged,
            objects: (new, policy.object_cost),
            purse: bound,
        };
        let (grounded, narrow) =
            match ground::ground_open(domain, &problem, &normal, &choice, limits) {
                Ok((Some(grounded), narrow)) => (grounded, narrow || dropped),
                Ok((None, narrow)) => return Err(Obstacle::Hopeless { narrow: narrow || dropped }),
                Err(Interrupted { stop, .. }) => return Err(Obstacle::Stopped(stop)),
            };
        let mut initial = grounded.initial.clone();
        initial.resize(initial.len() + objects.len(), false);
        let mut locked: Vec<bool> =
            grounded.facts.iter().map(|fact| policy.protected.contains(&fact.predicate)).collect();
        locked.resize(initial.len(), false);
        if !policy.goal {
            lock_goal(&grounded, domain.predicates.len(), &mut locked);
        }
        let cost = |fact: &crate::grounded::Fact| {
            prices.get(fact.predicate.index()).copied().flatten().unwrap_or(0)
        };
        let mut editable: Vec<u32> = grounded.facts.iter().map(cost).collect();
        editable.resize(initial.len(), 0);
        Ok(Self {
            problem,
            normal,
            grounded,
            objects,
            initial,
            editable,
            locked,
            changes,
            narrow,
            first_new,
        })
    }

    /// How many facts there are, with those that stand for new objects.
    pub fn count(&self) -> usize {
        self.initial.len()
    }

    /// The arguments of a fact.
    pub fn arguments(&self, fact: FactId) -> &[ObjectId] {
        let range = &self.grounded.facts[fact.index()].arguments;
        &self.grounded.arguments[range.start as usize..range.end as usize]
    }

    /// The objects in a range of those of the ground problem.
    pub fn bound(&self, range: &std::ops::Range<u32>) -> &[ObjectId] {
        &self.grounded.arguments[range.start as usize..range.end as usize]
    }

    /// The new objects among the arguments of a fact, by number.
    pub fn needs(&self, fact: FactId) -> Vec<u32> {
        self.new_among(self.arguments(fact))
    }

    /// The new objects among some objects, by number.
    pub fn new_among(&self, objects: &[ObjectId]) -> Vec<u32> {
        let mut new: Vec<u32> = objects
            .iter()
            .filter(|object| object.0 >= self.first_new)
            .map(|object| object.0 - self.first_new)
            .collect();
        new.sort_unstable();
        new.dedup();
        new
    }

    /// The literals of a condition of something about `own` objects, without those about new objects that are not its own:
    /// a universal condition does not range over objects that do not exist.
    pub fn demanded<'a>(
        &'a self,
        literals: &'a [Literal],
        own: &'a [ObjectId],
    ) -> impl Iterator<Item = Literal> + 'a {
        literals.iter().copied().filter(move |literal| {
            self.objects.is_empty()
                || self
                    .arguments(literal.fact)
                    .iter()
                    .all(|object| object.0 < self.first_new || own.contains(object))
        })
    }
}

/// The predicates that some condition asks for.
fn asked(normal: &Normal) -> Vec<bool> {
    let mut asked = vec![false; normal.predicates.len()];
    each_atom(normal, &mut |atom, effect| asked[atom.predicate.index()] |= !effect);
    asked
}

/// Visits every atom of schemas, rules and the goal; the second argument says whether it stands in an effect.
fn each_atom(normal: &Normal, visit: &mut dyn FnMut(&Atom, bool)) {
    for schema in &normal.schemas {
        each_of_condition(&schema.condition, visit);
        for effect in &schema.effects {
            each_of_condition(&effect.condition, visit);
            visit(&effect.literal.atom, true);
        }
    }
    for rule in &normal.rules {
        each_of_condition(&rule.condition, visit);
    }
    each_of_condition(&normal.goal, visit);
}

fn each_of_condition(condition: &Condition, visit: &mut dyn FnMut(&Atom, bool)) {
    for literal in &condition.literals {
        visit(&literal.atom, false);
    }
    let mut filters: Vec<&Filter> = condition.filters.iter().collect();
    for universal in &condition.universals {
        filters.push(&universal.guard);
        for literal in &universal.literals {
            visit(&literal.atom, false);
        }
    }
    while let Some(filter) = filters.pop() {
        match filter {
            Filter::Atom(atom) => visit(atom, false),
            Filter::Equal(..) => {}
            Filter::Not(child) | Filter::Exists(_, child) | Filter::Forall(_, child) => {
                filters.push(child);
            }
            Filter::All(children) | Filter::Any(children) => filters.extend(children),
        }
    }
}

/// Adds `count` objects of every type that objects have or actions ask for.
fn add_objects(domain: &Domain, problem: &mut Problem, count: u32) -> Vec<NewObject> {
    let mut types: BTreeSet<TypeId> =
        problem.objects.iter().flat_map(|object| object.types.iter().copied()).collect();
    let parameters = domain
        .actions
        .iter()
        .flat_map(|action| &action.scope.variables[..action.scope.parameters as usize]);
    for wanted in parameters.filter_map(|variable| variable.types.first()) {
        let held =
            |object: &Object| object.types.iter().any(|&has| domain.is_subtype(has, *wanted));
        if !problem.objects.iter().any(held) {
            types.insert(*wanted);
        }
    }
    let mut new = Vec::new();
    for of in types {
        let mut after = None;
        for number in 1..=count {
            let mut text = format!("new-{}-{number}", domain.types[of.index()].name.text);
            while problem.objects.iter().any(|other| other.name.text.eq_ignore_ascii_case(&text)) {
                text.push('x');
            }
            let id = ObjectId(problem.objects.len() as u32);
            let span = problem.name.span;
            problem.objects.push(Object {
                name: Name { text, span },
                types: vec![of],
                holder: None,
            });
            new.push(NewObject { id, after });
            after = Some(new.len() as u32 - 1);
        }
    }
    new
}

/// Marks what the goal asks for; where it is hidden behind auxiliary predicates, whatever these ask for.
fn lock_goal(grounded: &Grounded, predicates: usize, locked: &mut [bool]) {
    let mut open: Vec<FactId> = grounded.goal.iter().map(|literal| literal.fact).collect();
    let mut seen = BTreeSet::new();
    while let Some(fact) = open.pop() {
        locked[fact.index()] = true;
        let auxiliary = grounded.facts[fact.index()].predicate.index() >= predicates;
        if auxiliary && seen.insert(fact) {
            for axiom in grounded.axioms.iter().filter(|axiom| axiom.head == fact) {
                let range = axiom.conditions.start as usize..axiom.conditions.end as usize;
                open.extend(grounded.literals[range].iter().map(|literal| literal.fact));
            }
        }
    }
}

/// All facts of the predicates `open` whose objects fit what the actions, the rules, the goal and the initial state put there, as far as they are
/// `affordable`, and whether some are not; none if there are too many.
fn facts(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    open: &[PredicateId],
    affordable: &dyn Fn(PredicateId, &[ObjectId]) -> bool,
) -> Option<(Vec<model::Fact>, bool)> {
    let sorts = sorts(domain, problem, normal);
    let mut facts = Vec::new();
    let mut dropped = false;
    for &predicate in open {
        let columns: Vec<Vec<ObjectId>> = domain.predicates[predicate.index()]
            .parameters
            .iter()
            .zip(&sorts[predicate.index()])
            .map(|(parameter, sort)| {
                let fits = |object: &ObjectId| {
                    domain.has_type(&problem.objects[object.index()], &parameter.types)
                };
                sort.iter().copied().filter(fits).collect()
            })
            .collect();
        let count: usize =
            columns.iter().try_fold(1_usize, |count, column| count.checked_mul(column.len()))?;
        if facts.len() + count > MOST_FACTS {
            return None;
        }
        let mut row = vec![0; columns.len()];
        for _ in 0..count {
            let arguments: Box<[ObjectId]> =
                row.iter().zip(&columns).map(|(&at, column): (&usize, _)| column[at]).collect();
            if affordable(predicate, &arguments) {
                facts.push(model::Fact { predicate, arguments });
            } else {
                dropped = true;
            }
            for (at, column) in row.iter_mut().zip(&columns).rev() {
                *at += 1;
                if *at < column.len() {
                    break;
                }
                *at = 0;
            }
        }
    }
    Some((facts, dropped))
}

/// For each argument of each predicate the objects that something may put there: by the types of variables and by static facts about one object, which in
/// domains without types stand for them.
fn sorts(domain: &Domain, problem: &Problem, normal: &Normal) -> Vec<Vec<BTreeSet<ObjectId>>> {
    let mut sorts: Vec<Vec<BTreeSet<ObjectId>>> =
        normal.predicates.iter().map(|predicate| vec![BTreeSet::new(); predicate.arity]).collect();
    for fact in &problem.init {
        for (position, &object) in fact.arguments.iter().enumerate() {
            sorts[fact.predicate.index()][position].insert(object);
        }
    }
    let holds = |predicate: PredicateId, object: ObjectId| {
        problem.init.iter().any(|fact| fact.predicate == predicate && *fact.arguments == [object])
    };
    let of_variables = |variables: &[crate::normal::Variable], condition: &Condition| {
        let of = |number: usize, variable: &crate::normal::Variable| -> Vec<ObjectId> {
            let asked: Vec<PredicateId> = condition
                .literals
                .iter()
                .filter(|literal| {
                    let atom = &literal.atom;
                    let kind = normal.predicates[atom.predicate.index()].kind;
                    literal.positive
                        && kind == crate::normal::Kind::Static
                        && atom.arguments == [Term::Variable(number as u32)]
                })
                .map(|literal| literal.atom.predicate)
                .collect();
            let fits = |&object: &ObjectId| {
                domain.has_type(&problem.objects[object.index()], &variable.types)
                    && asked.iter().all(|&predicate| holds(predicate, object))
            };
            (0..problem.objects.len() as u32).map(ObjectId).filter(fits).collect()
        };
        let each = variables.iter().enumerate().map(|(number, variable)| of(number, variable));
        each.collect::<Vec<_>>()
    };
    let mut put = |atom: &Atom, objects: &[Vec<ObjectId>]| {
        for (position, &term) in atom.arguments.iter().enumerate() {
            let sort = &mut sorts[atom.predicate.index()][position];
            match term {
                Term::Object(object) => {
                    sort.insert(object);
                }
                Term::Variable(variable) => sort.extend(&objects[variable as usize]),
            }
        }
    };
    for schema in &normal.schemas {
        let objects = of_variables(&schema.variables, &schema.condition);
        each_of_condition(&schema.condition, &mut |atom, _| put(atom, &objects));
        for effect in &schema.effects {
            each_of_condition(&effect.condition, &mut |atom, _| put(atom, &objects));
            put(&effect.literal.atom, &objects);
        }
    }
    for rule in &normal.rules {
        let objects = of_variables(&rule.variables, &rule.condition);
        each_of_condition(&rule.condition, &mut |atom, _| put(atom, &objects));
    }
    let objects = of_variables(&normal.goal_variables, &normal.goal);
    each_of_condition(&normal.goal, &mut |atom, _| put(atom, &objects));
    sorts
}
