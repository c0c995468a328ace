#![doc = include_str!("unsupported_feature.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unsupported-feature`.
pub const RULE: Rule = Rule {
    code: "E0303",
    name: "unsupported-feature",
    severity: Severity::Error,
    page: include_str!("unsupported_feature.md"),
};

/// `feature` is used at `span`, and Caveat only checks it.
pub fn unsupported_feature(feature: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("{feature} cannot be planned or validated"), "used here first")
        .help("`caveat check` checks them; `caveat check --support` names planners that plan them")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::{check, run};

    #[test]
    fn once_for_each_feature() {
        run(&[
            "(define (domain d)
  (:requirements :adl :durative-actions :fluents)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:functions (water))
  (:durative-action soak :parameters (?d - dish) :duration (= ?duration 5) :effect (at end (clean ?d)))
;                   ^^^^ E0303: durative actions cannot be planned or validated
  (:durative-action dry :parameters (?d - dish) :duration (= ?duration 5) :effect (at end (clean ?d)))
  (:action wash
    :parameters (?d - dish)
    :precondition (and (>= (water) 3) (< (water) 9))
;                       ^^ E0303: numeric conditions cannot be planned or validated
    :effect (and (clean ?d) (decrease (water) 2) (assign (water) (+ (water) 1)))))
;                            ^^^^^^^^ E0303: numeric effects other than `increase` by a constant or a function cannot be planned or validated
",
        ]);
    }

    #[test]
    fn reading_alone_refuses_nothing() {
        check(&["(define (domain d)
  (:requirements :durative-actions)
  (:predicates (lit))
  (:durative-action glow :parameters () :duration (= ?duration 5) :effect (at end (lit))))
"]);
    }

    #[test]
    fn a_requirement_alone_is_no_use() {
        run(&["(define (domain d)
  (:requirements :adl :durative-actions :preferences :timed-initial-literals)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn in_a_problem() {
        run(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:functions (total-cost))
  (:action wash
    :parameters (?d - dish)
    :precondition (in ?d sink)
    :effect (clean ?d)))
",
            "(define (problem p) (:domain d)
  (:requirements :timed-initial-literals :preferences :constraints)
  (:objects mug - cup)
  (:init (at 5 (lit)) (at 7 (lit)) (= (total-cost) 0))
;            ^ E0303: timed initial literals cannot be planned or validated
  (:goal (preference nice (clean mug)))
;         ^^^^^^^^^^ E0303: preferences cannot be planned or validated
  (:constraints (always (lit)))
;  ^^^^^^^^^^^^ E0303: trajectory constraints cannot be planned or validated
  (:metric maximize (total-cost)))
;  ^^^^^^^ E0303: metrics other than `minimize` of a function without parameters cannot be planned or validated
",
        ]);
    }
}
