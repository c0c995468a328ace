//! LM-cut (Helmert and Domshlak, ICAPS 2009): the summed costs of disjunctive action landmarks, found as cuts in the justification graph of hmax.
//!
//! Each round computes hmax, takes for each rule the need that is reached last (its *supporter*), and cuts the graph of supporters between the state and
//! the *goal zone*, from where the goal is reached for nothing. Some operator of the cut is in every plan: its cheapest cost is counted, taken off all of
//! them, and hmax repaired, until it is zero.
//!
//! Conditional effects make several rules of one operator, which share one cost: a cut that holds some of them takes the cost off once, for all of them
//! (Röger, Pommerening and Helmert, ECAI 2014). Axioms are rules that cost nothing. Both keep the sum admissible.

use super::queue::Queue;
use super::relaxed::{AXIOM, Relaxation, Rule};
use super::{Costs, DEAD_END, Heuristic, Profile};
use crate::axioms::by_key;
use crate::task::Task;

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "lmcut",
        summary: "landmarks that cut the goal off, each counted at its cheapest operator",
        source: "Helmert and Domshlak, ICAPS 2009; Röger, Pommerening and Helmert, ECAI 2014",
        admissible: true,
        consistent: false,
        safe: true,
        conditional_effects: true,
        axioms: true,
        preferred: false,
    }
}

const NONE: u32 = u32::MAX;
const UNREACHED: u32 = u32::MAX;

/// What a round knows of a rule.
#[derive(Debug, Clone, Copy)]
struct Reached {
    /// What is left of its cost.
    cost: u32,
    /// How many needs are not reached.
    unsatisfied: u32,
    /// The need reached last; [`NONE`] while some are not.
    supporter: u32,
    supporter_cost: u32,
}

/// Lists of numbers by number.
#[derive(Debug, Clone, Default)]
struct Table {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Table {
    /// Groups pairs by their first part, which is below `keys`.
    fn new(pairs: &[(u32, u32)], keys: usize) -> Self {
        let (starts, items) = by_key(pairs, keys);
        Self { starts, items }
    }

    #[inline]
    fn get(&self, key: u32) -> &[u32] {
        &self.items[self.starts[key as usize] as usize..self.starts[key as usize + 1] as usize]
    }
}

/// See the module.
#[derive(Debug, Clone)]
pub struct LmCut {
    offsets: Vec<u32>,
    /// The fact that stands for the whole goal.
    goal: u32,
    /// The fact that rules without needs get, which always holds.
    always: u32,
    needs: Table,
    adds: Table,
    /// For each fact the rules that need it, and those that add it.
    users: Table,
    achievers: Table,
    /// For each rule the operator-like thing whose cost it shares, and the rules of each.
    group_of: Vec<u32>,
    groups: Table,
    shares: bool,
    start: Vec<Reached>,
    rules: Vec<Reached>,
    facts: Vec<u32>,
    /// For each fact the round in which it was found to be in the goal zone (even marks), or before it (odd ones).
    marks: Vec<u32>,
    group_marks: Vec<u32>,
    now: u32,
    queue: Queue,
    stack: Vec<u32>,
    cut: Vec<u32>,
}

impl LmCut {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        let relaxation = Relaxation::new(task, costs);
        let goal = relaxation.facts as u32;
        let always = goal + 1;
        let facts = relaxation.facts + 2;
        let mut rules = relevant(&relaxation);
        merge(&mut rules);
        rules.push(Rule { needs: relaxation.goal.clone(), adds: vec![goal], cost: 0, origin: AXIOM });
        let mut needs = Vec::new();
        let mut adds = Vec::new();
        let mut start = Vec::new();
        let mut group_of = Vec::new();
        let mut groups = 0;
        let mut last_origin = AXIOM;
        for (index, rule) in (0..).zip(&mut rules) {
            if rule.needs.is_empty() {
                rule.needs.push(always);
            }
            needs.extend(rule.needs.iter().map(|&fact| (index, fact)));
            adds.extend(rule.adds.iter().map(|&fact| (index, fact)));
            // Rules of one operator stand side by side.
            if rule.origin == AXIOM || rule.origin != last_origin {
                groups += 1;
            }
            last_origin = rule.origin;
            group_of.push(groups - 1);
            start.push(Reached { cost: rule.cost, unsatisfied: rule.needs.len() as u32, supporter: NONE, supporter_cost: 0 });
        }
        let swapped = |pairs: &[(u32, u32)]| pairs.iter().map(|&(rule, fact)| (fact, rule)).collect::<Vec<_>>();
        let members: Vec<(u32, u32)> = group_of.iter().copied().zip(0..).collect();
        Self {
            offsets: relaxation.offsets,
            goal,
            always,
            users: Table::new(&swapped(&needs), facts),
            achievers: Table::new(&swapped(&adds), facts),
            needs: Table::new(&needs, rules.len()),
            adds: Table::new(&adds, rules.len()),
            groups: Table::new(&members, groups as usize),
            shares: (groups as usize) < rules.len(),
            group_of,
            rules: start.clone(),
            start,
            facts: vec![UNREACHED; facts],
            marks: vec![0; facts],
            group_marks: vec![0; groups as usize],
            now: 0,
            queue: Queue::new(),
            stack: Vec::new(),
            cut: Vec::new(),
        }
    }

    /// hmax from scratch, with the costs that the rules have.
    fn explore(&mut self, values: &[u32]) {
        self.facts.fill(UNREACHED);
        self.queue.clear();
        for (&offset, &value) in self.offsets.iter().zip(values) {
            self.facts[(offset + value) as usize] = 0;
            self.queue.push(0, offset + value);
        }
        self.facts[self.always as usize] = 0;
        self.queue.push(0, self.always);
        while let Some((cost, fact)) = self.queue.pop() {
            if self.facts[fact as usize] < cost {
                continue;
            }
            for &index in self.users.get(fact) {
                let rule = &mut self.rules[index as usize];
                rule.unsatisfied -= 1;
                if rule.unsatisfied == 0 {
                    rule.supporter = fact;
                    rule.supporter_cost = cost;
                    let target = cost.saturating_add(rule.cost).min(UNREACHED - 1);
                    for &add in self.adds.get(index) {
                        if target < self.facts[add as usize] {
                            self.facts[add as usize] = target;
                            self.queue.push(target, add);
                        }
                    }
                }
            }
        }
    }

    /// Marks the facts from which the goal costs nothing.
    fn mark_goal_zone(&mut self) {
        self.now += 2;
        self.marks[self.goal as usize] = self.now;
        self.stack.push(self.goal);
        while let Some(fact) = self.stack.pop() {
            for &index in self.achievers.get(fact) {
                let rule = &self.rules[index as usize];
                if rule.cost == 0 && rule.supporter != NONE && self.marks[rule.supporter as usize] != self.now {
                    self.marks[rule.supporter as usize] = self.now;
                    self.stack.push(rule.supporter);
                }
            }
        }
    }

    /// Collects the rules that lead from the state into the goal zone, outside of which their supporters are reached.
    fn find_cut(&mut self, values: &[u32]) {
        let (zone, before) = (self.now, self.now + 1);
        self.cut.clear();
        self.stack.extend(self.offsets.iter().zip(values).map(|(&offset, &value)| offset + value));
        self.stack.push(self.always);
        for &fact in &self.stack {
            self.marks[fact as usize] = before;
        }
        while let Some(fact) = self.stack.pop() {
            for &index in self.users.get(fact) {
                if self.rules[index as usize].supporter != fact {
                    continue;
                }
                let adds = self.adds.get(index);
                if adds.iter().any(|&add| self.marks[add as usize] == zone) {
                    self.cut.push(index);
                    continue;
                }
                for &add in adds {
                    if self.marks[add as usize] != before {
                        self.marks[add as usize] = before;
                        self.stack.push(add);
                    }
                }
            }
        }
    }

    /// Takes the cheapest cost of the cut off all its operators, and repairs hmax. Returns that cost.
    fn reduce(&mut self) -> u32 {
        let least = self.cut.iter().map(|&index| self.rules[index as usize].cost).min().unwrap_or(0);
        self.queue.clear();
        for at in 0..self.cut.len() {
            let index = self.cut[at];
            if !self.shares {
                self.cheapen(index, least);
                continue;
            }
            let group = self.group_of[index as usize];
            if self.group_marks[group as usize] != self.now {
                self.group_marks[group as usize] = self.now;
                for member in self.groups.starts[group as usize]..self.groups.starts[group as usize + 1] {
                    self.cheapen(self.groups.items[member as usize], least);
                }
            }
        }
        self.repair();
        least
    }

    #[inline]
    fn cheapen(&mut self, index: u32, by: u32) {
        let rule = &mut self.rules[index as usize];
        rule.cost -= by;
        if rule.supporter != NONE {
            let target = rule.supporter_cost + rule.cost;
            self.spread(index, target);
        }
    }

    /// Notes that a rule now reaches its facts at this cost.
    #[inline]
    fn spread(&mut self, index: u32, target: u32) {
        for &add in self.adds.get(index) {
            if target < self.facts[add as usize] {
                self.facts[add as usize] = target;
                self.queue.push(target, add);
            }
        }
    }

    /// Brings supporters and costs up to date after costs fell.
    fn repair(&mut self) {
        while let Some((cost, fact)) = self.queue.pop() {
            if self.facts[fact as usize] < cost {
                continue;
            }
            for &index in self.users.get(fact) {
                let rule = &mut self.rules[index as usize];
                if rule.supporter != fact || rule.supporter_cost <= cost {
                    continue;
                }
                let before = rule.supporter_cost;
                rule.supporter_cost = cost;
                let needs = self.needs.get(index);
                if needs.len() > 1 {
                    for &need in needs {
                        if self.facts[need as usize] > rule.supporter_cost {
                            rule.supporter = need;
                            rule.supporter_cost = self.facts[need as usize];
                        }
                    }
                }
                if rule.supporter_cost < before {
                    let target = rule.supporter_cost + rule.cost;
                    for &add in self.adds.get(index) {
                        if target < self.facts[add as usize] {
                            self.facts[add as usize] = target;
                            self.queue.push(target, add);
                        }
                    }
                }
            }
        }
    }
}

impl Heuristic for LmCut {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.rules.copy_from_slice(&self.start);
        self.explore(values);
        if self.facts[self.goal as usize] == UNREACHED {
            return DEAD_END;
        }
        let mut total: u32 = 0;
        while self.facts[self.goal as usize] > 0 {
            if self.now > u32::MAX - 4 {
                self.marks.fill(0);
                self.group_marks.fill(0);
                self.now = 0;
            }
            self.mark_goal_zone();
            self.find_cut(values);
            total = total.saturating_add(self.reduce()).min(DEAD_END - 1);
        }
        total
    }
}

/// The rules that help towards the goal, with the additions that do.
fn relevant(relaxation: &Relaxation) -> Vec<Rule> {
    let mut adders = vec![Vec::new(); relaxation.facts];
    for (index, rule) in relaxation.rules.iter().enumerate() {
        for &fact in &rule.adds {
            adders[fact as usize].push(index);
        }
    }
    let mut is_relevant = vec![false; relaxation.facts];
    let mut stack = Vec::new();
    let mut demand = |facts: &[u32], stack: &mut Vec<u32>| {
        for &fact in facts {
            if !std::mem::replace(&mut is_relevant[fact as usize], true) {
                stack.push(fact);
            }
        }
    };
    demand(&relaxation.goal, &mut stack);
    while let Some(fact) = stack.pop() {
        for index in std::mem::take(&mut adders[fact as usize]) {
            demand(&relaxation.rules[index].needs, &mut stack);
        }
    }
    let mut rules = relaxation.rules.clone();
    for rule in &mut rules {
        rule.adds.retain(|&fact| is_relevant[fact as usize]);
    }
    rules.retain(|rule| !rule.adds.is_empty());
    rules
}

/// Of operators that are one rule each, with equal needs and additions, keeps the cheapest, the first of equals.
fn merge(rules: &mut Vec<Rule>) {
    let mut order: Vec<usize> = (0..rules.len()).collect();
    let mut is_single = vec![true; rules.len()];
    for index in 1..rules.len() {
        if rules[index].origin != AXIOM && rules[index].origin == rules[index - 1].origin {
            is_single[index] = false;
            is_single[index - 1] = false;
        }
    }
    order.sort_by(|&a, &b| {
        let key = |index: usize| (&rules[index].needs, &rules[index].adds, rules[index].cost, index);
        key(a).cmp(&key(b))
    });
    let mut keep = vec![true; rules.len()];
    let mut first: Option<usize> = None;
    for index in order {
        if !is_single[index] {
            continue;
        }
        match first {
            Some(winner) if rules[winner].needs == rules[index].needs && rules[winner].adds == rules[index].adds => keep[index] = false,
            _ => first = Some(index),
        }
    }
    let mut keep = keep.into_iter();
    rules.retain(|_| keep.next() == Some(true));
}
