#![doc = include_str!("dash_not_separated.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `dash-not-separated`.
pub const RULE: Rule = Rule {
    code: "W0007",
    name: "dash-not-separated",
    severity: Severity::Warning,
    page: include_str!("dash_not_separated.md"),
};

/// `-NAME` is read as `- NAME`.
pub fn dash_not_separated(text: &str, span: Span) -> Diagnostic {
    let name = text.strip_prefix('-').unwrap_or(text);
    RULE.at(
        span,
        format!("`{text}` is read as `- {name}`; some planners read it as one word"),
        "no space after `-`",
    )
    .help(format!("write `- {name}`"))
    .fix("insert a space after `-`", span, format!("- {name}"))
    .safely()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn the_type_is_read() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d -dish ?p -plate)
;                   ^^^^^ W0007: `-dish` is read as `- dish`; some planners read it as one word
;                            ^^^^^^ W0007: `-plate` is read as `- plate`; some planners read it as one word
    :precondition (in ?p sink)
    :effect (clean ?d)))
",
        ]);
    }

    #[test]
    fn names_with_dashes_and_numbers_are_whole() {
        check(&["(define (domain d)
  (:constants a-1 -5 b)
  (:predicates (p ?x))
  (:action a :effect (and (p a-1) (p -5))))
"]);
    }
}
