#![doc = include_str!("type_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `type-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0202",
    name: "type-mismatch",
    severity: Severity::Error,
    page: include_str!("type_mismatch.md"),
};

/// `term` is of type `found`, but `what` wants `wanted` there, as declared.
pub fn type_mismatch(
    term: &str,
    found: &str,
    what: &str,
    wanted: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    RULE.at(
        span,
        format!("`{term}` is of type `{found}`, but {what} takes `{wanted}` here"),
        format!("expected `{wanted}`"),
    )
    .label(declared, "declared here")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn arguments_in_the_wrong_order() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (in sink ?d)
;                     ^^^^ E0202: `sink` is of type `place`, but predicate `in` takes `dish` here
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn in_the_goal() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (in ?d sink)
    :effect (clean ?d)))
",
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:init (clean sink))
;               ^^^^ E0202: `sink` is of type `place`, but predicate `clean` takes `dish` here
  (:goal (in mug mug)))
;                ^^^ E0202: `mug` is of type `cup`, but predicate `in` takes `place` here
",
        ]);
    }

    #[test]
    fn one_of_several_types_does_not_fit() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - (either cup place))
    :effect (clean ?d)))
;                  ^^ E0202: `?d` is of type `(either cup place)`, but predicate `clean` takes `dish` here
",
        ]);
    }
}
