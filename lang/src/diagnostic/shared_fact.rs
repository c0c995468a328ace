#![doc = include_str!("shared_fact.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `shared-fact`.
pub const RULE: Rule = Rule {
    code: "W0807",
    name: "shared-fact",
    severity: Severity::Warning,
    page: include_str!("shared_fact.md"),
};

/// Both `actions` delete `atom`, at `spans`, and add what is `made` of it; `condition` would forbid it in the first.
pub fn shared_fact(
    actions: [&str; 2],
    atom: &str,
    spans: [Span; 2],
    made: [(&str, Span); 2],
    condition: &str,
) -> Diagnostic {
    let [first, second] = actions;
    let [(one, one_span), (other, other_span)] = made;
    let (message, diagnostic);
    if first == second {
        message = format!("two agents can `{first}` with one and the same `{atom}`");
        diagnostic =
            RULE.at(spans[0], message, "both take it").label(one_span, "and each makes this of it");
    } else {
        message = format!("`{first}` and `{second}` can take one and the same `{atom}`");
        diagnostic = RULE
            .at(spans[0], message, format!("`{first}` takes it"))
            .label(one_span, format!("and makes `{one}` of it"))
            .label(spans[1], format!("`{second}` takes it too"))
            .label(other_span, format!("and makes `{other}` of it"));
    }
    diagnostic
        .help(format!("no action alone makes two of one; forbid it in `{first}`: `{condition}`"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn each_makes_something_of_it() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types cook cup shelf)
  (:predicates (free ?c - cup) (has ?a - cook ?c - cup) (on ?c - cup ?s - shelf))
  (:action take
    :agent ?a - cook
    :parameters (?c - cup)
    :precondition (free ?c)
    :effect (and (not (free ?c)) (has ?a ?c)))
;                ^^^^^^^^^^^^^^^ W0807: two agents can `take` with one and the same `(free ?c)`
;                ^^^^^^^^^^^^^^^ W0807: `take` and `store` can take one and the same `(free ?c)`
  (:action store
    :agent ?a - cook
    :parameters (?c - cup ?s - shelf)
    :precondition (forall (?b - cook ?z - shelf) (not (store ?b ?c ?z)))
    :effect (when (free ?c) (and (not (free ?c)) (on ?c ?s)))))
"]);
    }

    #[test]
    fn not_of_what_both_make_the_same_of() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm table)
  (:predicates (down ?t - table) (up ?t - table) (at ?a - arm ?t - table))
  (:action lift
    :agent ?a - arm
    :parameters (?t - table)
    :precondition (and (at ?a ?t) (down ?t) (exists (?b - arm) (and (not (= ?a ?b)) (lift ?b ?t))))
    :effect (and (not (down ?t)) (up ?t))))
"]);
    }

    #[test]
    fn not_of_what_is_of_one_agent() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types driver truck place)
  (:predicates (at ?t - truck ?p - place) (drives ?d - driver ?t - truck))
  (:action drive
    :agent ?d - driver
    :parameters (?t - truck ?from ?to - place)
    :precondition (and (drives ?d ?t) (at ?t ?from))
    :effect (and (not (at ?t ?from)) (at ?t ?to))))
"]);
    }

    #[test]
    fn a_crossing_that_falls_after_all_have_crossed() {
        lint(&["(define (domain d)
  (:requirements :typing :multi-agent)
  (:types walker place)
  (:predicates (at ?w - walker ?p - place) (bridge ?p ?q - place) (road ?p ?q - place))
  (:action walk
    :agent ?w - walker
    :parameters (?p ?q - place)
    :precondition (and (at ?w ?p) (road ?p ?q))
    :effect (and (not (at ?w ?p)) (at ?w ?q)))
  (:action cross
    :agent ?w - walker
    :parameters (?p ?q - place)
    :precondition (and (at ?w ?p) (bridge ?p ?q))
    :effect (and (not (at ?w ?p)) (at ?w ?q) (not (bridge ?p ?q)))))
"]);
    }
}
