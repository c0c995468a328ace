#![doc = include_str!("unknown_field.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-field`.
pub const RULE: Rule = Rule {
    code: "E0005",
    name: "unknown-field",
    severity: Severity::Error,
    page: include_str!("unknown_field.md"),
};

/// `name` is no field of `owner`, which is something like "action `drive`".
pub fn unknown_field(owner: &str, name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown field `{name}` in {owner}"), "not a field of it")
        .suggest(near)
        .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_misspelt_one_is_taken_as_the_one_meant() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :preconditions (in ?d sink)
;   ^^^^^^^^^^^^^^ E0005: unknown field `:preconditions` in action `wash`
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn far_from_any() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :colour (red)
;   ^^^^^^^ E0005: unknown field `:colour` in action `wash`
    :effect (clean ?d)))
"]);
    }
}
