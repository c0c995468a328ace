#![doc = include_str!("unbalanced_annotation.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unbalanced-annotation`.
pub const RULE: Rule = Rule {
    code: "E1002",
    name: "unbalanced-annotation",
    severity: Severity::Error,
    page: include_str!("unbalanced_annotation.md"),
};

/// An annotation that begins with the word `head` is open at the end of its run, or where the next one starts.
///
/// `insertion` says where how many `)` are missing.
pub fn unclosed(paren: Span, head: &str, insertion: (Span, usize)) -> Diagnostic {
    let label = match head {
        "" => "opened here".to_owned(),
        _ => format!("`{head}` opened here"),
    };
    let (place, count) = (Span { start: insertion.0.end, ..insertion.0 }, insertion.1);
    let missing =
        if count <= 8 { format!("`{}`", ")".repeat(count)) } else { format!("{count} times `)`") };
    RULE.at(paren, "this `(` of an annotation is never closed", label)
        .label(place, format!("missing {missing}"))
        .help("an annotation goes on as long as the lines below it begin with `;@`")
        .fix(format!("insert {missing}"), place, ")".repeat(count))
}

/// A `)` closes nothing.
pub fn unexpected(span: Span) -> Diagnostic {
    RULE.at(span, "this `)` of an annotation has no matching `(`", "nothing is open here")
        .help("remove it")
        .fix("remove this `)`", span, "")
}

/// A text begins with `"` and does not end on its line.
pub fn open_text(span: Span) -> Diagnostic {
    let after = Span { start: span.end, ..span };
    RULE.at(span, "this text has no second `\"`", "it ends on the line on which it begins").fix(
        "close the text",
        after,
        "\"",
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_run_ends_with_its_last_line() {
        check(&["(define (domain d)
  (:predicates (p))
  ;@ (:measured (weight ?x)
;    ^ E1002: this `(` of an annotation is never closed
  ; a remark
  ;@ (:at-most-one (p))
  ;@ (:measured ((weight ?x)
;    ^ E1002: this `(` of an annotation is never closed
)
"]);
    }

    #[test]
    fn a_known_kind_begins_anew() {
        check(&["(define (domain d)
  (:predicates (p))
  ;@ (:measured (weight ?x)
;    ^ E1002: this `(` of an annotation is never closed
  ;@ (:exactly-one 3)
  ;@ (:at-most-one (p))
)
"]);
    }

    #[test]
    fn parentheses_too_many_and_texts_without_end() {
        check(&["(define (domain d)
  (:predicates (p)) ;@ (:at-most-one (p))) and more)
;                                        ^ E1002: this `)` of an annotation has no matching `(`
  (:action a
    ;@ (:seen \"a)
;             ^^^ E1002: this text has no second `\"`
    :effect (p)))
"]);
    }
}
