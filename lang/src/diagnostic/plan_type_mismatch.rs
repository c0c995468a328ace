#![doc = include_str!("plan_type_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-type-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0714",
    name: "plan-type-mismatch",
    severity: Severity::Error,
    page: include_str!("plan_type_mismatch.md"),
};

/// `object` is of type `found`, but the parameter `parameter` of `action` wants `wanted`.
pub fn plan_type_mismatch(
    (object, found): (&str, &str),
    (action, parameter, wanted): (&str, &str, &str),
    span: Span,
    declared: Span,
) -> Diagnostic {
    RULE.at(
        span,
        format!("`{object}` is of type `{found}`, not `{wanted}`"),
        format!("`{action}` takes type `{wanted}` here"),
    )
    .label(declared, format!("`{parameter}` is declared here"))
}
