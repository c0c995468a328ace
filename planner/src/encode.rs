//! A ground problem and its mutex groups go in; a finite-domain [`Task`] and the way back to names come out.
//!
//! 1. A cover: groups of facts that exclude each other become variables ([`cover`], `Layout`).
//! 2. Operators, axioms and the goal are said over those variables ([`operators`]).
//! 3. What the goal does not need is dropped, with what is never reached and what is there twice ([`prune`]); variables get an order
//!    in which causes come first ([`order`]).
//! 4. Axioms get their layers ([`axioms`]).
//!
//! Conventions: a variable has a value for each of its facts, then, where it may be without any, one for that; a derived variable is
//! 0 where its fact holds and 1, its default, where not. A fact that is asked for negatively and shares its variable with several others
//! has a second variable that follows it alone, so that no negation is ever multiplied out.

mod cover;
mod operators;
mod order;
mod prune;
mod twins;
mod axioms;

use std::collections::BTreeSet;

use lang::model::{ActionId, ObjectId};
use lang::plan::{Plan, Step};

use crate::grounded::{FactId, Grounded};
use crate::limits::{Limits, Stop};
use crate::task::{Fact, OperatorId, Task, Variable, VariableId};

/// What a value of a variable says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Value {
    /// The fact holds.
    Atom(FactId),
    /// The fact does not hold; the variable has no other fact.
    Negated(FactId),
    /// No fact of the variable holds.
    Other,
}

/// A task, and what its operators and values stand for.
#[derive(Debug, Clone)]
pub struct Encoded {
    /// The task.
    pub task: Task,
    /// For each operator of the task the index of the ground operator that it stems from.
    pub origins: Vec<u32>,
    /// Whether it is settled already that no plan exists; the task is then a small one without any plan.
    pub unsolvable: bool,
    /// Where the values of each variable start in `values`.
    offsets: Vec<u32>,
    values: Vec<Value>,
}

impl Encoded {
    /// What a value says.
    pub fn value(&self, fact: Fact) -> Value {
        self.values[(self.offsets[fact.variable.index()] + fact.value) as usize]
    }

    /// The ground action behind an operator.
    pub fn step(&self, grounded: &Grounded, operator: OperatorId) -> Step {
        let origin = &grounded.operators[self.origins[operator.index()] as usize];
        let arguments =
            &grounded.arguments[origin.arguments.start as usize..origin.arguments.end as usize];
        Step { action: origin.action, arguments: arguments.into() }
    }

    /// Keeps of a ground problem only what names operators: it is the larger part of memory that search would like to have.
    pub fn decoder(&self, grounded: Grounded) -> Decoder {
        let named = |&origin: &u32| {
            let operator = &grounded.operators[origin as usize];
            (operator.action, operator.arguments.start, operator.arguments.end)
        };
        Decoder {
            operators: self.origins.iter().map(named).collect(),
            arguments: grounded.arguments,
        }
    }
}

/// From operators of a task back to steps of a plan.
#[derive(Debug, Clone)]
pub struct Decoder {
    operators: Vec<(ActionId, u32, u32)>,
    arguments: Vec<ObjectId>,
}

impl Decoder {
    /// The ground action behind an operator.
    pub fn step(&self, operator: OperatorId) -> Step {
        let (action, start, end) = self.operators[operator.index()];
        Step { action, arguments: self.arguments[start as usize..end as usize].into() }
    }

    /// The plan behind a sequence of operators.
    pub fn plan(&self, operators: &[OperatorId]) -> Plan {
        Plan { steps: operators.iter().map(|&operator| self.step(operator)).collect() }
    }
}

/// Encodes a ground problem. At most one fact of each group holds in any reachable state; with no groups every variable is two-valued.
pub fn encode(
    grounded: &Grounded,
    groups: &[Vec<FactId>],
    limits: &Limits,
) -> Result<Encoded, Stop> {
    let layout = cover::Layout::new(grounded, groups);
    let operators::Translated { mut task, mut origins, contradictory } =
        operators::translate(grounded, &layout, limits)?;
    if contradictory {
        return Ok(trivial(false));
    }
    let pruned = prune::prune(&mut task, &mut origins);
    if pruned.unsolvable || pruned.variables.is_empty() {
        return Ok(trivial(!pruned.unsolvable));
    }
    axioms::stratify(&mut task);

    let mut offsets = Vec::with_capacity(pruned.variables.len());
    let mut values = Vec::new();
    for (&variable, kept) in pruned.variables.iter().zip(&pruned.values) {
        offsets.push(values.len() as u32);
        let members = &layout.members[variable as usize];
        values.extend(kept.iter().map(|&value| match members.get(value as usize) {
            Some(&fact) => Value::Atom(fact),
            None if members.len() == 1 => Value::Negated(members[0]),
            None => Value::Other,
        }));
    }
    for group in groups {
        let facts: BTreeSet<Fact> =
            group.iter().filter_map(|fact| pruned.fact(layout.homes[fact.index()])).collect();
        let facts: Vec<Fact> = facts.into_iter().collect();
        if facts.iter().any(|fact| fact.variable != facts[0].variable) {
            task.mutex_groups.push(facts);
        }
    }
    Ok(Encoded { task, origins, unsolvable: false, offsets, values })
}

/// A task of one variable whose goal holds already or never.
fn trivial(solvable: bool) -> Encoded {
    let variable = VariableId(0);
    let task = Task {
        variables: vec![Variable { domain_size: 2, axiom_layer: None, default: 0 }],
        initial_state: vec![0],
        goal: vec![Fact { variable, value: u32::from(!solvable) }],
        ..Task::default()
    };
    let values = vec![Value::Other; 2];
    Encoded { task, origins: Vec::new(), unsolvable: !solvable, offsets: vec![0], values }
}

#[cfg(test)]
pub(crate) mod tests;
