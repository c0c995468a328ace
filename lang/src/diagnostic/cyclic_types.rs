#![doc = include_str!("cyclic_types.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `cyclic-types`.
pub const RULE: Rule = Rule {
    code: "E0204",
    name: "cyclic-types",
    severity: Severity::Error,
    page: include_str!("cyclic_types.md"),
};

/// The types in `names` are each below the next one, and the last is below the first.
pub fn cyclic_types(names: &[String], span: Span, others: &[Span]) -> Diagnostic {
    let first = names.first().map_or("", String::as_str);
    let chain: Vec<String> =
        names.iter().chain(names.first()).map(|name| format!("`{name}`")).collect();
    let mut diagnostic = RULE
        .at(
            span,
            format!("type `{first}` is a subtype of itself: {}", chain.join(" - ")),
            "the cycle goes through here",
        )
        .help("remove one of these supertypes");
    for &other in others {
        diagnostic = diagnostic.label(other, "and through here");
    }
    diagnostic
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn two_types_and_one() {
        check(&["(define (domain d) (:requirements :typing)
  (:types a - b
;         ^ E0204: type `a` is a subtype of itself: `a` - `b` - `a`
    b - a
    c - c)
;   ^ E0204: type `c` is a subtype of itself: `c` - `c`
  (:predicates (p ?x - a)))
"]);
    }

    #[test]
    fn object_may_stand_anywhere() {
        check(&["(define (domain d) (:requirements :typing)
  (:types a b object - object c - b object)
  (:predicates (p ?x - a)))
"]);
    }
}
