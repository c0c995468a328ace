#![doc = include_str!("action_atom_arity.md")]

use super::{Diagnostic, Rule, Severity, wrong_arity};
use crate::source::Span;

/// The kind `action-atom-arity`.
pub const RULE: Rule = Rule {
    code: "E0801",
    name: "action-atom-arity",
    severity: Severity::Error,
    page: include_str!("action_atom_arity.md"),
};

/// The action `name` has another number of arguments than is given; `count` is both, `all` shows the declaration.
pub fn action_atom_arity(
    name: &str,
    count: (usize, usize),
    missing: &str,
    all: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    wrong_arity::of(&RULE, &format!("action `{name}`"), count, missing, span, declared)
        .help(format!("declared as `{all}`; the agent is the first argument"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn without_the_agent() {
        check(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm table)
  (:predicates (up ?t - table) (free ?a - arm))
  (:action lift
    :agent ?a - arm
    :parameters (?t - table)
    :precondition (and (free ?a) (exists (?b - arm) (and (not (= ?a ?b)) (lift ?t))))
;                                                                        ^^^^^^^^^ E0801: action `lift` takes 2 arguments, 1 given
    :effect (up ?t)))
"]);
    }

    #[test]
    fn types_are_checked_too() {
        check(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm table)
  (:predicates (up ?t - table) (free ?a - arm))
  (:action lift
    :agent ?a - arm
    :parameters (?t - table)
    :precondition (and (free ?a) (exists (?b - arm) (and (not (= ?a ?b)) (lift ?t ?b))))
;                                                                              ^^ E0202: `?t` is of type `table`, but action `lift` takes `arm` here
    :effect (up ?t)))
"]);
    }
}
