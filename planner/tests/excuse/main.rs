//! Excuses of random tiny problems against a search that tries every change and looks at every state.

mod brute;
mod random;
mod export;

use std::collections::BTreeSet;

use lang::model::{Domain, Fact, Problem};
use lang::source::Sources;
use planner::excuse::{self, Outcome, Policy, Question, catalogue, find};
use planner::limits::Limits;
use proptest::prelude::*;

use brute::{Change, Tried};

/// Reads two texts that are known to be right.
fn read(domain: &str, problem: &str) -> (Domain, Problem) {
    let mut sources = Sources::default();
    let first = sources.add("domain.pddl".to_owned(), domain.to_owned());
    let second = sources.add("problem.pddl".to_owned(), problem.to_owned());
    let (domain, found) = lang::read_domain(&sources, first);
    assert!(!found.has_errors(), "{}", lang::render::concise(&found, &sources));
    let (problem, found) = lang::read_problem(&sources, second, &domain);
    assert!(!found.has_errors(), "{}", lang::render::concise(&found, &sources));
    (domain, problem)
}

/// The changes of an excuse as facts.
fn changes(excuse: &excuse::Excuse) -> BTreeSet<Change> {
    excuse.changes.iter().map(|change| (change.from.clone(), change.to.clone())).collect()
}

/// So many sets of changes are tried by hand at most, and so much may they cost.
const SETS: usize = 4_000;
const COST: u32 = 4;

/// Compares one world. Says whether it had a smallest excuse. Without `abstraction` all nogoods are explanations of what was reached.
fn compare(domain: &str, problem: &str, abstraction: bool) -> bool {
    let (domain, problem) = read(domain, problem);
    let limits = Limits::default();
    let policy = Policy { objects: 0, ..Policy::default() };
    let question = Question {
        policy: policy.clone(),
        most_excuses: usize::MAX,
        polish: 0,
        abstraction,
        ..Question::default()
    };
    let (outcome, _) = find(&domain, &problem, &question, &limits).expect("it is plain PDDL");
    let known = catalogue(&domain, &problem, &policy, COST, &limits).expect("it is small");
    let solvable = brute::has_plan(&domain, &problem);
    assert_eq!(matches!(outcome, Outcome::Solvable(_)), solvable, "whether there is a plan");
    let Some(known) = known.filter(|_| !solvable) else { return false };
    let tried = brute::smallest(&domain, &problem, &known, COST, SETS);
    if tried == Tried::TooMany {
        return false;
    }
    match outcome {
        Outcome::Excuses { list, proven, complete, .. } => {
            assert!(proven && complete);
            if let Tried::Smallest(cost, sets) = tried {
                assert_eq!(list[0].cost, cost, "the cost");
                let ours: BTreeSet<BTreeSet<Change>> = list.iter().map(changes).collect();
                assert_eq!(ours, sets, "all smallest excuses");
                return true;
            }
            assert!(list[0].cost > COST, "none so cheap was found by hand");
        }
        Outcome::None { .. } => assert_eq!(tried, Tried::Nothing, "an excuse is lost"),
        other => panic!("{other:?}"),
    }
    false
}

/// How many worlds are tried.
fn cases() -> u32 {
    let asked = std::env::var_os("PROPTEST_CASES").is_some();
    if asked { ProptestConfig::default().cases } else { 400 }
}

#[test]
fn smallest_excuses_are_those_that_trying_everything_finds() {
    compare_worlds(true);
}

#[test]
fn smallest_excuses_are_the_same_where_only_what_was_reached_is_explained() {
    compare_worlds(false);
}

fn compare_worlds(abstraction: bool) {
    let mut found = 0;
    let config =
        ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) };
    let mut runner = proptest::test_runner::TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let seeds = any::<u64>();
    let counter = std::cell::Cell::new(0_u32);
    runner
        .run(&seeds, |seed| {
            let (domain, problem) = random::world(seed);
            let result = std::panic::catch_unwind(|| compare(&domain, &problem, abstraction));
            match result {
                Ok(true) => counter.set(counter.get() + 1),
                Ok(false) => {}
                Err(_) => {
                    return Err(TestCaseError::fail(format!("{domain}\n{problem}")));
                }
            }
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    found += counter.get();
    assert!(found > cases() / 10, "only {found} of {} worlds had an excuse", cases());
}

#[test]
fn an_excuse_never_makes_the_goal_true_at_once() {
    let domain = "(define (domain d) (:requirements :strips :derived-predicates)
      (:predicates (lit) (wired) (powered) (tested))
      (:derived (lit) (and (wired) (powered)))
      (:action wire :parameters () :precondition (and (powered) (tested)) :effect (wired)))";
    let problem = "(define (problem p) (:domain d) (:init (tested)) (:goal (lit)))";
    let (domain, problem) = read(domain, problem);
    let (outcome, _) =
        find(&domain, &problem, &Question::default(), &Limits::default()).expect("it is plain");
    let Outcome::Excuses { list, .. } = outcome else { panic!("{outcome:?}") };
    let powered = |fact: &Fact| domain.predicates[fact.predicate.index()].name.text == "powered";
    assert_eq!(list.len(), 1);
    assert!(list[0].changes[0].to.as_ref().is_some_and(powered));
    assert_eq!(list[0].plan.steps.len(), 1);
}

#[test]
fn the_catalogue_has_no_change_that_no_possible_state_has() {
    let domain = "(define (domain d) (:requirements :strips)
      (:predicates (charge ?rover ?level) (below ?level ?other) (seen ?rover))
      (:action use :parameters (?rover ?from ?to) :precondition (and (charge ?rover ?from) (below ?to ?from))
        :effect (and (not (charge ?rover ?from)) (charge ?rover ?to)))
      (:action see :parameters (?rover ?level ?to) :precondition (and (charge ?rover ?level) (below ?to ?level))
        :effect (and (seen ?rover) (not (charge ?rover ?level)) (charge ?rover ?to))))";
    let problem = "(define (problem p) (:domain d) (:objects r low high) (:init (charge r low) (below low high))
      (:goal (and (seen r) (charge r low))))";
    let (domain, problem) = read(domain, problem);
    let policy = Policy { objects: 0, goal: true, ..Policy::default() };
    let known = catalogue(&domain, &problem, &policy, COST, &Limits::default());
    let known = known.expect("it is small").expect("the goal is in reach");
    let of_charge = |fact: &Option<Fact>| {
        fact.as_ref()
            .is_some_and(|fact| domain.predicates[fact.predicate.index()].name.text == "charge")
    };
    let charge = known.variables.iter().find(|choice| of_charge(&choice.from));
    let charge = charge.expect("the charge can be changed");
    assert!(charge.to.iter().all(|(to, _)| of_charge(to)), "a rover has some charge: {charge:?}");
    assert!(!charge.to.is_empty());
}
