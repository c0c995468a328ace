#![doc = include_str!("unknown_variable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-variable`.
pub const RULE: Rule = Rule {
    code: "E0102",
    name: "unknown-variable",
    severity: Severity::Error,
    page: include_str!("unknown_variable.md"),
};

/// No variable `name` is bound in `owner`; `scope` lists what is, with types.
pub fn unknown_variable(
    name: &str,
    span: Span,
    owner: &str,
    scope: &[String],
    near: Option<&str>,
) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("variable `{name}` is not bound in {owner}"), "not bound here");
    match near {
        Some(_) => diagnostic.suggest(near),
        None if scope.is_empty() => diagnostic.help("no variable is in scope"),
        None => diagnostic.help(format!("in scope: {}", scope.join(", "))),
    }
}
