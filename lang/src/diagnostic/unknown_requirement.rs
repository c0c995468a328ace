#![doc = include_str!("unknown_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-requirement`.
pub const RULE: Rule = Rule {
    code: "W0301",
    name: "unknown-requirement",
    severity: Severity::Warning,
    page: include_str!("unknown_requirement.md"),
};

/// PDDL has no requirement `name`.
pub fn unknown_requirement(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown requirement `{name}`"), "not a PDDL requirement")
        .suggest(near)
        .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_misspelt_one_counts() {
        check(&["(define (domain d)
  (:requirements :typing :negative-precondition :magic)
;                        ^^^^^^^^^^^^^^^^^^^^^^ W0301: unknown requirement `:negative-precondition`
;                                               ^^^^^^ W0301: unknown requirement `:magic`
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (not (clean ?d))
    :effect (clean ?d)))
"]);
    }
}
