#![doc = include_str!("unknown_annotation.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-annotation`.
pub const RULE: Rule = Rule {
    code: "W1001",
    name: "unknown-annotation",
    severity: Severity::Warning,
    page: include_str!("unknown_annotation.md"),
};

/// There is no annotation of the kind `name`, which is empty where no word stands.
pub fn unknown_annotation(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    if name.is_empty() {
        return RULE
            .at(span, "an annotation without a kind", "expected a kind such as `:seen`")
            .help("begin a remark with `;` alone");
    }
    let message = format!("unknown annotation `{name}`");
    match near {
        Some(_) => RULE.at(span, message, "no such kind").suggest(near).safely(),
        None => RULE
            .at(span, message, "no such kind")
            .help("it is kept and says nothing; begin a remark with `;` alone"),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_misspelt_kind_is_taken_as_the_one_meant() {
        check(&["(define (domain d)
  (:predicates (p))
  ;@ (:mesured (weight ?x))
;     ^^^^^^^^ W1001: unknown annotation `:mesured`
  ;@ (at-most-one (p)) (:author (somebody))
;     ^^^^^^^^^^^ W1001: unknown annotation `at-most-one`
;                       ^^^^^^^ W1001: unknown annotation `:author`
  ;@ () ((p))
;    ^ W1001: an annotation without a kind
;       ^ W1001: an annotation without a kind
)
"]);
    }
}
