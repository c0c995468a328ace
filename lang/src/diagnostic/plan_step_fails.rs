#![doc = include_str!("plan_step_fails.md")]

use super::{Rule, Severity};

/// The kind `plan-step-fails`.
pub const RULE: Rule = Rule {
    code: "E0720",
    name: "plan-step-fails",
    severity: Severity::Error,
    page: include_str!("plan_step_fails.md"),
};
