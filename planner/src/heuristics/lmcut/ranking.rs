//! Sample states go in; LM-cut leaves with the order of ties that gives them the largest estimates.
//!
//! Where several needs of a rule cost the same, any of them may be its supporter. Which one it is decides how small the cuts are: estimates of one state
//! differ by a factor of two, and no fixed order is best in all domains. So each of a few orders is tried on samples.

use super::LmCut;
use crate::heuristics::{DEAD_END, Heuristic};

/// How much trying may cost: rules times rounds, about a nanosecond each.
const MOST_WORK: u64 = 400_000_000;

/// What the facts are ordered by; each up and down.
const KEYS: [fn(&LmCut, u32) -> u32; 4] = [
    |_, fact| fact,
    |lmcut, fact| lmcut.graph.achievers.get(fact).len() as u32,
    |lmcut, fact| lmcut.graph.users.get(fact).len() as u32,
    |lmcut, fact| lmcut.facts[fact as usize],
];

/// Tries the orders, and leaves the best, the first of equals.
pub(super) fn choose(lmcut: &mut LmCut, samples: &[Vec<u32>]) {
    let Some(first) = samples.first() else { return };
    // Fills in hmax, by which one of the orders goes.
    lmcut.left.copy_from_slice(&lmcut.graph.costs);
    lmcut.explore(first);
    let rankings: Vec<Vec<u32>> = KEYS
        .iter()
        .flat_map(|key| {
            let up: Vec<u32> = (0..lmcut.graph.facts as u32).map(|fact| key(lmcut, fact)).collect();
            let down = up.iter().map(|&rank| u32::MAX - rank).collect();
            [up, down]
        })
        .collect();
    let mut sums = vec![0_u64; rankings.len()];
    let mut work = 0;
    for sample in samples {
        let mut row = Vec::with_capacity(rankings.len());
        for ranking in &rankings {
            let before = lmcut.rounds;
            lmcut.graph.rank(ranking);
            let estimate = lmcut.evaluate(sample);
            row.push(if estimate == DEAD_END { 0 } else { u64::from(estimate) });
            work += (lmcut.rounds - before + 2) * lmcut.graph.costs.len() as u64;
            if work > MOST_WORK {
                break;
            }
        }
        // A row that was broken off says nothing.
        if row.len() < rankings.len() {
            break;
        }
        for (sum, estimate) in sums.iter_mut().zip(row) {
            *sum += estimate;
        }
    }
    let best = (0..rankings.len())
        .max_by_key(|&ranking| (sums[ranking], rankings.len() - ranking))
        .unwrap_or(0);
    lmcut.graph.rank(&rankings[best]);
}
