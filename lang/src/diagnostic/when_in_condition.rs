#![doc = include_str!("when_in_condition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `when-in-condition`.
pub const RULE: Rule = Rule {
    code: "E0403",
    name: "when-in-condition",
    severity: Severity::Error,
    page: include_str!("when_in_condition.md"),
};

/// `when` stands in a condition.
pub fn when_in_condition(span: Span) -> Diagnostic {
    RULE.at(span, "`when` is an effect; it is not allowed in a condition", "not a condition")
        .help("use `imply`: `(imply … …)`")
        .fix("replace with `imply`", span, "imply")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_precondition() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (when (lit) (clean ?d))
;                  ^^^^ E0403: `when` is an effect; it is not allowed in a condition
    :effect (clean ?d)))
"]);
    }
}
