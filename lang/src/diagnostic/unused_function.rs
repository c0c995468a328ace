#![doc = include_str!("unused_function.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-function`.
pub const RULE: Rule = Rule {
    code: "W0104",
    name: "unused-function",
    severity: Severity::Warning,
    page: include_str!("unused_function.md"),
};

/// Nothing in the domain names the function.
pub fn unused_function(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("function `{name}` is never used"), "only declared")
        .help("remove it, or look for the place where it was meant")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn costs_use_and_a_metric_may() {
        lint(&["(define (domain d)
  (:requirements :action-costs)
  (:predicates (clean ?x))
  (:functions (weight ?x) (colour ?x) (total-cost) (effort))
;                          ^^^^^^ W0104: function `colour` is never used
  (:action wash
    :parameters (?x)
    :effect (and (clean ?x) (increase (total-cost) (WEIGHT ?x)))))
"]);
    }

    #[test]
    fn a_vocabulary_is_used_by_others() {
        lint(&["(define (domain d)
  (:predicates (clean ?x))
  (:functions (weight ?x)))
"]);
    }
}
