//! A state, the facts that it consists of, and how a step changed it.

use std::sync::{Arc, OnceLock};

use super::joint::Acting;
use super::relation::Relation;
use super::{Executor, derive};
use crate::model::{Fact, ObjectId, PredicateId};

/// A set of facts, made by an [`Executor`] and understood only by it.
///
/// Clones share what they have in common, static facts above all, and each copies a predicate's facts when it first changes them.
/// What axioms derive is worked out when it is first asked for, and forgotten when a step changes what it depends on.
#[derive(Debug, Clone)]
pub struct State {
    pub(super) relations: Vec<Arc<Relation>>,
    /// The derived relations of each component.
    pub(super) derived: Vec<OnceLock<Arc<Vec<Relation>>>>,
}

/// What a step did to a state. Facts that held before and after are not in it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Change {
    /// The facts that hold since, in the order of the effects.
    pub added: Vec<Fact>,
    /// The facts that no longer hold, in the order of the effects.
    pub deleted: Vec<Fact>,
}

impl State {
    /// All facts but derived ones, sorted.
    pub fn facts(&self) -> Vec<Fact> {
        let mut facts: Vec<_> = self
            .relations
            .iter()
            .enumerate()
            .flat_map(|(predicate, relation)| {
                let predicate = PredicateId(predicate as u32);
                relation.tuples().map(move |tuple| Fact { predicate, arguments: tuple.into() })
            })
            .collect();
        facts.sort();
        facts
    }

    fn relation_mut(&mut self, predicate: PredicateId) -> &mut Relation {
        Arc::make_mut(&mut self.relations[predicate.index()])
    }

    /// Adds a fact; false if it held.
    pub(super) fn insert(&mut self, predicate: PredicateId, arguments: &[ObjectId]) -> bool {
        !self.relations[predicate.index()].contains(arguments)
            && self.relation_mut(predicate).insert(arguments)
    }

    /// Deletes a fact; false if it did not hold.
    pub(super) fn remove(&mut self, predicate: PredicateId, arguments: &[ObjectId]) -> bool {
        self.relations[predicate.index()].contains(arguments)
            && self.relation_mut(predicate).remove(arguments)
    }
}

/// A state as formulas see it, with the derived predicates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<'a> {
    pub(crate) executor: &'a Executor<'a>,
    pub(crate) state: &'a State,
    /// The component that is being derived, as far as it is.
    pub(crate) building: Option<(usize, &'a [Relation])>,
    /// The joint action that action atoms ask about.
    pub(crate) joint: Option<Acting<'a>>,
}

impl<'a> View<'a> {
    /// The facts of `predicate`.
    pub(crate) fn relation(self, predicate: PredicateId) -> &'a Relation {
        match (self.executor.strata().place(predicate), self.building) {
            (None, _) => &self.state.relations[predicate.index()],
            (Some((component, at)), Some((building, relations))) if component == building => {
                &relations[at]
            }
            (Some((component, at)), _) => {
                &derive::derived(self.executor, self.state, component)[at]
            }
        }
    }
}
