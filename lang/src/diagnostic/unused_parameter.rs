#![doc = include_str!("unused_parameter.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unused-parameter`.
pub const RULE: Rule = Rule {
    code: "W0101",
    name: "unused-parameter",
    severity: Severity::Warning,
    page: include_str!("unused_parameter.md"),
};

/// The parameter `name` of `owner` is used nowhere.
pub fn unused_parameter(name: &str, owner: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("parameter `{name}` of {owner} is never used"), "unused")
        .help("remove it: an unused parameter multiplies the number of ground actions by the number of its objects")
}

/// Says in the help of such a diagnostic that `count` objects of `problem` may stand for the parameter.
pub fn tell_factor(diagnostic: &mut Diagnostic, count: u64, problem: &str) {
    diagnostic.help = Some(format!(
        "remove it: an unused parameter multiplies the number of ground actions by the number of its objects (here {count}, in problem `{problem}`)"
    ));
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn the_last_of_three() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish ?p ?q - place)
;                             ^^ W0101: parameter `?q` of action `wash` is never used
    :precondition (in ?d ?p)
    :effect (clean ?d)))
"]);
    }

    #[test]
    fn a_quantifier_may_hide_it() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (exists (?d - dish) (clean ?d))
;                          ^^ W0102: `?d` hides another `?d` of action `wash`
    :effect (lit)))
"]);
    }

    #[test]
    fn what_others_ask_with_is_used() {
        check(&["(define (domain d)
  (:requirements :adl :multi-agent)
  (:types arm table box)
  (:predicates (up ?t - table) (tired ?a - arm))
  (:action hold
    :agent ?a - arm
    :parameters (?t - table)
    :effect (tired ?a))
  (:action wait
    :agent ?a - arm
    :parameters (?t - table)
;                ^^ W0101: parameter `?t` of action `wait` is never used
    :effect (not (tired ?a)))
  (:action lift
    :agent ?a - arm
    :parameters (?t - table)
    :precondition (exists (?b - arm) (and (not (= ?a ?b)) (hold ?b ?t)))
    :effect (up ?t)))
"]);
    }

    #[test]
    fn what_a_constraint_counts_is_used() {
        check(&["(define (domain d)
  (:requirements :typing :multi-agent :concurrency-network)
  (:types arm table)
  (:predicates (done ?a - arm))
  (:action polish
    :agent ?a - arm
    :parameters (?t - table)
    :effect (done ?a))
  (:concurrency-constraint one
    :parameters (?t - table)
    :bounds (1 1)
    :actions ((polish 1))))
"]);
    }
}
