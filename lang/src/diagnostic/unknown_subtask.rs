#![doc = include_str!("unknown_subtask.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-subtask`.
pub const RULE: Rule = Rule {
    code: "E0903",
    name: "unknown-subtask",
    severity: Severity::Error,
    page: include_str!("unknown_subtask.md"),
};

/// No subtask of the network is called `name`.
pub fn unknown_subtask(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("unknown subtask `{name}`"), "no subtask here has this name");
    match near {
        Some(_) => diagnostic.suggest(near),
        None => diagnostic.help("name subtasks as in `(first (TASK …))`"),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn in_an_ordering() {
        check(&["(define (domain d)
  (:requirements :hierarchy)
  (:predicates (clean))
  (:task tidy :parameters ())
  (:method twice
    :parameters ()
    :task (tidy)
    :subtasks (and (one (wash)) (two (wash)))
    :ordering (and (< one two) (< two three)))
;                                     ^^^^^ E0903: unknown subtask `three`
  (:action wash :parameters () :effect (clean)))
"]);
    }
}
