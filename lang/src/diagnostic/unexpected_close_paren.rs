#![doc = include_str!("unexpected_close_paren.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unexpected-close-paren`.
pub const RULE: Rule = Rule {
    code: "E0002",
    name: "unexpected-close-paren",
    severity: Severity::Error,
    page: include_str!("unexpected_close_paren.md"),
};

/// A `)` closes nothing, or it closes the whole definition although another section follows.
pub fn unexpected_close_paren(span: Span, closes_definition: bool) -> Diagnostic {
    let label = if closes_definition {
        "this closes `(define`, but another section follows"
    } else {
        "nothing is open here"
    };
    RULE.at(span, "this `)` has no matching `(`", label)
        .help("remove it")
        .fix("remove this `)`", span, "")
        .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn one_that_closes_the_definition_too_early_is_dropped() {
        check(&["(define (domain d)
  (:predicates (p)))
;                  ^ E0002: this `)` has no matching `(`
  (:action a :parameters () :effect (p)))
"]);
    }

    #[test]
    fn those_after_the_end_are_reported_together() {
        check(&["(define (domain d)
  (:predicates (p)))))
;                   ^ E0002: this `)` has no matching `(`
"]);
    }
}
