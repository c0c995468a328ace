#![doc = include_str!("predicate_as_function.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `predicate-as-function`.
pub const RULE: Rule = Rule {
    code: "E0206",
    name: "predicate-as-function",
    severity: Severity::Error,
    page: include_str!("predicate_as_function.md"),
};

/// The predicate `name`, declared at `declared`, stands where a function should.
pub fn predicate_as_function(name: &str, span: Span, declared: Span) -> Diagnostic {
    RULE.at(span, format!("`{name}` is a predicate, not a function"), "true or false, not a value")
        .label(declared, "declared here")
        .help("declare a function in `:functions`, or use the predicate as a condition of its own")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_an_effect_and_in_an_argument() {
        check(&["(define (domain d)
  (:requirements :adl :fluents)
  (:types cup place)
  (:predicates (in ?c - cup ?p - place) (clean ?c - cup))
  (:action wash
    :parameters (?c - cup ?p - place)
    :precondition (in ?c (clean ?c))
;                         ^^^^^ E0206: `clean` is a predicate, not a function
    :effect (and (in ?c ?p) (increase (in ?c ?p) 1))))
;                                      ^^ E0206: `in` is a predicate, not a function
"]);
    }
}
