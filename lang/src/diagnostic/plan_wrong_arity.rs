#![doc = include_str!("plan_wrong_arity.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `plan-wrong-arity`.
pub const RULE: Rule = Rule {
    code: "E0712",
    name: "plan-wrong-arity",
    severity: Severity::Error,
    page: include_str!("plan_wrong_arity.md"),
};

/// `action` has as many parameters as `expected`, written out in `parameters`, and the step gives `given` arguments.
pub fn plan_wrong_arity(
    action: &str,
    (expected, given): (usize, usize),
    parameters: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    let plural = if expected == 1 { "" } else { "s" };
    let diagnostic = RULE
        .at(
            span,
            format!("`{action}` takes {expected} argument{plural}, {given} given"),
            format!("{given} here"),
        )
        .label(declared, "declared here");
    if expected == 0 {
        diagnostic
    } else {
        diagnostic.help(format!("its parameters are `{parameters}`"))
    }
}
