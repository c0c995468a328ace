#![doc = include_str!("action_without_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `action-without-effect`.
pub const RULE: Rule = Rule {
    code: "W0405",
    name: "action-without-effect",
    severity: Severity::Warning,
    page: include_str!("action_without_effect.md"),
};

/// The action has a precondition and no effect.
pub fn action_without_effect(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("action `{name}` changes nothing"), "no effect")
        .help("no plan needs it: add its `:effect`, or remove the action")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn left_out_or_empty() {
        lint(&["(define (domain d)
  (:requirements :action-costs)
  (:predicates (lit))
  (:functions (total-cost))
  (:action look :parameters () :precondition (lit))
;          ^^^^ W0405: action `look` changes nothing
  (:action stare :parameters () :precondition (lit) :effect (and ()))
;          ^^^^^ W0405: action `stare` changes nothing
  (:action wait :parameters () :precondition () :effect ())
  (:action rest :parameters () :precondition (lit) :effect (increase (total-cost) 1))
  (:action press :parameters () :effect (lit)))
"]);
    }
}
