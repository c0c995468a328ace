#![doc = include_str!("unknown_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-predicate`.
pub const RULE: Rule = Rule {
    code: "E0101",
    name: "unknown-predicate",
    severity: Severity::Error,
    page: include_str!("unknown_predicate.md"),
};

/// No predicate `name` is declared.
pub fn unknown_predicate(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown predicate `{name}`"), "not declared in `:predicates`");
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help(format!("declare it: add `({name} …)` to `:predicates`")),
    }
}

/// No predicate and no action `name` is declared; the action `near` was probably meant.
pub fn nor_action(name: &str, span: Span, near: &str) -> Diagnostic {
    let message = format!("unknown action or predicate `{name}`");
    RULE.at(span, message, "neither an action nor a predicate").suggest(Some(near))
}

/// `name` is an action, declared at `declared`, in a domain without agents.
pub fn an_action(name: &str, span: Span, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`{name}` is an action, not a predicate"),
        "not declared in `:predicates`",
    )
    .label(declared, "the action")
    .help("only where actions have an `:agent` may conditions name other actions")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn each_is_reported_once() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (and (cleen ?d) (not (cleen ?d)))
;                       ^^^^^ E0101: unknown predicate `cleen`
    :effect (wet ?d sink)))
;            ^^^ E0101: unknown predicate `wet`
"]);
    }

    #[test]
    fn a_misspelt_connective() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (nto (clean ?d))
;                  ^^^ E0101: unknown predicate `nto`
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn a_misspelt_action_where_agents_act() {
        check(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm box place)
  (:predicates (pushed ?b - box) (at ?b - box ?p - place) (pull ?b - box))
  (:action push
    :agent ?a - arm
    :parameters (?b - box ?p - place)
    :precondition (and (at ?b ?p)
      (exists (?c - arm) (psuh ?c ?b ?p))
;                         ^^^^ E0101: unknown action or predicate `psuh`
      (pushd ?b)
;      ^^^^^ E0101: unknown predicate `pushd`
      (exists (?c - arm) (pul ?b)))
;                         ^^^ E0101: unknown predicate `pul`
    :effect (pushed ?b)))
"]);
    }
}
