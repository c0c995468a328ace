#![doc = include_str!("contradictory_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `contradictory-effect`.
pub const RULE: Rule = Rule {
    code: "W0401",
    name: "contradictory-effect",
    severity: Severity::Warning,
    page: include_str!("contradictory_effect.md"),
};

/// The same atom is added and deleted by one effect.
pub fn contradictory_effect(atom: &str, owner: &str, span: Span, other: Span) -> Diagnostic {
    RULE.at(span, format!("{owner} both adds and deletes `{atom}`"), "")
        .label(other, "the opposite here")
        .help("the atom is true afterwards: deletes come first; remove one of them")
}
