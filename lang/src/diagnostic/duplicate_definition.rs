#![doc = include_str!("duplicate_definition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-definition`.
pub const RULE: Rule = Rule {
    code: "E0104",
    name: "duplicate-definition",
    severity: Severity::Error,
    page: include_str!("duplicate_definition.md"),
};

/// The `what` called `name` is declared again; `detail` may say how the two differ.
pub fn duplicate_definition(
    what: &str,
    name: &str,
    detail: &str,
    span: Span,
    first: Span,
) -> Diagnostic {
    RULE.at(span, format!("{what} `{name}` is declared twice{detail}"), "redeclared here")
        .label(first, "first declared here")
}
