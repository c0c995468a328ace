//! Random tiny tasks go through every part of the search, and through a simulator that does the same in the most obvious way.

use std::collections::HashMap;

use planner::axioms::Evaluator;
use planner::heuristics::{Costs, DEAD_END, Kind};
use planner::limits::Limits;
use planner::random::Random;
use planner::registry::Registry;
use planner::search::{self, Config, Status, Strategy};
use planner::state::Packer;
use planner::successor::Successors;
use planner::task::{Axiom, Effect, Fact, Operator, OperatorId, Task, Variable, VariableId};
use proptest::prelude::{Just, ProptestConfig, Strategy as Generator, any, proptest};

/// What a random task may have.
#[derive(Debug, Clone, Copy)]
struct Features {
    conditional_effects: bool,
    axioms: bool,
}

/// Where the parts of a task come from.
struct Source {
    random: Random,
}

impl Source {
    fn below(&mut self, bound: u32) -> u32 {
        self.random.below(u64::from(bound)) as u32
    }

    fn fact(&mut self, task: &Task, variables: u32) -> Fact {
        let variable = self.below(variables);
        let value = self.below(task.variables[variable as usize].domain_size);
        Fact { variable: VariableId(variable), value }
    }

    /// Up to `most` facts, at most one for each of the first `variables`.
    fn facts(&mut self, task: &Task, variables: u32, most: u32) -> Vec<Fact> {
        let mut facts: Vec<Fact> =
            (0..self.below(most + 1)).map(|_| self.fact(task, variables)).collect();
        facts.sort();
        facts.dedup_by_key(|fact| fact.variable);
        facts
    }
}

fn pool<T: Clone>(pool: &mut Vec<T>, items: &[T]) -> std::ops::Range<u32> {
    let first = pool.len() as u32;
    pool.extend_from_slice(items);
    first..pool.len() as u32
}

fn build(seed: u64, features: Features) -> Task {
    let mut source = Source { random: Random::new(seed) };
    let mut task = Task { uses_metric: true, ..Task::default() };
    let states = 4 + source.below(3);
    for _ in 0..states {
        let domain_size = 2 + source.below(3);
        task.variables.push(Variable { domain_size, axiom_layer: None, default: 0 });
        let value = source.below(domain_size);
        task.initial_state.push(value);
    }
    let derived = if features.axioms { 1 + source.below(3) } else { 0 };
    for index in 0..derived {
        let default = source.below(2);
        // Two to a layer, so that there are positive cycles.
        task.variables.push(Variable { domain_size: 2, axiom_layer: Some(index / 2), default });
        task.initial_state.push(default);
    }
    let all = states + derived;
    for index in 0..derived {
        for _ in 0..=source.below(2) {
            let head = VariableId(states + index);
            let mut conditions = source.facts(&task, all, 3);
            conditions.retain(|fact| {
                let variable = &task.variables[fact.variable.index()];
                match variable.axiom_layer {
                    Some(layer) => {
                        layer < index / 2 || layer == index / 2 && fact.value != variable.default
                    }
                    None => true,
                }
            });
            let value = 1 - task.variables[head.index()].default;
            let conditions = pool(&mut task.condition_pool, &conditions);
            task.axioms.push(Axiom { conditions, head: Fact { variable: head, value } });
        }
    }
    for _ in 0..8 + source.below(12) {
        let precondition = source.facts(&task, all, 2);
        let mut effects = Vec::new();
        for _ in 0..=source.below(3) {
            let has_conditions = features.conditional_effects && source.below(2) == 0;
            let conditions = if has_conditions { source.facts(&task, all, 2) } else { Vec::new() };
            let fact = source.fact(&task, states);
            let conditions = pool(&mut task.condition_pool, &conditions);
            effects.push(Effect { conditions, fact });
        }
        let precondition = pool(&mut task.precondition_pool, &precondition);
        let effects = pool(&mut task.effect_pool, &effects);
        let cost = source.below(5);
        task.operators.push(Operator { precondition, effects, cost });
    }
    task.goal = source.facts(&task, all, 4);
    for fact in &mut task.goal {
        // Mostly something to do.
        if fact.value == task.initial_state[fact.variable.index()] && source.below(4) > 0 {
            fact.value = (fact.value + 1) % task.variables[fact.variable.index()].domain_size;
        }
    }
    task
}

fn task(features: Features) -> impl Generator<Value = Task> {
    any::<u64>().prop_map(move |seed| build(seed, features))
}

fn any_task() -> impl Generator<Value = Task> {
    (any::<bool>(), any::<bool>())
        .prop_map(|(conditional_effects, axioms)| Features { conditional_effects, axioms })
        .prop_flat_map(|features| (Just(features), any::<u64>()))
        .prop_map(|(features, seed)| build(seed, features))
}

fn holds(facts: &[Fact], values: &[u32]) -> bool {
    facts.iter().all(|fact| values[fact.variable.index()] == fact.value)
}

/// The derived values, layer by layer, each until nothing changes.
fn derive(task: &Task, values: &mut [u32]) {
    let layers = task
        .variables
        .iter()
        .filter_map(|variable| variable.axiom_layer)
        .max()
        .map_or(0, |layer| layer + 1);
    for (value, variable) in values.iter_mut().zip(&task.variables) {
        if variable.axiom_layer.is_some() {
            *value = variable.default;
        }
    }
    for layer in 0..layers {
        loop {
            let before = values.to_vec();
            for axiom in &task.axioms {
                let is_here =
                    task.variables[axiom.head.variable.index()].axiom_layer == Some(layer);
                if is_here && holds(task.conditions(&axiom.conditions), values) {
                    values[axiom.head.variable.index()] = axiom.head.value;
                }
            }
            if before == values {
                break;
            }
        }
    }
}

fn initial(task: &Task) -> Vec<u32> {
    let mut values = task.initial_state.clone();
    derive(task, &mut values);
    values
}

fn apply(task: &Task, operator: OperatorId, values: &[u32]) -> Vec<u32> {
    let mut after = values.to_vec();
    for effect in task.effects(operator) {
        if holds(task.conditions(&effect.conditions), values) {
            after[effect.fact.variable.index()] = effect.fact.value;
        }
    }
    derive(task, &mut after);
    after
}

fn applicable(task: &Task, values: &[u32]) -> Vec<OperatorId> {
    task.operator_ids().filter(|&operator| holds(task.precondition(operator), values)).collect()
}

/// All reachable states with the cost of a cheapest plan from each, by going over all of them until nothing changes.
fn distances(task: &Task, cost: impl Fn(OperatorId) -> u64) -> HashMap<Vec<u32>, Option<u64>> {
    let mut distances = HashMap::from([(initial(task), None)]);
    let mut order = vec![initial(task)];
    let mut next = 0;
    while next < order.len() {
        for operator in applicable(task, &order[next]) {
            let after = apply(task, operator, &order[next]);
            if !distances.contains_key(&after) {
                distances.insert(after.clone(), None);
                order.push(after);
            }
        }
        next += 1;
    }
    loop {
        let mut is_stable = true;
        for state in &order {
            let mut best: Option<u64> = holds(&task.goal, state).then_some(0);
            for operator in applicable(task, state) {
                if let Some(rest) = distances[&apply(task, operator, state)] {
                    best = Some(best.map_or(u64::MAX, |best| best).min(rest + cost(operator)));
                }
            }
            if best != distances[state] {
                distances.insert(state.clone(), best);
                is_stable = false;
            }
        }
        if is_stable {
            return distances;
        }
    }
}

fn metric(task: &Task) -> impl Fn(OperatorId) -> u64 {
    |operator| u64::from(task.operators[operator.index()].cost)
}

/// Runs a strategy; all its plans are replayed. Gives the outcome's status, whether it claims optimality, and the last plan's length and cost.
fn run(task: &Task, strategy: Strategy, anytime: bool) -> (Status, bool, Option<(usize, u64)>) {
    let mut plans = Vec::new();
    let config = Config { strategy, anytime, ..Config::default() };
    let outcome = search::run(task, &config, &Limits::default(), &mut |plan, cost| {
        plans.push((plan.to_vec(), cost));
    });
    let mut before = u64::MAX;
    for (plan, cost) in &plans {
        let mut values = initial(task);
        for &operator in plan {
            assert!(
                holds(task.precondition(operator), &values),
                "{strategy}: a step is applicable"
            );
            values = apply(task, operator, &values);
        }
        assert!(holds(&task.goal, &values), "{strategy}: the goal holds in the end");
        assert_eq!(
            plan.iter().map(|&operator| metric(task)(operator)).sum::<u64>(),
            *cost,
            "{strategy}"
        );
        assert!(*cost < before, "{strategy}: each plan is cheaper than the one before");
        before = *cost;
    }
    (outcome.status, outcome.optimal, plans.last().map(|(plan, cost)| (plan.len(), *cost)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn estimates_keep_the_promises_of_their_profiles(task in any_task()) {
        let distances = distances(&task, metric(&task));
        for kind in Kind::ALL {
            let profile = kind.profile();
            let mut heuristic = kind.build(&task, Costs::Metric);
            for (state, &distance) in &distances {
                let estimate = heuristic.evaluate(state);
                let limit = distance.unwrap_or(u64::MAX);
                assert!(estimate != DEAD_END || distance.is_none(), "{} is safe", profile.name);
                if profile.admissible && estimate != DEAD_END {
                    assert!(u64::from(estimate) <= limit, "{} is admissible in {state:?}: {estimate} > {limit}", profile.name);
                }
                heuristic.enter(state);
                for operator in applicable(&task, state) {
                    let after = apply(&task, operator, state);
                    let child = heuristic.evaluate_child(operator, &after);
                    assert!(child != DEAD_END || distances[&after].is_none(), "{} is safe for successors", profile.name);
                    if profile.admissible && child != DEAD_END {
                        assert!(u64::from(child) <= distances[&after].unwrap_or(u64::MAX), "{} is admissible for successors", profile.name);
                    }
                    if profile.consistent && child != DEAD_END && estimate != DEAD_END {
                        assert!(u64::from(estimate) <= u64::from(child) + metric(&task)(operator), "{} is consistent", profile.name);
                    }
                }
            }
        }
    }

    #[test]
    fn lmcut_is_never_below_hmax(task in task(Features { conditional_effects: false, axioms: true })) {
        let mut hmax = Kind::Hmax.build(&task, Costs::Metric);
        let mut lmcut = Kind::LmCut.build(&task, Costs::Metric);
        for state in distances(&task, metric(&task)).keys() {
            assert!(hmax.evaluate(state) <= lmcut.evaluate(state));
        }
    }

    #[test]
    fn a_star_finds_the_optimal_cost_with_every_admissible_heuristic(task in any_task()) {
        let optimum = distances(&task, metric(&task))[&initial(&task)];
        let kinds = Kind::ALL.into_iter().filter(|kind| kind.profile().admissible).map(Strategy::AStar);
        for strategy in kinds.chain([Strategy::Optimal]) {
            let (status, optimal, plan) = run(&task, strategy, false);
            assert_eq!(plan.map(|(_, cost)| cost), optimum, "{strategy}");
            assert_eq!(status, if optimum.is_some() { Status::Solved } else { Status::Unsolvable });
            assert_eq!(optimal, optimum.is_some());
        }
    }

    #[test]
    fn greedy_searches_find_a_plan_where_there_is_one(task in any_task()) {
        let optimum = distances(&task, metric(&task))[&initial(&task)];
        for kind in Kind::ALL {
            for strategy in [Strategy::Eager(kind), Strategy::Lazy(kind)] {
                let (status, _, plan) = run(&task, strategy, false);
                assert_eq!(plan.is_some(), optimum.is_some(), "{strategy}");
                assert_eq!(status, if optimum.is_some() { Status::Solved } else { Status::Unsolvable });
            }
        }
    }

    #[test]
    fn breadth_first_plans_have_the_fewest_steps(task in any_task()) {
        let fewest = distances(&task, |_| 1)[&initial(&task)];
        let (_, _, plan) = run(&task, Strategy::Breadth, false);
        assert_eq!(plan.map(|(steps, _)| steps as u64), fewest);
    }

    #[test]
    fn going_on_for_cheaper_plans_ends_with_an_optimal_one(task in any_task()) {
        let optimum = distances(&task, metric(&task))[&initial(&task)];
        let (_, optimal, plan) = run(&task, Strategy::First, true);
        assert_eq!(plan.map(|(_, cost)| cost), optimum);
        assert_eq!(optimal, optimum.is_some());
    }

    #[test]
    fn states_operators_and_derived_values_are_those_of_the_simulator(task in any_task()) {
        let packer = Packer::new(&task);
        let successors = Successors::new(&task);
        let mut axioms = Evaluator::new(&task);
        let mut registry = Registry::new(packer.words());
        let mut words = vec![0; packer.words()];
        for (index, state) in distances(&task, |_| 1).keys().enumerate() {
            let mut found = Vec::new();
            successors.applicable(state, &mut found);
            found.sort();
            assert_eq!(&found, &applicable(&task, state));
            packer.pack(state, &mut words);
            let (id, is_new) = registry.insert(&words);
            assert!(is_new && id.index() == index && registry.insert(&words) == (id, false));
            let mut values = task.initial_state.clone();
            packer.unpack(registry.words(id), &mut values);
            axioms.evaluate(&mut values);
            assert_eq!(&values, state);
            assert!(packer.is_goal(&words).is_none_or(|goal| goal == holds(&task.goal, state)));
            for operator in found {
                packer.pack(state, &mut words);
                packer.apply(&task, operator, state, &mut words);
                packer.unpack(&words, &mut values);
                axioms.evaluate(&mut values);
                assert_eq!(&values, &apply(&task, operator, state));
            }
        }
    }
}

#[test]
fn a_registry_keeps_its_ids_while_it_grows() {
    let mut registry = Registry::new(3);
    let state = |number: u32| [number, number / 7, !number];
    for number in 0..50_000 {
        assert_eq!(registry.insert(&state(number)).0.0, number);
    }
    for number in 0..50_000 {
        let (id, is_new) = registry.insert(&state(number));
        assert!(!is_new && id.0 == number && registry.words(id) == state(number));
    }
}

#[test]
fn a_goal_that_holds_at_once_takes_no_steps() {
    let variable = Variable { domain_size: 2, axiom_layer: None, default: 0 };
    let mut task = Task { variables: vec![variable], initial_state: vec![1], ..Task::default() };
    for goal in [vec![], vec![Fact { variable: VariableId(0), value: 1 }]] {
        task.goal = goal;
        for strategy in
            [Strategy::Optimal, Strategy::First, Strategy::Breadth, Strategy::Eager(Kind::Ff)]
        {
            for anytime in [false, true] {
                assert_eq!(run(&task, strategy, anytime).2, Some((0, 0)), "{strategy}");
            }
        }
    }
    task.goal = vec![Fact { variable: VariableId(0), value: 0 }];
    for strategy in
        [Strategy::Optimal, Strategy::First, Strategy::Breadth, Strategy::Eager(Kind::Ff)]
    {
        assert_eq!(run(&task, strategy, false).0, Status::Unsolvable, "{strategy}");
    }
}

#[test]
fn costs_beyond_what_a_node_holds_are_no_proof_of_anything() {
    let mut task = Task { uses_metric: true, ..Task::default() };
    task.variables = vec![Variable { domain_size: 2, axiom_layer: None, default: 0 }];
    task.initial_state = vec![0];
    task.goal = vec![Fact { variable: VariableId(0), value: 1 }];
    task.effect_pool = vec![Effect { conditions: 0..0, fact: task.goal[0] }];
    task.operators = vec![Operator { precondition: 0..0, effects: 0..1, cost: u32::MAX }];
    for strategy in [Strategy::AStar(Kind::Blind), Strategy::Optimal, Strategy::First] {
        assert_eq!(run(&task, strategy, false).0, Status::Incomplete, "{strategy}");
    }
}
