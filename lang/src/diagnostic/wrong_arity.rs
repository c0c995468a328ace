#![doc = include_str!("wrong_arity.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `wrong-arity`.
pub const RULE: Rule = Rule {
    code: "E0201",
    name: "wrong-arity",
    severity: Severity::Error,
    page: include_str!("wrong_arity.md"),
};

/// `what` takes `expected` arguments and is given `given`; `missing` shows the parameters that have no argument.
pub fn wrong_arity(
    what: &str,
    expected: usize,
    given: usize,
    missing: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    let plural = if expected == 1 { "" } else { "s" };
    let label = match (missing, given > expected) {
        (_, true) => format!("{} too many", given - expected),
        ("", false) => String::new(),
        (missing, false) => format!("missing argument `{missing}`"),
    };
    RULE.at(span, format!("{what} takes {expected} argument{plural}, {given} given"), label)
        .label(declared, "declared here")
}
