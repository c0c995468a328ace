//! No estimate at all: 0 in a goal state, elsewhere the cost of the cheapest operator, which any plan pays at least once.

use super::{Costs, DEAD_END, Heuristic, Profile};
use crate::state::holds;
use crate::task::{Fact, Task};

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "blind",
        summary: "0 in goal states, elsewhere the cost of the cheapest operator",
        source: "folklore",
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
pub struct Blind {
    goal: Vec<Fact>,
    cheapest: u32,
}

impl Blind {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        let cheapest = task
            .operator_ids()
            .map(|operator| costs.of(task, operator))
            .min()
            .unwrap_or(0)
            .min(DEAD_END - 1);
        Self { goal: task.goal.clone(), cheapest }
    }
}

impl Heuristic for Blind {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        if holds(&self.goal, values) { 0 } else { self.cheapest }
    }

    fn constant(&self) -> Option<u32> {
        Some(self.cheapest)
    }
}
