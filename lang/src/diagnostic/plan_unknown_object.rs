#![doc = include_str!("plan_unknown_object.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-unknown-object`.
pub const RULE: Rule = Rule {
    code: "E0713",
    name: "plan-unknown-object",
    severity: Severity::Error,
    page: include_str!("plan_unknown_object.md"),
};

/// No object or constant is called `name`.
pub fn plan_unknown_object(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown object `{name}`"), "not in the problem or the domain")
        .suggest(near)
}
