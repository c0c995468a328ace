#![doc = include_str!("dash_not_separated.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `dash-not-separated`.
pub const RULE: Rule = Rule {
    code: "W0007",
    name: "dash-not-separated",
    severity: Severity::Warning,
    page: include_str!("dash_not_separated.md"),
};

/// `-NAME` is read as `- NAME`.
pub fn dash_not_separated(text: &str, span: Span) -> Diagnostic {
    let name = text.strip_prefix('-').unwrap_or(text);
    RULE.at(
        span,
        format!("`{text}` is read as `- {name}`; some planners read it as one word"),
        "no space after `-`",
    )
    .help(format!("write `- {name}`"))
    .fix("insert a space after `-`", span, format!("- {name}"))
}
