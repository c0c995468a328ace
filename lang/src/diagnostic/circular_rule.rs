#![doc = include_str!("circular_rule.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `circular-rule`.
pub const RULE: Rule = Rule {
    code: "W0410",
    name: "circular-rule",
    severity: Severity::Warning,
    page: include_str!("circular_rule.md"),
};

/// The rule for `name` demands its own head at `span`.
pub fn circular_rule(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("the rule for `{name}` demands what it concludes"), "known before")
        .help("it never derives anything: another argument or another predicate was meant")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn with_the_same_arguments() {
        lint(&["(define (domain d)
  (:requirements :derived-predicates :disjunctive-preconditions)
  (:predicates (in ?x ?y) (inside ?x ?y))
  (:derived (inside ?x ?y) (or (in ?x ?y) (inside ?x ?y)))
  (:derived (inside ?x ?y) (and (in ?x ?x) (inside ?y ?x)))
  (:derived (inside ?x ?y) (and (in ?x ?y) (inside ?x ?y))))
;                                          ^^^^^^^^^^^^^^ W0410: the rule for `inside` demands what it concludes
"]);
    }
}
