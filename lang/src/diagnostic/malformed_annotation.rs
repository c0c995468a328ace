#![doc = include_str!("malformed_annotation.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `malformed-annotation`.
pub const RULE: Rule = Rule {
    code: "E1005",
    name: "malformed-annotation",
    severity: Severity::Error,
    page: include_str!("malformed_annotation.md"),
};

/// An annotation of the kind `name`, which stands at `keyword`, needs `expected` at `span`, or behind all that there is.
pub fn needs(
    name: &str,
    keyword: Span,
    span: Option<Span>,
    expected: &str,
    example: &str,
) -> Diagnostic {
    let message = format!("`{name}` needs {expected}, such as `{example}`");
    match span {
        Some(span) => RULE.at(span, message, format!("expected {expected}")),
        None => RULE.at(keyword, message, "missing here"),
    }
}

/// Annotations of the kind `name` have no field `field`.
pub fn unknown_field(name: &str, field: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("`{name}` has no field `{field}`"), "not a field of it").suggest(near)
}

/// The field `field` stands twice.
pub fn repeated(field: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`{field}` stands here again"), "a field stands once in an annotation")
}

/// The annotation names a thing of this sort that there is not.
pub fn unknown(sort: &str, name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("there is no {sort} `{name}`"), "not declared").suggest(near)
}

/// An atom has `found` arguments where its predicate takes `wanted`.
pub fn arity(name: &str, wanted: usize, found: usize, span: Span) -> Diagnostic {
    let s = if wanted == 1 { "" } else { "s" };
    let message = format!("predicate `{name}` takes {wanted} argument{s}, {found} given");
    RULE.at(span, message, format!("expected {wanted}"))
}

/// An atom has no name.
pub fn nameless(span: Span) -> Diagnostic {
    RULE.at(span, "an atom begins with the name of a predicate", "no name here")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_causal_model() {
        check(&["(define (domain d)
  (:predicates (p))
  (:action a
    :parameters ()
    :precondition (and
      ;@ (:causal stack.json :outcome (= on 1))
;                 ^^^^^^^^^^ E1005: `:causal` needs the file of its model, such as `\"stack.cbn.json\"`
      ;@ (:causal \"s.json\" :at-least 0.9)
;         ^^^^^^^ E1005: `:causal` needs an outcome, such as `:outcome (= onTop 1)`
      ;@ (:causal \"s.json\" :outcome on)
;                                   ^^ E1005: `:causal` needs an outcome, such as `:outcome (= onTop 1)`
      ;@ (:causal \"s.json\" :outcome (= on 1) :at-least 90)
;                                                      ^^ E1005: `:causal` needs a probability from 0 to 1, such as `:at-least 0.9`
      ;@ (:causal \"s.json\" :outcome (= on 1) :atleast 0.9)
;                                            ^^^^^^^^ E1005: `:causal` has no field `:atleast`
      ;@ (:causal \"s.json\" :outcome (= on 1) :outcome (= on 1))
;                                            ^^^^^^^^ E1005: `:outcome` stands here again
      ;@ (:causal \"s.json\" :outcome (= on 1) :at-least 0.9 :bind ((x (p)) y))
;                                                                ^^^^^^^^^^^ E1005: `:causal` needs a list of variables with their terms, such as `:bind ((xOff (x-offset ?a ?b)))`
      ;@ (:causal \"s.json\" :outcome (= on 1) :at-least .9
      ;@   :bind ((x (offset ?a) :nominal 0 :sd 0.4) (y (offset ?b) :from (a ?b) :otherwise 0)))
    )
    :effect (p)))
"]);
    }

    #[test]
    fn groups_of_atoms() {
        check(&["(define (domain d)
  (:predicates (p) (holding ?x))
  ;@ (:exactly-one (p) (holdin ?x))
;                       ^^^^^^ E1005: there is no predicate `holdin`
  ;@ (:at-most-one (p ?x) (holding box))
;                  ^^^^^^ E1005: predicate `p` takes 0 arguments, 1 given
;                                  ^^^ E1005: there is no object `box`
)
"]);
    }

    #[test]
    fn lists_of_one_thing() {
        check(&["(define (domain d)
  (:predicates (p))
  ;@ (:exactly-one)
;     ^^^^^^^^^^^^ E1005: `:exactly-one` needs atoms, such as `(holding ?x)`
  ;@ (:at-most-one (p) q)
;                      ^ E1005: `:at-most-one` needs atoms, such as `(holding ?x)`
  ;@ (:exactly-one (p)
  ;@   (:at-most-one (p)))
;      ^^^^^^^^^^^^^^^^^^ E1005: `:exactly-one` needs atoms, such as `(holding ?x)`
  ;@ (:measured weight)
;               ^^^^^^ E1005: `:measured` needs functions with their parameters, such as `(weight ?c - cube)`
)
", "(define (problem e) (:domain d)
  ;@ (:observed (= (weight box) 2.5) (= (weight box) heavy) (weight box))
;                                    ^^^^^^^^^^^^^^^^^^^^^^ E1005: `:observed` needs values, such as `(= (weight box) 2.5)`
  (:init (p)) ;@ (:observed (= (weight box) -2))
  (:goal (p)))
"]);
    }
}
