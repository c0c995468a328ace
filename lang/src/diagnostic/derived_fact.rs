#![doc = include_str!("derived_fact.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `derived-fact`.
pub const RULE: Rule = Rule {
    code: "W0705",
    name: "derived-fact",
    severity: Severity::Warning,
    page: include_str!("derived_fact.md"),
};

/// The initial state lists a fact of the derived predicate `name`.
pub fn derived_fact(name: &str, span: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`:init` lists a fact of `{name}`, which rules derive"),
        "not for `:init`",
    )
    .help("it is taken to hold in every state, and planners disagree on that: let a rule derive it")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn once_for_each_predicate() {
        lint(&[
            "(define (domain d)
  (:requirements :derived-predicates)
  (:predicates (dark ?x) (off ?x))
  (:derived (dark ?x) (off ?x))
  (:action press :parameters (?x) :effect (off ?x)))
",
            "(define (problem p) (:domain d)
  (:objects a b c)
  (:init (DARK a) (dark b) (off b))
;        ^^^^^^^^ W0705: `:init` lists a fact of `DARK`, which rules derive
  (:goal (dark c)))
",
        ]);
    }
}
