#![doc = include_str!("contradictory_fact.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `contradictory-fact`.
pub const RULE: Rule = Rule {
    code: "W0704",
    name: "contradictory-fact",
    severity: Severity::Warning,
    page: include_str!("contradictory_fact.md"),
};

/// The fact, or its opposite, stands at `first` already.
pub fn contradictory_fact(span: Span, first: Span) -> Diagnostic {
    let message = "this fact is said to hold and not to hold";
    RULE.at(span, message, "the opposite of what is said before")
        .label(first, "said here first")
        .help("remove one of them; what `:init` does not list is false")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn in_any_order() {
        lint(&[
            "(define (domain d)
  (:predicates (lit) (open))
  (:action press :parameters () :precondition (open) :effect (not (lit))))
",
            "(define (problem p) (:domain d)
  (:init (not (lit)) (lit) (open) (not (open)))
;                    ^^^^^ W0704: this fact is said to hold and not to hold
;                                 ^^^^^^^^^^^^ W0704: this fact is said to hold and not to hold
  (:goal (lit)))
;        ^^^^^ W0702: the goal already holds in the initial state
",
        ]);
    }
}
