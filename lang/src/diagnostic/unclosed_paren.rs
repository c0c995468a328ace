#![doc = include_str!("unclosed_paren.md")]

use super::{Diagnostic, Label, Rule, Severity};
use crate::source::Span;

/// The kind `unclosed-paren`.
pub const RULE: Rule = Rule {
    code: "E0001",
    name: "unclosed-paren",
    severity: Severity::Error,
    page: include_str!("unclosed_paren.md"),
};

/// A list is still open where the section `keyword` starts; `insertion` says where how many `)` are missing.
pub fn before_section(
    paren: Span,
    heading: &str,
    keyword: Span,
    section: &str,
    insertion: (Span, usize),
) -> Diagnostic {
    let section = section.to_ascii_lowercase();
    RULE.at(paren, "this `(` is never closed", opened(heading))
        .label(keyword, format!("a new `{section}` starts here"))
        .help(format!(
            "a `)` is missing before this `{section}`: a section cannot contain another section"
        ))
        .fix(
            format!("insert `{}`", ")".repeat(insertion.1.min(8))),
            insertion.0,
            ")".repeat(insertion.1),
        )
        .safely()
}

/// A list is still open where something follows that cannot stand in it; `insertion` says where how many `)` are missing, behind `after`.
///
/// `misplaced` is the first keyword of a field that would stand inside of a list.
pub fn inside(
    paren: Span,
    heading: &str,
    after: Span,
    misplaced: Option<(Span, &str)>,
    insertion: (Span, usize),
) -> Diagnostic {
    let (place, count) = insertion;
    let missing = ")".repeat(count);
    let mut diagnostic = RULE
        .at(paren, "this `(` is never closed", opened(heading))
        .label(after, format!("`{missing}` is missing after this"));
    if let Some((span, word)) = misplaced {
        diagnostic = diagnostic.label(span, format!("`{word}` cannot stand inside of it"));
    }
    diagnostic.fix(format!("insert `{missing}`"), place, missing).safely()
}

/// Adds to a message about a `)` that is missing that the one at `span` is too many: it stands in the wrong place.
pub fn instead(diagnostic: &mut Diagnostic, span: Span) {
    let label = Label { span, text: "and here is one too many".to_owned() };
    diagnostic.secondary.push(label);
    if let Some(fix) = diagnostic.fixes.first_mut() {
        fix.title.push_str(", and remove the one that is too many");
        fix.edits.push((span, String::new()));
    }
}

/// A `(` is one too many.
pub fn superfluous(paren: Span) -> Diagnostic {
    RULE.at(paren, "this `(` is never closed", "one too many")
        .help("remove it")
        .fix("remove this `(`", paren, "")
        .safely()
}

/// What stands at the `(` of a list that starts so.
fn opened(heading: &str) -> String {
    match heading {
        "" => "opened here".to_owned(),
        _ => format!("`{heading}` opened here"),
    }
}

/// The text ends while lists are open; `insertion` says where how many `)` are missing.
pub fn at_end(
    paren: Span,
    heading: &str,
    others: &[String],
    insertion: (Span, usize),
) -> Diagnostic {
    let (place, count) = insertion;
    let mut label = opened(heading);
    let named: Vec<String> = others.iter().rev().map(|other| format!("`({other}`")).collect();
    let too = match named.as_slice() {
        [] => String::new(),
        [one] => format!("; {one} is open too"),
        [first @ .., last] => format!("; {} and {last} are open too", first.join(", ")),
    };
    label.push_str(&too);
    let message = match count {
        1 => "unexpected end of file: this `(` is never closed".to_owned(),
        _ => format!("unexpected end of file: {count} unclosed `(`"),
    };
    let missing =
        if count <= 8 { format!("`{}`", ")".repeat(count)) } else { format!("{count} times `)`") };
    RULE.at(paren, message, label).help(format!("add {missing} at the end of the file")).fix(
        format!("append {missing}"),
        place,
        ")".repeat(count),
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_section_closes_what_is_open() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
; ^ E0001: this `(` is never closed
    :parameters (?d - dish)
    :effect (and (clean ?d)
  (:action light
    :parameters ()
    :effect (lit)))
"]);
    }

    #[test]
    fn the_end_closes_what_is_open() {
        check(&["(define (domain d)
  (:predicates (p)
; ^ E0001: unexpected end of file: 2 unclosed `(`
    (q)
"]);
    }

    #[test]
    fn only_the_definition_is_open() {
        check(&["  (define (domain d)
; ^ E0001: unexpected end of file: this `(` is never closed
  (:predicates (p))
"]);
    }
}
