#![doc = include_str!("constraint_position.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `constraint-position`.
pub const RULE: Rule = Rule {
    code: "E0805",
    name: "constraint-position",
    severity: Severity::Error,
    page: include_str!("constraint_position.md"),
};

/// A constraint has `wanted` parameters, and an action in it has `given` positions.
pub fn count(wanted: usize, given: usize, span: Span) -> Diagnostic {
    let plural = if wanted == 1 { "" } else { "s" };
    RULE.at(
        span,
        format!("the constraint has {wanted} parameter{plural}, and {given} positions are given"),
        "one position for each parameter of the constraint",
    )
}

/// `position` is none of the positions of `action`, which are `range`.
pub fn position(
    position: &str,
    action: &str,
    range: (usize, usize),
    span: Span,
    declared: Span,
) -> Diagnostic {
    let (first, last) = range;
    RULE.at(
        span,
        format!("action `{action}` has no argument at position `{position}`"),
        format!("a number from {first} to {last}"),
    )
    .label(declared, "declared here")
    .help("position 0 is the agent, 1 the first parameter")
}

/// The argument at a position and the parameter of the constraint, each with its type, do not fit.
pub fn types(
    argument: (&str, &str),
    parameter: (&str, &str),
    span: Span,
    declared: Span,
) -> Diagnostic {
    RULE.at(
        span,
        format!(
            "`{}` is of type `{}`, and `{}` of type `{}`",
            argument.0, argument.1, parameter.0, parameter.1
        ),
        "no object can be both",
    )
    .label(declared, "declared here")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn count_place_and_type() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent :concurrency-network)
  (:types arm table)
  (:predicates (up ?t - table))
  (:action lift :agent ?a - arm :parameters (?t - table) :effect (up ?t))
  (:concurrency-constraint one :parameters (?t - table) :bounds (2 inf) :actions ((lift 0 1)))
;                                                                                 ^^^^^^^^^^ E0805: the constraint has 1 parameter, and 2 positions are given
  (:concurrency-constraint two :parameters (?t - table) :bounds (2 1) :actions ((lift 2)))
;                                                                  ^ E0013: expected an upper bound that is not below the lower one
;                                                                                     ^ E0805: action `lift` has no argument at position `2`
  (:concurrency-constraint three :parameters (?t - table) :bounds (1 inf) :actions ((lift 0))))
;                                                                                         ^ E0805: `?a` is of type `arm`, and `?t` of type `table`
"]);
    }
}
