#![doc = include_str!("plan_step_order.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-step-order`.
pub const RULE: Rule = Rule {
    code: "E0715",
    name: "plan-step-order",
    severity: Severity::Error,
    page: include_str!("plan_step_order.md"),
};

/// A step at `time` follows one at `last`, which is later.
pub fn plan_step_order(time: f64, span: Span, last: f64, before: Span) -> Diagnostic {
    RULE.at(span, "this step comes before the one above it", format!("at time {time}"))
        .label(before, format!("at time {last}"))
        .help("write the steps in the order of their times")
}
