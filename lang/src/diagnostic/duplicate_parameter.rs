#![doc = include_str!("duplicate_parameter.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `duplicate-parameter`.
pub const RULE: Rule = Rule {
    code: "E0105",
    name: "duplicate-parameter",
    severity: Severity::Error,
    page: include_str!("duplicate_parameter.md"),
};

/// The variable `name` stands twice in the list of `owner`.
pub fn duplicate_parameter(name: &str, owner: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("parameter `{name}` is given twice in {owner}"), "second time")
        .label(first, "first time")
        .help("rename one of them")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_parameters() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d ?D - dish)
;                   ^^ E0105: parameter `?D` is given twice in action `wash`
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn in_a_declaration_it_does_no_harm() {
        check(&[
            "(define (domain d) (:predicates (p ?x ?x)) (:action a :parameters (?x) :effect (p ?x ?x)))
",
        ]);
    }
}
