#![doc = include_str!("domain_name_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `domain-name-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0106",
    name: "domain-name-mismatch",
    severity: Severity::Error,
    page: include_str!("domain_name_mismatch.md"),
};

/// The problem names the domain `asked`, but the domain at hand is called `name` and is declared at `declared`.
pub fn domain_name_mismatch(asked: &str, span: Span, name: &str, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("the problem is for domain `{asked}`, but the domain file defines `{name}`"),
        "no such domain",
    )
    .label(declared, "the domain is named here")
    .suggest(Some(name))
}
