#![doc = include_str!("unstratified_axioms.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unstratified-axioms`.
pub const RULE: Rule = Rule {
    code: "E0404",
    name: "unstratified-axioms",
    severity: Severity::Error,
    page: include_str!("unstratified_axioms.md"),
};

/// The rule `rule` for `head` negates `negated`, which depends on `head`.
pub fn unstratified_axioms(head: &str, negated: &str, span: Span, rule: Span) -> Diagnostic {
    let how = if head == negated { "itself" } else { "it in turn" };
    RULE.at(
        span,
        format!("`{head}` is derived from its own negation"),
        format!("`{negated}` is negated here and depends on {how}"),
    )
    .label(rule, format!("in this rule for `{head}`"))
    .help("let each derived predicate negate only predicates that are derived without it")
}
