#![doc = include_str!("wrong_arity.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `wrong-arity`.
pub const RULE: Rule = Rule {
    code: "E0201",
    name: "wrong-arity",
    severity: Severity::Error,
    page: include_str!("wrong_arity.md"),
};

/// `what` takes `expected` arguments and is given `given`; `missing` shows the parameters that have no argument.
pub fn wrong_arity(
    what: &str,
    expected: usize,
    given: usize,
    missing: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    of(&RULE, what, (expected, given), missing, span, declared)
}

/// The same as a mistake of another kind; `count` is how many arguments are wanted and how many are given.
pub(super) fn of(
    rule: &Rule,
    what: &str,
    count: (usize, usize),
    missing: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    let (expected, given) = count;
    let plural = if expected == 1 { "" } else { "s" };
    let label = match (missing, given > expected) {
        (_, true) => format!("{} too many", given - expected),
        ("", false) => String::new(),
        (missing, false) => format!("missing argument `{missing}`"),
    };
    rule.at(span, format!("{what} takes {expected} argument{plural}, {given} given"), label)
        .label(declared, "declared here")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn too_few_and_too_many() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (in ?d)
;                 ^^^^^^^ E0201: predicate `in` takes 2 arguments, 1 given
    :effect (clean ?d sink)))
;           ^^^^^^^^^^^^^^^ E0201: predicate `clean` takes 1 argument, 2 given
"]);
    }

    #[test]
    fn in_the_initial_state() {
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
  (:init (in mug) (lit mug))
;        ^^^^^^^^ E0201: predicate `in` takes 2 arguments, 1 given
;                 ^^^^^^^^^ E0201: predicate `lit` takes 0 arguments, 1 given
  (:goal (clean mug)))
",
        ]);
    }
}
