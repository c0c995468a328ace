#![doc = include_str!("identical_actions.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `identical-actions`.
pub const RULE: Rule = Rule {
    code: "W0408",
    name: "identical-actions",
    severity: Severity::Warning,
    page: include_str!("identical_actions.md"),
};

/// The action `name` is written as the action `first` is, which stands at `other`.
pub fn identical_actions(name: &str, span: Span, first: &str, other: Span) -> Diagnostic {
    RULE.at(span, format!("action `{name}` is the same as action `{first}`"), "the same once more")
        .label(other, "the first of the two")
        .help("remove one of them, or look for what was to be changed in the copy")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn but_for_the_names_of_variables() {
        lint(&["(define (domain d)
  (:requirements :typing)
  (:types cup plate)
  (:predicates (near ?x ?y - object))
  (:action go :parameters (?x ?y - cup) :effect (near ?x ?y))
  (:action come :parameters (?y ?x - cup)
;          ^^^^ W0408: action `come` is the same as action `go`
    :effect (near ?Y ?x)) ; the same
  (:action back :parameters (?x ?y - cup) :effect (near ?y ?x))
  (:action walk :parameters (?x ?y - plate) :effect (near ?x ?y)))
"]);
    }
}
