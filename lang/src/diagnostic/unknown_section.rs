#![doc = include_str!("unknown_section.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-section`.
pub const RULE: Rule = Rule {
    code: "E0004",
    name: "unknown-section",
    severity: Severity::Error,
    page: include_str!("unknown_section.md"),
};

/// `(NAME …)` is no section of a `whole`, which is "domain" or "problem".
pub fn unknown_section(whole: &str, name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let label = match near {
        Some(near)
            if near.strip_prefix(':').is_some_and(|bare| bare.eq_ignore_ascii_case(name)) =>
        {
            "a section keyword starts with `:`".to_owned()
        }
        _ => format!("not a section of a {whole}"),
    };
    RULE.at(span, format!("unknown {whole} section `{name}`"), label).suggest(near)
}
