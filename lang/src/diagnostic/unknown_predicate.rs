#![doc = include_str!("unknown_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-predicate`.
pub const RULE: Rule = Rule {
    code: "E0101",
    name: "unknown-predicate",
    severity: Severity::Error,
    page: include_str!("unknown_predicate.md"),
};

/// No predicate `name` is declared.
pub fn unknown_predicate(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown predicate `{name}`"), "not declared in `:predicates`");
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help(format!("declare it: add `({name} …)` to `:predicates`")),
    }
}
