#![doc = include_str!("disjunctive_effect.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `disjunctive-effect`.
pub const RULE: Rule = Rule {
    code: "E0402",
    name: "disjunctive-effect",
    severity: Severity::Error,
    page: include_str!("disjunctive_effect.md"),
};

/// `keyword` leaves open what an effect does.
pub fn disjunctive_effect(keyword: &str, span: Span) -> Diagnostic {
    let message = match keyword {
        "not" => "an effect may negate an atom only".to_owned(),
        _ => format!("`{keyword}` is a condition; it is not allowed in an effect"),
    };
    RULE.at(span, message, "leaves open what happens")
        .help("say what becomes true and what becomes false; for a choice, write one action for each outcome")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn what_leaves_open_what_happens() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :effect (and (or (clean ?d) (lit)) (not (and (lit))) (exists (?p - place) (in ?d ?p)))))
;                 ^^ E0402: `or` is a condition; it is not allowed in an effect
;                                       ^^^ E0402: an effect may negate an atom only
;                                                         ^^^^^^ E0402: `exists` is a condition; it is not allowed in an effect
",
        ]);
    }
}
