#![doc = include_str!("plan_syntax.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-syntax`.
pub const RULE: Rule = Rule {
    code: "E0710",
    name: "plan-syntax",
    severity: Severity::Error,
    page: include_str!("plan_syntax.md"),
};

/// Something is no step; `fix` is a title and what to write in its place.
pub fn plan_syntax(
    message: &str,
    span: Span,
    label: &str,
    fix: Option<(&str, String)>,
) -> Diagnostic {
    let diagnostic =
        RULE.at(span, message, label).help("a plan file has one `(action object …)` for each step");
    match fix {
        Some((title, text)) => diagnostic.fix(title, span, text),
        None => diagnostic,
    }
}
