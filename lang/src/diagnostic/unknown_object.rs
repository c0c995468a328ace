#![doc = include_str!("unknown_object.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-object`.
pub const RULE: Rule = Rule {
    code: "E0103",
    name: "unknown-object",
    severity: Severity::Error,
    page: include_str!("unknown_object.md"),
};

/// No object or constant `name` is declared; `place` says where it was looked for.
pub fn unknown_object(name: &str, span: Span, place: &str, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown object `{name}`"), format!("not declared in {place}"));
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help("declare it, or write `?` before it if it is a variable"),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_the_initial_state_and_the_goal() {
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
  (:init (in mug tabel) (in pot sink) (clean pot))
;                ^^^^^ E0103: unknown object `tabel`
;                           ^^^ E0103: unknown object `pot`
  (:goal (clean mog)))
;               ^^^ E0103: unknown object `mog`
",
        ]);
    }

    #[test]
    fn a_variable_without_its_question_mark() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (clean d)))
;                  ^ E0103: unknown object `d`
"]);
    }
}
