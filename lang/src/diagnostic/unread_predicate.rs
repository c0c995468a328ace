#![doc = include_str!("unread_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unread-predicate`.
pub const RULE: Rule = Rule {
    code: "W0711",
    name: "unread-predicate",
    severity: Severity::Warning,
    page: include_str!("unread_predicate.md"),
};

/// Actions change the predicate, and nothing in the domain or in `problem` asks for it.
pub fn unread_predicate(name: &str, declared: Span, problem: &str) -> Diagnostic {
    RULE.at(declared, format!("predicate `{name}` is changed and never asked for"), "never read")
        .help(format!(
            "no condition names it, nor the goal of problem `{problem}`: is a condition missing?"
        ))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn the_goal_may_ask() {
        lint(&[
            "(define (domain d)
  (:requirements :negative-preconditions)
  (:predicates (warm) (lit) (seen) (open))
;               ^^^^ W0711: predicate `warm` is changed and never asked for
  (:action heat :parameters () :effect (and (warm) (not (lit)) (seen) (open)))
  (:action press :parameters () :effect (and (lit) (not (warm)) (not (open)))))
",
            "(define (problem p) (:domain d)
  (:init (open))
  (:goal (and (lit) (not (open)))))
",
        ]);
    }
}
