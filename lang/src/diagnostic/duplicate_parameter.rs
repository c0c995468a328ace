#![doc = include_str!("duplicate_parameter.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-parameter`.
pub const RULE: Rule = Rule {
    code: "E0105",
    name: "duplicate-parameter",
    severity: Severity::Error,
    page: include_str!("duplicate_parameter.md"),
};

/// The variable `name` stands twice in the list of `owner`.
pub fn duplicate_parameter(name: &str, owner: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("parameter `{name}` is given twice in {owner}"), "second time")
        .label(first, "first time")
        .help("rename one of them")
}
