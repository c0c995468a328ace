//! How much is evaluated, which no one sees from outside.

use super::Executor;
use crate::source::Sources;

/// How much evaluating the goal of `problem` takes, in a world of 300 nodes in a row, and what it comes to.
fn work(goal: &str) -> (u64, bool) {
    let domain = "(define (domain row) (:requirements :adl :derived-predicates)
        (:predicates (edge ?x ?y) (mark ?x) (path ?x ?y) (pair ?x ?y))
        (:derived (path ?x ?y) (or (edge ?x ?y) (exists (?z) (and (edge ?x ?z) (path ?z ?y)))))
        (:derived (pair ?x ?y) (not (edge ?x ?y))))";
    let objects = (0..300).map(|at| format!("n{at}")).collect::<Vec<_>>().join(" ");
    let edges =
        (0..299).map(|at| format!("(edge n{at} n{})", at + 1)).collect::<Vec<_>>().join(" ");
    let problem = format!(
        "(define (problem p) (:domain row) (:objects {objects}) (:init {edges} (mark n150)) (:goal {goal}))"
    );
    let mut sources = Sources::default();
    let (domain_id, problem_id) = (sources.add("domain", domain), sources.add("problem", problem));
    let (domain, diagnostics) = crate::read_domain(&sources, domain_id);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    let (problem, diagnostics) = crate::read_problem(&sources, problem_id, &domain);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    let executor = Executor::new(&domain, &problem).expect("nothing is derived from its negation");
    let holds = executor.goal(&executor.initial());
    (executor.work(), holds)
}

#[test]
fn atoms_bind_the_variables_of_quantifiers() {
    let chain = "(and (edge ?a ?b) (edge ?b ?c) (edge ?c ?d) (mark ?d))";
    let (steps, holds) = work(&format!("(exists (?a ?b ?c ?d) {chain})"));
    assert!(holds && steps < 100, "{steps}");
    let (steps, holds) = work(&format!("(forall (?a ?b ?c ?d) (imply {chain} (mark ?a)))"));
    assert!(!holds && steps < 100, "{steps}");
    let (steps, holds) = work(
        "(forall (?a ?b ?c ?d) (or (not (mark ?a)) (not (edge ?a ?b)) (not (edge ?c ?b)) (= ?a ?c)))",
    );
    assert!(holds && steps < 100, "{steps}");
}

#[test]
fn questions_that_share_no_variable_are_not_multiplied() {
    let (steps, holds) = work(
        "(and (exists (?a ?b) (edge ?a ?b)) (exists (?c ?d) (edge ?c ?d)) (exists (?e ?f) (and (edge ?e ?f) (mark ?e) (mark ?f))))",
    );
    assert!(!holds && steps < 100, "{steps}");
}

#[test]
fn only_the_derived_predicates_that_are_asked_for_are_worked_out() {
    let (steps, holds) = work("(exists (?x) (mark ?x))");
    assert!(holds && steps < 100, "{steps}");
    // Of 44 850 paths each is found once and tried once.
    let (steps, holds) = work("(path n0 n299)");
    assert!(holds && (44_850..500_000).contains(&steps), "{steps}");
}
