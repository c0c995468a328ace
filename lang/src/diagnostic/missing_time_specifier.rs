#![doc = include_str!("missing_time_specifier.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `missing-time-specifier`.
pub const RULE: Rule = Rule {
    code: "E0601",
    name: "missing-time-specifier",
    severity: Severity::Error,
    page: include_str!("missing_time_specifier.md"),
};

/// A condition of `owner`, a durative action, does not say when it holds.
pub fn in_condition(owner: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("a condition of {owner} does not say when it holds"), "when?")
        .help("write `(at start …)`, `(over all …)` or `(at end …)` around it")
        .wrap("(at start ", ")")
        .wrap("(over all ", ")")
        .wrap("(at end ", ")")
}

/// An effect of `owner`, a durative action, does not say when it happens.
pub fn in_effect(owner: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("an effect of {owner} does not say when it happens"), "when?")
        .help("write `(at start …)` or `(at end …)` around it")
        .wrap("(at end ", ")")
        .wrap("(at start ", ")")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn one_of_several() {
        check(&["(define (domain d)
  (:requirements :durative-actions :negative-preconditions :fluents)
  (:predicates (lit) (dark) (warm))
  (:functions (oil))
  (:durative-action glow
    :parameters ()
    :duration (= ?duration 5)
    :condition (and (at start (dark)) (not (lit)) (>= (oil) 1) (over all (warm)))
;                                     ^^^^^^^^^^^ E0601: a condition of durative action `glow` does not say when it holds
;                                                 ^^^^^^^^^^^^ E0601: a condition of durative action `glow` does not say when it holds
    :effect (and (lit) (at end (not (lit))) (increase (oil) 1))))
;                ^^^^^ E0601: an effect of durative action `glow` does not say when it happens
;                                           ^^^^^^^^^^^^^^^^^^ E0601: an effect of durative action `glow` does not say when it happens
"]);
    }

    #[test]
    fn none_at_all_is_one_mistake() {
        check(&["(define (domain d)
  (:requirements :durative-actions)
  (:predicates (lit) (dark) (warm))
  (:durative-action glow
    :parameters ()
    :duration (= ?duration 5)
    :condition (and (dark) (warm))
;                   ^^^^^^ E0601: a condition of durative action `glow` does not say when it holds
    :effect (and (lit) (not (dark)))))
;                ^^^^^ E0601: an effect of durative action `glow` does not say when it happens
"]);
    }

    #[test]
    fn what_flows_needs_none() {
        check(&["(define (domain d)
  (:requirements :durative-actions :continuous-effects :numeric-fluents :conditional-effects)
  (:predicates (lit) (dark))
  (:functions (oil))
  (:durative-action glow
    :parameters ()
    :duration ()
    :condition ()
    :effect (and (decrease (oil) (* #t 2)) (when (at start (dark)) (at end (lit)))
      (at end (when (dark) (lit))))))
"]);
    }
}
