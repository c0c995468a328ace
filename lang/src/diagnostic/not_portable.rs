#![doc = include_str!("not_portable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `not-portable`.
pub const RULE: Rule = Rule {
    code: "W0305",
    name: "not-portable",
    severity: Severity::Warning,
    page: include_str!("not_portable.md"),
};

/// The program `tool` refuses or misreads `what`, as the verb `does` says.
pub fn not_portable(tool: &str, does: &str, what: &str, span: Span, instead: &str) -> Diagnostic {
    RULE.at(span, format!("{tool} {does} {what}"), "here first").help(instead)
}
