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

/// The function `name`, with `parameters` or without, is used at `span` and has no initial value; `here` says whether that is in the problem.
pub fn uninitialised_function(name: &str, parameters: bool, span: Span, here: bool) -> Diagnostic {
    let shown = if parameters { format!("({name} …)") } else { format!("({name})") };
    let label = if here { "used here" } else { "used here, and no effect assigns it a value" };
    RULE.at(span, format!("`{shown}` has no initial value"), label)
        .help(format!("add `(= {shown} 0)` to `:init`"))
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

    #[test]
    fn a_condition_has_no_value() {
        check(&[
            "(define (domain d)
  (:requirements :fluents)
  (:predicates (clean))
  (:functions (water) (soap) (heat))
  (:action wash
    :precondition (and (>= (water) 3) (< (soap) 5) (= (heat) 1))
;                          ^^^^^^^ W0501: `(water)` has no initial value
    :effect (and (clean) (assign (soap) 2))))
",
            "(define (problem p) (:domain d)
  (:init (= (heat) 0))
  (:goal (clean)))
",
        ]);
    }
}
