//! hmax (Bonet and Geffner 2001): the cost of reaching the most expensive goal fact, where facts are reached alone and nothing is ever deleted.

use super::relaxed::{Combine, Exploration};
use super::{Costs, Heuristic, Profile};
use crate::task::Task;

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "hmax",
        summary: "the most expensive goal fact without deletes",
        source: "Bonet and Geffner, Planning as heuristic search, AIJ 2001",
        admissible: true,
        consistent: true,
        safe: true,
        conditional_effects: true,
        axioms: true,
        preferred: false,
    }
}

/// See the module.
#[derive(Debug, Clone)]
pub struct Hmax {
    exploration: Exploration,
}

impl Hmax {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        Self { exploration: Exploration::new(task, costs) }
    }
}

impl Heuristic for Hmax {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.exploration.explore(values, Combine::Max)
    }
}
