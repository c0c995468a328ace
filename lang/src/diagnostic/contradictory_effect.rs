#![doc = include_str!("contradictory_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `contradictory-effect`.
pub const RULE: Rule = Rule {
    code: "W0401",
    name: "contradictory-effect",
    severity: Severity::Warning,
    page: include_str!("contradictory_effect.md"),
};

/// The same atom is added and deleted by one effect.
pub fn contradictory_effect(atom: &str, owner: &str, span: Span, other: Span) -> Diagnostic {
    RULE.at(span, format!("{owner} both adds and deletes `{atom}`"), "")
        .label(other, "the opposite here")
        .help("the atom is true afterwards: deletes come first; remove one of them")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn the_same_atom_under_the_same_condition() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d ?e - dish)
    :effect (and (clean ?d) (not (clean ?e)) (not (clean ?d)))))
;                                            ^^^^^^^^^^^^^^^^ W0401: action `wash` both adds and deletes `(clean ?d)`
",
        ]);
    }

    #[test]
    fn other_conditions_are_other_effects() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (and (clean ?d) (when (lit) (not (clean ?d))))))
"]);
    }

    #[test]
    fn an_agent_holds_what_it_gives_back() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent)
  (:types rover channel)
  (:predicates (free ?c - channel) (ready ?r - rover) (told ?r - rover))
  (:action tell
    :agent ?r - rover
    :parameters (?c - channel)
    :precondition (and (free ?c) (ready ?r))
    :effect (and (not (free ?c)) (not (ready ?r)) (told ?r) (free ?c) (ready ?r))))
;                                                                     ^^^^^^^^^^ W0401: action `tell` both adds and deletes `(ready ?r)`
"]);
    }
}
