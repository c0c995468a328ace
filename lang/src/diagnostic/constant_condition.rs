#![doc = include_str!("constant_condition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `constant-condition`.
pub const RULE: Rule = Rule {
    code: "W0402",
    name: "constant-condition",
    severity: Severity::Warning,
    page: include_str!("constant_condition.md"),
};

/// What stands at `span` always has the same truth value.
pub fn constant_condition(value: bool, span: Span) -> Diagnostic {
    RULE.at(span, format!("this condition is always {value}"), "in every state")
        .help("remove it, or name what was meant")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn equalities_and_empty_disjunctions() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:constants sink table)
  (:predicates (near ?x ?y))
  (:action wash
    :parameters (?x ?y)
    :precondition (and (not (= ?x ?y)) (or (= sink table) (= ?y ?y)))
;                                          ^^^^^^^^^^^^^^ W0402: this condition is always false
;                                                         ^^^^^^^^^ W0402: this condition is always true
    :effect (when (or) (near ?x ?y))))
;                 ^^^^ W0402: this condition is always false
"]);
    }
}
