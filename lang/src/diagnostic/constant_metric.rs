#![doc = include_str!("constant_metric.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `constant-metric`.
pub const RULE: Rule = Rule {
    code: "W0706",
    name: "constant-metric",
    severity: Severity::Warning,
    page: include_str!("constant_metric.md"),
};

/// No action changes the function that the metric names.
pub fn constant_metric(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("no action changes `{name}`"), "the same for every plan")
        .help("name the function that actions increase, or give them their `(increase …)`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn another_function_is_increased() {
        lint(&[
            "(define (domain d)
  (:requirements :action-costs)
  (:predicates (lit))
  (:functions (total-cost) (effort))
  (:action press :parameters () :effect (and (lit) (increase (effort) 1))))
",
            "(define (problem p) (:domain d)
  (:init (= (total-cost) 0) (= (effort) 0))
  (:goal (lit))
  (:metric minimize (total-cost)))
;                   ^^^^^^^^^^^^ W0706: no action changes `total-cost`
",
        ]);
    }
}
