#![doc = include_str!("repeated_condition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `repeated-condition`.
pub const RULE: Rule = Rule {
    code: "W0406",
    name: "repeated-condition",
    severity: Severity::Warning,
    page: include_str!("repeated_condition.md"),
};

/// The condition stands at `first` already.
pub fn repeated_condition(span: Span, first: Span) -> Diagnostic {
    RULE.at(span, "this condition stands here twice", "again here")
        .label(first, "here first")
        .help("remove one of them, or was another name meant?")
        .fix("remove it", span, "")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn nested_conjunctions_are_one() {
        lint(&[
            "(define (domain d)
  (:requirements :adl)
  (:predicates (clean ?x) (near ?x ?y))
  (:action wash
    :parameters (?x ?y)
    :precondition (and
      (near ?x ?y) (near ?y ?x)
      (and (not (= ?x ?y)) (NEAR ?X ?Y))
;                          ^^^^^^^^^^^^ W0406: this condition stands here twice
      (not (= ?y ?x)) (not (= ?x ?y))
;                     ^^^^^^^^^^^^^^^ W0406: this condition stands here twice
      (or (near ?x ?y) (not (clean ?x)) (not (clean ?x))))
;                                       ^^^^^^^^^^^^^^^^ W0406: this condition stands here twice
    :effect (clean ?x)))
",
            "(define (problem p) (:domain d)
  (:objects a b)
  (:init (near a b) (near b a))
  (:goal (and (clean a) (clean b) (clean a))))
;                                 ^^^^^^^^^ W0406: this condition stands here twice
",
        ]);
    }
}
