#![doc = include_str!("wrong_value.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `wrong-value`.
pub const RULE: Rule = Rule {
    code: "E0502",
    name: "wrong-value",
    severity: Severity::Error,
    page: include_str!("wrong_value.md"),
};

/// An object of type `found` stands where `wanted` needs a number.
pub fn object(found: &str, wanted: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("{wanted} needs a number"), format!("an object of type `{found}`"))
}

/// A number stands where `wanted` needs an object.
pub fn number(wanted: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("{wanted} needs an object"), "a number")
}

/// An object of type `found` is compared with the number at `number`.
pub fn mixed(found: &str, object: Span, number: Span) -> Diagnostic {
    RULE.at(object, "an object cannot equal a number", format!("an object of type `{found}`"))
        .label(number, "a number")
}

/// Something of type `found`, or a number, is assigned to something that has values of type `wanted`.
pub fn assigned(wanted: &str, found: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("the value must be of type `{wanted}`"), format!("of type `{found}`"))
}

/// The value of `function` is `wanted`, such as "a number", and the initial state gives it something else.
pub fn initial(function: &str, wanted: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("the value of {function} is {wanted}"), "something else")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn objects_and_numbers() {
        check(&[
            "(define (domain d)
  (:requirements :adl :fluents)
  (:types cup place)
  (:predicates (in ?c - cup ?p - place) (clean ?c - cup))
  (:functions (water) - number (home ?c - cup) - place)
  (:action wash
    :parameters (?c - cup ?p - place)
    :precondition (and (in ?c ?p) (>= (water) ?c) (= (home ?c) 3) (in ?c (home ?c)) (in ?c (water)))
;                                             ^^ E0502: `>=` needs a number
;                                                    ^^^^^^^^^ E0502: an object cannot equal a number
;                                                                                          ^^^^^^^ E0502: predicate `in` needs an object
    :effect (and (decrease (water) (home ?c)) (assign (home ?c) 4) (assign (home ?c) ?c)
;                                  ^^^^^^^^^ E0502: `decrease` needs a number
;                                                               ^ E0502: the value must be of type `place`
;                                                                                    ^^ E0502: the value must be of type `place`
      (increase (home ?c) 1))))
;      ^^^^^^^^ E0502: `increase` needs a number
",
            "(define (problem p) (:domain d)
  (:objects mug - cup sink - place)
  (:init (= (water) sink) (= (home mug) mug) (= (home mug) 3) (= (home mug) sink))
;                   ^^^^ E0502: the value of function `water` is a number
;                                       ^^^ E0502: the value of function `home` is of type `place`
;                                                          ^ E0502: the value of function `home` is of type `place`
  (:goal (clean mug)))
",
        ]);
    }
}
