//! What ground problems and tasks mean, said as simply as can be. States of ground problems are bit sets of facts.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use crate::encode::{Encoded, Value};
use crate::grounded::{FactId, Grounded, Literal};
use crate::task::{Fact, OperatorId, Task, VariableId};

/// All reachable states of a ground problem, derived facts included, and the least cost of a plan.
pub(crate) struct Propositional {
    pub(crate) states: BTreeSet<u32>,
    pub(crate) cost: Option<u32>,
    facts: u32,
    derived: u32,
}

fn holds(literals: &[Literal], state: u32) -> bool {
    literals.iter().all(|literal| (state >> literal.fact.0 & 1 == 1) == literal.positive)
}

/// Derived facts anew: rules in the order of their heads, which is the order of layers in drafts, each head to its fixpoint.
fn derive(grounded: &Grounded, state: u32) -> u32 {
    let mut state = (0..grounded.facts.len())
        .filter(|&fact| grounded.derived[fact])
        .fold(state, |state, fact| state & !(1 << fact));
    for head in 0..grounded.facts.len() as u32 {
        for _ in 0..2 {
            for axiom in grounded.axioms.iter().filter(|axiom| axiom.head.0 == head) {
                if holds(
                    &grounded.literals
                        [axiom.conditions.start as usize..axiom.conditions.end as usize],
                    state,
                ) {
                    state |= 1 << head;
                }
            }
        }
    }
    state
}

fn successor(grounded: &Grounded, operator: usize, state: u32) -> Option<u32> {
    let operator = &grounded.operators[operator];
    if !holds(
        &grounded.literals
            [operator.precondition.start as usize..operator.precondition.end as usize],
        state,
    ) {
        return None;
    }
    let mut after = state;
    for positive in [false, true] {
        for effect in
            &grounded.effects[operator.effects.start as usize..operator.effects.end as usize]
        {
            let conditions = &grounded.literals
                [effect.conditions.start as usize..effect.conditions.end as usize];
            if effect.literal.positive == positive && holds(conditions, state) {
                let bit = 1 << effect.literal.fact.0;
                after = if positive { after | bit } else { after & !bit };
            }
        }
    }
    Some(derive(grounded, after))
}

fn initial(grounded: &Grounded) -> u32 {
    derive(
        grounded,
        grounded
            .initial
            .iter()
            .enumerate()
            .fold(0, |state, (fact, &holds)| state | u32::from(holds) << fact),
    )
}

/// Whether the operators can be applied in turn and end in the goal.
pub(crate) fn solves(grounded: &Grounded, plan: &[u32]) -> bool {
    let end = plan.iter().try_fold(initial(grounded), |state, &operator| {
        successor(grounded, operator as usize, state)
    });
    end.is_some_and(|state| holds(&grounded.goal, state))
}

/// States with their least cost and how they are reached first.
fn dijkstra<S: Ord + Clone>(
    start: S,
    successors: impl Fn(&S) -> Vec<(u32, S, u32)>,
) -> BTreeMap<S, (u32, Option<(S, u32)>)> {
    let mut best = BTreeMap::from([(start.clone(), (0, None))]);
    let mut queue = BinaryHeap::from([Reverse((0, start))]);
    while let Some(Reverse((cost, state))) = queue.pop() {
        if best[&state].0 < cost {
            continue;
        }
        for (operator, next, step) in successors(&state) {
            let total = cost + step;
            if best.get(&next).is_none_or(|&(old, _)| total < old) {
                best.insert(next.clone(), (total, Some((state.clone(), operator))));
                queue.push(Reverse((total, next)));
            }
        }
    }
    best
}

impl Propositional {
    pub(crate) fn explore(grounded: &Grounded) -> Self {
        let successors = |&state: &u32| {
            let apply = |operator: usize| {
                Some((
                    operator as u32,
                    successor(grounded, operator, state)?,
                    grounded.operators[operator].cost,
                ))
            };
            (0..grounded.operators.len()).filter_map(apply).collect()
        };
        let best = dijkstra(initial(grounded), successors);
        let goals = best
            .iter()
            .filter(|&(&state, _)| holds(&grounded.goal, state))
            .map(|(_, &(cost, _))| cost);
        let derived = grounded
            .derived
            .iter()
            .enumerate()
            .fold(0, |mask, (fact, &derived)| mask | u32::from(derived) << fact);
        Self {
            cost: goals.min(),
            states: best.into_keys().collect(),
            facts: grounded.facts.len() as u32,
            derived,
        }
    }

    /// Some mutex groups that really are: from each fact on, further facts in an order that the seed decides.
    pub(crate) fn groups(&self, seed: u64) -> Vec<Vec<FactId>> {
        let apart =
            |a: u32, b: u32| self.states.iter().all(|state| state >> a & state >> b & 1 == 0);
        let mut groups = Vec::new();
        for first in
            (0..self.facts).filter(|&fact| self.derived >> fact & 1 == 0 && seed >> fact & 1 == 1)
        {
            let mut group = vec![first];
            for offset in 0..self.facts {
                let fact = (offset + (seed >> 8) as u32 % self.facts) % self.facts;
                if self.derived >> fact & 1 == 0
                    && !group.contains(&fact)
                    && group.iter().all(|&member| apart(member, fact))
                {
                    group.push(fact);
                }
            }
            groups.push(group.into_iter().map(FactId).collect());
        }
        groups
    }
}

/// All reachable states of a task, derived variables included, and a cheapest plan.
pub(crate) struct Reached {
    pub(crate) states: Vec<Vec<u32>>,
    pub(crate) cost: Option<u32>,
    pub(crate) plan: Option<Vec<OperatorId>>,
}

fn all(facts: &[Fact], state: &[u32]) -> bool {
    facts.iter().all(|fact| state[fact.variable.index()] == fact.value)
}

/// Derived variables anew, layer by layer.
fn evaluate(task: &Task, mut state: Vec<u32>) -> Vec<u32> {
    for (variable, value) in task.variables.iter().zip(&mut state) {
        if variable.axiom_layer.is_some() {
            *value = variable.default;
        }
    }
    for layer in
        0..=task.variables.iter().filter_map(|variable| variable.axiom_layer).max().unwrap_or(0)
    {
        loop {
            let before = state.clone();
            for axiom in task.axioms.iter().filter(|axiom| {
                task.variables[axiom.head.variable.index()].axiom_layer == Some(layer)
            }) {
                if all(task.conditions(&axiom.conditions), &state) {
                    state[axiom.head.variable.index()] = axiom.head.value;
                }
            }
            if state == before {
                break;
            }
        }
    }
    state
}

pub(crate) fn explore(encoded: &Encoded) -> Reached {
    let task = &encoded.task;
    let successors = |state: &Vec<u32>| {
        let apply = |operator: OperatorId| {
            let mut after = state.clone();
            for effect in task.effects(operator) {
                if all(task.conditions(&effect.conditions), state) {
                    after[effect.fact.variable.index()] = effect.fact.value;
                }
            }
            (operator.0, evaluate(task, after), task.operators[operator.index()].cost)
        };
        task.operator_ids()
            .filter(|&operator| all(task.precondition(operator), state))
            .map(apply)
            .collect()
    };
    let best = dijkstra(evaluate(task, task.initial_state.clone()), successors);
    let goal =
        best.iter().filter(|(state, _)| all(&task.goal, state)).min_by_key(|(_, (cost, _))| *cost);
    let plan = goal.map(|(state, _)| {
        let mut plan = Vec::new();
        let mut at = state;
        while let Some((parent, operator)) = &best[at].1 {
            plan.push(OperatorId(*operator));
            at = parent;
        }
        plan.reverse();
        plan
    });
    Reached { cost: goal.map(|(_, (cost, _))| *cost), plan, states: best.into_keys().collect() }
}

/// The facts that some value of the task names.
pub(crate) fn visible(encoded: &Encoded) -> u32 {
    encoded.values.iter().fold(0, |mask, value| match value {
        Value::Atom(fact) | Value::Negated(fact) => mask | 1 << fact.0,
        Value::Other => mask,
    })
}

/// The states as sets of facts. A fact with two variables must say the same twice.
pub(crate) fn project(encoded: &Encoded, states: &[Vec<u32>]) -> BTreeSet<u32> {
    let decode = |state: &Vec<u32>| {
        let (mut holds, mut fails) = (0u32, 0u32);
        for (variable, &now) in state.iter().enumerate() {
            for value in 0..encoded.task.variables[variable].domain_size {
                match encoded.value(Fact { variable: VariableId(variable as u32), value }) {
                    Value::Atom(fact) if value == now => holds |= 1 << fact.0,
                    Value::Atom(fact) => fails |= 1 << fact.0,
                    Value::Negated(fact) if value == now => fails |= 1 << fact.0,
                    Value::Negated(_) | Value::Other => {}
                }
            }
        }
        assert_eq!(holds & fails, 0, "two variables disagree about a fact");
        holds
    };
    states.iter().map(decode).collect()
}
