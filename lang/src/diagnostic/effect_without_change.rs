#![doc = include_str!("effect_without_change.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `effect-without-change`.
pub const RULE: Rule = Rule {
    code: "W0404",
    name: "effect-without-change",
    severity: Severity::Warning,
    page: include_str!("effect_without_change.md"),
};

/// An effect adds, or else deletes, what is so already, as is demanded at `demanded`.
pub fn effect_without_change(positive: bool, span: Span, demanded: Span) -> Diagnostic {
    let state = if positive { "it holds already" } else { "it does not hold anyway" };
    RULE.at(span, "this effect changes nothing", state).label(demanded, "demanded here").help(
        "what an action does not mention stays as it is: remove it, or was the opposite meant?",
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn what_is_demanded_stays() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean ?x) (dry ?x) (new ?x) (seen ?x))
  (:action wash
    :parameters (?x ?y)
    :precondition (and (clean ?x) (not (dry ?x)) (new ?x))
    :effect (and
      (clean ?x)
;     ^^^^^^^^^^ W0404: this effect changes nothing
      (clean ?y)
      (not (dry ?x))
;     ^^^^^^^^^^^^^^ W0404: this effect changes nothing
      (when (seen ?y) (and (seen ?y) (seen ?x)))
;                          ^^^^^^^^^ W0404: this effect changes nothing
      (new ?x)
      (not (new ?y)))))
"]);
    }

    #[test]
    fn what_is_added_keeps_others_from_deleting_it() {
        lint(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm cup)
  (:predicates (full ?c - cup) (hot ?c - cup) (held ?a - arm ?c - cup))
  (:action hold
    :agent ?a - arm
    :parameters (?c - cup)
    :precondition (and (full ?c) (hot ?c))
    :effect (and (held ?a ?c) (full ?c) (hot ?c)))
;                                       ^^^^^^^^ W0404: this effect changes nothing
  (:action empty
    :agent ?a - arm
    :parameters (?c - cup)
    :precondition (held ?a ?c)
    :effect (not (full ?c))))
"]);
    }
}
