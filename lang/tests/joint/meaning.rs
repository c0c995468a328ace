//! What both semantics must say, one rule of the language a test: where both were wrong, the other tests would not see it.

use crate::{Both, Texts, joint};
use lang::execute::joint::Concurrency;

/// A world of `a1`, `a2` and `a3`, of which the predicates, actions and true facts are given.
fn world(predicates: &str, actions: &str, init: &str) -> Both {
    let domain = format!(
        "(define (domain d) (:requirements :adl :multi-agent) (:types arm)
          (:predicates {predicates}) {actions})"
    );
    let problem = format!(
        "(define (problem p) (:domain d) (:objects a1 a2 a3 - arm) (:init {init}) (:goal (and)))"
    );
    Both::read(Texts { domain, problem })
}

/// Whether both say that these lines can be joined at first.
fn joins(both: &Both, lines: &[&str], concurrency: Concurrency) -> bool {
    let parts: Vec<_> = lines.iter().map(|line| both.parse(line)).collect();
    let lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
    let executor = both.executor();
    let first = executor.join(&executor.initial(), &parts, concurrency).is_ok();
    let safe = concurrency == Concurrency::Safe;
    let second = both.world.joins(&both.world.initial, &joint(&lines), safe);
    assert_eq!(first, second, "{lines:?}");
    first
}

fn liberal(both: &Both, lines: &[&str]) -> bool {
    joins(both, lines, Concurrency::Liberal)
}

/// What holds after these lines; both must say the same.
fn after(both: &Both, lines: &[&str]) -> String {
    let parts: Vec<_> = lines.iter().map(|line| both.parse(line)).collect();
    let lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
    let executor = both.executor();
    let mut state = executor.initial();
    executor.apply_joint(&mut state, &parts);
    let facts = both.world.after(&both.world.initial, &joint(&lines));
    assert_eq!(both.lines(&state.facts()), facts, "{lines:?}");
    facts.into_iter().collect::<Vec<_>>().join(" ")
}

#[test]
fn an_atom_that_must_be_false_does_not_count_the_own_action() {
    let both = world(
        "(done)",
        "(:action grab :agent ?a - arm :precondition (forall (?b - arm) (not (grab ?b))) :effect (done))",
        "",
    );
    assert!(liberal(&both, &["(grab a1)"]));
    assert!(!liberal(&both, &["(grab a1)", "(grab a2)"]));
}

#[test]
fn under_two_negations_an_atom_must_be_true() {
    let both = world(
        "(done)",
        "(:action grab :agent ?a - arm :precondition (not (forall (?b - arm) (not (grab ?b)))) :effect (done))
         (:action touch :agent ?a - arm :precondition (imply (touch ?a) (done)) :effect (done))",
        "",
    );
    assert!(liberal(&both, &["(grab a1)"]));
    assert!(liberal(&both, &["(touch a1)"]));
}

#[test]
fn an_atom_that_must_be_true_counts_the_own_action() {
    let both = world(
        "(done)",
        "(:action grab :agent ?a - arm :precondition (exists (?b - arm) (grab ?b)) :effect (done))
         (:action pair :agent ?a - arm :precondition (exists (?b - arm) (and (not (= ?a ?b)) (pair ?b))) :effect (done))",
        "",
    );
    assert!(liberal(&both, &["(grab a1)"]));
    assert!(!liberal(&both, &["(pair a1)"]));
    assert!(liberal(&both, &["(pair a1)", "(pair a2)"]));
    assert!(liberal(&both, &["(pair a1)", "(pair a2)", "(grab a3)"]));
    assert!(!liberal(&both, &["(pair a1)", "(grab a2)"]));
}

#[test]
fn the_condition_of_an_effect_counts_the_own_action() {
    let both = world(
        "(own) (nobody)",
        "(:action lift :agent ?a - arm :effect (and (when (lift ?a) (own)) (when (forall (?b - arm) (not (lift ?b))) (nobody))))",
        "",
    );
    assert_eq!(after(&both, &["(lift a1)"]), "(own)");
}

#[test]
fn all_conditions_read_the_state_before() {
    let both = world(
        "(on ?a)",
        "(:action copy :agent ?a - arm :parameters (?b - arm) :precondition (copy ?b ?a)
           :effect (and (when (on ?b) (on ?a)) (when (not (on ?b)) (not (on ?a)))))",
        "(on a1)",
    );
    assert!(liberal(&both, &["(copy a1 a2)", "(copy a2 a1)"]));
    assert_eq!(after(&both, &["(copy a1 a2)", "(copy a2 a1)"]), "(on a2)");
}

#[test]
fn what_one_part_adds_no_other_may_delete_but_one_alone_may_do_both() {
    let both = world(
        "(p)",
        "(:action add :agent ?a - arm :effect (p)) (:action delete :agent ?a - arm :effect (not (p)))
         (:action both :agent ?a - arm :effect (and (not (p)) (p)))",
        "",
    );
    assert!(!liberal(&both, &["(add a1)", "(delete a2)"]));
    assert!(!liberal(&both, &["(both a1)", "(both a2)"]));
    assert!(liberal(&both, &["(both a1)"]));
    assert!(!liberal(&both, &["(both a1)", "(add a2)"]));
    assert_eq!(after(&both, &["(both a1)"]), "(p)");
}

#[test]
fn two_take_one_fact_unless_parts_must_not_interfere() {
    let both = world(
        "(free) (has ?a)",
        "(:action grab :agent ?a - arm :precondition (free) :effect (and (not (free)) (has ?a)))
         (:action look :agent ?a - arm :effect (has ?a))",
        "(free)",
    );
    assert!(liberal(&both, &["(grab a1)", "(grab a2)"]));
    assert!(!joins(&both, &["(grab a1)", "(grab a2)"], Concurrency::Safe));
    assert!(joins(&both, &["(grab a1)", "(look a2)"], Concurrency::Safe));
    assert_eq!(after(&both, &["(grab a1)", "(grab a2)"]), "(has a1) (has a2)");
}

#[test]
fn each_agent_does_one_thing_and_nobody_is_one_more() {
    let both = world(
        "(p)",
        "(:action one :agent ?a - arm :effect (p)) (:action two :agent ?a - arm :effect (p))
         (:action rain :effect (p)) (:action snow :effect (p))",
        "",
    );
    assert!(!liberal(&both, &["(one a1)", "(two a1)"]));
    assert!(liberal(&both, &["(one a1)", "(two a2)", "(rain)"]));
    assert!(!liberal(&both, &["(rain)", "(snow)"]));
    assert!(!liberal(&both, &[]));
}

#[test]
fn a_cost_may_depend_on_who_acts_and_counts_the_own_action() {
    let domain = "(define (domain d) (:requirements :adl :multi-agent :action-costs) (:types arm)
        (:predicates (p)) (:functions (total-cost) - number)
        (:action lift :agent ?a - arm :effect (and (p)
          (when (exists (?b - arm) (lift ?b)) (increase (total-cost) 1))
          (when (exists (?b - arm) (and (not (= ?a ?b)) (lift ?b))) (increase (total-cost) 10)))))"
        .to_owned();
    let problem =
        "(define (problem p) (:domain d) (:objects a1 a2 - arm) (:init (= (total-cost) 0))
        (:goal (p)) (:metric minimize (total-cost)))"
            .to_owned();
    let both = Both::read(Texts { domain, problem });
    for (lines, cost) in [(&["(lift a1)"][..], 1), (&["(lift a1)", "(lift a2)"], 22)] {
        let parts: Vec<_> = lines.iter().map(|line| both.parse(line)).collect();
        let lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        let executor = both.executor();
        assert_eq!(executor.joint_cost(&executor.initial(), &parts), Ok(cost.into()));
        assert_eq!(both.world.cost(&both.world.initial, &joint(&lines)), cost);
    }
}
