//! Best-first width search, BFWS(f5) (Lipovetzky and Geffner, AAAI 2017): states come in the order of their novelty, then of the goals left.
//!
//! A state is as novel as the smallest set of its facts that no state before had among those that are as far: with as many goals left, and as many
//! facts achieved of the relaxed plan made when the number of goals left last fell. Sets of one and of two facts are told apart, and all else.
//! Whenever fewer goals are left than ever before, the search begins anew from there, and comes back to what it left when it finds no way on:
//! goals are reached one after another (Lipovetzky and Geffner, ECAI 2012, serialised width).
//! Where a search by estimates of distance is lost on a plateau, this one spreads evenly over it. Ties: the oldest first.

use rustc_hash::FxHashMap;

use super::node::{Node, Nodes, Status};
use super::{End, Profile, Run};
use crate::heuristics::ff::Ff;
use crate::heuristics::{Costs, DEAD_END, Heuristic};
use crate::open::{Open, Order};
use crate::registry::StateId;
use crate::segmented::Segmented;
use crate::space::Space;
use crate::task::{Fact, Task, VariableId};

/// How it is listed.
pub fn profile() -> Profile {
    Profile {
        name: "bfws",
        summary: "best-first by novelty of width 2, then by the goals left",
        source: "Lipovetzky and Geffner, Best-first width search, AAAI 2017",
        optimal: false,
    }
}

/// Pairs are looked at where there are no more variables than this, since every state has a pair for each two of them.
const MOST_VARIABLES: usize = 400;

/// The work for each variable of a new state, in comparison with that of a heuristic for each operator.
const WORK: u64 = 2;

/// Bytes that tables of pairs may take in all; states that would need a new one then have no novelty of two.
const MOST_BYTES: usize = 1 << 30;

/// How far a state is.
#[derive(Debug, Clone, Copy, Default)]
struct Way {
    /// Goals that do not hold.
    goals: u32,
    /// Which relaxed plan counts; 0 for one that is still to be made, as it is when the state is expanded.
    plan: u32,
    /// Which of its first 128 facts have been achieved.
    achieved: u128,
}

/// The sets of facts that have been seen in one part of the state space.
#[derive(Debug, Default)]
struct Seen {
    single: Vec<u64>,
    pairs: Vec<u64>,
}

/// What tells new from old.
struct Novelty {
    /// The number of each variable's first fact; facts are numbered in sequence.
    offsets: Vec<u32>,
    /// The variables of states, without derived ones.
    variables: Vec<usize>,
    facts: usize,
    parts: FxHashMap<(u32, u32), Seen>,
    bytes: usize,
}

impl Novelty {
    fn new(task: &Task) -> Self {
        let mut offsets = Vec::with_capacity(task.variables.len());
        let mut facts = 0;
        for variable in &task.variables {
            offsets.push(facts);
            facts += variable.domain_size;
        }
        let variables =
            (0..offsets.len()).filter(|&at| task.variables[at].axiom_layer.is_none()).collect();
        let facts = facts as usize;
        Self { offsets, variables, facts, parts: FxHashMap::default(), bytes: 0 }
    }

    /// Forgets all.
    fn clear(&mut self) {
        self.parts.clear();
        self.bytes = 0;
    }

    /// 1 or 2 for the size of the smallest set of facts that is new, 3 if none is; from now on they are known.
    /// `known` are the values of a state that has been looked at under the same key.
    fn of(&mut self, key: (u32, u32), values: &[u32], known: Option<&[u32]>) -> u32 {
        let words = self.facts.div_ceil(64);
        let wanted = (self.facts * self.facts / 2).div_ceil(64);
        let pairs = self.variables.len() <= MOST_VARIABLES;
        let seen = self.parts.entry(key).or_insert_with(|| {
            let room = pairs && self.bytes + wanted * 8 <= MOST_BYTES;
            self.bytes += if room { wanted * 8 } else { 0 };
            Seen { single: vec![0; words], pairs: vec![0; if room { wanted } else { 0 }] }
        });
        let number = |&variable: &usize| (self.offsets[variable] + values[variable]) as usize;
        let mut novelty = 3;
        let mut note = |bits: &mut [u64], at: usize, width: u32| {
            let (word, bit) = (&mut bits[at / 64], 1 << (at % 64));
            if *word & bit == 0 {
                *word |= bit;
                novelty = novelty.min(width);
            }
        };
        for variable in &self.variables {
            if known.is_some_and(|known| known[*variable] == values[*variable]) {
                continue;
            }
            let one = number(variable);
            note(&mut seen.single, one, 1);
            if !seen.pairs.is_empty() {
                for other in self.variables.iter().map(number).filter(|&other| other != one) {
                    // Below the diagonal of the square of facts.
                    let (large, small) = (one.max(other), one.min(other));
                    note(&mut seen.pairs, large * (large - 1) / 2 + small, 2);
                }
            }
        }
        novelty
    }
}

/// The counts by which states are told apart.
struct Counter {
    ff: Ff,
    goal: Vec<Fact>,
    /// All facts of state variables.
    facts: Vec<Fact>,
    /// The facts of each relaxed plan.
    plans: Vec<Vec<Fact>>,
}

impl Counter {
    fn goals(&self, values: &[u32]) -> u32 {
        self.goal.iter().filter(|fact| values[fact.variable.index()] != fact.value).count() as u32
    }

    /// How far a state is with these goals left, when it is reached from one that is as far as `before`.
    fn way(&self, values: &[u32], goals: u32, before: Way) -> Way {
        if goals < before.goals {
            return Way { goals, ..Way::default() };
        }
        let mut way = Way { goals, ..before };
        for (at, fact) in self.plans[before.plan as usize].iter().enumerate() {
            if values[fact.variable.index()] == fact.value {
                way.achieved |= 1 << at;
            }
        }
        way
    }

    /// Makes a relaxed plan for a state that has none; false for a dead end.
    fn plan(&mut self, values: &[u32], way: &mut Way) -> bool {
        if self.ff.evaluate(values) == DEAD_END {
            return false;
        }
        let mut facts = self.ff.achieves(&self.facts);
        facts.truncate(128);
        self.plans.push(facts);
        way.plan = self.plans.len() as u32 - 1;
        true
    }
}

/// All facts of state variables.
fn facts(task: &Task) -> Vec<Fact> {
    let variables = task.variables.iter().enumerate();
    variables
        .filter(|(_, variable)| variable.axiom_layer.is_none())
        .flat_map(|(at, variable)| {
            let variable_id = VariableId(at as u32);
            (0..variable.domain_size).map(move |value| Fact { variable: variable_id, value })
        })
        .collect()
}

/// Runs until a plan is found.
pub(super) fn search(space: &mut Space, run: &mut Run) -> End {
    let task = space.task();
    let (ff, goal, facts) = (Ff::new(task, Costs::Unit), task.goal.clone(), facts(task));
    let mut counter = Counter { ff, goal, facts, plans: vec![Vec::new()] };
    let mut novelty = Novelty::new(task);
    let mut nodes = Nodes::default();
    let mut ways: Segmented<Way> = Segmented::new(Way::default());
    let mut open: Open<u32> = Open::new(Order::Fifo);
    let mut stages = Vec::new();
    let mut values = task.initial_state.clone();
    let mut child_values = values.clone();
    let mut operators = Vec::new();
    let initial = space.initial();
    space.load(initial, &mut values);
    let goals = counter.goals(&values);
    let mut way = Way { goals, ..Way::default() };
    if !counter.plan(&values, &mut way) {
        run.initial(DEAD_END);
        return End::Exhausted;
    }
    run.initial(goals);
    nodes.set(initial, Node { status: Status::Open, cost: 0, parent: initial });
    ways.push(way);
    if space.is_goal(&values) {
        return run.solved(space, initial, |state| nodes.parent(state));
    }
    open.push((1, goals), initial.0);
    let mut best = goals;
    loop {
        let Some((_, state)) = open.pop() else {
            match stages.pop() {
                Some(before) => open = before,
                None => return End::Exhausted,
            }
            continue;
        };
        if let Some(end) = run.stopped(space) {
            return end;
        }
        let state = StateId(state);
        let mut before = ways.get(state.index());
        space.load(state, &mut values);
        if before.plan == 0 {
            run.statistics.evaluated += 1;
            if !counter.plan(&values, &mut before) {
                run.statistics.dead_ends += 1;
                continue;
            }
            ways.set(state.index(), before);
        }
        run.statistics.expanded += 1;
        space.applicable(&values, &mut operators);
        run.work += operators.len() as u64 * task.variables.len() as u64 * WORK;
        for &operator in &operators {
            run.statistics.generated += 1;
            let (child, is_new) = space.successor(state, &values, operator);
            if !is_new {
                continue;
            }
            nodes.set(child, Node { status: Status::Open, cost: 0, parent: state });
            space.load(child, &mut child_values);
            if space.is_goal(&child_values) {
                return run.solved(space, child, |state| nodes.parent(state));
            }
            let goals = counter.goals(&child_values);
            let way = counter.way(&child_values, goals, before);
            ways.push(way);
            if goals < best {
                best = goals;
                run.reached(best);
                novelty.clear();
                stages.push(std::mem::replace(&mut open, Open::new(Order::Fifo)));
            }
            let key = |way: Way| (way.goals, way.plan, way.achieved.count_ones());
            let known = (key(way) == key(before)).then_some(values.as_slice());
            let width = novelty.of((goals, way.achieved.count_ones()), &child_values, known);
            open.push((width, goals), child.0);
        }
    }
}
