//! What becomes of a condition: how many schemas, what is joined over, filtered, expanded, derived.

use lang::source::Sources;
use planner::normal::Normal;
use planner::normalize::normalize;

/// The normal form of a domain with static `s`, `r` and changing `p`, `q`, whose one action has this precondition.
fn normal(precondition: &str) -> Normal {
    problem(precondition, "(p a)", "", "")
}

fn problem(precondition: &str, goal: &str, effect: &str, metric: &str) -> Normal {
    let mut sources = Sources::default();
    let domain = sources.add(
        "domain.pddl",
        format!(
            "(define (domain d) (:requirements :adl :action-costs)
              (:predicates (s ?x) (r ?x ?y) (p ?x) (q ?x ?y)) (:functions (total-cost) - number (length ?x) - number)
              (:action act :parameters (?x ?y) :precondition {precondition}
                :effect (and (p ?x) (not (q ?x ?y)) {effect})))"
        ),
    );
    let problem = sources.add(
        "problem.pddl",
        format!(
            "(define (problem p) (:domain d) (:objects a b) (:init (= (length a) 1.25) (= (length b) 3)) (:goal {goal}) {metric})"
        ),
    );
    let (domain, diagnostics) = lang::read_domain(&sources, domain);
    assert!(!diagnostics.has_errors(), "{}", lang::render::full(&diagnostics, &sources, false));
    let (problem, diagnostics) = lang::read_problem(&sources, problem, &domain);
    assert!(!diagnostics.has_errors(), "{}", lang::render::full(&diagnostics, &sources, false));
    normalize(&domain, &problem).expect("the problem can be planned")
}

/// For each schema: bound variables, literals, filters, universals.
fn shape(normal: &Normal) -> Vec<(usize, usize, usize, usize)> {
    let condition = |schema: &planner::normal::Schema| {
        let condition = &schema.condition;
        (
            schema.bound,
            condition.literals.len(),
            condition.filters.len(),
            condition.universals.len(),
        )
    };
    normal.schemas.iter().map(condition).collect()
}

#[test]
fn a_static_disjunction_stays_one_filter() {
    assert_eq!(shape(&normal("(and (p ?x) (or (s ?x) (r ?x ?y) (= ?x ?y)))")), [(2, 1, 1, 0)]);
}

#[test]
fn a_disjunction_over_facts_splits_the_action() {
    assert_eq!(shape(&normal("(or (p ?x) (q ?x ?y))")), [(2, 1, 0, 0), (2, 1, 0, 0)]);
}

#[test]
fn a_mixed_disjunction_asks_for_the_fact_only_where_the_static_part_fails() {
    // `imply` over a static predicate: nothing where it does not hold, the fact where it does.
    assert_eq!(shape(&normal("(imply (s ?x) (p ?y))")), [(2, 0, 1, 0), (2, 2, 0, 0)]);
}

#[test]
fn static_quantifiers_are_filters_and_bind_nothing() {
    assert_eq!(shape(&normal("(exists (?z) (and (r ?x ?z) (r ?z ?y)))")), [(2, 0, 1, 0)]);
}

#[test]
fn an_existential_over_facts_becomes_a_variable() {
    assert_eq!(shape(&normal("(exists (?z) (and (r ?x ?z) (q ?z ?y)))")), [(3, 2, 0, 0)]);
}

#[test]
fn a_guarded_universal_is_expanded_and_needs_no_axiom() {
    let normal = normal("(forall (?z) (imply (r ?x ?z) (not (p ?z))))");
    assert_eq!(shape(&normal), [(2, 0, 0, 1)]);
    assert!(normal.rules.is_empty());
}

#[test]
fn a_universal_over_a_disjunction_of_facts_needs_an_axiom_for_each_disjunct() {
    let normal = normal("(forall (?z) (or (p ?z) (q ?z ?x)))");
    assert_eq!(shape(&normal), [(2, 0, 0, 1)]);
    assert_eq!(normal.rules.len(), 2);
}

#[test]
fn too_many_disjuncts_are_hidden_behind_derived_predicates() {
    let part = "(or (p ?x) (p ?y) (q ?x ?y) (q ?y ?x))";
    let normal = normal(&format!("(and {part} {part} {part} {part})"));
    assert!(normal.schemas.len() <= 64 && !normal.rules.is_empty());
    assert_eq!(normal.schemas.len(), 64);
    assert_eq!(normal.rules.len(), 4);
}

#[test]
fn a_goal_that_is_no_conjunction_is_derived() {
    assert_eq!(problem("()", "(or (p a) (p b))", "", "").rules.len(), 2);
    assert!(problem("()", "(and (p a) (not (q a b)))", "", "").rules.is_empty());
}

#[test]
fn decimal_costs_are_scaled_together() {
    let effect = "(increase (total-cost) 0.5) (increase (total-cost) (length ?x))";
    let normal = problem("()", "(p a)", effect, "(:metric minimize (total-cost))");
    assert_eq!(normal.scale, 2);
    assert!(matches!(normal.schemas[0].costs[0], planner::normal::Cost::Constant(50)));
    assert!(!problem("()", "(p a)", effect, "").uses_metric);
}
