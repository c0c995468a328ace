#![doc = include_str!("impossible_action_atom.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `impossible-action-atom`.
pub const RULE: Rule = Rule {
    code: "W0808",
    name: "impossible-action-atom",
    severity: Severity::Warning,
    page: include_str!("impossible_action_atom.md"),
};

/// The action `name` never stands in a joint action where a condition asks for it; `why` says what is against it.
pub fn impossible_action_atom(name: &str, why: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("this action atom is never true: {why}"), "never true").help(format!(
        "name an agent and arguments of `{name}` that can be, or remove the action atom"
    ))
}

/// The action `name` needs a second agent, as the atom at `atom` says, and the problem has only `agent`.
pub fn alone(name: &str, agent: &str, problem: (&str, Span), atom: Span) -> Diagnostic {
    let (problem, span) = problem;
    let message =
        format!("action `{name}` needs another agent, and problem `{problem}` has only `{agent}`");
    RULE.at(span, message, "one agent only")
        .label(atom, "the other agent is needed here")
        .help(format!("add an agent to the problem: `{name}` can never be applied without"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn an_agent_does_one_thing_and_some_exclude_each_other() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook pot)
  (:predicates (hot ?p - pot) (held ?p - pot) (clean ?p - pot))
  (:action hold
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (and (not (hot ?p)) (forall (?b - cook) (not (dry ?b ?p))))
    :effect (held ?p))
  (:action scrub
    :agent ?a - cook
    :parameters (?p ?q - pot)
    :precondition (or (hold ?a ?p) (exists (?b - cook) (and (= ?b ?a) (hold ?b ?q))))
;                     ^^^^^^^^^^^^ W0808: this action atom is never true: `?a` does `scrub` in that step, and one thing at a time
;                                                                     ^^^^^^^^^^^^ W0808: this action atom is never true: `?a` does `scrub` in that step, and one thing at a time
    :effect (clean ?p))
  (:action cool
    :agent ?a - cook
    :parameters (?p ?q - pot)
    :precondition (and (hot ?p) (exists (?b - cook) (hold ?b ?p)) (exists (?b - cook) (hold ?b ?q)))
;                                                   ^^^^^^^^^^^^ W0808: this action atom is never true: `cool` and `hold` demand the opposite of one another
    :effect (not (hot ?p)))
  (:action dry
    :agent ?a - cook
    :parameters (?p - pot)
    :effect (when (exists (?b - cook) (hold ?b ?p)) (clean ?p))))
;                                     ^^^^^^^^^^^^ W0808: this action atom is never true: `hold` forbids `dry`
"]);
    }

    #[test]
    fn one_agent_is_not_enough() {
        let domain = "(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook pot)
  (:predicates (held ?p - pot) (clean ?p - pot))
  (:action hold
    :agent ?a - cook
    :parameters (?p - pot)
    :effect (held ?p))
  (:action scrub
    :agent ?a - cook
    :parameters (?p - pot)
    :precondition (exists (?b - cook) (hold ?b ?p))
    :effect (clean ?p)))
";
        lint(&[
            domain,
            "(define (problem p) (:domain d)
;                ^ W0808: action `scrub` needs another agent, and problem `p` has only `ann`
  (:objects ann - cook wok - pot)
  (:init)
  (:goal (clean wok)))
",
        ]);
        lint(&[
            domain,
            "(define (problem p) (:domain d)
  (:objects ann bob - cook wok - pot)
  (:init)
  (:goal (clean wok)))
",
        ]);
    }
}
