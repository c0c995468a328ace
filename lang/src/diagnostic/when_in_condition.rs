#![doc = include_str!("when_in_condition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `when-in-condition`.
pub const RULE: Rule = Rule {
    code: "E0403",
    name: "when-in-condition",
    severity: Severity::Error,
    page: include_str!("when_in_condition.md"),
};

/// `when` stands in a condition.
pub fn when_in_condition(span: Span) -> Diagnostic {
    RULE.at(span, "`when` is an effect; it is not allowed in a condition", "not a condition")
        .help("use `imply`: `(imply … …)`")
        .fix("replace with `imply`", span, "imply")
}
