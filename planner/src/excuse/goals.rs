//! A problem without a plan goes in; which parts of its goal cannot be had together comes out: all minimal subsets of the goal that have no plan.
//!
//! After the MUGS of Eifler, Cashmore, Hoffmann, Magazzeni and Steinmetz ("A new approach to plan-space explanation: analyzing plan-property dependencies in
//! oversubscription planning", AAAI 2020), enumerated as by MARCO (Liffiton, Previti, Malik and Marques-Silva, "Fast, flexible MUS enumeration", 2016): a
//! subset about which nothing is known is looked at; one that has a plan grows as long as it has one, one that has none shrinks as long as it has none.

use lang::condition::Condition;
use lang::model::{Domain, Problem};

use crate::limits::{Limits, Stop};
use crate::normalize::Unsupported;
use crate::solve::{Answer, solve};

/// With more parts than this a goal is not taken apart.
pub const MOST_PARTS: usize = 63;

/// What is known of the parts of a goal. Sets of parts are bit masks over [`Conflicts::parts`].
#[derive(Debug, Clone)]
pub struct Conflicts {
    /// The conjuncts of the goal.
    pub parts: Vec<Condition>,
    /// Sets that have no plan although each smaller one has.
    pub conflicts: Vec<u64>,
    /// Sets that have a plan although no larger one has: as much of the goal as can be had.
    pub feasible: Vec<u64>,
    /// Whether these are all: otherwise it was told to stop, or some set was too hard.
    pub complete: bool,
}

/// How much work a set gets.
const EFFORT: u64 = 200_000_000;

/// Finds the conflicts of a goal, `most` at most. `None` where the goal cannot be taken apart.
///
/// # Errors
/// What the planner does not plan.
pub fn conflicts(
    domain: &Domain,
    problem: &Problem,
    most: usize,
    limits: &Limits,
) -> Result<Option<Conflicts>, Unsupported> {
    let Some(goal) = Condition::new(&problem.goal) else { return Ok(None) };
    let parts = goal.conjuncts().to_vec();
    if parts.is_empty() || parts.len() > MOST_PARTS {
        return Ok(None);
    }
    let mut map = Map {
        domain,
        problem,
        limits,
        conflicts: Vec::new(),
        feasible: Vec::new(),
        unknown: Vec::new(),
        parts,
    };
    let stopped = map.explore(most)?;
    let complete = stopped.is_none() && map.unknown.is_empty() && map.conflicts.len() < most;
    let Map { parts, mut conflicts, feasible, .. } = map;
    conflicts.sort_by_key(|set| (set.count_ones(), *set));
    Ok(Some(Conflicts { parts, conflicts, feasible, complete }))
}

struct Map<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    limits: &'a Limits,
    parts: Vec<Condition>,
    conflicts: Vec<u64>,
    feasible: Vec<u64>,
    unknown: Vec<u64>,
}

impl Map<'_> {
    /// Looks at sets until nothing is open.
    fn explore(&mut self, most: usize) -> Result<Option<Stop>, Unsupported> {
        let all = u64::MAX >> (64 - self.parts.len());
        while self.conflicts.len() < most {
            if let Some(stop) = self.limits.stopped() {
                return Ok(Some(stop));
            }
            let Some(seed) = self.open(all) else { return Ok(None) };
            match self.has_plan(seed)? {
                None => self.unknown.push(seed),
                Some(true) => {
                    let grown = self.grow(seed, all)?;
                    self.feasible.push(grown);
                }
                Some(false) => {
                    let shrunk = self.shrink(seed)?;
                    self.conflicts.push(shrunk);
                }
            }
        }
        Ok(None)
    }

    /// A largest set that contains no known conflict and is in no set that is known to have a plan: hitting sets of the conflicts, taken away, the smallest
    /// first. Sets that were too hard are passed over.
    fn open(&self, all: u64) -> Option<u64> {
        let mut queue = std::collections::BinaryHeap::from([std::cmp::Reverse((0_u32, 0_u64))]);
        let mut seen = rustc_hash::FxHashSet::default();
        while let Some(std::cmp::Reverse((_, removed))) = queue.pop() {
            if !seen.insert(removed) {
                continue;
            }
            let set = all & !removed;
            let within = |known: &&u64| **known & set == **known;
            if let Some(conflict) = self.conflicts.iter().find(within) {
                for part in bits(*conflict) {
                    let next = removed | 1 << part;
                    queue.push(std::cmp::Reverse((next.count_ones(), next)));
                }
                continue;
            }
            let known =
                self.feasible.iter().any(|known| set & known == set) || self.unknown.contains(&set);
            if !known {
                return Some(set);
            }
            if self.unknown.contains(&set) {
                for part in bits(set) {
                    let next = removed | 1 << part;
                    queue.push(std::cmp::Reverse((next.count_ones(), next)));
                }
            }
        }
        None
    }

    fn grow(&mut self, mut set: u64, all: u64) -> Result<u64, Unsupported> {
        for part in bits(all & !set) {
            let larger = set | 1 << part;
            let conflicts = self.conflicts.iter().any(|known| known & larger == *known);
            if !conflicts && self.has_plan(larger)? == Some(true) {
                set = larger;
            }
        }
        Ok(set)
    }

    fn shrink(&mut self, mut set: u64) -> Result<u64, Unsupported> {
        for part in bits(set) {
            let smaller = set & !(1 << part);
            let feasible = self.feasible.iter().any(|known| smaller & known == smaller);
            if smaller != 0 && !feasible && self.has_plan(smaller)? == Some(false) {
                set = smaller;
            }
        }
        Ok(set)
    }

    /// Whether some parts of the goal have a plan; nothing if that is too hard to say.
    fn has_plan(&self, set: u64) -> Result<Option<bool>, Unsupported> {
        let mut problem = self.problem.clone();
        let parts = bits(set).map(|part| self.parts[part].clone());
        problem.goal = Condition::all(parts).formula(problem.name.span);
        let answer = solve(self.domain, &problem, false, EFFORT, self.limits)?;
        Ok(match answer {
            Answer::Plan(_) => Some(true),
            Answer::Unsolvable(_) => Some(false),
            Answer::Spent | Answer::Stopped(_) => None,
        })
    }
}

/// The members of a set, in ascending order.
pub fn bits(set: u64) -> impl Iterator<Item = usize> {
    (0..64).filter(move |bit| set >> bit & 1 == 1)
}
