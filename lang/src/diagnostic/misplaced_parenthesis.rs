#![doc = include_str!("misplaced_parenthesis.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `misplaced-parenthesis`.
pub const RULE: Rule = Rule {
    code: "E0015",
    name: "misplaced-parenthesis",
    severity: Severity::Error,
    page: include_str!("misplaced_parenthesis.md"),
};

/// `not (p)` at `word` and `list`, for `(not (p))`.
pub fn before_list(name: &str, word: Span, list: Span) -> Diagnostic {
    let blank = if word.end == list.start { " " } else { "" };
    outside(name, word)
        .help(format!("write `({name} (…))`"))
        .fix(format!("put `{name}` into parentheses"), start(word), "(")
        .along(end(word), blank)
        .along(end(list), ")")
        .safely()
}

/// `p(?x)` at `word` and `list`, for `(p ?x)`.
pub fn call(name: &str, word: Span, list: Span) -> Diagnostic {
    outside(name, word)
        .help(format!("write `({name} …)`"))
        .fix(format!("put `{name}` into the parentheses"), start(word), "(")
        .along(opening(list), " ")
        .safely()
}

/// `(p(?x))`, where the list around the arguments is too much.
pub fn around_arguments(name: &str, list: Span) -> Diagnostic {
    RULE.at(list, format!("the arguments of `{name}` have parentheses of their own"), "too many")
        .help(format!("write `({name} …)`, with the arguments after the name"))
        .fix("remove the parentheses", opening(list), " ")
        .along(Span { start: list.end - 1, ..list }, "")
        .safely()
}

/// `(forall ?x - t FORMULA)`, where the variables stand without parentheses.
pub fn variables(word: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("the variables of `{word}` need parentheses"), "not in parentheses")
        .help(format!("write `({word} (?x - TYPE) FORMULA)`"))
        .fix("put them into parentheses", start(span), "(")
        .along(end(span), ")")
        .safely()
}

fn outside(name: &str, word: Span) -> Diagnostic {
    RULE.at(word, format!("`{name}` stands before the parenthesis"), "belongs inside")
}

fn start(span: Span) -> Span {
    Span { end: span.start, ..span }
}

fn end(span: Span) -> Span {
    Span { start: span.end, ..span }
}

fn opening(list: Span) -> Span {
    Span { end: list.start + 1, ..list }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn all_that_are_seen_in_print() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup place)
  (:predicates (in ?c - cup ?p - place) (clean ?c - cup))
  (:action wash
    :parameters (?c - cup)
    :precondition (and (clean(?c)) not(clean ?c) (forall ?p - place (exists ?d - cup in(?d ?p))))
;                            ^^^^ E0015: the arguments of `clean` have parentheses of their own
;                                  ^^^ E0015: `not` stands before the parenthesis
;                                                        ^^^^^^^^^^ E0015: the variables of `forall` need parentheses
;                                                                           ^^^^^^^^ E0015: the variables of `exists` need parentheses
;                                                                                    ^^ E0015: `in` stands before the parenthesis
    :effect (and not (clean ?c))))
;                ^^^ E0015: `not` stands before the parenthesis
"]);
    }
}
