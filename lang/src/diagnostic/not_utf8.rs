#![doc = include_str!("not_utf8.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `not-utf-8`.
pub const RULE: Rule = Rule {
    code: "E0014",
    name: "not-utf-8",
    severity: Severity::Error,
    page: include_str!("not_utf8.md"),
};

/// The bytes of the file are no UTF-8 from byte `offset` on; `span` is the end of the text that could be read.
pub fn not_utf8(offset: usize, span: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("the file is not UTF-8: byte {offset} cannot be read"),
        "the text up to here can be read",
    )
    .help("save the file as UTF-8")
}
