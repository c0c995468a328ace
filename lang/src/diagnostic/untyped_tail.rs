#![doc = include_str!("untyped_tail.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `untyped-tail`.
pub const RULE: Rule = Rule {
    code: "W0203",
    name: "untyped-tail",
    severity: Severity::Warning,
    page: include_str!("untyped_tail.md"),
};

/// `names` follow the last type of a list, `above`, which stands at `reference`.
pub fn untyped_tail(names: &str, span: Span, above: &str, reference: Span) -> Diagnostic {
    let after = Span { start: span.end, ..span };
    RULE.at(span, format!("`{names}` stands after the last type"), "any object will do")
        .label(reference, "the type of what stands before it")
        .help(format!("write `{names} - {above}`, or `{names} - object` if any object is meant"))
        .fix(format!("write `{names} - {above}`"), after, format!(" - {above}"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn in_every_list_but_types() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:types cup - dish place)
  (:constants sink - place towel)
;                          ^^^^^ W0203: `towel` stands after the last type
  (:predicates (in ?x - dish ?p - place) (near ?x - dish ?y ?z) (dry ?x ?y))
;                                                        ^^^^^ W0203: `?y ?z` stands after the last type
  (:action wash
    :parameters (?x -dish ?y)
;                   ^^^^^ W0007: `-dish` is read as `- dish`; some planners read it as one word
;                         ^^ W0203: `?y` stands after the last type
    :precondition (forall (?a - (either dish place) ?b) (near ?x ?a ?b))
;                                                   ^^ W0203: `?b` stands after the last type
    :effect (and (dry ?y ?y) (in ?x sink))))
",
"(define (problem p) (:domain d)
  (:objects a b - cup c)
;                     ^ W0203: `c` stands after the last type
  (:init (near a b c))
  (:goal (dry c c)))
"]);
    }
}
