#![doc = include_str!("idle_action_atom.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `idle-action-atom`.
pub const RULE: Rule = Rule {
    code: "W0810",
    name: "idle-action-atom",
    severity: Severity::Warning,
    page: include_str!("idle_action_atom.md"),
};

/// A negative action atom of `name` is about the agent `agent`, which acts itself.
pub fn of_one_agent(name: &str, agent: &str, span: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("this action atom says nothing: `{agent}` does one thing at a time anyway"),
        "never true",
    )
    .help(format!("name another agent: `(forall (?other …) (not ({name} ?other …)))`; an action does not forbid itself"))
}

/// The action `name` makes an action atom of its own precondition true by itself.
pub fn own(name: &str, span: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("this action atom says nothing: `{name}` makes it true by itself"),
        "always true",
    )
    .help("if another agent is needed, say that it is another one: `(not (= ?agent ?other))`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn about_the_acting_agent() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook pot)
  (:predicates (held ?p - pot) (clean ?p - pot) (hot ?p - pot))
  (:action hold
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (and (not (hold ?a ?p)) (forall (?b - cook ?q - pot) (not (hold ?b ?q))))
;                           ^^^^^^^^^^^^ W0810: this action atom says nothing: `?a` does one thing at a time anyway
    :effect (held ?p))
  (:action scrub
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (forall (?b - cook) (imply (= ?a ?b) (not (hold ?b ?p))))
;                                                           ^^^^^^^^^^^^ W0810: this action atom says nothing: `?a` does one thing at a time anyway
    :effect (and (clean ?p) (when (forall (?b - cook) (not (scrub ?b ?p))) (hot ?p)))))
"]);
    }

    #[test]
    fn the_action_itself() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook pot)
  (:predicates (raised ?p - pot) (strong ?a - cook))
  (:action lift
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (exists (?b - cook) (lift ?b ?p))
;                                     ^^^^^^^^^^^^ W0810: this action atom says nothing: `lift` makes it true by itself
    :effect (raised ?p))
  (:action heave
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (exists (?b - cook) (and (strong ?b) (heave ?b ?p)))
    :effect (raised ?p))
  (:action raise
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (and (strong ?a) (exists (?b - cook) (and (not (= ?b ?a)) (raise ?b ?p))))
    :effect (raised ?p)))
"]);
    }
}
