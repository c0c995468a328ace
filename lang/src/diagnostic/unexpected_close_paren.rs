#![doc = include_str!("unexpected_close_paren.md")]

use super::{Diagnostic, Label, Rule, Severity};
use crate::source::Span;

/// The kind `unexpected-close-paren`.
pub const RULE: Rule = Rule {
    code: "E0002",
    name: "unexpected-close-paren",
    severity: Severity::Error,
    page: include_str!("unexpected_close_paren.md"),
};

/// A `)` where nothing is open.
pub fn nothing_open(span: Span) -> Diagnostic {
    stray(span, "nothing is open here")
}

/// A `)` that closes the whole definition although another section follows.
pub fn closes_definition(span: Span) -> Diagnostic {
    stray(span, "this closes `(define`, but another section follows")
}

/// A `)` that ends some list too early; `misplaced` is the first keyword that would stand outside of its list because of it.
pub fn too_many(span: Span, misplaced: Option<(Span, &str)>) -> Diagnostic {
    let diagnostic = stray(span, "one too many");
    match misplaced {
        Some((span, word)) => {
            diagnostic.label(span, format!("because of it `{word}` stands outside of its list"))
        }
        None => diagnostic,
    }
}

fn stray(span: Span, label: &str) -> Diagnostic {
    RULE.at(span, "this `)` has no matching `(`", label)
        .help("remove it")
        .fix("remove this `)`", span, "")
        .safely()
}

/// Adds to a message about a `)` that is too many that one is missing after `span`: it stands in the wrong place.
pub fn instead(diagnostic: &mut Diagnostic, span: Span) {
    let label = Label { span, text: "after this one is missing".to_owned() };
    diagnostic.secondary.push(label);
    diagnostic.help = Some("move it".to_owned());
    if let Some(fix) = diagnostic.fixes.first_mut() {
        "move this `)`".clone_into(&mut fix.title);
        fix.edits.push((Span { start: span.end, ..span }, ")".to_owned()));
    }
}

/// A later `)` has no partner, because a `(` is missing before `word`.
pub fn missing_open(word: &str, span: Span) -> Diagnostic {
    let place = Span { end: span.start, ..span };
    RULE.at(span, format!("a `(` is missing before `{word}`"), "a list starts here")
        .help("without it, a later `)` has no matching `(`")
        .fix("insert `(`", place, "(")
        .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn one_that_closes_the_definition_too_early_is_dropped() {
        check(&["(define (domain d)
  (:predicates (p)))
;                  ^ E0002: this `)` has no matching `(`
  (:action a :parameters () :effect (p)))
"]);
    }

    #[test]
    fn those_after_the_end_are_reported_together() {
        check(&["(define (domain d)
  (:predicates (p)))))
;                   ^ E0002: this `)` has no matching `(`
"]);
    }

    #[test]
    fn one_that_ends_an_action_too_early_is_dropped() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (p) (q))
  (:action a
    :parameters ()
    :precondition (and (p)) (q))
;                         ^ E0002: this `)` has no matching `(`
    :effect (p))
  (:action b
    :parameters ())
;                 ^ E0002: this `)` has no matching `(`
    :effect (q))
)
"]);
    }

    #[test]
    fn indentation_shows_which_one_was_meant() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (p) (q))
  (:action a
    :parameters ()
    :effect (and
      (p)
      (q))
;        ^ E0002: this `)` has no matching `(`
    )
  )
  (:action b
    :effect (and
      (p)
    )
  )
  )
; ^ E0002: this `)` has no matching `(`
)
"]);
    }

    #[test]
    fn one_that_stands_in_the_wrong_place_is_one_mistake() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates (p))
  (:action a
    :parameters ()
    :effect (p)))
;               ^ E0002: this `)` has no matching `(`
  (:action b
    :effect (p))
"]);
    }

    #[test]
    fn where_an_open_one_is_missing() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:predicates p ?x ?y) (q))
;              ^ E0002: a `(` is missing before `p`
  (:action a
    :parameters ?x ?y)
;               ^^ E0002: a `(` is missing before `?x`
    :effect (p ?x ?y))
  (:action b
    :precondition and (q) (not (q)))
;                 ^^^ E0002: a `(` is missing before `and`
    :effect (q))
  (:action c
    :effect (not q)))
;                ^ E0002: a `(` is missing before `q`
  :action d
; ^^^^^^^ E0002: a `(` is missing before `:action`
    :effect (q))
)
"]);
    }
}
