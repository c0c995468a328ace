#![doc = include_str!("unused_variable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-variable`.
pub const RULE: Rule = Rule {
    code: "W0106",
    name: "unused-variable",
    severity: Severity::Warning,
    page: include_str!("unused_variable.md"),
};

/// A quantifier of `owner` binds the variable `name` in vain.
pub fn unused_variable(name: &str, owner: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("variable `{name}` of {owner} is never used"), "bound here in vain").help(
        "what is said is the same for every object: was another variable meant, or can it go?",
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn in_conditions_effects_rules_and_goals() {
        lint(&["(define (domain d)
  (:requirements :adl :derived-predicates)
  (:predicates (near ?x ?y) (lit) (dark))
  (:derived (dark) (forall (?x ?y) (not (near ?x ?x))))
;                              ^^ W0106: variable `?y` of the rule for `dark` is never used
  (:action walk
    :parameters (?a)
    :precondition (and (exists (?x) (near ?a ?x)) (exists (?x) (near ?a ?a)))
;                                                          ^^ W0106: variable `?x` of action `walk` is never used
    :effect (and (forall (?x) (near ?x ?a)) (forall (?z) (when (dark) (lit))))))
;                                                    ^^ W0106: variable `?z` of action `walk` is never used
",
"(define (problem p) (:domain d)
  (:objects a)
  (:init (near a a))
  (:goal (and (lit) (forall (?x ?y) (near ?y ?y)))))
;                            ^^ W0106: variable `?x` of the goal is never used
"]);
    }

    #[test]
    fn one_that_is_hidden_has_been_reported() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (near ?x ?y) (lit))
  (:action walk
    :parameters ()
    :precondition (forall (?x) (exists (?x) (near ?x ?x)))
;                                       ^^ W0102: `?x` hides another `?x` of action `walk`
    :effect (lit)))
"]);
    }
}
