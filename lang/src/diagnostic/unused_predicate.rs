#![doc = include_str!("unused_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-predicate`.
pub const RULE: Rule = Rule {
    code: "W0103",
    name: "unused-predicate",
    severity: Severity::Warning,
    page: include_str!("unused_predicate.md"),
};

/// Nothing in the domain names the predicate.
pub fn unused_predicate(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("predicate `{name}` is never used"), "only declared")
        .help("remove it, or look for the place where it was meant")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn conditions_effects_and_axioms_use() {
        lint(&["(define (domain d)
  (:requirements :adl :derived-predicates)
  (:predicates (lit) (dark) (open) (seen) (broken))
;                                          ^^^^^^ W0103: predicate `broken` is never used
  (:derived (dark) (not (lit)))
  (:action press
    :parameters ()
    :precondition (open)
    :effect (when (seen) (not (open)))))
"]);
    }
}
