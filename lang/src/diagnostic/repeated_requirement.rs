#![doc = include_str!("repeated_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `repeated-requirement`.
pub const RULE: Rule = Rule {
    code: "W0304",
    name: "repeated-requirement",
    severity: Severity::Warning,
    page: include_str!("repeated_requirement.md"),
};

/// The flag stands at `first` already.
pub fn repeated_requirement(name: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("requirement `{name}` is listed twice"), "again here")
        .label(first, "listed here first")
        .help("remove one of them")
        .fix("remove it", span, "")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn whatever_the_case() {
        lint(&["(define (domain d)
  (:requirements :strips :adl :STRIPS)
;                             ^^^^^^^ W0304: requirement `:STRIPS` is listed twice
  (:predicates (lit)))
"]);
    }
}
