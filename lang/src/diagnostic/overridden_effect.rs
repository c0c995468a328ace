#![doc = include_str!("overridden_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `overridden-effect`.
pub const RULE: Rule = Rule {
    code: "W0411",
    name: "overridden-effect",
    severity: Severity::Warning,
    page: include_str!("overridden_effect.md"),
};

/// The effect at `span` happens anyway, at `other`.
pub fn anyway(span: Span, other: Span) -> Diagnostic {
    RULE.at(span, "this effect happens whether its condition holds or not", "nothing more")
        .label(other, "without a condition here")
        .help("remove one of the two")
}

/// The effect at `span` deletes what is added without a condition at `other`.
pub fn in_vain(span: Span, other: Span) -> Diagnostic {
    RULE.at(span, "this deletion never shows", "added at the same time")
        .label(other, "added without a condition here")
        .help(
            "what an action adds is true afterwards: put the addition under the opposite condition",
        )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn an_addition_under_a_condition_stays() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean ?x) (greasy ?x) (dry ?x))
  (:action wash
    :parameters (?x)
    :effect (and
      (clean ?x)
      (not (dry ?x))
      (when (greasy ?x) (not (clean ?x)))
;                       ^^^^^^^^^^^^^^^^ W0411: this deletion never shows
      (when (not (greasy ?x)) (and (clean ?x) (dry ?x))))))
;                                  ^^^^^^^^^^ W0411: this effect happens whether its condition holds or not
"]);
    }
}
