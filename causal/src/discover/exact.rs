//! The best graph of all: dynamic programming over sets of variables (Silander and Myllymäki 2006).
//!
//! Every graph has a variable that is nobody's parent. The best graph of a set of variables is the best graph of the set without some
//! variable, and that variable with its best parents in the set.

use rayon::prelude::*;

use super::Job;
use crate::graph::Dag;
use crate::set::Set;
use crate::variable::VariableId;

/// As many variables as there are bits in the sets that fit into memory.
pub const MOST: usize = 20;

/// As many families as are counted: about two seconds for ten thousand trials.
const FAMILIES: usize = 150_000;

/// As many parents as a variable can have among so many variables, if not too many families are to be counted.
pub fn parents(variables: usize) -> usize {
    let others = variables - 1;
    let (mut sets, mut of_size) = (1, 1_usize);
    for size in 1..=others {
        of_size = of_size * (others + 1 - size) / size;
        sets += of_size;
        if sets * variables > FAMILIES {
            return size - 1;
        }
    }
    others
}

/// The best parents of one variable within each set of the others.
struct Best {
    scores: Vec<f64>,
    parents: Vec<u32>,
}

/// Finds the graph with the highest score.
pub fn search(job: &Job) -> Dag {
    let many = job.scorer.len();
    let families = families(job, many);
    let all: Vec<(VariableId, Set)> = families.iter().flatten().copied().collect();
    job.scorer.prepare(&all);
    let scored: Vec<Vec<(u32, f64)>> = families
        .iter()
        .map(|family| {
            let score = |&(child, parents): &(VariableId, Set)| {
                (pressed(parents.0 as u32, child), job.scorer.local(child, parents))
            };
            family.iter().map(score).collect()
        })
        .collect();
    let best: Vec<Best> = scored.par_iter().map(|scored| spread(many - 1, scored)).collect();
    // The last variable of the best graph of each set.
    let sets = 1_usize << many;
    let mut scores = vec![f64::NEG_INFINITY; sets];
    let mut last = vec![0_u8; sets];
    scores[0] = 0.0;
    for set in 1..sets {
        let mut rest = set;
        while rest != 0 {
            let at = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let others = set & !(1 << at);
            let within = pressed(others as u32, VariableId(at as u16)) as usize;
            let score = scores[others] + best[at].scores[within];
            if score > scores[set] {
                (scores[set], last[set]) = (score, at as u8);
            }
        }
    }
    let mut parents = vec![Vec::new(); many];
    let mut set = sets - 1;
    while set != 0 {
        let at = usize::from(last[set]);
        set &= !(1 << at);
        let id = VariableId(at as u16);
        let chosen = best[at].parents[pressed(set as u32, id) as usize];
        parents[at] = Set(u128::from(unpressed(chosen, id))).list();
    }
    Dag::new(parents).expect("each variable has its parents among those before it")
}

/// The families of each variable that knowledge and the number of parents allow.
fn families(job: &Job, many: usize) -> Vec<Vec<(VariableId, Set)>> {
    (0..many as u16)
        .map(|child| {
            let child = VariableId(child);
            let required = job.rules.required(child);
            let free = job.rules.allowed(child).minus(required);
            (0..=job.max_parents - required.len())
                .flat_map(|size| free.subsets(size))
                .map(|set| (child, set.union(required)))
                .collect()
        })
        .collect()
}

/// The best family within each set of other variables, from the scores of families.
fn spread(others: usize, scored: &[(u32, f64)]) -> Best {
    let sets = 1_usize << others;
    let mut best = Best { scores: vec![f64::NEG_INFINITY; sets], parents: vec![0; sets] };
    for &(parents, score) in scored {
        (best.scores[parents as usize], best.parents[parents as usize]) = (score, parents);
    }
    for set in 1..sets {
        let mut rest = set;
        while rest != 0 {
            let without = set & !(rest & rest.wrapping_neg());
            rest &= rest - 1;
            if best.scores[without] >= best.scores[set] {
                best.scores[set] = best.scores[without];
                best.parents[set] = best.parents[without];
            }
        }
    }
    best
}

/// A set of the other variables without the place of this one.
fn pressed(set: u32, without: VariableId) -> u32 {
    let low = (1 << without.0) - 1;
    set & low | set >> 1 & !low
}

/// The inverse.
fn unpressed(set: u32, without: VariableId) -> u32 {
    let low = (1 << without.0) - 1;
    set & low | (set & !low) << 1
}
