#![doc = include_str!("unknown_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-requirement`.
pub const RULE: Rule = Rule {
    code: "W0301",
    name: "unknown-requirement",
    severity: Severity::Warning,
    page: include_str!("unknown_requirement.md"),
};

/// PDDL has no requirement `name`.
pub fn unknown_requirement(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown requirement `{name}`"), "not a PDDL requirement").suggest(near)
}
