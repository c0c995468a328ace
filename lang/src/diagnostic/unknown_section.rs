#![doc = include_str!("unknown_section.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-section`.
pub const RULE: Rule = Rule {
    code: "E0004",
    name: "unknown-section",
    severity: Severity::Error,
    page: include_str!("unknown_section.md"),
};

/// `(NAME …)` is no section of a `whole`, which is "domain" or "problem".
pub fn unknown_section(whole: &str, name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let label = match near {
        Some(near)
            if near.strip_prefix(':').is_some_and(|bare| bare.eq_ignore_ascii_case(name)) =>
        {
            "a section keyword starts with `:`".to_owned()
        }
        _ => format!("not a section of a {whole}"),
    };
    RULE.at(span, format!("unknown {whole} section `{name}`"), label).suggest(near).safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_misspelt_one_is_taken_as_the_one_meant() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:acton wash :parameters (?d - dish) :effect (clean ?d)))
;  ^^^^^^ E0004: unknown domain section `:acton`
"]);
    }

    #[test]
    fn without_its_colon() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (action wash :parameters (?d - dish) :effect (clean ?d)))
;  ^^^^^^ E0004: unknown domain section `action`
"]);
    }

    #[test]
    fn of_a_problem() {
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
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:inti (in mug sink))
;  ^^^^^ E0004: unknown problem section `:inti`
  (:goal (clean mug)))
",
        ]);
    }

    #[test]
    fn far_from_any() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:nonsense (whatever)))
;  ^^^^^^^^^ E0004: unknown domain section `:nonsense`
"]);
    }
}
