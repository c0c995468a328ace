//! hadd (Bonet and Geffner 2001): the sum of the costs of reaching the goal facts, each reached by itself, where nothing is ever deleted.

use super::relaxed::{Combine, Exploration};
use super::{Costs, Heuristic, Profile};
use crate::task::Task;

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "hadd",
        summary: "the sum over the goal facts without deletes",
        source: "Bonet and Geffner, Planning as heuristic search, AIJ 2001",
        admissible: false,
        consistent: false,
        safe: true,
        conditional_effects: true,
        axioms: true,
        preferred: false,
    }
}

/// See the module.
#[derive(Debug, Clone)]
pub struct Hadd {
    exploration: Exploration,
}

impl Hadd {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        Self { exploration: Exploration::new(task, costs) }
    }
}

impl Heuristic for Hadd {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.exploration.explore(values, Combine::Sum)
    }
}
