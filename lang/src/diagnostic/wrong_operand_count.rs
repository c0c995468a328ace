#![doc = include_str!("wrong_operand_count.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `wrong-operand-count`.
pub const RULE: Rule = Rule {
    code: "E0401",
    name: "wrong-operand-count",
    severity: Severity::Error,
    page: include_str!("wrong_operand_count.md"),
};

/// `keyword` takes `expected` operands and is given `given`.
pub fn wrong_operand_count(keyword: &str, expected: usize, given: usize, span: Span) -> Diagnostic {
    let plural = if expected == 1 { "" } else { "s" };
    let message = format!("`{keyword}` takes {expected} argument{plural}, {given} given");
    let help = match keyword {
        "not" if given > 1 => "negate each on its own: `(not …) (not …)`",
        "not" => "write `(not FORMULA)`",
        "imply" => "write `(imply CONDITION CONDITION)`",
        "when" => "write `(when CONDITION EFFECT)`",
        "forall" | "exists" => {
            "after the list of variables stands one formula; join several with `and`"
        }
        _ => "it compares two terms: `(= ?x ?y)`",
    };
    RULE.at(span, message, "").help(help)
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn of_each_connective() {
        check(&[
            "(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters (?d - dish)
    :precondition (and (not (clean ?d) (lit)) (imply (lit)) (= ?d) (forall (?e - dish)))
;                      ^^^^^^^^^^^^^^^^^^^^^^ E0401: `not` takes 1 argument, 2 given
;                                             ^^^^^^^^^^^^^ E0401: `imply` takes 2 arguments, 1 given
;                                                           ^^^^^^ E0401: `=` takes 2 arguments, 1 given
;                                                                  ^^^^^^^^^^^^^^^^^^^^ E0401: `forall` takes 2 arguments, 1 given
    :effect (and (not) (when (lit)) (clean ?d))))
;                ^^^^^ E0401: `not` takes 1 argument, 0 given
;                      ^^^^^^^^^^^^ E0401: `when` takes 2 arguments, 1 given
",
        ]);
    }

    #[test]
    fn empty_conjunctions_are_fine() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action wash
    :parameters ()
    :precondition ()
    :effect (and)))
"]);
    }
}
