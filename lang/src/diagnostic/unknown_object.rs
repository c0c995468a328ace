#![doc = include_str!("unknown_object.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-object`.
pub const RULE: Rule = Rule {
    code: "E0103",
    name: "unknown-object",
    severity: Severity::Error,
    page: include_str!("unknown_object.md"),
};

/// No object or constant `name` is declared; `place` says where it was looked for.
pub fn unknown_object(name: &str, span: Span, place: &str, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown object `{name}`"), format!("not declared in {place}"));
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help("declare it, or write `?` before it if it is a variable"),
    }
}
