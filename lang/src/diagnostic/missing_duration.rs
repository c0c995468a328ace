#![doc = include_str!("missing_duration.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `missing-duration`.
pub const RULE: Rule = Rule {
    code: "E0602",
    name: "missing-duration",
    severity: Severity::Error,
    page: include_str!("missing_duration.md"),
};

/// The durative action `name` has no `:duration`; it belongs at `place`.
pub fn missing_duration(name: &str, span: Span, place: Span) -> Diagnostic {
    RULE.at(span, format!("durative action `{name}` has no `:duration`"), "")
        .help("add `:duration (= ?duration 1)` after `:parameters`")
        .fix("insert `:duration (= ?duration 1)`", place, " :duration (= ?duration 1)")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn only_where_it_is_missing() {
        check(&["(define (domain d)
  (:requirements :durative-actions)
  (:predicates (wet) (dry))
  (:durative-action wait
;                   ^^^^ E0602: durative action `wait` has no `:duration`
    :parameters ()
    :effect (at end (dry)))
  (:durative-action rest
    :parameters ()
    :duration ()
    :effect (at end (dry))))
"]);
    }
}
