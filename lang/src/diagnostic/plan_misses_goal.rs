#![doc = include_str!("plan_misses_goal.md")]

use super::{Rule, Severity};

/// The kind `plan-misses-goal`.
pub const RULE: Rule = Rule {
    code: "E0721",
    name: "plan-misses-goal",
    severity: Severity::Error,
    page: include_str!("plan_misses_goal.md"),
};
