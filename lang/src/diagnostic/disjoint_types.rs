#![doc = include_str!("disjoint_types.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `disjoint-types`.
pub const RULE: Rule = Rule {
    code: "W0202",
    name: "disjoint-types",
    severity: Severity::Warning,
    page: include_str!("disjoint_types.md"),
};

/// The two `terms`, one of each of `types`, are compared at `span`.
pub fn disjoint_types(terms: [&str; 2], types: [&str; 2], span: Span) -> Diagnostic {
    let message = format!("`{}` and `{}` are never the same object", terms[0], terms[1]);
    RULE.at(span, message, "always false").help(format!(
        "`{}` is a `{}` and `{}` is a `{}`, and no type lies below both",
        terms[0], types[0], terms[1], types[1]
    ))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn a_type_below_both_will_do() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish mug - cup mug - toy place)
  (:constants sink - place)
  (:predicates (near ?x ?y) (done))
  (:action walk
    :parameters (?c - cup ?p - plate ?t - toy ?e - (either place plate))
    :precondition (and (near ?c ?t) (near ?p ?e) (not (= ?c ?t)) (not (= ?e ?p)) (not (= ?c ?e)) (not (= ?p sink)))
;                                                                                     ^^^^^^^^^ W0202: `?c` and `?e` are never the same object
;                                                                                                     ^^^^^^^^^^^ W0202: `?p` and `sink` are never the same object
    :effect (done)))
"]);
    }

    #[test]
    fn what_a_constraint_says_of_agents_is_not_written() {
        lint(&["(define (domain d)
  (:requirements :typing :multi-agent :concurrency-network)
  (:types driver crane truck)
  (:predicates (at ?d - driver) (loaded ?t - truck) (open ?t - truck))
  (:action unlatch
    :agent ?d - driver
    :parameters (?t - truck)
    :precondition (at ?d)
    :effect (open ?t))
  (:action load
    :agent ?c - crane
    :parameters (?t - truck)
    :effect (and (loaded ?t) (not (open ?t))))
  (:concurrency-constraint opening :parameters (?t - truck) :bounds (1 1) :actions ((unlatch 1)))
  (:concurrency-constraint loading :parameters (?t - truck) :bounds (1 1) :actions ((load 1)))
  (:positive-dependence opening loading))
"]);
    }
}
