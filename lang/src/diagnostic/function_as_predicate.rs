#![doc = include_str!("function_as_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `function-as-predicate`.
pub const RULE: Rule = Rule {
    code: "E0205",
    name: "function-as-predicate",
    severity: Severity::Error,
    page: include_str!("function_as_predicate.md"),
};

/// The function `name`, declared at `declared`, stands where a predicate should.
pub fn function_as_predicate(name: &str, span: Span, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`{name}` is a function, not a predicate"),
        "has a number as its value, and is not true or false",
    )
    .label(declared, "declared here")
    .help("compare its value with a number, or declare a predicate")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_condition() {
        check(&["(define (domain d)
  (:requirements :adl :action-costs)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:functions (total-cost))
  (:action wash
    :parameters ()
    :precondition (total-cost)
;                  ^^^^^^^^^^ E0205: `total-cost` is a function, not a predicate
    :effect (lit)))
"]);
    }
}
