#![doc = include_str!("uninitialised_function.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `uninitialised-function`.
pub const RULE: Rule = Rule {
    code: "W0501",
    name: "uninitialised-function",
    severity: Severity::Warning,
    page: include_str!("uninitialised_function.md"),
};

/// `(NAME)` is used in `:metric` and has no initial value.
pub fn uninitialised_function(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`({name})` has no initial value"), "used in `:metric`")
        .help(format!("add `(= ({name}) 0)` to `:init`"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn the_metric_has_no_value() {
        check(&[
            "(define (domain d)
  (:requirements :adl :action-costs)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:functions (total-cost))
  (:action wash
    :parameters (?d - dish)
    :effect (and (clean ?d) (increase (total-cost) 1))))
",
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:goal (clean mug))
  (:metric minimize (total-cost)))
;                   ^^^^^^^^^^^^ W0501: `(total-cost)` has no initial value
",
        ]);
    }
}
