#![doc = include_str!("unused_parameter.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-parameter`.
pub const RULE: Rule = Rule {
    code: "W0101",
    name: "unused-parameter",
    severity: Severity::Warning,
    page: include_str!("unused_parameter.md"),
};

/// The parameter `name` of `owner` is used nowhere.
pub fn unused_parameter(name: &str, owner: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("parameter `{name}` of {owner} is never used"), "unused")
        .help("remove it: an unused parameter multiplies the number of ground actions by the number of its objects")
}
