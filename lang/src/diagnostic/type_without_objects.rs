#![doc = include_str!("type_without_objects.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `type-without-objects`.
pub const RULE: Rule = Rule {
    code: "W0709",
    name: "type-without-objects",
    severity: Severity::Warning,
    page: include_str!("type_without_objects.md"),
};

/// The problem has no object of any of the `count` types `names`, the first of which is declared at `declared`; `actions` need them.
pub fn type_without_objects(
    names: &str,
    count: usize,
    declared: Span,
    problem: &str,
    span: Span,
    actions: &str,
) -> Diagnostic {
    let (types, label) =
        if count == 1 { ("type", "the type") } else { ("the types", "the first of the types") };
    let message = format!("problem `{problem}` has no object of {types} {names}");
    RULE.at(span, message, "no such object")
        .label(declared, label)
        .help(format!("actions that need one can never be applied: {actions}"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn one_reason_is_enough() {
        lint(&[
            "(define (domain d)
  (:requirements :typing)
  (:types cup lamp)
  (:predicates (clean ?c - cup) (lit ?l - lamp) (power))
;                                                ^^^^^ W0701: predicate `power` is never added by any action nor in `:init` of problem `p`
  (:action wash :parameters (?c - cup) :effect (clean ?c))
  (:action press :parameters (?l - lamp) :precondition (power) :effect (lit ?l)))
",
            "(define (problem p) (:domain d)
  (:objects a - cup)
  (:init)
  (:goal (clean a)))
",
        ]);
    }

    #[test]
    fn objects_of_types_below_will_do() {
        lint(&[
            "(define (domain d)
  (:requirements :typing)
  (:types cup plate - dish tool lamp bed)
  (:predicates (clean ?d - dish) (mended ?t - tool) (lit ?l - lamp) (made ?b - bed))
  (:action wash :parameters (?d - dish) :effect (clean ?d))
  (:action mend :parameters (?t - tool) :effect (mended ?t))
  (:action make :parameters (?b - bed) :effect (made ?b))
  (:action press :parameters (?t - tool ?l - lamp) :precondition (mended ?t) :effect (lit ?l)))
",
            "(define (problem p) (:domain d)
;                ^ W0709: problem `p` has no object of the types `tool`, `bed`
  (:objects a - cup l - lamp)
  (:init)
  (:goal (clean a)))
",
        ]);
    }
}
