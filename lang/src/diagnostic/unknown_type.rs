#![doc = include_str!("unknown_type.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-type`.
pub const RULE: Rule = Rule {
    code: "E0203",
    name: "unknown-type",
    severity: Severity::Error,
    page: include_str!("unknown_type.md"),
};

/// No type `name` is declared; `place` says where it was looked for.
pub fn unknown_type(name: &str, span: Span, place: &str, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown type `{name}`"), format!("not declared in {place}"));
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help(format!("declare it: add `{name}` to `:types`")),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn nothing_is_said_of_what_has_it() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dihs ?p - spot ?q - spot)
;                     ^^^^ E0203: unknown type `dihs`
;                               ^^^^ E0203: unknown type `spot`
    :precondition (and (in ?d ?p) (in ?d ?q))
    :effect (clean ?d)))
"]);
    }
}
