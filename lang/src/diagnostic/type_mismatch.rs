#![doc = include_str!("type_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `type-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0202",
    name: "type-mismatch",
    severity: Severity::Error,
    page: include_str!("type_mismatch.md"),
};

/// `term` is of type `found`, but `what` wants `wanted` there, as declared.
pub fn type_mismatch(
    term: &str,
    found: &str,
    what: &str,
    wanted: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    RULE.at(
        span,
        format!("`{term}` is a `{found}`, but {what} takes a `{wanted}` here"),
        format!("expected `{wanted}`"),
    )
    .label(declared, "declared here")
}
