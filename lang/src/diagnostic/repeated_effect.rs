#![doc = include_str!("repeated_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `repeated-effect`.
pub const RULE: Rule = Rule {
    code: "W0407",
    name: "repeated-effect",
    severity: Severity::Warning,
    page: include_str!("repeated_effect.md"),
};

/// The effect stands at `first` already.
pub fn repeated_effect(span: Span, first: Span) -> Diagnostic {
    RULE.at(span, "this effect stands here twice", "again here")
        .label(first, "here first")
        .help("remove one of them, or was another name meant?")
        .fix("remove it", span, "")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn under_the_same_condition() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean ?x) (lit))
  (:action wash
    :parameters (?x ?y)
    :effect (and (clean ?x) (clean ?y) (and (clean ?x))
;                                           ^^^^^^^^^^ W0407: this effect stands here twice
      (when (lit) (and (not (lit)) (not (lit)))))))
;                                  ^^^^^^^^^^^ W0407: this effect stands here twice
"]);
    }
}
