#![doc = include_str!("misplaced_modality.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `misplaced-modality`.
pub const RULE: Rule = Rule {
    code: "E0406",
    name: "misplaced-modality",
    severity: Severity::Error,
    page: include_str!("misplaced_modality.md"),
};

/// `word`, such as `always`, stands in a condition on one state.
pub fn misplaced_modality(word: &str, span: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`{word}` is about a whole plan, not about one state"),
        "not in a condition",
    )
    .help("move it into `:constraints`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_goal() {
        check(&[
            "(define (domain d)
  (:requirements :constraints)
  (:predicates (lit))
  (:action press :effect (lit)))
",
            "(define (problem p) (:domain d)
  (:goal (and (lit) (sometime (lit))))
;                    ^^^^^^^^ E0406: `sometime` is about a whole plan, not about one state
  (:constraints (and (always (lit)) (sometime-after (lit) (lit)) (within 5 (lit)) (at end (lit)))))
",
        ]);
    }
}
