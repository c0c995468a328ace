#![doc = include_str!("conflicting_effects.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `conflicting-effects`.
pub const RULE: Rule = Rule {
    code: "W0806",
    name: "conflicting-effects",
    severity: Severity::Warning,
    page: include_str!("conflicting_effects.md"),
};

/// The first of `actions` adds `atom` and the second deletes it, at `spans`; `condition` would say so in the first.
pub fn conflicting_effects(
    actions: [&str; 2],
    atom: &str,
    spans: [Span; 2],
    condition: &str,
) -> Diagnostic {
    let [adds, deletes] = actions;
    let whose = if adds == deletes {
        format!("two agents never `{adds}` in one step")
    } else {
        format!("`{adds}` and `{deletes}` are never taken in one step")
    };
    let message = format!("{whose}: one adds `{atom}`, and the other deletes it");
    let label = format!("deleted here by `{deletes}`");
    RULE.at(spans[0], message, format!("added here by `{adds}`")).label(spans[1], label).help(
        format!("if they are to exclude each other, demand it in `{adds}`: `{condition}`; otherwise remove one of the effects"),
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn what_one_adds_another_deletes() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook cup)
  (:predicates (clean ?c - cup) (full ?c - cup) (wet ?a - cook))
  (:action wash
    :agent ?a - cook
    :parameters (?c - cup)
    :precondition (not (wash ?a ?c))
;                      ^^^^^^^^^^^^ W0810: this action atom says nothing: `?a` does one thing at a time anyway
    :effect (and (clean ?c) (wet ?a)))
;                ^^^^^^^^^^ W0806: `wash` and `fill` are never taken in one step: one adds `(clean ?c)`, and the other deletes it
  (:action fill
    :agent ?a - cook
    :parameters (?c - cup)
    :precondition (clean ?c)
    :effect (and (full ?c) (not (clean ?c)) (not (wet ?a)))))
"]);
    }

    #[test]
    fn not_of_what_cannot_be_together() {
        let domain = |wash: &str, fill: &str| {
            format!(
                "(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook cup)
  (:predicates (clean ?c - cup) (full ?c - cup) (dirty ?c - cup))
  (:action wash
    :agent ?a - cook
    :parameters (?c - cup)
    :precondition {wash}
    :effect (and (clean ?c) (not (dirty ?c))))
  (:action fill
    :agent ?a - cook
    :parameters (?c - cup)
    :precondition (and (clean ?c) {fill})
    :effect (and (full ?c) (not (clean ?c)))))
"
            )
        };
        // They demand the opposite of one another, or facts of which only one holds.
        lint(&[&domain("(full ?c)", "(not (full ?c))")]);
        lint(&[&domain("(dirty ?c)", "(and)")]);
        // One of them forbids the other.
        lint(&[&domain("(forall (?b - cook) (not (fill ?b ?c)))", "(and)")]);
        lint(&[&domain("(full ?c)", "(forall (?b - cook) (imply (wash ?b ?c) (= ?a ?b)))")]);
        // One adds what it demands, which keeps it from the other.
        lint(&[&domain("(and (clean ?c) (full ?c))", "(and)")]);
    }
}
