#![doc = include_str!("subtask_arity.md")]

use super::{Diagnostic, Rule, Severity, wrong_arity};
use crate::source::Span;

/// The kind `subtask-arity`.
pub const RULE: Rule = Rule {
    code: "E0901",
    name: "subtask-arity",
    severity: Severity::Error,
    page: include_str!("subtask_arity.md"),
};

/// The task `name` has another number of arguments than is given; `count` is both, `all` shows the declaration.
pub fn subtask_arity(
    name: &str,
    count: (usize, usize),
    missing: &str,
    all: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    wrong_arity::of(&RULE, &format!("task `{name}`"), count, missing, span, declared)
        .help(format!("declared as `{all}`"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn the_missing_one_is_named() {
        check(&["(define (domain d)
  (:requirements :typing :hierarchy)
  (:types cup place)
  (:predicates (in ?c - cup ?p - place))
  (:task tidy :parameters (?c - cup))
  (:method directly
    :parameters (?c - cup ?from ?to - place)
    :task (tidy ?c ?from)
;         ^^^^^^^^^^^^^^^ E0901: task `tidy` takes 1 argument, 2 given
    :precondition (in ?c ?from)
    :ordered-subtasks (and (move ?c ?to)))
;                          ^^^^^^^^^^^^^ E0901: task `move` takes 3 arguments, 2 given
  (:action move
    :parameters (?c - cup ?from ?to - place)
    :precondition (in ?c ?from)
    :effect (in ?c ?to)))
"]);
    }
}
