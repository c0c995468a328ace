#![doc = include_str!("missing_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `missing-requirement`.
pub const RULE: Rule = Rule {
    code: "W0302",
    name: "missing-requirement",
    severity: Severity::Warning,
    page: include_str!("missing_requirement.md"),
};

/// What stands at `span` needs the requirement `flag`, which is not declared.
pub fn missing_requirement(flag: &str, span: Span, what: &str) -> Diagnostic {
    RULE.at(
        span,
        format!("{what} needs the requirement `{flag}`, which is not declared"),
        "used here first",
    )
    .help(format!("add `{flag}` to `:requirements`"))
}
