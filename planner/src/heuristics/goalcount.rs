//! The number of goal facts that do not hold.

use super::{Heuristic, Profile};
use crate::task::{Fact, Task};

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "goalcount",
        summary: "how many goal facts do not hold",
        source: "Fikes and Nilsson 1971 (the difference to the goal in STRIPS)",
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
pub struct GoalCount {
    goal: Vec<Fact>,
}

impl GoalCount {
    /// For `task`.
    pub fn new(task: &Task) -> Self {
        Self { goal: task.goal.clone() }
    }
}

impl Heuristic for GoalCount {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.goal.iter().filter(|fact| values[fact.variable.index()] != fact.value).count() as u32
    }
}
