#![doc = include_str!("derived_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `derived-effect`.
pub const RULE: Rule = Rule {
    code: "E0405",
    name: "derived-effect",
    severity: Severity::Error,
    page: include_str!("derived_effect.md"),
};

/// An action called `action` changes the predicate `name`, which the rule at `rule` derives.
pub fn derived_effect(action: &str, name: &str, span: Span, rule: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("action `{action}` changes `{name}`, which is derived"),
        "only rules decide when it holds",
    )
    .label(rule, "derived here")
    .help("change what the rule depends on, or give the two predicates different names")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn an_addition_and_a_deletion() {
        check(&["(define (domain d)
  (:requirements :derived-predicates)
  (:predicates (hot) (on))
  (:action cool :effect (and (not (on)) (not (hot))))
;                                       ^^^^^^^^^^^ E0405: action `cool` changes `hot`, which is derived
  (:action heat :effect (and (on) (hot)))
;                                 ^^^^^ E0405: action `heat` changes `hot`, which is derived
  (:derived (hot) (on)))
"]);
    }
}
