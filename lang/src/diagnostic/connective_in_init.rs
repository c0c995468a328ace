#![doc = include_str!("connective_in_init.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `connective-in-init`.
pub const RULE: Rule = Rule {
    code: "E0012",
    name: "connective-in-init",
    severity: Severity::Error,
    page: include_str!("connective_in_init.md"),
};

/// `keyword` joins facts in `:init`, which is a list of facts already.
pub fn connective_in_init(keyword: &str, span: Span) -> Diagnostic {
    let diagnostic = RULE.at(
        span,
        format!("`:init` is a list of facts; `{keyword}` is not allowed here"),
        "not a fact",
    );
    if keyword.eq_ignore_ascii_case("and") {
        diagnostic.help("remove `(and` and its closing `)`: all facts of `:init` hold together")
    } else {
        diagnostic.help("list the facts that hold; all others are false")
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn an_and_is_taken_away() {
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
  (:init (and (in mug sink) (lit)))
;         ^^^ E0012: `:init` is a list of facts; `and` is not allowed here
  (:goal (clean mug)))
",
        ]);
    }

    #[test]
    fn others_are_not() {
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
  (:init (or (in mug sink) (lit)))
;         ^^ E0012: `:init` is a list of facts; `or` is not allowed here
  (:goal (clean mug)))
",
        ]);
    }
}
