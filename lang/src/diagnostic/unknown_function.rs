#![doc = include_str!("unknown_function.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-function`.
pub const RULE: Rule = Rule {
    code: "E0107",
    name: "unknown-function",
    severity: Severity::Error,
    page: include_str!("unknown_function.md"),
};

/// No function `name` is declared.
pub fn unknown_function(
    name: &str,
    span: Span,
    none_declared: bool,
    near: Option<&str>,
) -> Diagnostic {
    let label = if none_declared {
        "not declared: the domain has no `:functions`"
    } else {
        "not declared in `:functions`"
    };
    let diagnostic = RULE.at(span, format!("unknown function `{name}`"), label);
    match near {
        Some(_) => diagnostic.suggest(near),
        None if none_declared => diagnostic.help(format!("add `(:functions ({name}) - number)`")),
        None => diagnostic.help(format!("declare it: add `({name} …) - number` to `:functions`")),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_an_effect() {
        check(&["(define (domain d)
  (:requirements :adl :action-costs)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:functions (total-cost))
  (:action wash
    :parameters (?d - dish)
    :effect (and (clean ?d) (increase (total-cots) 1))))
;                                      ^^^^^^^^^^ E0107: unknown function `total-cots`
"]);
    }

    #[test]
    fn in_the_metric() {
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
  (:goal (lit))
  (:metric minimize (total-cost)))
;                    ^^^^^^^^^^ E0107: unknown function `total-cost`
",
        ]);
    }
}
