#![doc = include_str!("private_access.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `private-access`.
pub const RULE: Rule = Rule {
    code: "E0803",
    name: "private-access",
    severity: Severity::Warning,
    page: include_str!("private_access.md"),
};

/// An action of `actor` uses the predicate `name`, which is private to agents of type `owner`.
pub fn private_access(
    name: &str,
    actor: &str,
    owner: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    RULE.at(
        span,
        format!(
            "`{name}` is private to an agent of type `{owner}` other than the acting `{actor}`"
        ),
        "private to another agent",
    )
    .label(declared, "declared private here")
    .help(format!("name the acting agent `{actor}` here, or make `{name}` public"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn of_another_agent() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent :unfactored-privacy)
  (:types arm person table)
  (:predicates (up ?t - table) (:private ?a - arm (holds ?a - arm ?t - table) (tired)))
  (:action lift
    :agent ?a - arm
    :parameters (?t - table ?b - arm)
    :precondition (and (holds ?a ?t) (holds ?b ?t))
;                                    ^^^^^^^^^^^^^ E0803: `holds` is private to an agent of type `arm` other than the acting `?a`
    :effect (up ?t))
  (:action look
    :agent ?p - person
    :parameters (?t - table)
    :precondition (tired)
;                 ^^^^^^^ E0803: `tired` is private to an agent of type `arm` other than the acting `?p`
    :effect (up ?t)))
"]);
    }
}
