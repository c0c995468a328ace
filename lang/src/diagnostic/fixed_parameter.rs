#![doc = include_str!("fixed_parameter.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `fixed-parameter`.
pub const RULE: Rule = Rule {
    code: "W0107",
    name: "fixed-parameter",
    severity: Severity::Warning,
    page: include_str!("fixed_parameter.md"),
};

/// The parameter `name` of `action`, declared at `declared`, must be `other`, as is said at `span`.
pub fn fixed_parameter(
    name: &str,
    other: &str,
    action: &str,
    span: Span,
    declared: Span,
) -> Diagnostic {
    let message = format!("parameter `{name}` of action `{action}` can only be `{other}`");
    RULE.at(span, message, "demanded here")
        .label(declared, "the parameter")
        .help(format!("write `{other}` wherever `{name}` stands and remove the parameter, so that fewer ground actions are tried"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn only_what_is_demanded() {
        lint(&["(define (domain d)
  (:requirements :adl)
  (:constants sink)
  (:predicates (in ?x ?y) (clean ?x))
  (:action wash
    :parameters (?x ?y ?z)
    :precondition (and (in ?x ?y) (= sink ?y) (not (= ?x ?y)) (or (= ?x sink) (clean ?z)) (and (= ?x ?z)))
;                                 ^^^^^^^^^^^ W0107: parameter `?y` of action `wash` can only be `sink`
;                                                                                              ^^^^^^^^^ W0107: parameter `?z` of action `wash` can only be `?x`
    :effect (clean ?x)))
"]);
    }
}
