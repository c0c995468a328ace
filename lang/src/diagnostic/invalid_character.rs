#![doc = include_str!("invalid_character.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `invalid-character`.
pub const RULE: Rule = Rule {
    code: "E0006",
    name: "invalid-character",
    severity: Severity::Error,
    page: include_str!("invalid_character.md"),
};

/// `character` stands outside comments, where PDDL has no use for it.
pub fn invalid_character(character: char, span: Span) -> Diagnostic {
    let point = format!("U+{:04X}", u32::from(character));
    let shown = if character.is_control() || character.is_whitespace() {
        point.clone()
    } else {
        format!("`{character}` ({point})")
    };
    let diagnostic =
        RULE.at(span, format!("invalid character {shown}"), "not allowed outside comments");
    let plain = match character {
        '\u{2010}'..='\u{2015}' | '\u{2212}' => "-",
        character if character.is_whitespace() => " ",
        _ => return diagnostic.help("names consist of letters, digits, `-` and `_`"),
    };
    let named = if plain == "-" { "a hyphen `-`" } else { "a plain blank" };
    diagnostic.help(format!("write {named} instead")).fix(
        format!("replace with {named}"),
        span,
        plain,
    )
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_dash_from_a_word_processor_is_a_dash() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d – dish)
;                   ^^^ E0006: invalid character `–` (U+2013)
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn each_character_is_reported_once() {
        check(&[r#"(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action café :effect (lit))
;             ^^ E0006: invalid character `é` (U+00E9)
  (:action thé :effect (and (lit) "and")))
;                                  ^ E0006: invalid character `"` (U+0022)
"#]);
    }
}
