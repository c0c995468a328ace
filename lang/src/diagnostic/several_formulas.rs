#![doc = include_str!("several_formulas.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `several-formulas`.
pub const RULE: Rule = Rule {
    code: "E0010",
    name: "several-formulas",
    severity: Severity::Error,
    page: include_str!("several_formulas.md"),
};

/// A second formula follows where `field` takes one.
pub fn several_formulas(field: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`{field}` takes one formula, but another one follows"), "second formula")
        .help("put them together: `(and … …)`")
}
