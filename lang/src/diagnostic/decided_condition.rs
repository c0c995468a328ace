#![doc = include_str!("decided_condition.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `decided-condition`.
pub const RULE: Rule = Rule {
    code: "W0409",
    name: "decided-condition",
    severity: Severity::Warning,
    page: include_str!("decided_condition.md"),
};

/// The condition at `span` holds whenever the action is applied, by what is demanded at `demanded`.
pub fn always(span: Span, demanded: Span) -> Diagnostic {
    RULE.at(span, "the condition of this effect always holds", "always true")
        .label(demanded, "demanded here")
        .help("write the effect without `when`, or was another name meant?")
}

/// The condition at `span` never holds when the action is applied, by what is demanded at `demanded`.
pub fn never(span: Span, demanded: Span) -> Diagnostic {
    RULE.at(span, "the condition of this effect never holds", "always false")
        .label(demanded, "the opposite is demanded here")
        .help("the effect never happens: remove it, or was another name meant?")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn by_the_precondition() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean ?x) (dry ?x) (seen ?x))
  (:action wipe
    :parameters (?x ?y)
    :precondition (and (clean ?x) (clean ?y) (not (dry ?x)))
    :effect (and
      (when (and (clean ?x) (clean ?y)) (dry ?x))
;                ^^^^^^^^^^^^^^^^^^^^^ W0409: the condition of this effect always holds
      (when (and (seen ?y) (dry ?x)) (seen ?x))
;                          ^^^^^^^^ W0409: the condition of this effect never holds
      (when (and (clean ?x) (seen ?x)) (dry ?y))
      (when (not (seen ?x)) (dry ?y)))))
"]);
    }
}
