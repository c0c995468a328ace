#![doc = include_str!("unknown_task.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-task`.
pub const RULE: Rule = Rule {
    code: "E0902",
    name: "unknown-task",
    severity: Severity::Error,
    page: include_str!("unknown_task.md"),
};

/// No task is called `name`, and no action either where `actions` may stand.
pub fn unknown_task(name: &str, span: Span, actions: bool, near: Option<&str>) -> Diagnostic {
    let label = if actions { "neither a task nor an action" } else { "no `:task` has this name" };
    RULE.at(span, format!("unknown task `{name}`"), label).suggest(near)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_a_method_and_in_a_problem() {
        check(&[
            "(define (domain d)
  (:requirements :typing :hierarchy)
  (:types cup)
  (:predicates (clean ?c - cup))
  (:task tidy :parameters (?c - cup))
  (:method directly
    :parameters (?c - cup)
    :task (tdy ?c)
;          ^^^ E0902: unknown task `tdy`
    :subtasks (and (wash ?c) (wsah ?c)))
;                             ^^^^ E0902: unknown task `wsah`
  (:action wash :parameters (?c - cup) :effect (clean ?c)))
",
            "(define (problem p) (:domain d)
  (:objects mug - cup)
  (:htn :parameters (?c - cup) :tasks (and (tidy mug) (tidy ?c) (sweep))))
;                                                                ^^^^^ E0902: unknown task `sweep`
",
        ]);
    }
}
