//! What a person reads of a plan that fails.

use insta::assert_snapshot;

use crate::text::Fixture;

const STACKING: &str = "(:requirements :adl :typing) (:types cube)
  (:predicates (table ?c - cube) (top ?a ?b - cube) (clear ?c - cube) (holding ?c - cube) (free) (red ?c - cube))
  (:action pick :parameters (?c - cube)
    :precondition (and (free) (table ?c) (clear ?c))
    :effect (and (holding ?c) (not (free)) (not (table ?c)) (not (clear ?c))))
  (:action put :parameters (?c - cube)
    :precondition (holding ?c)
    :effect (and (not (holding ?c)) (free) (table ?c) (clear ?c)))
  (:action stack :parameters (?a ?b - cube)
    :precondition (and (holding ?a) (clear ?b))
    :effect (and (not (holding ?a)) (free) (top ?a ?b) (clear ?a) (not (clear ?b))))
  (:action paint :parameters (?c ?d - cube)
    :precondition (and (not (holding ?c)) (not (= ?c ?d)))
    :effect (red ?c))
  (:action leave :parameters ()
    :precondition (and (forall (?c - cube) (imply (red ?c) (or (table ?c) (exists (?d - cube) (top ?c ?d))))) (free)))
  (:action show :parameters (?c - cube)
    :precondition (and (red ?c) (exists (?d - cube) (and (top ?d ?c) (not (red ?d))))))";

fn stacking(goal: &str) -> Fixture {
    let problem = format!(
        "(:objects A B C - cube)
  (:init (free) (red B) (table A) (table B) (table C) (clear A) (clear B) (clear C))
  (:goal {goal})"
    );
    Fixture::new(STACKING, &problem)
}

#[test]
fn a_valid_plan() {
    assert_snapshot!(stacking("(top a b)").verdict("(pick a) (stack a b)"), @r#"
    Plan executed successfully - checking goal
    Plan valid
    Final value: 2

    The plan is valid: 2 steps, cost 2.
    "#);
}

#[test]
fn a_dropped_step_is_inserted_again() {
    assert_snapshot!(stacking("(and (top a b) (top c a))").verdict("(pick a) (stack a b) (stack c a)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 3 (stack c a): its precondition does not hold.
      (holding C) is false: it was never true
    Repair: the plan is valid with (pick c) inserted before step 3 (stack c a).
    "#);
}

#[test]
fn a_dropped_step_is_inserted_further_up() {
    assert_snapshot!(stacking("(and (top a b) (top b c))").verdict("(pick b) (pick a) (stack a b)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 2 (pick a): its precondition does not hold.
      (free) is false: step 1 (pick b) deleted it
    Repair: the plan is valid with (stack b c) inserted before step 2 (pick a).
    "#);
}

#[test]
fn exchanged_steps_are_moved_back() {
    assert_snapshot!(stacking("(and (top a b) (top c a))").verdict("(pick a) (pick c) (stack a b) (stack c a)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 2 (pick c): its precondition does not hold.
      (free) is false: step 1 (pick a) deleted it
    Repair: the plan is valid with step 3 (stack a b) moved before step 2 (pick c).
    "#);
}

#[test]
fn a_plan_that_ends_too_early() {
    assert_snapshot!(stacking("(and (top a b) (not (clear b)))").verdict("(pick a)"), @r#"
    Plan executed successfully - checking goal
    Goal not satisfied
    Plan invalid

    The plan fails at the goal, which does not hold in the end.
      (top A B) is false: it was never true
      (clear B) is true and must be false: it held from the beginning
    Repair: the plan is valid with (stack a b) inserted at the end.
    "#);
}

#[test]
fn a_plan_that_no_one_step_mends() {
    assert_snapshot!(stacking("(and (top a b) (top b c))").verdict(""), @r#"
    Plan executed successfully - checking goal
    Goal not satisfied
    Plan invalid

    The plan fails at the goal, which does not hold in the end.
      (top A B) is false: it was never true
      (top B C) is false: it was never true
    Repair: no one step was found that mends the plan; set (top A B) to true, and set (top B C) to true.
    "#);
}

#[test]
fn a_forbidden_fact_and_an_inequality() {
    assert_snapshot!(stacking("(top a b)").verdict("(pick a) (paint a a)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 2 (paint a a): its precondition does not hold.
      (holding A) is true and must be false: step 1 (pick a) added it
      (not (= ?c ?d)) is false: both are A
    "#);
}

#[test]
fn a_universal_condition_names_its_counterexample() {
    assert_snapshot!(stacking("(red c)").verdict("(pick b) (leave)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 2 (leave): its precondition does not hold.
      (imply (red B) (or (table B) (exists (?d - cube) (top B ?d)))) does not hold
        (red B) is true: it held from the beginning
        (or (table B) (exists (?d - cube) (top B ?d))) does not hold
          (table B) is false: step 1 (pick b) deleted it
          (exists (?d - cube) (top B ?d)) does not hold
      (free) is false: step 1 (pick b) deleted it
    "#);
}

#[test]
fn an_existential_condition_is_quoted() {
    assert_snapshot!(stacking("(free)").verdict("(show b)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 1 (show b): its precondition does not hold.
      (exists (?d - cube) (and (top ?d B) (not (red ?d)))) does not hold
    "#);
}

#[test]
fn a_goal_with_a_disjunction() {
    assert_snapshot!(stacking("(or (top a b) (and (holding c) (holding b)))").verdict("(pick c)"), @r#"
    Plan executed successfully - checking goal
    Goal not satisfied
    Plan invalid

    The plan fails at the goal, which does not hold in the end.
      (or (top A B) (and (holding C) (holding B))) does not hold
        (top A B) is false: it was never true
        (holding B) is false: it was never true
    "#);
}

#[test]
fn derived_facts_name_the_step_since_which_they_changed() {
    let mut fixture = Fixture::new(
        "(:requirements :adl :derived-predicates) (:predicates (edge ?x ?y) (path ?x ?y) (seen ?x))
  (:derived (path ?x ?y) (or (edge ?x ?y) (exists (?z) (and (edge ?x ?z) (path ?z ?y)))))
  (:action cut :parameters (?x ?y) :precondition (edge ?x ?y) :effect (not (edge ?x ?y)))
  (:action join :parameters (?x ?y) :precondition (not (path ?y ?x)) :effect (edge ?x ?y))
  (:action walk :parameters (?x ?y) :precondition (path ?x ?y) :effect (seen ?y))",
        "(:objects a b c) (:init (edge a b) (edge b c)) (:goal (seen c))",
    );
    assert_snapshot!(fixture.verdict("(walk a b) (cut b c) (walk a c)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 3 (walk a c): its precondition does not hold.
      (path a c) is false: no rule derives it since step 2 (cut b c)
    Repair: the plan is valid with (join a c) inserted before step 3 (walk a c).
    "#);
    assert_snapshot!(fixture.verdict("(cut a b) (cut b c) (join a b) (join b c) (join c a)"), @r#"
    Plan failed to execute
    Plan invalid

    The plan fails at step 5 (join c a): its precondition does not hold.
      (path a c) is true and must be false: a rule derives it since step 4 (join b c)
    "#);
}

#[test]
fn a_failure_is_a_diagnostic_at_the_false_condition() {
    assert_snapshot!(stacking("(and (top a b) (top b c))").diagnostic("(pick b)\n(pick a)\n(stack a b)"), @r#"
    error[E0720]: the plan fails at step 2 (pick a): its precondition does not hold
     --> domain.pddl:5:24
      |
    5 |     :precondition (and (free) (table ?c) (clear ?c))
      |                        ^^^^^^ (free) is false: step 1 (pick b) deleted it
      |
     ::: plan:2:1
      |
    2 | (pick a)
      | -------- step 2
      |
      = help: the plan is valid with (stack b c) inserted before step 2 (pick a)
    "#);
    assert_snapshot!(stacking("(and (top a b) (not (clear b)))").diagnostic("(pick a)"), @r#"
    error[E0721]: the plan fails at the goal, which does not hold in the end
     --> problem.pddl:4:15
      |
    4 |   (:goal (and (top a b) (not (clear b)))))
      |               ^^^^^^^^^      --------- (clear B) is true and must be false: it held from the beginning
      |               |
      |               (top A B) is false: it was never true
      |
      = help: the plan is valid with (stack a b) inserted at the end
    "#);
}
