#![doc = include_str!("variable_in_init.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `variable-in-init`.
pub const RULE: Rule = Rule {
    code: "E0701",
    name: "variable-in-init",
    severity: Severity::Error,
    page: include_str!("variable_in_init.md"),
};

/// A variable stands where only objects can.
pub fn variable_in_init(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`:init` contains the variable `{name}`"), "not an object")
        .help("write a fact for each object for which it holds")
}
