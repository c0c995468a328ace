//! What is seen once against many times.

use learner::rule::{self, Options, Rule};

use super::words::{action, domain, trace};

const LAMP: &str = "(define (domain lamp) (:requirements :strips :typing) (:types lamp)
  (:predicates (plugged ?l - lamp) (lit ?l - lamp) (warm ?l - lamp))
  (:action press :parameters (?l - lamp) :effect (and)))";

const LIT: &str = "((:state (plugged l)) (:action (press l)) (:state (plugged l) (lit l)))";

/// What is learned from nine usual examples and an odd one.
fn learn(odd: &str, options: &Options) -> rule::Learned {
    let domain = domain(LAMP);
    let mut traces: Vec<_> = (0..9).map(|at| trace(&format!("t{at}"), &domain, LIT)).collect();
    traces.push(trace("odd", &domain, odd));
    rule::learn(&domain, &traces, options)
}

const DARK: &str = "((:state (plugged l)) (:action (press l)) (:state (plugged l)))";
const LOOSE: &str = "((:state) (:action (press l)) (:state (lit l)))";

#[test]
fn an_effect_that_fails_once_is_refused_unless_it_is_outvoted() {
    let learned = learn(DARK, &Options::default());
    assert!(learned.actions.is_empty());
    assert_eq!(
        learned.refused[0].describe(&learned.domain),
        "`press` added `(lit ?l)` in 9 examples and did not in 1"
    );
    let tolerant = Options { tolerance: 0.1, ..Options::default() };
    assert_eq!(action(&learn(DARK, &tolerant), "press").adds.len(), 1);
    let strict = Options { tolerance: 0.09, ..Options::default() };
    assert!(learn(DARK, &strict).actions.is_empty());
}

#[test]
fn the_rule_of_the_thesis_goes_by_the_majority() {
    let options = Options { rule: Rule::Changed, ..Options::default() };
    assert_eq!(action(&learn(DARK, &options), "press").adds.len(), 1);
}

#[test]
fn a_precondition_that_was_missing_once_goes_unless_that_is_outvoted() {
    assert_eq!(action(&learn(LOOSE, &Options::default()), "press").required, []);
    let tolerant = Options { tolerance: 0.1, ..Options::default() };
    let learned = learn(LOOSE, &tolerant);
    let press = action(&learned, "press");
    assert_eq!((press.required.len(), press.doubts[0].seen, press.doubts[0].of), (1, 9, 10));
}
