#![doc = include_str!("variable_in_init.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `variable-in-init`.
pub const RULE: Rule = Rule {
    code: "E0701",
    name: "variable-in-init",
    severity: Severity::Error,
    page: include_str!("variable_in_init.md"),
};

/// A variable stands where only objects can.
pub fn variable_in_init(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`:init` contains the variable `{name}`"), "not an object")
        .help("write a fact for each object for which it holds")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn once_for_each() {
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
  (:init (in ?x sink) (clean ?x))
;            ^^ E0701: `:init` contains the variable `?x`
  (:goal (clean mug)))
",
        ]);
    }
}
