#![doc = include_str!("goal_already_true.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `goal-already-true`.
pub const RULE: Rule = Rule {
    code: "W0702",
    name: "goal-already-true",
    severity: Severity::Warning,
    page: include_str!("goal_already_true.md"),
};

/// The goal at `span` holds already.
pub fn goal_already_true(span: Span) -> Diagnostic {
    RULE.at(span, "the goal already holds in the initial state", "nothing needs to be done")
        .help("the plan for this problem is empty")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn all_of_it_must_hold() {
        let domain = "(define (domain d)
  (:requirements :negative-preconditions)
  (:predicates (open) (lit))
  (:action press :parameters () :precondition (not (open)) :effect (and (lit) (open))))
";
        lint(&[
            domain,
            "(define (problem p) (:domain d)
  (:init (lit))
  (:goal (and (lit) (not (open)))))
;        ^^^^^^^^^^^^^^^^^^^^^^^^ W0702: the goal already holds in the initial state
",
        ]);
        lint(&[
            domain,
            "(define (problem p) (:domain d)
  (:init (lit))
  (:goal (and (lit) (open))))
",
        ]);
    }
}
