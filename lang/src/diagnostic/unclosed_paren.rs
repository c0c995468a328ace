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

    #[test]
    fn a_field_is_not_part_of_a_formula() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) (lit))
  (:action wash
    :parameters ()
    :precondition (and (not (clean)) (lit)
;                 ^ E0001: this `(` is never closed
    :effect (clean))
  (:action light
    :parameters (
;               ^ E0001: this `(` is never closed
    :precondition (not (lit))
    :effect (lit)))
"]);
    }

    #[test]
    fn indentation_shows_which_list_was_meant() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) (lit) (wet))
  (:action wash
    :parameters ()
    :precondition (and
      (or (clean)
;     ^ E0001: this `(` is never closed
        (wet)
      (lit))
    :effect (and
      (forall (?x)
;     ^ E0001: this `(` is never closed
        (when (lit)
          (clean))
      (wet)))
)
"]);
    }

    #[test]
    fn tabs_and_capitals() {
        check(&["(DEFINE (DOMAIN D)
\t(:REQUIREMENTS :ADL)
\t(:PREDICATES (CLEAN) (LIT)
;^ E0001: this `(` is never closed
\t(:ACTION WASH
\t\t:PARAMETERS ()
\t\t:PRECONDITION (AND (LIT)
;               ^ E0001: this `(` is never closed
\t\t:EFFECT (CLEAN))
)
"]);
    }

    #[test]
    fn where_all_is_on_one_line_the_words_decide() {
        check(&["(define (domain d) (:requirements :adl) (:predicates (p ?x) (q)) (:action a :parameters (?x) :precondition (and (not (p ?x) (q)) :effect (q)))
;                                                                                                               ^ E0001: this `(` is never closed
"]);
    }

    #[test]
    fn a_misspelt_section_starts_one_too() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) (lit))
  (:action wash
; ^ E0001: this `(` is never closed
    :effect (clean)
  (:acton light
;  ^^^^^^ E0004: unknown domain section `:acton`
    :effect (lit)))
"]);
    }

    #[test]
    fn one_that_opens_nothing_is_dropped() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) ((lit))
;                       ^ E0001: this `(` is never closed
  ((:action wash
; ^ E0001: this `(` is never closed
    :precondition ((and (lit))
;                  ^ E0001: this `(` is never closed
    :effect (clean)))
"]);
    }

    #[test]
    fn one_that_stands_in_the_wrong_place_is_one_mistake() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) (lit))
  (:action wash
    :precondition (and (lit)
;                 ^ E0001: this `(` is never closed
    :effect (clean)))
  (:action light
    :effect (lit)))
"]);
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (clean) (lit))
  (:action wash
; ^ E0001: this `(` is never closed
    :effect (clean)
  (:action light
    :effect (lit))))
"]);
    }
}
