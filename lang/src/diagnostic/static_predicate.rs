#![doc = include_str!("static_predicate.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `static-predicate`.
pub const RULE: Rule = Rule {
    code: "W0710",
    name: "static-predicate",
    severity: Severity::Warning,
    page: include_str!("static_predicate.md"),
};

/// No action changes the predicate, and all its `facts` are in the initial state of `problem`.
pub fn static_predicate(name: &str, declared: Span, facts: u64, problem: &str) -> Diagnostic {
    let message = format!("predicate `{name}` holds for everything in problem `{problem}`");
    RULE.at(declared, message, "always true").help(format!(
        "no action changes it and `:init` lists all {facts} facts: conditions on it only cost time"
    ))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn for_every_combination() {
        lint(&["(define (domain d)
  (:predicates (near ?x ?y) (known ?x ?y) (lit ?x))
;               ^^^^ W0710: predicate `near` holds for everything in problem `p`
  (:action walk :parameters (?x ?y) :precondition (and (near ?x ?y) (known ?x ?y)) :effect (lit ?y)))
",
"(define (problem p) (:domain d)
  (:objects a b)
  (:init (near a a) (near a b) (near b a) (near b b) (known a a) (known a b) (known b a))
  (:goal (lit b)))
"]);
    }
}
