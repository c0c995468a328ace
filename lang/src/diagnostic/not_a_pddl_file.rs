#![doc = include_str!("not_a_pddl_file.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `not-a-pddl-file`.
pub const RULE: Rule = Rule {
    code: "E0003",
    name: "not-a-pddl-file",
    severity: Severity::Error,
    page: include_str!("not_a_pddl_file.md"),
};

/// What the text is, where something else was wanted.
pub fn not_a_pddl_file(
    span: Span,
    message: impl Into<String>,
    label: impl Into<String>,
    help: impl Into<String>,
) -> Diagnostic {
    RULE.at(span, message, label).help(help)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn other_text() {
        check(&[" hello (world)
;^^^^^ E0003: this is not a PDDL file
"]);
    }

    #[test]
    fn a_problem_as_the_domain() {
        check(&["(define (problem p) (:domain d) (:init (p)) (:goal (p)))
;        ^^^^^^^ E0003: this file is a problem, where a domain is expected
"]);
    }

    #[test]
    fn something_after_the_end() {
        check(&["(define (domain d) (:predicates (p)))
 (define (domain e))
;^^^^^^^^^^^^^^^^^^^ E0003: something follows after the end of the domain
"]);
    }

    #[test]
    fn a_misspelt_define_is_read_all_the_same() {
        check(&[" (defin (domain d)
;^^^^^^ E0003: this is not a PDDL file
  (:predicates (p))
  (:action a :effect (q)))
;                     ^ E0101: unknown predicate `q`
"]);
    }
}
