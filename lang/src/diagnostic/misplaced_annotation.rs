#![doc = include_str!("misplaced_annotation.md")]

use super::{Diagnostic, Rule, Severity};
use crate::annotation::Place;
use crate::source::Span;

/// The kind `misplaced-annotation`.
pub const RULE: Rule = Rule {
    code: "W1003",
    name: "misplaced-annotation",
    severity: Severity::Warning,
    page: include_str!("misplaced_annotation.md"),
};

/// Annotations of the kind `name` do not stand in `place`, but where `stands` says.
pub fn misplaced_annotation(name: &str, span: Span, place: &Place, stands: &str) -> Diagnostic {
    RULE.at(span, format!("`{name}` says nothing here"), format!("it stands in {place}"))
        .help(format!("`{name}` belongs {stands}"))
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_kind_has_its_places() {
        check(&["(define (domain d)
  ;@ (:seen 3)
;     ^^^^^ W1003: `:seen` says nothing here
  (:predicates (p)) ;@ (:at-most-one (p))
  (:action a
    :precondition (and (p) ;@ (:measured (weight ?x))
;                              ^^^^^^^^^ W1003: `:measured` says nothing here
      ;@ (:causal \"a.json\" :outcome (= on 1))
    )
    :effect ;@ (:seen 3) (:causal \"a.json\" :outcome (= on 1))
;                         ^^^^^^^ W1003: `:causal` says nothing here
    (p)))
"]);
    }
}
