//! What PDDL means, one rule a test.

use lang::plan::Plan;
use lang::source::Sources;
use lang::validate::{Verdict, judge};
use rust_decimal::Decimal;

use crate::text::Fixture;

/// The cost of a plan that must be valid.
fn cost(fixture: &mut Fixture, plan: &str) -> Decimal {
    let (listing, notes) = fixture.plan(plan);
    assert_eq!(notes, "");
    match judge(&fixture.executor(), &listing.plan) {
        Verdict::Valid(success) => success.cost,
        Verdict::Invalid(failure) => panic!("{failure:?}"),
    }
}

fn valid(domain: &str, problem: &str, plan: &str) -> bool {
    let mut fixture = Fixture::new(domain, problem);
    let (listing, notes) = fixture.plan(plan);
    assert_eq!(notes, "");
    matches!(judge(&fixture.executor(), &listing.plan), Verdict::Valid(_))
}

#[test]
fn a_fact_that_a_step_both_deletes_and_adds_holds_after() {
    let domain = "(:predicates (p) (q))
        (:action first :parameters () :effect (and (p) (not (p))))
        (:action second :parameters () :effect (and (not (q)) (q)))";
    assert!(valid(domain, "(:init) (:goal (and (p) (q)))", "(first) (second)"));
    assert!(valid(domain, "(:init (p) (q)) (:goal (and (p) (q)))", "(first) (second)"));
}

#[test]
fn effects_read_the_state_before() {
    let domain = "(:requirements :conditional-effects) (:predicates (p) (q))
        (:action swap :parameters () :effect (and
            (when (p) (and (q) (not (p)))) (when (q) (and (p) (not (q))))))";
    assert!(valid(domain, "(:init (p)) (:goal (q))", "(swap)"));
    assert!(valid(domain, "(:init (p)) (:goal (p))", "(swap) (swap)"));
    assert!(!valid(domain, "(:init (p)) (:goal (p))", "(swap)"));
    assert!(valid(domain, "(:init (p) (q)) (:goal (and (p) (q)))", "(swap)"));
}

#[test]
fn a_universal_effect_reaches_all_objects_of_its_type_and_no_others() {
    let domain = "(:requirements :adl :typing) (:types cup plate) (:predicates (wet ?x) (broken ?x))
        (:action rain :parameters () :effect (forall (?c - cup) (when (not (broken ?c)) (wet ?c))))";
    let problem =
        |goal: &str| format!("(:objects a b - cup c - plate) (:init (broken b)) (:goal {goal})");
    assert!(valid(domain, &problem("(wet a)"), "(rain)"));
    assert!(!valid(domain, &problem("(wet b)"), "(rain)"));
    assert!(!valid(domain, &problem("(wet c)"), "(rain)"));
}

#[test]
fn quantifiers_over_an_empty_type_are_true_and_false() {
    let domain = "(:requirements :adl :typing) (:types cup) (:predicates (wet ?x))";
    assert!(valid(domain, "(:init) (:goal (forall (?c - cup) (wet ?c)))", ""));
    assert!(!valid(domain, "(:init) (:goal (exists (?c - cup) (not (wet ?c))))", ""));
    assert!(!valid(domain, "(:init) (:goal (exists (?c - cup) (and)))", ""));
}

#[test]
fn derived_predicates_are_recursive_and_negated_in_layers() {
    let domain = "(:requirements :adl :derived-predicates)
        (:predicates (edge ?x ?y) (path ?x ?y) (apart ?x ?y) (lonely ?x))
        (:derived (path ?x ?y) (or (edge ?x ?y) (exists (?z) (and (edge ?x ?z) (path ?z ?y)))))
        (:derived (apart ?x ?y) (and (not (path ?x ?y)) (not (path ?y ?x)) (not (= ?x ?y))))
        (:derived (lonely ?x) (forall (?y) (imply (not (= ?x ?y)) (apart ?x ?y))))
        (:action join :parameters (?x ?y) :precondition (lonely ?y) :effect (edge ?x ?y))
        (:action cut :parameters (?x ?y) :precondition (path ?x ?y) :effect (not (edge ?x ?y)))";
    let problem =
        |goal: &str| format!("(:objects a b c d) (:init (edge a b) (edge b c)) (:goal {goal})");
    assert!(valid(domain, &problem("(and (path a c) (not (path c a)) (lonely d))"), ""));
    assert!(valid(domain, &problem("(and (path a d) (not (lonely d)))"), "(join c d)"));
    assert!(!valid(domain, &problem("(path d c)"), "(join d c)"));
    assert!(valid(domain, &problem("(and (apart a c) (lonely a))"), "(cut a b)"));
}

#[test]
fn recursion_through_forall_reaches_its_fixpoint() {
    let domain = "(:requirements :adl :derived-predicates) (:predicates (edge ?x ?y) (safe ?x))
        (:derived (safe ?x) (forall (?y) (imply (edge ?x ?y) (safe ?y))))";
    let objects = "(:objects a b c d e) (:init (edge a b) (edge b c) (edge d e) (edge e d))";
    assert!(valid(domain, &format!("{objects} (:goal (and (safe a) (safe b) (safe c)))"), ""));
    assert!(valid(domain, &format!("{objects} (:goal (not (or (safe d) (safe e))))"), ""));
}

#[test]
fn negation_in_a_circle_is_refused_with_its_place() {
    let mut sources = Sources::default();
    let id = sources.add(
        "domain.pddl",
        "(define (domain d)
(:requirements :adl :derived-predicates) (:predicates (p) (q))
        (:derived (p) (not (q)))
        (:derived (q) (p)))",
    );
    let (domain, diagnostics) = lang::read_domain(&sources, id);
    assert_eq!(diagnostics.list.len(), 1);
    let diagnostic = &diagnostics.list[0];
    assert_eq!(sources.text(diagnostic.primary.span), "(q)");
    assert_eq!(diagnostic.message, "`p` is derived from its own negation");
    assert_eq!(diagnostic.primary.text, "`q` is negated here and depends on it in turn");
    let unstratified = lang::execute::stratified(&domain).unwrap_err();
    assert_eq!(unstratified.span, diagnostic.primary.span);
}

const COSTS: &str = "(:requirements :action-costs :typing) (:types place)
    (:predicates (at ?x - place)) (:functions (total-cost) - number (length ?x ?y - place) - number)
    (:action go :parameters (?x ?y - place) :precondition (at ?x)
        :effect (and (at ?y) (not (at ?x)) (increase (total-cost) (length ?x ?y))))
    (:action fly :parameters (?y - place) :effect (and (at ?y) (increase (total-cost) 2.75)))";

fn roads(metric: &str) -> Fixture {
    let problem = format!(
        "(:objects a b - place) (:init (at a) (= (total-cost) 0) (= (length a b) 0.1) (= (length b a) 0.2))
        (:goal (at b)) {metric}"
    );
    Fixture::new(COSTS, &problem)
}

#[test]
fn costs_are_exact_decimals() {
    let mut fixture = roads("(:metric minimize (total-cost))");
    assert_eq!(cost(&mut fixture, "(go a b) (go b a) (go a b)"), Decimal::new(4, 1));
    assert_eq!(cost(&mut fixture, "(go a b) (go b a) (fly b)"), Decimal::new(305, 2));
}

#[test]
fn without_a_metric_each_step_costs_one_even_where_it_increases_total_cost() {
    assert_eq!(cost(&mut roads(""), "(go a b) (go b a) (fly b)"), Decimal::from(3));
}

#[test]
fn a_cost_without_a_value_fails_the_plan() {
    let mut fixture = roads("(:metric minimize (total-cost))");
    let said = fixture.verdict("(go a a) (go a b)");
    assert!(
        said.contains("at step 1 (go a a): its cost needs (length a a), which has no value"),
        "{said}"
    );
}

#[test]
fn facts_are_the_same_whatever_their_case() {
    let domain = "(:predicates (On ?x)) (:action PUT :parameters (?X) :effect (oN ?x))";
    assert!(valid(domain, "(:objects Box) (:init) (:goal (ON BOX))", "(Put bOx)"));
}

#[test]
fn the_empty_plan_is_valid_where_the_goal_holds() {
    let mut fixture = Fixture::new("(:predicates (p))", "(:init (p)) (:goal (p))");
    assert_eq!(cost(&mut fixture, "; nothing to do\n"), Decimal::ZERO);
    assert_eq!(fixture.plan("").0.plan, Plan::default());
}
