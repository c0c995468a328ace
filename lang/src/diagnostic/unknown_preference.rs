#![doc = include_str!("unknown_preference.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-preference`.
pub const RULE: Rule = Rule {
    code: "E0108",
    name: "unknown-preference",
    severity: Severity::Error,
    page: include_str!("unknown_preference.md"),
};

/// No preference is called `name`.
pub fn unknown_preference(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown preference `{name}`"), "no `(preference …)` has this name");
    match near {
        Some(_) => diagnostic.suggest(near),
        None => {
            diagnostic.help("name a preference of the goal, of a precondition or of `:constraints`")
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_metric() {
        check(&[
            "(define (domain d)
  (:requirements :preferences)
  (:predicates (lit))
  (:action press :precondition (preference gently (lit)) :effect (lit)))
",
            "(define (problem p) (:domain d)
  (:goal (and (lit) (preference soon (lit))))
  (:constraints (preference often (sometime (lit))))
  (:metric minimize (+ (* 2 (is-violated soon)) (is-violated often) (is-violated gently) (is-violated soo))))
;                                                                                                     ^^^ E0108: unknown preference `soo`
",
        ]);
    }
}
