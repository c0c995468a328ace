#![doc = include_str!("never_applicable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `never-applicable`.
pub const RULE: Rule = Rule {
    code: "W0403",
    name: "never-applicable",
    severity: Severity::Warning,
    page: include_str!("never_applicable.md"),
};

/// `owner` demands the atom at `first` and its opposite at `span`.
pub fn never_applicable(owner: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("{owner} can never be applied"), "the opposite of what is demanded")
        .label(first, "demanded here")
        .help("remove one of the two")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn an_atom_and_its_opposite() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (near ?x ?y))
  (:action wash
    :parameters (?x ?y)
    :precondition (and (near ?x ?y) (not (near ?y ?x)) (and (not (near ?x ?y))))
;                                                           ^^^^^^^^^^^^^^^^^^ W0403: action `wash` can never be applied
    :effect (near ?y ?x)))
"]);
    }
}
