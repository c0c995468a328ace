#![doc = include_str!("unknown_time_specifier.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-time-specifier`.
pub const RULE: Rule = Rule {
    code: "E0604",
    name: "unknown-time-specifier",
    severity: Severity::Error,
    page: include_str!("unknown_time_specifier.md"),
};

/// `word name` is no time specifier; `meant` is put in the place of `name`, or of both where it has two words.
pub fn unknown_time_specifier(word: &str, name: &str, span: Span, meant: &str) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown time specifier `{word} {name}`"), "not a time specifier");
    if meant.contains(' ') {
        return diagnostic
            .help(format!("write `{meant}`: conditions hold `at start`, `over all` or `at end`"));
    }
    diagnostic.suggest(Some(meant)).safely()
}

/// `word`, such as `overall`, stands for the two words `meant`.
pub fn in_one_word(word: &str, span: Span, meant: &str) -> Diagnostic {
    RULE.at(span, format!("unknown time specifier `{word}`"), "two words are meant")
        .suggest(Some(meant))
        .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn misspelt_ones_are_taken_as_meant() {
        check(&["(define (domain d)
  (:requirements :durative-actions)
  (:predicates (lit) (dark))
  (:durative-action glow
    :parameters ()
    :duration (= ?duration 5)
    :condition (and (at strat (dark)) (at all (dark)) (overall (dark)))
;                       ^^^^^ E0604: unknown time specifier `at strat`
;                                         ^^^ E0604: unknown time specifier `at all`
;                                                      ^^^^^^^ E0604: unknown time specifier `overall`
    :effect (at end (lit))))
"]);
    }
}
