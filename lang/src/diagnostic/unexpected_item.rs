#![doc = include_str!("unexpected_item.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unexpected-item`.
pub const RULE: Rule = Rule {
    code: "E0013",
    name: "unexpected-item",
    severity: Severity::Error,
    page: include_str!("unexpected_item.md"),
};

/// Something stands where `expected` should.
pub fn unexpected_item(expected: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("expected {expected}"), "found this")
}

/// Something is missing in or after `span`.
pub fn missing_item(expected: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("expected {expected}"), "missing here")
}
