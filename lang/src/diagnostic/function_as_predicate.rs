#![doc = include_str!("function_as_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `function-as-predicate`.
pub const RULE: Rule = Rule {
    code: "E0205",
    name: "function-as-predicate",
    severity: Severity::Error,
    page: include_str!("function_as_predicate.md"),
};

/// The function `name`, declared at `declared`, stands where a predicate should.
pub fn function_as_predicate(name: &str, span: Span, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`{name}` is a function, not a predicate"),
        "has a number as its value, and is not true or false",
    )
    .label(declared, "declared here")
    .help(format!("compare its value: `(= ({name} …) …)`, or declare a predicate"))
}
