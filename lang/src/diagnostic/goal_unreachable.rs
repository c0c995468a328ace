#![doc = include_str!("goal_unreachable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `goal-unreachable`.
pub const RULE: Rule = Rule {
    code: "W0701",
    name: "goal-unreachable",
    severity: Severity::Warning,
    page: include_str!("goal_unreachable.md"),
};

/// The predicate is never true in the problem; `needed` says who needs it.
pub fn never_true(predicate: &str, problem: &str, declared: Span, needed: &str) -> Diagnostic {
    let message = format!(
        "predicate `{predicate}` is never added by any action nor in `:init` of problem `{problem}`"
    );
    RULE.at(declared, message, "always false").help(needed)
}

/// The goal at `span` needs the predicate, and no action that adds it can be applied.
pub fn out_of_reach(predicate: &str, span: Span) -> Diagnostic {
    let message = format!("the goal needs `{predicate}`, which nothing can make true");
    RULE.at(span, message, "out of reach")
        .help("every action that adds it needs something that needs it first")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn the_cause_is_said_once() {
        lint(&[
            "(define (domain d)
  (:predicates (open) (lit) (seen))
;               ^^^^ W0701: predicate `open` is never added by any action nor in `:init` of problem `p`
  (:action press :parameters () :precondition (open) :effect (lit))
  (:action look :parameters () :precondition (lit) :effect (seen)))
",
            "(define (problem p) (:domain d)
  (:init)
  (:goal (seen)))
",
        ]);
    }

    #[test]
    fn what_needs_itself() {
        lint(&[
            "(define (domain d)
  (:predicates (open) (lit))
  (:action press :parameters () :precondition (open) :effect (lit))
  (:action push :parameters () :precondition (lit) :effect (open)))
",
            "(define (problem p) (:domain d)
  (:init)
  (:goal (lit)))
;        ^^^^^ W0701: the goal needs `lit`, which nothing can make true
",
        ]);
    }

    #[test]
    fn axioms_add_too() {
        lint(&[
            "(define (domain d)
  (:requirements :derived-predicates)
  (:predicates (open) (lit))
  (:derived (lit) (open))
  (:action push :parameters () :effect (open)))
",
            "(define (problem p) (:domain d)
  (:init)
  (:goal (lit)))
",
        ]);
    }
}
