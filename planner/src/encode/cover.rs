//! Mutex groups go in; a set of disjoint groups that become variables comes out.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::grounded::{FactId, Grounded, Literal};
use crate::task::{Fact, VariableId};

/// Stands for no variable or no group.
pub(super) const NONE: u32 = u32::MAX;

/// A list of ids for each of a row of things, in one array.
pub(super) struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Collects `(row, item)` pairs; within a row, items keep the order of the pairs.
    pub(super) fn new(rows: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut starts = vec![0u32; rows + 1];
        for (row, _) in pairs.clone() {
            starts[row as usize + 1] += 1;
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[rows] as usize];
        for (row, item) in pairs {
            items[next[row as usize] as usize] = item;
            next[row as usize] += 1;
        }
        Self { starts, items }
    }

    /// The items of a row.
    #[inline]
    pub(super) fn row(&self, row: usize) -> &[u32] {
        &self.items[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// More than every item.
    pub(super) fn bound(&self) -> usize {
        self.items.iter().max().map_or(0, |&item| item as usize + 1)
    }
}

/// Where each fact lives: in a value of one variable, and some also in a variable of their own.
pub(super) struct Layout {
    /// For each fact the variable and the value that say that it holds.
    pub(super) homes: Vec<Fact>,
    /// For each fact that is asked for negatively and shares a variable with two or more others: a two-valued variable that follows
    /// it alone, 0 where it holds and 1 where it does not. Otherwise [`NONE`].
    pub(super) duals: Vec<u32>,
    /// The facts of each variable's values from 0 on. A dual has the one fact that it follows.
    pub(super) members: Vec<Vec<FactId>>,
    /// Whether the variable has one more value, the last, for none of its facts. Without it one of them holds in every reachable state.
    pub(super) open: Vec<bool>,
    /// The groups, of those with facts in several variables, that each fact belongs to.
    pub(super) crossing: Lists,
    /// How many variables come from the cover; those behind are duals.
    pub(super) covering: usize,
}

impl Layout {
    /// Covers the facts: again and again the group with the most uncovered facts becomes a variable, of equals the first in `groups`.
    ///
    /// Facts that no group of two or more covers become variables of their own, in the order of their ids, behind the groups.
    pub(super) fn new(grounded: &Grounded, groups: &[Vec<FactId>]) -> Self {
        let facts = grounded.facts.len();
        let pairs = groups
            .iter()
            .enumerate()
            .flat_map(|(group, facts)| facts.iter().map(move |fact| (fact.0, group as u32)));
        let containing = Lists::new(facts, pairs);
        let unplaced = Fact { variable: VariableId(NONE), value: 0 };
        let mut homes = vec![unplaced; facts];
        let mut members: Vec<Vec<FactId>> = Vec::new();

        let mut sizes: Vec<u32> = groups.iter().map(|group| group.len() as u32).collect();
        let mut heap: BinaryHeap<(u32, Reverse<u32>)> = sizes
            .iter()
            .enumerate()
            .filter(|&(_, &size)| size > 1)
            .map(|(group, &size)| (size, Reverse(group as u32)))
            .collect();
        while let Some((size, Reverse(group))) = heap.pop() {
            let left = sizes[group as usize];
            if left < size {
                if left > 1 {
                    heap.push((left, Reverse(group)));
                }
                continue;
            }
            let mut values = Vec::with_capacity(size as usize);
            for &fact in &groups[group as usize] {
                if homes[fact.index()] == unplaced && !grounded.derived[fact.index()] {
                    homes[fact.index()] = Fact {
                        variable: VariableId(members.len() as u32),
                        value: values.len() as u32,
                    };
                    values.push(fact);
                    for &other in containing.row(fact.index()) {
                        sizes[other as usize] -= 1;
                    }
                }
            }
            members.push(values);
        }
        for (fact, home) in homes.iter_mut().enumerate() {
            if *home == unplaced {
                *home = Fact { variable: VariableId(members.len() as u32), value: 0 };
                members.push(vec![FactId(fact as u32)]);
            }
        }

        let spans_several = |group: &[FactId]| {
            group
                .windows(2)
                .any(|pair| homes[pair[0].index()].variable != homes[pair[1].index()].variable)
        };
        let crossing = groups.iter().enumerate().filter(|(_, facts)| spans_several(facts));
        let pairs = crossing
            .flat_map(|(group, facts)| facts.iter().map(move |fact| (fact.0, group as u32)));
        let crossing = Lists::new(facts, pairs);
        let covering = members.len();
        let mut layout = Self {
            homes,
            duals: vec![NONE; facts],
            open: vec![true; covering],
            members,
            crossing,
            covering,
        };
        layout.add_duals(grounded);
        layout
    }

    /// How many values a variable has before unreachable ones go.
    pub(super) fn size(&self, variable: usize) -> u32 {
        self.members[variable].len() as u32 + u32::from(self.open[variable])
    }

    /// Gives every fact that is asked for negatively a variable that has its negation as one value.
    fn add_duals(&mut self, grounded: &Grounded) {
        let mut negative = vec![false; grounded.facts.len()];
        let mut any = false;
        for literal in
            grounded.literals.iter().chain(&grounded.goal).filter(|literal| !literal.positive)
        {
            let shared = self.members[self.homes[literal.fact.index()].variable.index()].len() > 1;
            negative[literal.fact.index()] |= shared;
            any |= shared;
        }
        if !any {
            return;
        }
        let needed = self.needed_negations(grounded, &negative);
        self.close_pairs(grounded, &needed);
        for fact in (0..needed.len()).filter(|&fact| needed[fact]) {
            if self.size(self.homes[fact].variable.index()) > 2 {
                self.duals[fact] = self.members.len() as u32;
                self.members.push(vec![FactId(fact as u32)]);
                self.open.push(true);
            }
        }
    }

    /// The negative facts that no positive literal beside them implies already.
    fn needed_negations(&self, grounded: &Grounded, negative: &[bool]) -> Vec<bool> {
        let mut needed = vec![false; negative.len()];
        let variable = |literal: &Literal| self.homes[literal.fact.index()].variable;
        let mut look = |literals: &[Literal], context: &[Literal]| {
            for literal in literals
                .iter()
                .filter(|literal| !literal.positive && negative[literal.fact.index()])
            {
                let fixed =
                    |other: &&Literal| other.positive && variable(other) == variable(literal);
                needed[literal.fact.index()] |=
                    !literals.iter().chain(context).any(|other| fixed(&other));
            }
        };
        let slice = |range: &std::ops::Range<u32>| {
            &grounded.literals[range.start as usize..range.end as usize]
        };
        for operator in &grounded.operators {
            let precondition = slice(&operator.precondition);
            look(precondition, &[]);
            for effect in
                &grounded.effects[operator.effects.start as usize..operator.effects.end as usize]
            {
                look(slice(&effect.conditions), precondition);
            }
        }
        for axiom in &grounded.axioms {
            look(slice(&axiom.conditions), &[]);
        }
        look(&grounded.goal, &[]);
        needed
    }

    /// Finds the variables of two facts of which always exactly one holds, among those where that saves a dual.
    fn close_pairs(&mut self, grounded: &Grounded, needed: &[bool]) {
        let mut closed = vec![false; self.covering];
        for fact in (0..needed.len()).filter(|&fact| needed[fact]) {
            let variable = self.homes[fact].variable.index();
            let members = &self.members[variable];
            closed[variable] =
                members.len() == 2 && members.iter().any(|member| grounded.initial[member.index()]);
        }
        if !closed.contains(&true) {
            return;
        }
        for operator in &grounded.operators {
            let precondition = &grounded.literals
                [operator.precondition.start as usize..operator.precondition.end as usize];
            let effects =
                &grounded.effects[operator.effects.start as usize..operator.effects.end as usize];
            for delete in effects.iter().filter(|effect| !effect.literal.positive) {
                let variable = self.homes[delete.literal.fact.index()].variable;
                if !closed[variable.index()] {
                    continue;
                }
                let conditions = &grounded.literals
                    [delete.conditions.start as usize..delete.conditions.end as usize];
                let elsewhere = |literal: &Literal| {
                    literal.positive
                        && literal.fact != delete.literal.fact
                        && self.homes[literal.fact.index()].variable == variable
                };
                let refilled = effects.iter().any(|add| {
                    add.literal.positive
                        && self.homes[add.literal.fact.index()].variable == variable
                        && (add.conditions.is_empty()
                            || grounded.literals
                                [add.conditions.start as usize..add.conditions.end as usize]
                                == *conditions)
                });
                closed[variable.index()] =
                    refilled || precondition.iter().chain(conditions).any(elsewhere);
            }
        }
        for (variable, _) in closed.iter().enumerate().filter(|(_, closed)| **closed) {
            self.open[variable] = false;
        }
    }
}
