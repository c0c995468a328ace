#![doc = include_str!("domain_name_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `domain-name-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0106",
    name: "domain-name-mismatch",
    severity: Severity::Error,
    page: include_str!("domain_name_mismatch.md"),
};

/// The problem names the domain `asked`, but the domain at hand is called `name` and is declared at `declared`.
pub fn domain_name_mismatch(asked: &str, span: Span, name: &str, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("the problem is for domain `{asked}`, but the domain file defines `{name}`"),
        "no such domain",
    )
    .label(declared, "the domain is named here")
    .suggest(Some(name))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn names_differ() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (in ?d sink)
    :effect (clean ?d)))
",
            "(define (problem p) (:domain dd)
;                            ^^ E0106: the problem is for domain `dd`, but the domain file defines `d`
  (:goal (lit)))
",
        ]);
    }

    #[test]
    fn case_does_not_matter() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (in ?d sink)
    :effect (clean ?d)))
",
            "(define (problem p) (:domain D)
  (:goal (lit)))
",
        ]);
    }
}
