#![doc = include_str!("unknown_action.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-action`.
pub const RULE: Rule = Rule {
    code: "E0109",
    name: "unknown-action",
    severity: Severity::Error,
    page: include_str!("unknown_action.md"),
};

/// No action is called `name`.
pub fn unknown_action(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("unknown action `{name}`"), "no action has this name").suggest(near)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_concurrency_constraint() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent :concurrency-network)
  (:types arm table)
  (:predicates (up ?t - table))
  (:action lift :agent ?a - arm :parameters (?t - table) :effect (up ?t))
  (:concurrency-constraint both :parameters (?t - table) :bounds (2 inf) :actions ((lfit 1))))
;                                                                                   ^^^^ E0109: unknown action `lfit`
"]);
    }
}
