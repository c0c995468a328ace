//! A task goes in; of operators that are applicable in the same states and do the same, the cheapest stays.

use crate::task::{Effect, Fact, OperatorId, Task};

/// How long the pools are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ends {
    /// Of preconditions.
    pub(super) preconditions: usize,
    /// Of effects.
    pub(super) effects: usize,
    /// Of conditions of effects.
    pub(super) conditions: usize,
}

/// Drops all twins but one, which takes the place of the first and has the least cost and its origin. Returns the new ends of the pools.
///
/// Twins are found by sorting hashes, not in a table: a million operators fit into no cache, and a sort walks them in order.
pub(super) fn merge(task: &mut Task, origins: &mut Vec<u32>, ends: Ends) -> Ends {
    let print =
        |index: u32| fingerprint(task, OperatorId(index)) & !u64::from(u32::MAX) | u64::from(index);
    let mut prints: Vec<u64> = (0..task.operators.len() as u32).map(print).collect();
    prints.sort_unstable();
    let mut dropped = Vec::new();
    let mut different: Vec<u32> = Vec::new();
    for run in prints.chunk_by(|left, right| left >> 32 == right >> 32).filter(|run| run.len() > 1)
    {
        different.clear();
        for &print in run {
            let index = print as u32;
            match different.iter().find(|&&first| same(task, OperatorId(first), OperatorId(index)))
            {
                None => different.push(index),
                Some(&first) => {
                    dropped.push(index);
                    let cost = task.operators[index as usize].cost;
                    if cost < task.operators[first as usize].cost {
                        task.operators[first as usize].cost = cost;
                        origins[first as usize] = origins[index as usize];
                    }
                }
            }
        }
    }
    if dropped.is_empty() {
        return ends;
    }
    dropped.sort_unstable();
    close_gaps(task, origins, &dropped)
}

/// Moves operators, and what they own in the pools, to the places of those that are dropped.
fn close_gaps(task: &mut Task, origins: &mut Vec<u32>, dropped: &[u32]) -> Ends {
    let mut ends = Ends::default();
    let mut gone = dropped.iter().copied().peekable();
    let mut kept = 0;
    for index in 0..task.operators.len() {
        if gone.next_if_eq(&(index as u32)).is_some() {
            continue;
        }
        let mut operator = task.operators[index].clone();
        let start = ends.preconditions;
        for position in operator.precondition {
            task.precondition_pool[ends.preconditions] = task.precondition_pool[position as usize];
            ends.preconditions += 1;
        }
        operator.precondition = start as u32..ends.preconditions as u32;
        let start = ends.effects;
        for position in operator.effects {
            let Effect { conditions, fact } = task.effect_pool[position as usize].clone();
            let start = ends.conditions;
            for position in conditions {
                task.condition_pool[ends.conditions] = task.condition_pool[position as usize];
                ends.conditions += 1;
            }
            let conditions = start as u32..ends.conditions as u32;
            task.effect_pool[ends.effects] = Effect { conditions, fact };
            ends.effects += 1;
        }
        operator.effects = start as u32..ends.effects as u32;
        task.operators[kept] = operator;
        origins[kept] = origins[index];
        kept += 1;
    }
    task.operators.truncate(kept);
    origins.truncate(kept);
    ends
}

/// A hash of what an operator asks for and does: each fact is mixed in by a multiplication whose high half folds back.
fn fingerprint(task: &Task, operator: OperatorId) -> u64 {
    let mix = |hash: u64, fact: &Fact| {
        let word = u64::from(fact.variable.0) << 32 | u64::from(fact.value);
        let product = u128::from(hash ^ word) * 0x9e37_79b9_7f4a_7c15;
        (product as u64) ^ ((product >> 64) as u64)
    };
    let mut hash = task.precondition(operator).iter().fold(1, mix);
    for effect in task.effects(operator) {
        hash = task.conditions(&effect.conditions).iter().fold(mix(hash, &effect.fact), mix);
    }
    hash
}

/// Whether two operators are applicable in the same states and do the same.
fn same(task: &Task, left: OperatorId, right: OperatorId) -> bool {
    let (ours, theirs) = (task.effects(left), task.effects(right));
    let equal = |(a, b): (&Effect, &Effect)| {
        a.fact == b.fact && task.conditions(&a.conditions) == task.conditions(&b.conditions)
    };
    task.precondition(left) == task.precondition(right)
        && ours.len() == theirs.len()
        && ours.iter().zip(theirs).all(equal)
}
