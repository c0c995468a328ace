#![doc = include_str!("duplicate_field.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-field`.
pub const RULE: Rule = Rule {
    code: "E0011",
    name: "duplicate-field",
    severity: Severity::Error,
    page: include_str!("duplicate_field.md"),
};

/// `field` of `owner` is given again.
pub fn duplicate_field(field: &str, owner: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("`{field}` is given twice in {owner}"), format!("second `{field}`"))
        .label(first, format!("first `{field}` here"))
        .help("merge both with `(and ...)`")
}
