#![doc = include_str!("missing_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `missing-requirement`.
pub const RULE: Rule = Rule {
    code: "W0302",
    name: "missing-requirement",
    severity: Severity::Warning,
    page: include_str!("missing_requirement.md"),
};

/// What stands at `span` needs the requirement `flag`, which is not declared.
pub fn missing_requirement(flag: &str, span: Span, what: &str) -> Diagnostic {
    RULE.at(
        span,
        format!("{what} needs the requirement `{flag}`, which is not declared"),
        "used here first",
    )
    .help(format!("add `{flag}` to `:requirements`"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn once_for_each() {
        check(&[
            "(define (domain d)
  (:requirements :strips)
  (:types cup plate - dish place)
;         ^^^ W0302: a type needs the requirement `:typing`, which is not declared
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (and (not (clean ?d)) (not (lit)) (or (lit) (exists (?e - dish) (not (= ?d ?e)))))
;                       ^^^ W0302: `not` in a condition needs the requirement `:negative-preconditions`, which is not declared
;                                                    ^^ W0302: a disjunction needs the requirement `:disjunctive-preconditions`, which is not declared
;                                                              ^^^^^^ W0302: `exists` needs the requirement `:existential-preconditions`, which is not declared
;                                                                                       ^ W0302: `=` needs the requirement `:equality`, which is not declared
    :effect (forall (?e - dish) (when (clean ?d) (clean ?e)))))
;            ^^^^^^ W0302: `when` or `forall` in an effect needs the requirement `:conditional-effects`, which is not declared
",
        ]);
    }

    #[test]
    fn an_aggregate_stands_for_its_parts() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (and (not (clean ?d)) (forall (?e - dish) (imply (= ?e ?d) (exists (?p - place) (in ?e ?p)))))
    :effect (forall (?e - dish) (when (clean ?e) (lit)))))
",
        ]);
    }

    #[test]
    fn the_problem_may_declare_too() {
        check(&[
            "(define (domain d)
  (:requirements :typing)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (clean ?d)))
",
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:requirements :negative-preconditions)
  (:goal (and (not (clean mug)) (or))))
;                                ^^ W0302: a disjunction needs the requirement `:disjunctive-preconditions`, which is not declared
",
        ]);
    }

    #[test]
    fn types_are_said_in_the_domain_only() {
        check(&[
            "(define (domain d)
  (:requirements :strips)
  (:types cup)
;         ^^^ W0302: a type needs the requirement `:typing`, which is not declared
  (:predicates (clean ?c - cup))
  (:action wash :parameters (?c - cup) :effect (clean ?c)))
",
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:goal (clean mug)))
",
        ]);
    }

    #[test]
    fn a_domain_that_declares_nothing_is_asked_nothing() {
        check(&["(define (domain d)
  (:types cup)
  (:predicates (clean ?c - cup))
  (:action wash :parameters (?c - cup) :precondition (not (clean ?c)) :effect (clean ?c)))
"]);
    }
}
