#![doc = include_str!("unknown_constraint.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-constraint`.
pub const RULE: Rule = Rule {
    code: "E0804",
    name: "unknown-constraint",
    severity: Severity::Error,
    page: include_str!("unknown_constraint.md"),
};

/// No concurrency constraint is called `name`.
pub fn unknown_constraint(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(
        span,
        format!("unknown concurrency constraint `{name}`"),
        "no `:concurrency-constraint` has this name",
    )
    .suggest(near)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_dependence() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent :concurrency-network)
  (:types arm table)
  (:predicates (up ?t - table))
  (:action lift :agent ?a - arm :parameters (?t - table) :effect (up ?t))
  (:concurrency-constraint both :parameters (?t - table) :bounds (2 inf) :actions ((lift 1)))
  (:positive-dependence both bothh))
;                            ^^^^^ E0804: unknown concurrency constraint `bothh`
"]);
    }
}
