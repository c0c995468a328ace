#![doc = include_str!("repeated_fact.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `repeated-fact`.
pub const RULE: Rule = Rule {
    code: "W0703",
    name: "repeated-fact",
    severity: Severity::Warning,
    page: include_str!("repeated_fact.md"),
};

/// The fact stands at `first` already.
pub fn repeated_fact(span: Span, first: Span) -> Diagnostic {
    RULE.at(span, "this fact is listed twice", "again here")
        .label(first, "here first")
        .help("remove one of them, or was another object meant?")
        .fix("remove it", span, "")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn whatever_the_case_and_the_blanks() {
        lint(&[
            "(define (domain d)
  (:requirements :action-costs)
  (:predicates (near ?x ?y))
  (:functions (total-cost) (far ?x))
  (:action walk :parameters (?x ?y) :effect (and (near ?x ?y) (increase (total-cost) (far ?x)))))
",
            "(define (problem p) (:domain d)
  (:objects a b)
  (:init (near a b) (near b a) (not (near a a)) (near  A ; again
;                                               ^^^^^^^^^^^^^^^^ W0703: this fact is listed twice
    B) (= (far a) 1) (= (far a) 1) (= (total-cost) 0))
;                    ^^^^^^^^^^^^^ W0703: this fact is listed twice
  (:goal (near b b))
  (:metric minimize (total-cost)))
",
        ]);
    }
}
