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

/// The goal at `span` wants a fact of the predicate to become true, or else false, and no action does that.
pub fn settled(predicate: &str, positive: bool, span: Span) -> Diagnostic {
    let (change, state, adds) = if positive {
        ("true", "not in `:init`", "adds")
    } else {
        ("false", "in `:init`", "deletes")
    };
    RULE.at(span, format!("nothing can make this {change}"), state)
        .help(format!("no action {adds} `{predicate}`"))
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

    #[test]
    fn what_no_action_changes_stays() {
        lint(&[
            "(define (domain d)
  (:requirements :negative-preconditions)
  (:predicates (near ?x ?y) (seen ?x) (used))
  (:action look :parameters (?x ?y) :precondition (near ?x ?y) :effect (and (seen ?y) (not (used)))))
",
            "(define (problem p) (:domain d)
  (:objects a b)
  (:init (near a b) (seen a))
  (:goal (and (near b a) (near a a) (near a b) (seen b) (not (seen a)) (not (near b b)))))
;             ^^^^^^^^^^ W0701: nothing can make this true
;                                                       ^^^^^^^^^^^^^^ W0701: nothing can make this false
",
        ]);
    }
}
