//! A problem in normal form and its ground facts go in; groups of facts of which at most one ever holds come out.
//!
//! The synthesis of Helmert ("Concise finite-domain representations for PDDL planning tasks", AIJ 2009, section 5), on schemas:
//! a [`candidate`] says "for these parameters, the number of facts like this never grows". One that an add effect may break
//! ([`balance`]) is extended by an atom that the same schema deletes, or given up. What holds is instantiated on the initial state:
//! where exactly one fact holds initially, the facts are a group.
//!
//! It goes further than the paper in three points. While a candidate is checked, states in which it is already broken are left out,
//! since they are never reached from where it holds. Types tell variables apart. So do pairs of parameters
//! that are never the same object in any ground operator.

mod candidate;
mod equality;
mod balance;

use std::collections::VecDeque;

use hashbrown::HashTable;
use lang::model::{Domain, Problem};
use rustc_hash::{FxBuildHasher, FxHashSet};
use std::hash::BuildHasher;

use crate::grounded::{FactId, Grounded};
use crate::limits::Limits;
use crate::normal::{Kind, Normal};
pub use candidate::{Candidate, Part};

use balance::{Actions, Open, Verdict};
use equality::Kinds;

/// So many candidates are looked at, at most.
const CANDIDATES: usize = 40_000;

/// So many comparisons of atoms are made, at most: less than a second.
const WORK: u64 = 8_000_000;

/// The mutex groups of a problem: of each, at most one fact holds in any reachable state. Facts of a group are sorted; no group is
/// there twice; each has at least two facts, none of them derived.
///
/// Told to stop, it returns what it has found by then.
pub fn groups(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    grounded: &Grounded,
    limits: &Limits,
) -> Vec<Vec<FactId>> {
    let kinds = Kinds::new(domain, problem);
    let actions = Actions::new(normal, grounded, false, &kinds);
    let invariants = synthesize(normal, &actions, limits);
    instantiate(&invariants, problem, normal, grounded)
}

/// The invariants of a problem before they are instantiated: only those that some effect adds to, since of the others the actions say nothing.
/// They hold whatever the initial state: where at most one of the facts of an instance holds, it stays so.
///
/// `grounded` may have more instances of actions than are reachable, and actions without any count, too. Told to stop, it returns what it has found by then.
pub fn lifted(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    grounded: &Grounded,
    limits: &Limits,
) -> Vec<Candidate> {
    let kinds = Kinds::new(domain, problem);
    let actions = Actions::new(normal, grounded, true, &kinds);
    let mut invariants = synthesize(normal, &actions, limits);
    invariants.retain(|one| one.parts.iter().any(|part| actions.adds(part.predicate)));
    invariants
}

/// All candidates that hold, in the order in which they were found.
fn synthesize(normal: &Normal, actions: &Actions, limits: &Limits) -> Vec<Candidate> {
    let fluents = (0..normal.predicates.len())
        .filter(|&predicate| normal.predicates[predicate].kind == Kind::Fluent);
    let mut queue: VecDeque<Open> = fluents
        .flat_map(|predicate| {
            Candidate::initial(predicate as u32, normal.predicates[predicate].arity)
        })
        .map(Open::new)
        .collect();
    let mut seen: FxHashSet<Candidate> = queue.iter().map(|open| open.candidate.clone()).collect();
    let mut invariants = Vec::new();
    let mut work = 0;
    while let Some(open) = queue.pop_front() {
        if work > WORK || limits.stopped().is_some() {
            break;
        }
        match actions.check(&open, &mut work) {
            Verdict::Holds => invariants.push(open.candidate),
            Verdict::Heavy => {}
            Verdict::Unbalanced(extensions) => {
                for extended in extensions {
                    if seen.len() < CANDIDATES && seen.insert(extended.candidate.clone()) {
                        queue.push_back(extended);
                    }
                }
            }
        }
    }
    invariants
}

/// Rows of `width` numbers, each known by its position.
struct Keys {
    width: usize,
    rows: Vec<u32>,
    count: u32,
    table: HashTable<u32>,
}

impl Keys {
    fn new(width: usize) -> Self {
        Self { width, rows: Vec::new(), count: 0, table: HashTable::new() }
    }

    fn find(&self, row: &[u32]) -> Option<u32> {
        let same = |&other: &u32| self.rows[other as usize * self.width..][..self.width] == *row;
        self.table.find(FxBuildHasher.hash_one(row), same).copied()
    }

    fn insert(&mut self, row: &[u32]) -> u32 {
        if let Some(id) = self.find(row) {
            return id;
        }
        let id = self.count;
        self.count += 1;
        self.rows.extend_from_slice(row);
        let (rows, width) = (&self.rows, self.width);
        let hash = |&other: &u32| FxBuildHasher.hash_one(&rows[other as usize * width..][..width]);
        self.table.insert_unique(FxBuildHasher.hash_one(row), id, hash);
        id
    }
}

/// Groups the facts of each invariant by its parameters, where exactly one of them holds initially.
fn instantiate(
    invariants: &[Candidate],
    problem: &Problem,
    normal: &Normal,
    grounded: &Grounded,
) -> Vec<Vec<FactId>> {
    let mut initial: Vec<Vec<u32>> = vec![Vec::new(); normal.predicates.len()];
    for (index, fact) in problem.init.iter().enumerate() {
        initial[fact.predicate.index()].push(index as u32);
    }
    let mut facts: Vec<Vec<u32>> = vec![Vec::new(); normal.predicates.len()];
    for (index, fact) in grounded.facts.iter().enumerate() {
        facts[fact.predicate.index()].push(index as u32);
    }
    let mut seen: FxHashSet<Vec<FactId>> = FxHashSet::default();
    let mut groups = Vec::new();
    let mut row = Vec::new();
    for invariant in invariants {
        let mut keys = Keys::new(invariant.parameters());
        let mut weights: Vec<u32> = Vec::new();
        for part in &invariant.parts {
            for &fact in &initial[part.predicate as usize] {
                row.clear();
                row.extend(
                    part.order.iter().map(|&position| {
                        problem.init[fact as usize].arguments[position as usize].0
                    }),
                );
                let key = keys.insert(&row) as usize;
                weights.resize(weights.len().max(key + 1), 0);
                weights[key] += 1;
            }
        }
        let mut members: Vec<Vec<FactId>> = vec![Vec::new(); weights.len()];
        for part in &invariant.parts {
            for &fact in &facts[part.predicate as usize] {
                let arguments =
                    &grounded.arguments[grounded.facts[fact as usize].arguments.start as usize..];
                row.clear();
                row.extend(part.order.iter().map(|&position| arguments[position as usize].0));
                if let Some(key) = keys.find(&row)
                    && weights[key as usize] == 1
                {
                    members[key as usize].push(FactId(fact));
                }
            }
        }
        for mut group in members.into_iter().filter(|group| group.len() > 1) {
            group.sort_unstable();
            if seen.insert(group.clone()) {
                groups.push(group);
            }
        }
    }
    groups
}

#[cfg(test)]
mod tests;
