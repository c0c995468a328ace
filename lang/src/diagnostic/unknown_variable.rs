#![doc = include_str!("unknown_variable.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-variable`.
pub const RULE: Rule = Rule {
    code: "E0102",
    name: "unknown-variable",
    severity: Severity::Error,
    page: include_str!("unknown_variable.md"),
};

/// No variable `name` is bound in `owner`; `scope` lists what is, with types.
pub fn unknown_variable(
    name: &str,
    span: Span,
    owner: &str,
    scope: &[String],
    near: Option<&str>,
) -> Diagnostic {
    let diagnostic =
        RULE.at(span, format!("variable `{name}` is not bound in {owner}"), "not bound here");
    match near {
        Some(_) => diagnostic.suggest(near),
        None if scope.is_empty() => diagnostic.help("no variable is in scope"),
        None => diagnostic.help(format!("in scope: {}", scope.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn once_in_each_action() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?dish - dish)
    :precondition (in ?dis sink)
;                     ^^^^ E0102: variable `?dis` is not bound in action `wash`
    :effect (and (clean ?dis) (clean ?x))))
;                                    ^^ E0102: variable `?x` is not bound in action `wash`
"]);
    }

    #[test]
    fn a_quantifier_binds_inside_only() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters ()
    :precondition (and (forall (?d - dish) (clean ?d)) (in ?d sink))
;                                                          ^^ E0102: variable `?d` is not bound in action `wash`
    :effect (lit)))
",
        ]);
    }
}
