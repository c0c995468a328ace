#![doc = include_str!("misplaced_time_specifier.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `misplaced-time-specifier`.
pub const RULE: Rule = Rule {
    code: "E0603",
    name: "misplaced-time-specifier",
    severity: Severity::Error,
    page: include_str!("misplaced_time_specifier.md"),
};

/// `words` stands in a condition of `owner` where there is one state only, or `inside` another time specifier.
pub fn in_condition(words: &str, owner: &str, inside: bool, span: Span) -> Diagnostic {
    let (label, help) = if inside {
        ("inside another time specifier", "each condition holds at one time")
    } else {
        ("only durative actions have a start and an end", "leave it out, or use `:durative-action`")
    };
    RULE.at(span, format!("`{words}` has no meaning here in {owner}"), label).help(help)
}

/// `words` stands in an effect of `owner`, which is `durative` or not.
pub fn in_effect(words: &str, owner: &str, durative: bool, span: Span) -> Diagnostic {
    let (label, help) = if durative {
        ("not a time of an effect", "an effect happens `at start` or `at end`")
    } else {
        ("only durative actions have a start and an end", "leave it out, or use `:durative-action`")
    };
    RULE.at(span, format!("`{words}` has no meaning here in {owner}"), label).help(help)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_an_instant_and_over_all_of_an_effect() {
        check(&["(define (domain d)
  (:requirements :durative-actions)
  (:predicates (lit) (dark) (at ?x ?y))
  (:action press
    :parameters (?start ?end)
    :precondition (and (at start (dark)) (at ?start ?end))
;                       ^^^^^^^^ E0603: `at start` has no meaning here in action `press`
    :effect (at end (lit)))
;            ^^^^^^ E0603: `at end` has no meaning here in action `press`
  (:durative-action glow
    :parameters ()
    :duration (= ?duration 5)
    :condition (at start (at end (dark)))
;                         ^^^^^^ E0603: `at end` has no meaning here in durative action `glow`
    :effect (over all (lit))))
;            ^^^^^^^^ E0603: `over all` has no meaning here in durative action `glow`
"]);
    }
}
