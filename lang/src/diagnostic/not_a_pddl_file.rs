#![doc = include_str!("not_a_pddl_file.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `not-a-pddl-file`.
pub const RULE: Rule = Rule {
    code: "E0003",
    name: "not-a-pddl-file",
    severity: Severity::Error,
    page: include_str!("not_a_pddl_file.md"),
};

/// What the text is, where something else was wanted.
pub fn not_a_pddl_file(
    span: Span,
    message: impl Into<String>,
    label: impl Into<String>,
    help: impl Into<String>,
) -> Diagnostic {
    RULE.at(span, message, label).help(help)
}
