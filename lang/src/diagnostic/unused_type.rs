#![doc = include_str!("unused_type.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-type`.
pub const RULE: Rule = Rule {
    code: "W0105",
    name: "unused-type",
    severity: Severity::Warning,
    page: include_str!("unused_type.md"),
};

/// Nothing in the domain names the type.
pub fn unused_type(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("type `{name}` is never used"), "only declared")
        .help("objects of it cannot take part in anything: remove it, or look for the place where it was meant")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn agents_share_their_types() {
        lint(&["(define (domain d)
  (:requirements :typing :multi-agent :factored-privacy)
  (:types driver package)
  (:predicates (clean ?p - package))
  (:action wash :parameters (?p - package) :effect (clean ?p)))
"]);
    }

    #[test]
    fn what_lies_above_or_below_is_used() {
        lint(&["(define (domain d)
  (:requirements :typing)
  (:types cup - dish dish - thing tool - device device place)
;                                 ^^^^ W0105: type `tool` is never used
;                                        ^^^^^^ W0105: type `device` is never used
  (:constants sink - place)
  (:predicates (clean ?d - dish))
  (:action wash :parameters (?d - dish) :effect (clean ?d)))
"]);
    }

    #[test]
    fn where_any_object_may_stand_all_are_used() {
        lint(&["(define (domain d)
  (:requirements :typing)
  (:types robot object fork knife - object)
  (:predicates (held ?o - object ?r - robot))
  (:action take :parameters (?r - robot ?o - object) :effect (held ?o ?r)))
"]);
    }
}
