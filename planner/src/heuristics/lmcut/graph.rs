//! The delete relaxation goes in; LM-cut's graph comes out: relevant rules, with an artificial goal, in flat tables.

use std::ops::Range;

use super::NONE;
use crate::axioms::by_key;
use crate::heuristics::Costs;
use crate::heuristics::relaxed::{AXIOM, Relaxation, Rule};
use crate::task::Task;

/// Lists of numbers by number.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    starts: Vec<u32>,
    pub items: Vec<u32>,
}

impl Table {
    /// Groups pairs by their first part, which is below `keys`.
    fn new(pairs: &[(u32, u32)], keys: usize) -> Self {
        let (starts, items) = by_key(pairs, keys);
        Self { starts, items }
    }

    /// How many lists there are.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the list of `key` stands in `items`.
    #[inline]
    pub(super) fn range(&self, key: u32) -> Range<usize> {
        self.starts[key as usize] as usize..self.starts[key as usize + 1] as usize
    }

    #[inline]
    pub(super) fn get(&self, key: u32) -> &[u32] {
        &self.items[self.range(key)]
    }
}

/// The rules of a task, each with the tables that LM-cut walks.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub offsets: Vec<u32>,
    /// How many facts there are, with the two artificial ones.
    pub facts: usize,
    /// The fact that stands for the whole goal.
    pub goal: u32,
    /// The fact that rules without needs get, which always holds.
    pub always: u32,
    pub needs: Table,
    pub adds: Table,
    /// For each fact the rules that need it, and those that add it.
    pub users: Table,
    pub achievers: Table,
    /// Rules that stem from one operator form a group and share its cost.
    pub group_of: Vec<u32>,
    pub groups: Table,
    /// Whether a group has more than one rule.
    pub shares: bool,
    /// For each operator its group, or that of an operator with the same effect for less; [`NONE`] where it does not help towards the goal.
    pub group_of_operator: Vec<u32>,
    /// For each rule its cost, and how many needs it has.
    pub costs: Vec<u32>,
    pub need_counts: Vec<u32>,
}

impl Graph {
    pub(super) fn new(task: &Task, costs: Costs) -> Self {
        let relaxation = Relaxation::new(task, costs);
        let goal = relaxation.facts as u32;
        let always = goal + 1;
        let facts = relaxation.facts + 2;
        let mut rules = relevant(&relaxation);
        let mut winners = merge(&mut rules, task.operators.len());
        rules.push(Rule {
            needs: relaxation.goal.clone(),
            adds: vec![goal],
            cost: 0,
            origin: AXIOM,
        });
        let mut needs = Vec::new();
        let mut adds = Vec::new();
        let mut group_of = Vec::new();
        let mut own_groups = vec![NONE; task.operators.len()];
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
            if rule.origin != AXIOM {
                own_groups[rule.origin as usize] = groups - 1;
            }
        }
        for winner in &mut winners {
            *winner = own_groups.get(*winner as usize).copied().unwrap_or(NONE);
        }
        let swapped = |pairs: &[(u32, u32)]| {
            pairs.iter().map(|&(rule, fact)| (fact, rule)).collect::<Vec<_>>()
        };
        let members: Vec<(u32, u32)> = group_of.iter().copied().zip(0..).collect();
        Self {
            offsets: relaxation.offsets,
            facts,
            goal,
            always,
            users: Table::new(&swapped(&needs), facts),
            achievers: Table::new(&swapped(&adds), facts),
            needs: Table::new(&needs, rules.len()),
            adds: Table::new(&adds, rules.len()),
            groups: Table::new(&members, groups as usize),
            shares: (groups as usize) < rules.len(),
            group_of,
            group_of_operator: winners,
            costs: rules.iter().map(|rule| rule.cost).collect(),
            need_counts: rules.iter().map(|rule| rule.needs.len() as u32).collect(),
        }
    }

    /// Puts the needs of each rule in the order of the facts' ranks.
    pub(super) fn rank(&mut self, ranks: &[u32]) {
        for rule in 0..self.costs.len() as u32 {
            let range = self.needs.range(rule);
            self.needs.items[range].sort_by_key(|&fact| (ranks[fact as usize], fact));
        }
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
/// Returns for each operator the one kept in its place; [`NONE`] where it has no rule.
fn merge(rules: &mut Vec<Rule>, operators: usize) -> Vec<u32> {
    let mut winners = vec![NONE; operators];
    let mut is_single = vec![true; rules.len()];
    for index in 0..rules.len() {
        let origin = rules[index].origin;
        if origin != AXIOM {
            winners[origin as usize] = origin;
            if index > 0 && origin == rules[index - 1].origin {
                is_single[index] = false;
                is_single[index - 1] = false;
            }
        }
    }
    let mut order: Vec<usize> = (0..rules.len()).filter(|&index| is_single[index]).collect();
    order.sort_by(|&a, &b| {
        let key =
            |index: usize| (&rules[index].needs, &rules[index].adds, rules[index].cost, index);
        key(a).cmp(&key(b))
    });
    let mut keep = vec![true; rules.len()];
    for group in
        order.chunk_by(|&a, &b| rules[a].needs == rules[b].needs && rules[a].adds == rules[b].adds)
    {
        for &index in &group[1..] {
            keep[index] = false;
            if rules[index].origin != AXIOM {
                winners[rules[index].origin as usize] = rules[group[0]].origin;
            }
        }
    }
    let mut keep = keep.into_iter();
    rules.retain(|_| keep.next() == Some(true));
    winners
}
