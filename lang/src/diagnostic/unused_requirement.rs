#![doc = include_str!("unused_requirement.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-requirement`.
pub const RULE: Rule = Rule {
    code: "W0303",
    name: "unused-requirement",
    severity: Severity::Warning,
    page: include_str!("unused_requirement.md"),
};

/// Nothing needs these flags; there is at least one.
pub fn unused_requirement(flags: &[(&str, Span)]) -> Diagnostic {
    let names: Vec<String> = flags.iter().map(|(name, _)| format!("`{name}`")).collect();
    let message = match names.as_slice() {
        [only] => format!("requirement {only} is not needed"),
        several => format!("requirements {} are not needed", several.join(", ")),
    };
    let mut diagnostic = RULE.at(flags[0].1, message, "nothing in the domain needs it");
    for &(_, span) in &flags[1..] {
        diagnostic = diagnostic.label(span, "nor this");
    }
    diagnostic.help("remove it: a planner that does not know a flag refuses the file")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::lint;

    #[test]
    fn once_for_all_flags() {
        lint(&["(define (domain d)
  (:requirements :strips :typing :equality :conditional-effects :action-costs :preferences)
;                        ^^^^^^^ W0303: requirements `:typing`, `:conditional-effects`, `:action-costs` are not needed
  (:predicates (lit))
  (:action press :parameters () :effect (lit)))
"]);
    }

    #[test]
    fn what_needs_them() {
        lint(&["(define (domain d)
  (:requirements :typing :conditional-effects :action-costs :derived-predicates)
  (:types cup)
  (:predicates (lit ?c - cup) (dark) (off))
  (:functions (total-cost) - number)
  (:derived (dark) (off))
  (:action press
    :parameters (?c - cup)
    :effect (and (when (dark) (lit ?c)) (increase (total-cost) 1))))
"]);
    }

    #[test]
    fn a_misspelt_flag_is_said_once() {
        lint(&["(define (domain d)
  (:requirements :strips :conditional-effect)
;                        ^^^^^^^^^^^^^^^^^^^ W0301: unknown requirement `:conditional-effect`
  (:predicates (lit))
  (:action press :parameters () :effect (lit)))
"]);
    }
}
