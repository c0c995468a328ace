//! LM-cut (Helmert and Domshlak, ICAPS 2009): the summed costs of disjunctive action landmarks, found as cuts in the justification graph of hmax.
//!
//! Each round computes hmax, takes for each rule the need that is reached last (its *supporter*), and cuts the graph of supporters between the state and
//! the *goal zone*, from where the goal is reached for nothing. Some operator of the cut is in every plan: its cheapest cost is counted, taken off all of
//! them, and hmax repaired, until it is zero.
//!
//! Conditional effects make several rules of one operator, which share one cost: a cut that holds some of them takes the cost off once, for all of them
//! (Röger, Pommerening and Helmert, ECAI 2014). Axioms are rules that cost nothing. Both keep the sum admissible.

mod graph;
mod ranking;

use graph::Graph;

use super::queue::Queue;
use super::{Costs, DEAD_END, Heuristic, Profile};
use crate::task::{OperatorId, Task};

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

/// In the goal zone.
const ZONE: u32 = 0;
/// Reached from the state outside of the zone.
const BEFORE: u32 = 1;
/// Not so reached.
const CUT_OFF: u32 = 2;
/// Looked at by the backward search under way.
const VISITED: u32 = 3;
/// How many numbers a round takes.
const ROUND: u32 = 4;

/// See the module.
#[derive(Debug, Clone)]
pub struct LmCut {
    graph: Graph,
    /// For each rule what is left of its cost, how many needs are not reached, the need reached last ([`NONE`] while some are not) and its hmax.
    left: Vec<u32>,
    unsatisfied: Vec<u32>,
    supporters: Vec<u32>,
    supporter_costs: Vec<u32>,
    /// For each fact its hmax.
    facts: Vec<u32>,
    /// For each fact the last round in which something was found about it: the round's number plus one of the constants above.
    marks: Vec<u32>,
    rule_marks: Vec<u32>,
    group_marks: Vec<u32>,
    now: u32,
    /// How many cuts were made, ever.
    rounds: u64,
    queue: Queue,
    stack: Vec<u32>,
    visited: Vec<u32>,
    cut: Vec<u32>,
    parent: Landmarks,
}

/// The landmarks of the state entered last, of which most hold in its successors too.
#[derive(Debug, Clone, Default)]
struct Landmarks {
    /// The state; taken apart when the first successor is asked for.
    values: Vec<u32>,
    is_ready: bool,
    total: u32,
    /// What the landmarks leave of each rule's cost.
    left: Vec<u32>,
    costs: Vec<u32>,
    /// For each landmark where its groups begin in `groups`, and the end.
    starts: Vec<u32>,
    groups: Vec<u32>,
}

impl LmCut {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        let graph = Graph::new(task, costs);
        let (rules, facts, groups) = (graph.costs.len(), graph.facts, graph.groups.len());
        Self {
            graph,
            left: vec![0; rules],
            unsatisfied: vec![0; rules],
            supporters: vec![NONE; rules],
            supporter_costs: vec![0; rules],
            facts: vec![UNREACHED; facts],
            marks: vec![0; facts],
            rule_marks: vec![0; rules],
            group_marks: vec![0; groups],
            now: 0,
            rounds: 0,
            queue: Queue::new(),
            stack: Vec::new(),
            visited: Vec::new(),
            cut: Vec::new(),
            parent: Landmarks::default(),
        }
    }

    /// LM-cut with what is left of the costs; `on_cut` sees each cut and its cost.
    fn cuts(&mut self, values: &[u32], mut on_cut: impl FnMut(&Graph, &[u32], u32)) -> u32 {
        self.explore(values);
        if self.facts[self.graph.goal as usize] == UNREACHED {
            return DEAD_END;
        }
        let mut total: u32 = 0;
        while self.facts[self.graph.goal as usize] > 0 {
            self.tick();
            self.rounds += 1;
            self.mark_goal_zone();
            self.find_cut();
            let least = self.reduce();
            on_cut(&self.graph, &self.cut, least);
            total = total.saturating_add(least).min(DEAD_END - 1);
        }
        total
    }

    /// Finds the landmarks of the state entered last.
    fn prepare(&mut self) {
        let mut parent = std::mem::take(&mut self.parent);
        parent.is_ready = true;
        parent.costs.clear();
        parent.starts.clear();
        parent.groups.clear();
        self.left.copy_from_slice(&self.graph.costs);
        parent.total = self.cuts(&parent.values, |graph, cut, cost| {
            parent.costs.push(cost);
            parent.starts.push(parent.groups.len() as u32);
            parent.groups.extend(cut.iter().map(|&rule| graph.group_of[rule as usize]));
        });
        parent.starts.push(parent.groups.len() as u32);
        parent.left.clone_from(&self.left);
        self.parent = parent;
    }

    /// Takes over those landmarks of the state entered last that `operator` is not in: they are landmarks of the state after it.
    /// Gives back the costs that the others took. Returns what the landmarks taken over sum up to.
    fn inherit(&mut self, operator: OperatorId) -> u32 {
        self.left.copy_from_slice(&self.parent.left);
        let own = self.graph.group_of_operator[operator.index()];
        let mut total = self.parent.total;
        if own == NONE {
            return total;
        }
        for landmark in 0..self.parent.costs.len() {
            let range =
                self.parent.starts[landmark] as usize..self.parent.starts[landmark + 1] as usize;
            if self.parent.groups[range.clone()].contains(&own) {
                let cost = self.parent.costs[landmark];
                total -= cost;
                self.tick();
                for &group in &self.parent.groups[range] {
                    // A cut may hold several rules of a group, whose cost it took once.
                    if std::mem::replace(&mut self.group_marks[group as usize], self.now)
                        != self.now
                    {
                        for &rule in self.graph.groups.get(group) {
                            self.left[rule as usize] += cost;
                        }
                    }
                }
            }
        }
        total
    }

    /// Begins a round: marks of earlier ones mean nothing from now on.
    fn tick(&mut self) {
        if self.now > u32::MAX - 2 * ROUND {
            self.marks.fill(0);
            self.rule_marks.fill(0);
            self.group_marks.fill(0);
            self.now = 0;
        }
        self.now += ROUND;
    }

    /// hmax from scratch, with the costs that the rules have.
    fn explore(&mut self, values: &[u32]) {
        self.facts.fill(UNREACHED);
        self.supporters.fill(NONE);
        self.unsatisfied.copy_from_slice(&self.graph.need_counts);
        self.queue.clear();
        for (&offset, &value) in self.graph.offsets.iter().zip(values) {
            self.facts[(offset + value) as usize] = 0;
            self.queue.push(0, offset + value);
        }
        self.facts[self.graph.always as usize] = 0;
        self.queue.push(0, self.graph.always);
        while let Some((cost, fact)) = self.queue.pop() {
            if self.facts[fact as usize] < cost {
                continue;
            }
            for &rule in self.graph.users.get(fact) {
                let unsatisfied = &mut self.unsatisfied[rule as usize];
                *unsatisfied -= 1;
                if *unsatisfied == 0 {
                    // Facts come by ascending cost: of the needs that cost as much as this one, the first is the supporter.
                    let needs = self.graph.needs.get(rule);
                    self.supporters[rule as usize] = if needs.len() == 1 {
                        fact
                    } else {
                        first_of_cost(needs, &self.facts, cost)
                    };
                    self.supporter_costs[rule as usize] = cost;
                    let target = cost.saturating_add(self.left[rule as usize]).min(UNREACHED - 1);
                    spread(self.graph.adds.get(rule), target, &mut self.facts, &mut self.queue);
                }
            }
        }
    }

    /// Marks the facts from which the goal costs nothing, and collects the rules that lead into their zone at a cost.
    fn mark_goal_zone(&mut self) {
        self.cut.clear();
        let zone = self.now + ZONE;
        self.marks[self.graph.goal as usize] = zone;
        self.stack.push(self.graph.goal);
        while let Some(fact) = self.stack.pop() {
            for &rule in self.graph.achievers.get(fact) {
                let supporter = self.supporters[rule as usize];
                if supporter == NONE || self.marks[supporter as usize] == zone {
                    continue;
                }
                if self.left[rule as usize] == 0 {
                    self.marks[supporter as usize] = zone;
                    self.stack.push(supporter);
                } else if self.rule_marks[rule as usize] != self.now {
                    self.rule_marks[rule as usize] = self.now;
                    self.cut.push(rule);
                }
            }
        }
    }

    /// Keeps those collected rules whose supporters are reached from the state outside of the goal zone.
    fn find_cut(&mut self) {
        let mut kept = 0;
        for at in 0..self.cut.len() {
            let rule = self.cut[at];
            if self.is_before_zone(self.supporters[rule as usize]) {
                self.cut[kept] = rule;
                kept += 1;
            }
        }
        self.cut.truncate(kept);
    }

    /// Whether a fact is reached from the state outside of the goal zone.
    ///
    /// Every fact of the zone costs at least as much as the goal, so all that is cheaper than the goal is reached outside of it, by its own supporters.
    /// Of the others it is found out by searching backward for something cheaper.
    fn is_before_zone(&mut self, fact: u32) -> bool {
        let goal_cost = self.facts[self.graph.goal as usize];
        if self.facts[fact as usize] < goal_cost {
            return true;
        }
        if self.marks[fact as usize] >= self.now {
            return self.marks[fact as usize] == self.now + BEFORE;
        }
        self.visited.clear();
        self.visited.push(fact);
        self.marks[fact as usize] = self.now + VISITED;
        let mut next = 0;
        while next < self.visited.len() {
            let target = self.visited[next];
            next += 1;
            for &rule in self.graph.achievers.get(target) {
                let supporter = self.supporters[rule as usize];
                if supporter == NONE {
                    continue;
                }
                let mark = self.marks[supporter as usize];
                let is_known =
                    self.facts[supporter as usize] < goal_cost || mark == self.now + BEFORE;
                // A rule that leads into the zone as well is in the cut already, or behind it.
                if !is_known && mark >= self.now
                    || self
                        .graph
                        .adds
                        .get(rule)
                        .iter()
                        .any(|&add| self.marks[add as usize] == self.now + ZONE)
                {
                    continue;
                }
                if is_known {
                    for &fact in &self.visited {
                        self.marks[fact as usize] = 0;
                    }
                    self.marks[fact as usize] = self.now + BEFORE;
                    self.marks[target as usize] = self.now + BEFORE;
                    return true;
                }
                self.marks[supporter as usize] = self.now + VISITED;
                self.visited.push(supporter);
            }
        }
        for &fact in &self.visited {
            self.marks[fact as usize] = self.now + CUT_OFF;
        }
        false
    }

    /// Takes the cheapest cost of the cut off all its operators, and repairs hmax. Returns that cost.
    fn reduce(&mut self) -> u32 {
        let least = self.cut.iter().map(|&rule| self.left[rule as usize]).min().unwrap_or(0);
        self.queue.clear();
        for at in 0..self.cut.len() {
            let rule = self.cut[at];
            if !self.graph.shares {
                self.cheapen(rule, least);
                continue;
            }
            let group = self.graph.group_of[rule as usize];
            if self.group_marks[group as usize] != self.now {
                self.group_marks[group as usize] = self.now;
                for member in self.graph.groups.range(group) {
                    self.cheapen(self.graph.groups.items[member], least);
                }
            }
        }
        self.repair();
        least
    }

    #[inline]
    fn cheapen(&mut self, rule: u32, by: u32) {
        self.left[rule as usize] -= by;
        if self.supporters[rule as usize] != NONE {
            let target =
                self.supporter_costs[rule as usize].saturating_add(self.left[rule as usize]);
            spread(self.graph.adds.get(rule), target, &mut self.facts, &mut self.queue);
        }
    }

    /// Brings supporters and costs up to date after costs fell; a goal that costs nothing needs no more of that.
    fn repair(&mut self) {
        while let Some((cost, fact)) = self.queue.pop() {
            if self.facts[fact as usize] < cost {
                continue;
            }
            if fact == self.graph.goal && cost == 0 {
                return;
            }
            for &rule in self.graph.users.get(fact) {
                if self.supporters[rule as usize] != fact
                    || self.supporter_costs[rule as usize] <= cost
                {
                    continue;
                }
                let needs = self.graph.needs.get(rule);
                let supporter_cost = if needs.len() == 1 {
                    cost
                } else {
                    let (supporter, supporter_cost) = dearest(needs, &self.facts);
                    self.supporters[rule as usize] = supporter;
                    supporter_cost
                };
                if supporter_cost < self.supporter_costs[rule as usize] {
                    self.supporter_costs[rule as usize] = supporter_cost;
                    let target = supporter_cost.saturating_add(self.left[rule as usize]);
                    spread(self.graph.adds.get(rule), target, &mut self.facts, &mut self.queue);
                }
            }
        }
    }
}

/// Notes that facts are reached at this cost.
#[inline]
fn spread(adds: &[u32], target: u32, facts: &mut [u32], queue: &mut Queue) {
    for &add in adds {
        if target < facts[add as usize] {
            facts[add as usize] = target;
            queue.push(target, add);
        }
    }
}

impl Heuristic for LmCut {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.left.copy_from_slice(&self.graph.costs);
        self.cuts(values, |_, _, _| {})
    }

    fn enter(&mut self, values: &[u32]) {
        self.parent.values.clear();
        self.parent.values.extend_from_slice(values);
        self.parent.is_ready = false;
    }

    fn evaluate_child(&mut self, operator: OperatorId, values: &[u32]) -> u32 {
        if !self.parent.is_ready {
            self.prepare();
        }
        let inherited = self.inherit(operator);
        match self.cuts(values, |_, _, _| {}) {
            DEAD_END => DEAD_END,
            rest => inherited.saturating_add(rest).min(DEAD_END - 1),
        }
    }

    fn tune(&mut self, samples: &[Vec<u32>]) {
        ranking::choose(self, samples);
    }
}

/// The first of `needs` that has this cost.
#[inline]
fn first_of_cost(needs: &[u32], facts: &[u32], cost: u32) -> u32 {
    needs
        .iter()
        .copied()
        .find(|&need| facts[need as usize] == cost)
        .expect("the need that was reached last has this cost")
}

/// The first of `needs` with the largest cost, and that cost.
#[inline]
fn dearest(needs: &[u32], facts: &[u32]) -> (u32, u32) {
    let mut dearest = (needs[0], facts[needs[0] as usize]);
    for &need in &needs[1..] {
        let cost = facts[need as usize];
        if cost > dearest.1 {
            dearest = (need, cost);
        }
    }
    dearest
}
