#![doc = include_str!("several_formulas.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `several-formulas`.
pub const RULE: Rule = Rule {
    code: "E0010",
    name: "several-formulas",
    severity: Severity::Error,
    page: include_str!("several_formulas.md"),
};

/// A second formula follows where `field` takes one.
pub fn several_formulas(field: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`{field}` takes one formula, but another one follows"), "second formula")
        .help("put them together: `(and … …)`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn two_goals() {
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
  (:goal (clean mug) (in mug sink)))
;                    ^^^^^^^^^^^^^ E0010: `:goal` takes one formula, but another one follows
",
        ]);
    }

    #[test]
    fn two_effects() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (clean ?d)
            (lit)))
;           ^^^^^ E0010: `:effect` takes one formula, but another one follows
"]);
    }
}
