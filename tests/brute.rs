//! A tiny multi-agent problem goes in; the best joint plan comes out, found by trying every joint action in every state.
//!
//! It asks nothing but the executor, so what it finds is what the joint semantics say.
//! An instance of an action is left out only where its precondition is false whatever else is done.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use lang::condition::Condition;
use lang::execute::joint::Concurrency;
use lang::execute::{Executor, State};
use lang::model::{ActionId, Domain, Formula, ObjectId, PredicateId, Scope};
use lang::plan::{JointPlan, Step};
use rust_decimal::Decimal;

/// What is to be as little as possible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Objective {
    /// The number of joint steps.
    Steps,
    /// The number of ground actions.
    Actions,
    /// The metric, summed over all parts.
    Cost,
}

/// There are more states than were allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLarge;

/// The joint plan with the fewest joint steps; `None` if there is no joint plan.
///
/// # Errors
/// More than `limit` states were seen.
pub fn shortest(
    executor: &Executor<'_>,
    concurrency: Concurrency,
    limit: usize,
) -> Result<Option<JointPlan>, TooLarge> {
    best(executor, concurrency, Objective::Steps, limit)
}

/// A joint plan that is best by `objective`; `None` if there is no joint plan.
///
/// # Errors
/// More than `limit` states were seen.
pub fn best(
    executor: &Executor<'_>,
    concurrency: Concurrency,
    objective: Objective,
    limit: usize,
) -> Result<Option<JointPlan>, TooLarge> {
    let moves = Moves::new(executor);
    let mut nodes = vec![Node { state: executor.initial(), weight: Decimal::ZERO, by: None }];
    let mut known = BTreeMap::from([(nodes[0].state.facts(), 0)]);
    let mut open = BinaryHeap::from([Reverse((Decimal::ZERO, 0))]);
    while let Some(Reverse((weight, at))) = open.pop() {
        if weight > nodes[at].weight {
            continue;
        }
        if executor.goal(&nodes[at].state) {
            return Ok(Some(trace(&nodes, at)));
        }
        for parts in moves.joint(&nodes[at].state) {
            if executor.join(&nodes[at].state, &parts, concurrency).is_err() {
                continue;
            }
            let mut state = nodes[at].state.clone();
            let Some(more) = weigh(executor, &state, &parts, objective) else { continue };
            executor.apply_joint(&mut state, &parts);
            let node = Node { weight: weight + more, by: Some((at, parts)), state };
            let next = *known.entry(node.state.facts()).or_insert(nodes.len());
            if next == nodes.len() {
                if next == limit {
                    return Err(TooLarge);
                }
                nodes.push(node);
            } else if node.weight < nodes[next].weight {
                nodes[next] = node;
            } else {
                continue;
            }
            open.push(Reverse((nodes[next].weight, next)));
        }
    }
    Ok(None)
}

/// A state, and how it was reached.
struct Node {
    state: State,
    weight: Decimal,
    by: Option<(usize, Vec<Step>)>,
}

/// The joint steps that lead to the node at `at`.
fn trace(nodes: &[Node], mut at: usize) -> JointPlan {
    let mut steps = Vec::new();
    while let Some((before, parts)) = &nodes[at].by {
        steps.push(parts.clone());
        at = *before;
    }
    steps.reverse();
    JointPlan { steps }
}

/// What a joint action adds to the weight of a plan; nothing if its cost is not defined, so that it cannot be taken.
fn weigh(
    executor: &Executor<'_>,
    state: &State,
    parts: &[Step],
    objective: Objective,
) -> Option<Decimal> {
    let cost = executor.joint_cost(state, parts).ok()?;
    Some(match objective {
        Objective::Steps => Decimal::ONE,
        Objective::Actions => Decimal::from(parts.len()),
        Objective::Cost => cost,
    })
}

/// Every instance of every action, by who takes it.
struct Moves<'a> {
    executor: &'a Executor<'a>,
    /// What each action demands of the state alone.
    alone: Vec<Formula>,
    agents: BTreeMap<Option<ObjectId>, Vec<Step>>,
}

impl<'a> Moves<'a> {
    /// All instances but those that what never changes forbids.
    fn new(executor: &'a Executor<'a>) -> Self {
        let domain = executor.domain();
        let fixed = fixed(domain);
        let state_only = |leaf: &Condition| !matches!(leaf, Condition::Action(..));
        let fixed_only = |leaf: &Condition| match leaf {
            Condition::Atom(atom, _) => fixed.contains(&atom.predicate),
            leaf => state_only(leaf),
        };
        let alone = domain.actions.iter().map(|it| relaxed(&it.precondition, &state_only));
        let mut moves = Self { executor, alone: alone.collect(), agents: BTreeMap::new() };
        let initial = executor.initial();
        for (at, action) in domain.actions.iter().enumerate() {
            let possible = relaxed(&action.precondition, &fixed_only);
            for arguments in moves.arguments(&action.scope) {
                let step = Step { action: ActionId(at as u32), arguments };
                if moves.holds(&initial, &possible, &step) {
                    moves.agents.entry(executor.agent(&step)).or_default().push(step);
                }
            }
        }
        moves
    }

    /// The objects that the parameters can stand for, in every combination.
    fn arguments(&self, scope: &Scope) -> Vec<Box<[ObjectId]>> {
        let (domain, problem) = (self.executor.domain(), self.executor.problem());
        let mut all = vec![Vec::new()];
        for variable in &scope.variables[..scope.parameters as usize] {
            let objects = || {
                let of_type = problem.objects.iter().enumerate();
                let of_type = of_type.filter(|(_, it)| domain.has_type(it, &variable.types));
                of_type.map(|(at, _)| ObjectId(at as u32))
            };
            let longer = |list: Vec<ObjectId>| objects().map(move |it| [&list[..], &[it]].concat());
            all = all.into_iter().flat_map(longer).collect();
        }
        all.into_iter().map(Vec::into_boxed_slice).collect()
    }

    /// Whether a condition of the step's action holds of its arguments.
    fn holds(&self, state: &State, condition: &Formula, step: &Step) -> bool {
        let scope = &self.executor.domain().actions[step.action.index()].scope;
        let mut binding = vec![None; scope.variables.len()];
        for (place, &object) in binding.iter_mut().zip(&step.arguments) {
            *place = Some(object);
        }
        self.executor.holds(state, scope, condition, &binding)
    }

    /// Every choice of at most one instance for each agent, at least one in all, among those that the state allows.
    fn joint(&self, state: &State) -> Vec<Vec<Step>> {
        let mut all: Vec<Vec<Step>> = vec![Vec::new()];
        for steps in self.agents.values() {
            let possible = |step: &&Step| self.holds(state, &self.alone[step.action.index()], step);
            let possible: Vec<&Step> = steps.iter().filter(possible).collect();
            let with = all.iter().flat_map(|parts| {
                possible.iter().map(move |&step| [&parts[..], std::slice::from_ref(step)].concat())
            });
            let with: Vec<_> = with.collect();
            all.extend(with);
        }
        all.retain(|parts| !parts.is_empty());
        all
    }
}

/// The predicates that no action changes and no axiom derives.
fn fixed(domain: &Domain) -> BTreeSet<PredicateId> {
    let effects = domain.actions.iter().flat_map(|action| &action.effects);
    let literals = effects.flat_map(|effect| &effect.literals);
    let changed: BTreeSet<_> = literals.map(|literal| literal.atom.predicate).collect();
    let all = domain.predicates.iter().enumerate().filter(|(_, predicate)| !predicate.derived);
    all.map(|(at, _)| PredicateId(at as u32)).filter(|id| !changed.contains(id)).collect()
}

/// A condition that holds wherever `formula` does: all but the `wanted` literals are taken for true.
fn relaxed(formula: &Formula, wanted: &dyn Fn(&Condition) -> bool) -> Formula {
    let condition = Condition::new(formula).unwrap_or(Condition::TRUE);
    let span = formula.nodes[formula.root().index()].span;
    let leaf = &mut |leaf| if wanted(&leaf) { leaf } else { Condition::TRUE };
    condition.map(leaf).formula(span)
}
