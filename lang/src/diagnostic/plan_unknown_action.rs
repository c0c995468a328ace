#![doc = include_str!("plan_unknown_action.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-unknown-action`.
pub const RULE: Rule = Rule {
    code: "E0711",
    name: "plan-unknown-action",
    severity: Severity::Error,
    page: include_str!("plan_unknown_action.md"),
};

/// No action is called `name`.
pub fn plan_unknown_action(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown action `{name}`"), "not in the domain").suggest(near)
}
