#![doc = include_str!("unexpected_item.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unexpected-item`.
pub const RULE: Rule = Rule {
    code: "E0013",
    name: "unexpected-item",
    severity: Severity::Error,
    page: include_str!("unexpected_item.md"),
};

/// Something stands where `expected` should.
pub fn unexpected_item(expected: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("expected {expected}"), "found this")
}

impl Diagnostic {
    /// Says that the words at the place of the mistake probably belong to the comment above them.
    #[must_use]
    pub(crate) fn in_comment(self) -> Self {
        let span = self.primary.span;
        self.help(
            "a comment ends with its line; if this belongs to the one above, begin it with `;`",
        )
        .fix("make it a comment", Span { end: span.start, ..span }, "; ")
    }
}

/// Something is missing in or after `span`.
pub fn missing_item(expected: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("expected {expected}"), "missing here")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn names_where_lists_belong() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action
;  ^^^^^^^ E0013: expected the name of the action
    :parameters (d - dish)
;                ^ E0013: expected a variable such as `?x`
    :precondition lit
;                 ^^^ E0013: expected a formula in parentheses
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn a_problem_needs_a_goal() {
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
;                ^ E0013: expected a `(:goal …)` in the problem
  (:objects mug - )
;               ^ E0013: expected a type after `-`
  (:init lit (in mug sink)))
;        ^^^ E0013: expected a fact in parentheses
",
        ]);
    }

    #[test]
    fn tasks_stand_for_a_goal() {
        check(&[
            "(define (domain d) (:requirements :hierarchy) (:predicates (clean)) (:task tidy :parameters ()))
",
            "(define (problem p) (:domain d)
  (:htn :ordered-subtasks (and (tidy)))
  (:init))
",
        ]);
    }
}
