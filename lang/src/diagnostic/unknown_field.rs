#![doc = include_str!("unknown_field.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-field`.
pub const RULE: Rule = Rule {
    code: "E0005",
    name: "unknown-field",
    severity: Severity::Error,
    page: include_str!("unknown_field.md"),
};

/// `name` is no field of `owner`, which is something like "action `drive`".
pub fn unknown_field(owner: &str, name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown field `{name}` in {owner}"), "not a field of it").suggest(near)
}
