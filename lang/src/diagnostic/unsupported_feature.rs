#![doc = include_str!("unsupported_feature.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unsupported-feature`.
pub const RULE: Rule = Rule {
    code: "E0303",
    name: "unsupported-feature",
    severity: Severity::Error,
    page: include_str!("unsupported_feature.md"),
};

/// `feature` is used at `span`, and Caveat does not plan it yet.
pub fn unsupported_feature(feature: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("{feature} are not supported yet"), "used here first")
        .help("`caveat plan` does not plan this yet; what stands here is not checked either")
}
