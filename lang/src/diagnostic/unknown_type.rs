#![doc = include_str!("unknown_type.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-type`.
pub const RULE: Rule = Rule {
    code: "E0203",
    name: "unknown-type",
    severity: Severity::Error,
    page: include_str!("unknown_type.md"),
};

/// No type `name` is declared; `place` says where it was looked for.
pub fn unknown_type(name: &str, span: Span, place: &str, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown type `{name}`"), format!("not declared in {place}"));
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help(format!("declare it: add `{name}` to `:types`")),
    }
}
