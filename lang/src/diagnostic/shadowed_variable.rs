#![doc = include_str!("shadowed_variable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `shadowed-variable`.
pub const RULE: Rule = Rule {
    code: "W0102",
    name: "shadowed-variable",
    severity: Severity::Warning,
    page: include_str!("shadowed_variable.md"),
};

/// The variable `name` hides one of `owner` that is bound at `outer`.
pub fn shadowed_variable(name: &str, owner: &str, span: Span, outer: Span) -> Diagnostic {
    RULE.at(span, format!("`{name}` hides another `{name}` of {owner}"), "bound again")
        .label(outer, "bound here first")
        .help("give one of them another name")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_quantifier_hides_a_parameter() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (near ?x ?y) (done))
  (:action walk
    :parameters (?x)
    :precondition (and (near ?x ?x) (forall (?x ?y) (near ?x ?y)) (forall (?y) (near ?y ?x)))
;                                            ^^ W0102: `?x` hides another `?x` of action `walk`
    :effect (done)))
"]);
    }
}
