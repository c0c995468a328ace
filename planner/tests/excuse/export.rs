//! The exported task against the search for excuses: its cheapest plans cost as much as the smallest excuses, and begin with one.

use std::collections::BTreeSet;

use lang::execute::Executor;
use lang::model::{Domain, Problem};
use lang::plan::{Plan, Step};
use lang::validate;
use planner::excuse::{self, Export, Outcome, Policy, Question, find};
use planner::heuristics::Kind;
use planner::limits::Limits;
use planner::search::{self, Config, Status, Strategy};
use planner::solve::{Obstacle, prepare};

use crate::brute::Change;
use crate::{cases, changes, random, read};

/// A cheapest plan and its cost, if there is a plan.
fn cheapest(domain: &Domain, problem: &Problem, strategy: Strategy) -> Option<(u64, Plan)> {
    let limits = Limits::default();
    let prepared = match prepare(domain, problem, &limits) {
        Ok(prepared) => prepared,
        Err(Obstacle::Unreachable) => return None,
        Err(other) => panic!("{other:?}"),
    };
    let mut best = None;
    let config = Config { strategy, ..Config::default() };
    let mut keep = |operators: &[_], cost| best = Some((cost, operators.to_vec()));
    let end = search::run(&prepared.encoded.task, &config, &limits, &mut keep);
    let Some((cost, operators)) = best else {
        assert_eq!(end.status, Status::Unsolvable);
        return None;
    };
    assert!(end.optimal);
    assert_eq!(prepared.normal.scale, 0, "costs are whole numbers");
    Some((cost, prepared.encoded.decoder(prepared.grounded).plan(&operators)))
}

/// What is exported, and the same as its texts are read.
fn exported(domain: &Domain, problem: &Problem, policy: &Policy) -> (Export, Domain, Problem) {
    let export = excuse::export(domain, problem, policy, u32::MAX, &Limits::default());
    let export = export.expect("it is small and plain");
    let (domain, problem) = read(&export.domain_text("Made."), &export.problem_text("Made."));
    (export, domain, problem)
}

/// What both ways agree on.
struct Compared {
    /// What a smallest excuse costs, if there is one.
    cost: Option<u32>,
    /// Whether its changes had to claim groups.
    claimed: bool,
}

/// Compares both ways to the smallest excuses.
fn compare(domain: &Domain, problem: &Problem, policy: &Policy, strategy: Strategy) -> Compared {
    let policy = Policy { objects: 0, ..policy.clone() };
    let (export, apart, task) = exported(domain, problem, &policy);
    let found = cheapest(&apart, &task, strategy);
    let question = Question { policy, most_excuses: usize::MAX, polish: 0, ..Question::default() };
    let (outcome, _) =
        find(domain, problem, &question, &Limits::default()).expect("it is plain PDDL");
    let Some((cost, plan)) = found else {
        assert!(matches!(outcome, Outcome::None { .. }), "no plan, but {outcome:?}");
        return Compared { cost: None, claimed: false };
    };
    let claim = |step: &Step| apart.actions[step.action.index()].name.text.starts_with("claim-");
    let claimed = plan.steps.iter().any(claim);
    let (made, plan) = export.read(&plan);
    let mut after = problem.clone();
    after.init.retain(|fact| made.iter().all(|(from, _)| from.as_ref() != Some(fact)));
    after.init.extend(made.iter().filter_map(|(_, to)| to.clone()));
    let executor = Executor::new(domain, &after).expect("it is stratified");
    assert!(validate::is_valid(&executor, &plan), "the plan for the changed problem");
    let cost = match outcome {
        Outcome::Solvable(_) => {
            assert_eq!((cost, made.len()), (0, 0), "there is a plan without changes");
            None
        }
        Outcome::Excuses { list, proven, complete, .. } => {
            assert!(proven && complete);
            assert_eq!(cost, u64::from(list[0].cost), "the cost");
            let made: BTreeSet<Change> = made.into_iter().collect();
            assert!(list.iter().any(|one| changes(one) == made), "no smallest excuse: {made:?}");
            Some(list[0].cost)
        }
        other => panic!("a plan that costs {cost}, but {other:?}"),
    };
    Compared { cost, claimed }
}

#[test]
fn cheapest_plans_of_exported_worlds_begin_with_smallest_excuses() {
    let mut found = 0;
    let mut claims = 0;
    for seed in 0..u64::from(cases()) {
        let (domain, problem) = random::world(seed);
        let compared = std::panic::catch_unwind(|| {
            let (domain, problem) = read(&domain, &problem);
            compare(&domain, &problem, &Policy::default(), Strategy::AStar(Kind::Blind))
        });
        let Ok(Compared { cost, claimed }) = compared else {
            panic!("seed {seed}:\n{domain}\n{problem}");
        };
        found += u32::from(cost.is_some());
        claims += u32::from(claimed);
    }
    println!("{found} with an excuse, {claims} with groups to claim, of {}", cases());
    assert!(found > cases() / 20, "only {found} of {} worlds had an excuse", cases());
    assert!(claims > cases() / 100, "only {claims} of {} worlds had groups to claim", cases());
}

macro_rules! domain {
    ($name:literal, $problem:literal) => {
        [
            include_str!(concat!("../../../domains/", $name, "/domain.pddl")),
            include_str!(concat!("../../../domains/", $name, "/", $problem, ".pddl")),
        ]
    };
}

#[test]
fn cheapest_plans_of_exported_domains_begin_with_smallest_excuses() {
    let costs = [
        (domain!("closed-drawer", "plate"), 1),
        (domain!("blocked-drawer", "plate"), 1),
        (domain!("rovers", "p01"), 1),
        (domain!("vials", "p01"), 1),
        (domain!("vials", "p02"), 2),
    ];
    for ([domain, problem], cost) in costs {
        let policy = declared(domain, problem);
        let (domain, problem) = read(domain, problem);
        let found = compare(&domain, &problem, &policy, Strategy::Optimal);
        assert_eq!(found.cost, Some(cost), "{}", problem.name.text);
    }
}

/// What a domain declares to exclude each other.
fn declared(domain: &str, problem: &str) -> Policy {
    let mut sources = lang::source::Sources::default();
    let first = sources.add("domain.pddl".to_owned(), domain.to_owned());
    let (annotations, _) = lang::annotations(&sources, first);
    let (domain, problem) = read(domain, problem);
    let declared = lang::group::groups(&annotations, &domain, Some(&problem));
    Policy { declared, ..Policy::default() }
}

/// Compares both ways on two texts, in which groups may be declared, and expects this cost.
fn check(domain: &str, problem: &str, cost: Option<u32>) {
    let policy = declared(domain, problem);
    let (domain, problem) = read(domain, problem);
    for strategy in [Strategy::AStar(Kind::Blind), Strategy::Optimal] {
        assert_eq!(compare(&domain, &problem, &policy, strategy).cost, cost);
    }
}

#[test]
fn two_things_change_places_though_neither_place_is_ever_empty() {
    let domain = "(define (domain shelf) (:requirements :typing) (:types box place)
      (:predicates (at ?box - box ?place - place) (counted))
      ;@ (:exactly-one (at ?box ?place))
      ;@ (:at-most-one (at ?thing ?place) (at ?box ?place))
      (:constants a b - box x y - place)
      (:action count :parameters () :precondition (and (at a y) (at b x)) :effect (counted)))";
    let problem = |init: &str| {
        format!("(define (problem p) (:domain shelf) (:init {init}) (:goal (counted)))")
    };
    check(domain, &problem("(at a x) (at b y)"), Some(6));
    check(domain, &problem("(at a y) (at b y)"), Some(3));
    check(domain, &problem("(at a y) (at b x)"), None);
}

#[test]
fn what_ranges_over_all_objects_does_not_range_over_variables_and_groups() {
    let domain = "(define (domain lamps) (:requirements :adl :derived-predicates)
      (:predicates (glows ?x) (dark) (ok) (done))
      (:derived (dark) (exists (?x) (not (glows ?x))))
      (:action finish :parameters () :precondition (forall (?x) (glows ?x)) :effect (ok))
      (:action end :parameters (?x) :precondition (and (ok) (not (dark))) :effect (done)))";
    let problem = "(define (problem p) (:domain lamps) (:objects a b c) (:init (glows a))
      (:goal (and (done) (forall (?x) (glows ?x)))))";
    check(domain, problem, None);
    let problem =
        "(define (problem p) (:domain lamps) (:objects a b c) (:init (glows a)) (:goal (done)))";
    check(domain, problem, Some(20));
}

#[test]
fn a_state_that_satisfies_the_goal_is_no_excuse() {
    let domain = "(define (domain d) (:requirements :adl :derived-predicates :typing)
      (:types lamp) (:constants c - lamp)
      (:predicates (lit ?x - lamp) (wired ?x - lamp) (powered ?x - lamp) (tested))
      (:derived (lit ?x - lamp) (and (wired ?x) (powered ?x)))
      (:action wire :parameters (?x - lamp) :precondition (and (powered ?x) (tested)) :effect (wired ?x)))";
    let problem = |init: &str, goal: &str| {
        format!(
            "(define (problem p) (:domain d) (:objects a b - lamp) (:init {init}) (:goal {goal}))"
        )
    };
    // With two changes, one of them tested or wired, it would hold at once, and with power alone it can be reached.
    check(domain, &problem("(tested)", "(and (lit a) (lit b) (lit c))"), Some(3));
    check(domain, &problem("(powered a)", "(and (lit a) (lit c))"), Some(2));
    check(domain, &problem("(tested) (powered a)", "(lit a)"), None);
    check(domain, &problem("(tested)", "(or (lit a) (lit b))"), Some(1));
    check(domain, &problem("(wired a) (wired c)", "(and (lit a) (lit c))"), Some(4));
    check(domain, &problem("(tested)", "(exists (?x - lamp) (lit ?x))"), Some(1));
    check(domain, &problem("(tested)", "(forall (?x - lamp) (imply (powered ?x) (lit ?x)))"), None);
}

#[test]
fn names_that_the_domain_has_already_are_not_taken_twice() {
    let domain =
        "(define (domain d) (:requirements :typing :action-costs) (:types thing variable group)
      (:predicates (editing) (Acting) (untouched ?variable - variable ?group - group) (was-nothing)
        (free ?variable - variable) (unclaimed ?group - group) (done))
      (:functions (total-cost) - number (price ?group - group) - number)
      ;@ (:exactly-one (free ?variable) (untouched ?variable ?group))
      ;@ (:at-most-one (unclaimed ?group) (untouched ?variable ?group))
      (:action begin :parameters (?variable - variable ?group - group)
        :precondition (and (untouched ?variable ?group) (was-nothing))
        :effect (and (Acting) (increase (total-cost) (price ?group))))
      (:action change-free-to-untouched :parameters (?variable - variable ?group - group)
        :precondition (and (Acting) (was-nothing) (untouched ?variable ?group)) :effect (done)))";
    let problem = "(define (problem p) (:domain d)
      (:objects whether-editing - variable one-of-free - group)
      (:init (free whether-editing) (unclaimed one-of-free) (= (total-cost) 0) (= (price one-of-free) 7))
      (:goal (done)) (:metric minimize (total-cost)))";
    check(domain, problem, Some(5));
}
