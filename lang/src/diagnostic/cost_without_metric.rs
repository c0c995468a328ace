#![doc = include_str!("cost_without_metric.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `cost-without-metric`.
pub const RULE: Rule = Rule {
    code: "W0707",
    name: "cost-without-metric",
    severity: Severity::Warning,
    page: include_str!("cost_without_metric.md"),
};

/// Actions increase the function `name`, first at `increased`, and the problem at `span` has no metric.
pub fn cost_without_metric(name: &str, span: Span, increased: Span) -> Diagnostic {
    let message = format!("actions have costs, but no `:metric` asks for the least `{name}`");
    RULE.at(span, message, "every action counts as 1")
        .label(increased, "a cost")
        .help(format!("add `(:metric minimize ({name}))`"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn a_metric_counts_them() {
        lint(&[
            "(define (domain d)
  (:requirements :action-costs)
  (:predicates (lit))
  (:functions (total-cost))
  (:action press :parameters () :effect (and (lit) (increase (total-cost) 1))))
",
            "(define (problem p) (:domain d)
;                ^ W0707: actions have costs, but no `:metric` asks for the least `total-cost`
  (:init (= (total-cost) 0))
  (:goal (lit)))
",
        ]);
    }
}
