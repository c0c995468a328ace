#![doc = include_str!("duplicate_field.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-field`.
pub const RULE: Rule = Rule {
    code: "E0011",
    name: "duplicate-field",
    severity: Severity::Error,
    page: include_str!("duplicate_field.md"),
};

/// `field` of `owner` is given again.
pub fn duplicate_field(field: &str, owner: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("`{field}` is given twice in {owner}"), format!("second `{field}`"))
        .label(first, format!("first `{field}` here"))
        .help("merge both with `(and ...)`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn both_are_read() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d ?e - dish)
    :precondition (clean ?e)
    :precondition (in ?d sink)
;   ^^^^^^^^^^^^^ E0011: `:precondition` is given twice in action `wash`
    :effect (clean ?d)))
"]);
    }
}
