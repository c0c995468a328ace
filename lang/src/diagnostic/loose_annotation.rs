#![doc = include_str!("loose_annotation.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `loose-annotation`.
pub const RULE: Rule = Rule {
    code: "W1004",
    name: "loose-annotation",
    severity: Severity::Warning,
    page: include_str!("loose_annotation.md"),
};

/// The word `text` of an annotation stands outside of all parentheses; `marker` is the `;@` of a line that begins so.
pub fn loose_annotation(text: &str, span: Span, marker: Option<Span>) -> Diagnostic {
    let diagnostic = RULE
        .at(span, format!("`{text}` stands outside of all annotations"), "not in parentheses")
        .help("annotations are lists such as `(:seen 3)`; begin a remark with `;` alone");
    match marker {
        Some(marker) => diagnostic.fix("make it a remark", marker, ";"),
        None => diagnostic,
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_remark_that_looks_like_an_annotation() {
        check(&[";@author Lovelace
; ^^^^^^ W1004: `author` stands outside of all annotations
(define (domain d)
  (:predicates (p))
  ;@ :at-most-one (:exactly-one (p)) ; a remark
;    ^^^^^^^^^^^^ W1004: `:at-most-one` stands outside of all annotations
)
"]);
    }
}
