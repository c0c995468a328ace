#![doc = include_str!("contradictory_goal.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `contradictory-goal`.
pub const RULE: Rule = Rule {
    code: "W0708",
    name: "contradictory-goal",
    severity: Severity::Warning,
    page: include_str!("contradictory_goal.md"),
};

/// The goal demands the atom at `first` and its opposite at `span`.
pub fn contradictory_goal(span: Span, first: Span) -> Diagnostic {
    RULE.at(span, "the goal can never be met", "the opposite of what is demanded")
        .label(first, "demanded here")
        .help("remove one of the two")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn an_atom_and_its_opposite() {
        lint(&[
            "(define (domain d)
  (:requirements :negative-preconditions)
  (:predicates (lit) (open))
  (:action press :parameters () :effect (and (lit) (open))))
",
            "(define (problem p) (:domain d)
  (:init)
  (:goal (and (not (lit)) (open) (lit))))
;                                ^^^^^ W0708: the goal can never be met
",
        ]);
    }
}
