#![doc = include_str!("uninitialised_function.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `uninitialised-function`.
pub const RULE: Rule = Rule {
    code: "W0501",
    name: "uninitialised-function",
    severity: Severity::Warning,
    page: include_str!("uninitialised_function.md"),
};

/// `(NAME)` is used in `:metric` and has no initial value.
pub fn uninitialised_function(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`({name})` has no initial value"), "used in `:metric`")
        .help(format!("add `(= ({name}) 0)` to `:init`"))
}
