//! A task goes in; its delete relaxation comes out: rules over flat fact numbers, which only ever add.
//!
//! An operator gives a rule for each condition among its effects: the rule needs the precondition and that condition, and adds what stands under it.
//! An axiom is a rule that costs nothing. That a derived variable has its default value is taken for granted: it is the negation of a fixpoint, which
//! grows as facts do, so whoever drops it stays safe and admissible.

use super::Costs;
use crate::axioms::by_key;
use crate::task::{Fact, OperatorId, Task};

/// The origin of a rule that comes from an axiom.
pub(super) const AXIOM: u32 = u32::MAX;

/// A rule: where all facts of `needs` are reached, each of `adds` is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Rule {
    /// Sorted.
    pub needs: Vec<u32>,
    /// Sorted, none of them needed, at least one.
    pub adds: Vec<u32>,
    pub cost: u32,
    /// The number of the operator, or [`AXIOM`].
    pub origin: u32,
}

/// The delete relaxation of a task.
#[derive(Debug, Clone)]
pub(super) struct Relaxation {
    /// For each variable the number of its first fact.
    pub offsets: Vec<u32>,
    /// How many facts there are.
    pub facts: usize,
    pub rules: Vec<Rule>,
    /// Sorted.
    pub goal: Vec<u32>,
}

impl Relaxation {
    pub(super) fn new(task: &Task, costs: Costs) -> Self {
        let mut offsets = Vec::with_capacity(task.variables.len());
        let mut facts = 0;
        for variable in &task.variables {
            offsets.push(facts);
            facts += variable.domain_size;
        }
        let mut relaxation =
            Self { offsets, facts: facts as usize, rules: Vec::new(), goal: Vec::new() };
        relaxation.goal = relaxation.demanded(task, &task.goal);
        for operator in task.operator_ids() {
            relaxation.add_operator(task, operator, costs.of(task, operator));
        }
        for axiom in &task.axioms {
            if let Some(conditions) = consistent(&[], task.conditions(&axiom.conditions)) {
                let needs = relaxation.demanded(task, &conditions);
                let head = relaxation.number(axiom.head);
                relaxation.add_rule(needs, vec![head], 0, AXIOM);
            }
        }
        relaxation
    }

    /// The number of a fact.
    fn number(&self, fact: Fact) -> u32 {
        self.offsets[fact.variable.index()] + fact.value
    }

    /// The numbers of those facts that are not taken for granted, sorted.
    fn demanded(&self, task: &Task, facts: &[Fact]) -> Vec<u32> {
        let mut numbers: Vec<u32> = facts
            .iter()
            .filter(|fact| {
                let variable = &task.variables[fact.variable.index()];
                variable.axiom_layer.is_none() || variable.default != fact.value
            })
            .map(|&fact| self.number(fact))
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    fn add_operator(&mut self, task: &Task, operator: OperatorId, cost: u32) {
        let mut effects: Vec<(&[Fact], u32)> = task
            .effects(operator)
            .iter()
            .map(|effect| (task.conditions(&effect.conditions), self.number(effect.fact)))
            .collect();
        effects.sort();
        for group in effects.chunk_by(|a, b| a.0 == b.0) {
            if let Some(conditions) = consistent(task.precondition(operator), group[0].0) {
                let needs = self.demanded(task, &conditions);
                self.add_rule(
                    needs,
                    group.iter().map(|&(_, fact)| fact).collect(),
                    cost,
                    operator.0,
                );
            }
        }
    }

    fn add_rule(&mut self, needs: Vec<u32>, mut adds: Vec<u32>, cost: u32, origin: u32) {
        adds.retain(|fact| needs.binary_search(fact).is_err());
        adds.sort_unstable();
        adds.dedup();
        if !adds.is_empty() {
            self.rules.push(Rule { needs, adds, cost, origin });
        }
    }
}

/// Both lists in one, unless they give a variable two values.
fn consistent(first: &[Fact], second: &[Fact]) -> Option<Vec<Fact>> {
    let mut all: Vec<Fact> = first.iter().chain(second).copied().collect();
    all.sort_unstable();
    all.dedup();
    all.windows(2).all(|pair| pair[0].variable != pair[1].variable).then_some(all)
}

/// What an exploration knows of a unary rule.
#[derive(Debug, Clone, Copy)]
struct Progress {
    cost: u32,
    unsatisfied: u32,
    adds: u32,
}

/// What an exploration knows of a fact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    /// [`UNREACHED`] where it is not.
    pub cost: u32,
    /// The unary rule that reaches it at this cost, [`NO_RULE`] where it holds in the state.
    pub supporter: u32,
}

pub(super) const UNREACHED: u32 = u32::MAX;
pub(super) const NO_RULE: u32 = u32::MAX;
/// Sums are cut here, so that they never look infinite.
const MOST_COST: u32 = u32::MAX / 2;

/// How the costs of several facts are put together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Combine {
    /// The largest.
    Max,
    /// Their sum.
    Sum,
}

/// Explores the relaxation from a state, by ascending cost, over rules with one added fact each.
#[derive(Debug, Clone)]
pub(super) struct Exploration {
    offsets: Vec<u32>,
    goal: Vec<u32>,
    is_goal: Vec<bool>,
    /// For each rule its origin.
    pub origins: Vec<u32>,
    need_starts: Vec<u32>,
    needs: Vec<u32>,
    /// For each fact the rules that need it.
    user_starts: Vec<u32>,
    users: Vec<u32>,
    /// Rules that need nothing.
    free: Vec<u32>,
    start: Vec<Progress>,
    progress: Vec<Progress>,
    pub facts: Vec<Reached>,
    queue: super::queue::Queue,
}

impl Exploration {
    pub(super) fn new(task: &Task, costs: Costs) -> Self {
        let relaxation = Relaxation::new(task, costs);
        let unary = simplify(&relaxation.rules);
        let mut need_starts = vec![0];
        let mut needs = Vec::new();
        let mut pairs = Vec::new();
        let mut start = Vec::new();
        let mut origins = Vec::new();
        for (rule, &(source, adds)) in (0..).zip(&unary) {
            let source = &relaxation.rules[source];
            needs.extend(&source.needs);
            need_starts.push(needs.len() as u32);
            pairs.extend(source.needs.iter().map(|&fact| (fact, rule)));
            start.push(Progress {
                cost: source.cost,
                unsatisfied: source.needs.len() as u32,
                adds,
            });
            origins.push(source.origin);
        }
        let (user_starts, users) = by_key(&pairs, relaxation.facts);
        let mut is_goal = vec![false; relaxation.facts];
        for &fact in &relaxation.goal {
            is_goal[fact as usize] = true;
        }
        Self {
            offsets: relaxation.offsets,
            goal: relaxation.goal,
            is_goal,
            free: (0..)
                .zip(&start)
                .filter(|(_, rule)| rule.unsatisfied == 0)
                .map(|(rule, _)| rule)
                .collect(),
            origins,
            need_starts,
            needs,
            user_starts,
            users,
            progress: start.clone(),
            start,
            facts: vec![Reached { cost: UNREACHED, supporter: NO_RULE }; relaxation.facts],
            queue: super::queue::Queue::new(),
        }
    }

    /// The goal's facts, sorted, without those taken for granted.
    pub(super) fn goal(&self) -> &[u32] {
        &self.goal
    }

    /// The number of a fact.
    pub(super) fn number(&self, fact: Fact) -> u32 {
        self.offsets[fact.variable.index()] + fact.value
    }

    /// What a rule needs.
    #[inline]
    pub(super) fn needs(&self, rule: u32) -> &[u32] {
        &self.needs
            [self.need_starts[rule as usize] as usize..self.need_starts[rule as usize + 1] as usize]
    }

    /// Reaches facts by ascending cost until all of the goal are; returns the goal's cost, [`UNREACHED`] if there is a goal fact that cannot be reached.
    pub(super) fn explore(&mut self, values: &[u32], combine: Combine) -> u32 {
        self.facts.fill(Reached { cost: UNREACHED, supporter: NO_RULE });
        self.progress.copy_from_slice(&self.start);
        self.queue.clear();
        for (&offset, &value) in self.offsets.iter().zip(values) {
            self.facts[(offset + value) as usize].cost = 0;
            self.queue.push(0, offset + value);
        }
        for &rule in &self.free {
            let Progress { cost, adds, .. } = self.start[rule as usize];
            reach(&mut self.facts, &mut self.queue, adds, cost.min(MOST_COST), rule);
        }
        let mut missing = self.goal.len();
        if missing == 0 {
            return 0;
        }
        while let Some((cost, fact)) = self.queue.pop() {
            if self.facts[fact as usize].cost < cost {
                continue;
            }
            if self.is_goal[fact as usize] {
                missing -= 1;
                if missing == 0 {
                    return self.goal_cost(combine);
                }
            }
            for &rule in &self.users[self.user_starts[fact as usize] as usize
                ..self.user_starts[fact as usize + 1] as usize]
            {
                let progress = &mut self.progress[rule as usize];
                progress.unsatisfied -= 1;
                if combine == Combine::Sum {
                    progress.cost = progress.cost.saturating_add(cost);
                }
                if progress.unsatisfied == 0 {
                    // Facts come by ascending cost, so the last one has the largest.
                    let total = if combine == Combine::Sum {
                        progress.cost
                    } else {
                        progress.cost.saturating_add(cost)
                    };
                    let adds = progress.adds;
                    reach(&mut self.facts, &mut self.queue, adds, total.min(MOST_COST), rule);
                }
            }
        }
        UNREACHED
    }

    fn goal_cost(&self, combine: Combine) -> u32 {
        let costs = self.goal.iter().map(|&fact| self.facts[fact as usize].cost);
        match combine {
            Combine::Max => costs.max().unwrap_or(0),
            Combine::Sum => costs.fold(0, u32::saturating_add).min(MOST_COST),
        }
    }
}

#[inline]
fn reach(facts: &mut [Reached], queue: &mut super::queue::Queue, fact: u32, cost: u32, rule: u32) {
    let reached = &mut facts[fact as usize];
    if cost < reached.cost {
        *reached = Reached { cost, supporter: rule };
        queue.push(cost, fact);
    }
}

/// More rules than this for one fact are only compared with their equals.
const MOST_COMPARED: usize = 2000;

/// Splits rules by added fact, and leaves out those for which another one needs no more, costs no more and adds the same.
/// Gives pairs of rule and added fact, in the order of the rules.
fn simplify(rules: &[Rule]) -> Vec<(usize, u32)> {
    let mut unary: Vec<(u32, usize)> = Vec::new();
    for (index, rule) in rules.iter().enumerate() {
        unary.extend(rule.adds.iter().map(|&fact| (fact, index)));
    }
    // Short ones first: only a shorter or equal one can dominate.
    unary.sort_by_cached_key(|&(fact, index)| {
        (fact, rules[index].needs.len(), rules[index].cost, index)
    });
    let mut kept = Vec::new();
    for group in unary.chunk_by(|a, b| a.0 == b.0) {
        let signatures: Vec<u64> =
            group.iter().map(|&(_, index)| signature(&rules[index].needs)).collect();
        let mut winners: Vec<usize> = Vec::new();
        let mut seen = rustc_hash::FxHashSet::default();
        for (at, &(fact, index)) in group.iter().enumerate() {
            let rule = &rules[index];
            let is_new = seen.insert(&rule.needs);
            let dominated = !is_new
                || group.len() <= MOST_COMPARED
                    && winners.iter().any(|&winner| {
                        let other = &rules[group[winner].1];
                        signatures[winner] & !signatures[at] == 0
                            && other.cost <= rule.cost
                            && is_subset(&other.needs, &rule.needs)
                    });
            if !dominated {
                winners.push(at);
                kept.push((index, fact));
            }
        }
    }
    kept.sort_unstable();
    kept
}

/// A bit for each fact, several facts to a bit: a subset has a subset of the bits.
fn signature(facts: &[u32]) -> u64 {
    facts.iter().fold(0, |bits, &fact| bits | 1 << (fact.wrapping_mul(0x9E37_79B9) >> 26))
}

/// Whether all of `small` are in `large`, both sorted.
fn is_subset(small: &[u32], large: &[u32]) -> bool {
    let mut large = large.iter();
    small.iter().all(|fact| large.any(|other| other == fact))
}
