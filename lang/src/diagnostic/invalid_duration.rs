#![doc = include_str!("invalid_duration.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `invalid-duration`.
pub const RULE: Rule = Rule {
    code: "E0605",
    name: "invalid-duration",
    severity: Severity::Error,
    page: include_str!("invalid_duration.md"),
};

/// What stands at `span` is no constraint on the duration.
pub fn invalid_duration(span: Span) -> Diagnostic {
    RULE.at(span, "this is no constraint on `?duration`", "expected `(= ?duration …)`").help(
        "write `(= ?duration VALUE)`, or bounds such as `(<= ?duration VALUE)`, several with `and`",
    )
}

/// A word stands there, perhaps a `number`, and no constraint.
pub fn not_a_constraint(number: Option<&str>, span: Span) -> Diagnostic {
    let diagnostic = invalid_duration(span);
    match number {
        Some(number) => {
            let meant = format!("(= ?duration {number})");
            diagnostic.help(format!("write `{meant}`")).fix(
                format!("replace with `{meant}`"),
                span,
                meant,
            )
        }
        None => diagnostic,
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn what_is_none() {
        check(&["(define (domain d)
  (:requirements :typing :durative-actions :duration-inequalities)
  (:types lamp)
  (:predicates (lit) (on ?l - lamp))
  (:functions (time ?l - lamp))
  (:durative-action glow
    :parameters (?l - lamp)
    :duration (= (time ?l) 5)
;             ^^^^^^^^^^^^^^^ E0605: this is no constraint on `?duration`
    :effect (at end (lit)))
  (:durative-action burn
    :parameters (?l - lamp)
    :duration (and (>= ?duration 2) (<= ?duration (* 2 (time ?l))) (lit))
;                                                                  ^^^^^ E0605: this is no constraint on `?duration`
    :effect (at end (lit)))
  (:durative-action blink
    :parameters (?l - lamp)
    :duration 5
;             ^ E0605: this is no constraint on `?duration`
    :effect (at end (on ?l))))
"]);
    }
}
