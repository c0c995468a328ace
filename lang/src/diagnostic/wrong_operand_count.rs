#![doc = include_str!("wrong_operand_count.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `wrong-operand-count`.
pub const RULE: Rule = Rule {
    code: "E0401",
    name: "wrong-operand-count",
    severity: Severity::Error,
    page: include_str!("wrong_operand_count.md"),
};

/// `keyword` takes `expected` operands and is given `given`.
pub fn wrong_operand_count(keyword: &str, expected: usize, given: usize, span: Span) -> Diagnostic {
    let plural = if expected == 1 { "" } else { "s" };
    RULE.at(span, format!("`{keyword}` takes {expected} argument{plural}, {given} given"), "")
}
