#![doc = include_str!("ambiguous_action.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `ambiguous-action`.
pub const RULE: Rule = Rule {
    code: "W0809",
    name: "ambiguous-action",
    severity: Severity::Warning,
    page: include_str!("ambiguous_action.md"),
};

/// `name` is that of an action and of a predicate with these numbers of arguments, declared at `spans`.
pub fn ambiguous_action(name: &str, arities: [usize; 2], spans: [Span; 2]) -> Diagnostic {
    let [action, predicate] = arities;
    let meant = if action == predicate {
        format!("`({name} …)` in a condition means the predicate, and nothing can mean the action")
    } else {
        format!(
            "`({name} …)` in a condition means the action with {action} arguments, and the predicate with {predicate}"
        )
    };
    RULE.at(spans[0], format!("`{name}` is both an action and a predicate"), "the action")
        .label(spans[1], "the predicate")
        .help(format!("rename one of them: {meant}"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn only_where_agents_act() {
        lint(&["(define (domain d)
  (:requirements :typing)
  (:types cook pot)
  (:predicates (hold ?a - cook ?p - pot))
  (:action Hold
    :parameters (?a - cook ?p - pot)
    :effect (hold ?a ?p)))
"]);
        lint(&["(define (domain d)
  (:requirements :typing :multi-agent)
  (:types cook pot)
  (:predicates (hold ?a - cook ?p - pot))
  (:action Hold
;          ^^^^ W0809: `Hold` is both an action and a predicate
    :agent ?a - cook
    :parameters (?p - pot)
    :effect (hold ?a ?p)))
"]);
    }

    #[test]
    fn with_other_arguments_only_where_the_action_is_named() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook pot)
  (:predicates (open ?p - pot) (hot ?p - pot))
  (:action open
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (not (hot ?p))
    :effect (open ?p))
  (:action hot
;          ^^^ W0809: `hot` is both an action and a predicate
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (forall (?b - cook) (not (hot ?b ?p)))
    :effect (hot ?p)))
"]);
    }
}
