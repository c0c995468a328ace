#![doc = include_str!("duplicate_definition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-definition`.
pub const RULE: Rule = Rule {
    code: "E0104",
    name: "duplicate-definition",
    severity: Severity::Error,
    page: include_str!("duplicate_definition.md"),
};

/// The `what` called `name` is declared again; `detail` may say how the two differ.
pub fn duplicate_definition(
    what: &str,
    name: &str,
    detail: &str,
    span: Span,
    first: Span,
) -> Diagnostic {
    RULE.at(span, format!("{what} `{name}` is declared twice{detail}"), "redeclared here")
        .label(first, "first declared here")
        .help("remove one of them, or rename it: names are compared without case")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn of_a_value_unless_it_is_the_same() {
        check(&[
            "(define (domain d) (:predicates (p)) (:functions (f ?x)))\n",
            "(define (problem p) (:domain d)
  (:objects a b)
  (:init (= (f a) 1) (= (f b) 2) (= (F A) 1.0) (= (f b) 3))
;                                              ^^^^^^^^^^^ E0104: the value of `f` is declared twice, as 2 and as 3
  (:goal (p)))
",
        ]);
    }

    #[test]
    fn of_all_kinds() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:predicates (lit ?x))
;               ^^^ E0104: predicate `lit` is declared twice, with 0 and with 1 arguments
  (:functions (total-cost) (total-cost) - number)
;                           ^^^^^^^^^^ E0104: function `total-cost` is declared twice
  (:action wash :effect (lit))
  (:action Wash :effect (lit)))
;          ^^^^ E0104: action `Wash` is declared twice
"]);
    }

    #[test]
    fn of_an_object_that_is_a_constant() {
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
  (:objects mug - cup sink - place)
;                     ^^^^ E0104: object `sink` is declared twice
  (:init (in mug sink))
  (:goal (clean mug)))
",
        ]);
    }
}
