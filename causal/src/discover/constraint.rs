//! PC in its stable form: arcs between variables that no others make independent; v-structures where the independence says so; and
//! Meek's rules (Spirtes et al. 2000; Colombo and Maathuis 2014).
//!
//! Of the sets that make two variables independent the one with the highest p-value counts (as in PC-Max; Ramsey 2016), and
//! v-structures that the data are surest of come first, so that contradictions are settled by evidence and not by the order of
//! variables.

use rustc_hash::FxHashMap;

use super::{Found, Job};
use crate::pattern::Pattern;
use crate::set::Set;
use crate::variable::VariableId;

/// What made two variables independent, and with which p-value.
pub type Separators = FxHashMap<(VariableId, VariableId), (Set, f64)>;

/// Learns a pattern.
pub fn pc(job: &Job) -> Found {
    let many = job.scorer.len();
    let mut adjacent: Vec<Set> = vec![Set::EMPTY; many];
    let ids: Vec<VariableId> = (0..many as u16).map(VariableId).collect();
    for (one, other) in pairs(many) {
        if job.rules.allows(one, other) || job.rules.allows(other, one) {
            link(&mut adjacent, one, other);
        }
    }
    let mut separators = Separators::default();
    let mut size = 0;
    while ids.iter().any(|id| adjacent[id.index()].len() > size) {
        // Within a level the neighbours are those of its beginning: that makes it stable.
        let before = adjacent.clone();
        let mut undecided: Vec<Pair> = pairs(many)
            .filter(|&(one, other)| {
                before[one.index()].contains(other) && !is_required(job, one, other)
            })
            .map(|(one, other)| Pair::new(one, other, &before, size))
            .collect();
        // Round by round each pair asks for one test, so that all of a round are made at once.
        let mut round = 0;
        while !undecided.is_empty() {
            undecided.retain(|pair| pair.sets.len() > round);
            let tests: Vec<_> =
                undecided.iter().map(|pair| (pair.one, pair.other, pair.sets[round])).collect();
            job.tester.prepare(&tests);
            undecided.retain(|pair| {
                let p = job.tester.test(pair.one, pair.other, pair.sets[round]).p;
                if p < job.alpha {
                    return true;
                }
                let rest: Vec<_> =
                    pair.sets[round..].iter().map(|&set| (pair.one, pair.other, set)).collect();
                job.tester.prepare(&rest);
                let mut best = (pair.sets[round], p);
                for &set in &pair.sets[round..] {
                    let p = job.tester.test(pair.one, pair.other, set).p;
                    if p > best.1 {
                        best = (set, p);
                    }
                }
                separators.insert((pair.one, pair.other), best);
                adjacent[pair.one.index()] = adjacent[pair.one.index()].without(pair.other);
                adjacent[pair.other.index()] = adjacent[pair.other.index()].without(pair.one);
                false
            });
            round += 1;
        }
        size += 1;
    }
    orient(job, &adjacent, &separators)
}

/// Two variables, and the sets that may make them independent.
struct Pair {
    one: VariableId,
    other: VariableId,
    sets: Vec<Set>,
}

impl Pair {
    fn new(one: VariableId, other: VariableId, adjacent: &[Set], size: usize) -> Self {
        let mut sets = adjacent[one.index()].without(other).subsets(size);
        sets.extend(adjacent[other.index()].without(one).subsets(size));
        sets.sort_unstable();
        sets.dedup();
        Self { one, other, sets }
    }
}

/// All pairs, the lower number first.
pub fn pairs(many: usize) -> impl Iterator<Item = (VariableId, VariableId)> {
    (0..many as u16).flat_map(move |one| {
        (one + 1..many as u16).map(move |other| (VariableId(one), VariableId(other)))
    })
}

pub fn is_required(job: &Job, one: VariableId, other: VariableId) -> bool {
    job.rules.required(one).contains(other) || job.rules.required(other).contains(one)
}

/// Makes two variables adjacent.
pub fn link(adjacent: &mut [Set], one: VariableId, other: VariableId) {
    adjacent[one.index()] = adjacent[one.index()].with(other);
    adjacent[other.index()] = adjacent[other.index()].with(one);
}

/// Gives directions: what knowledge says, v-structures, and what follows.
pub fn orient(job: &Job, adjacent: &[Set], separators: &Separators) -> Found {
    let many = adjacent.len();
    let mut pattern = Pattern::empty(many);
    for (one, other) in pairs(many).filter(|&(one, other)| adjacent[one.index()].contains(other)) {
        let may = |from, to| job.rules.allows(from, to);
        if job.rules.required(other).contains(one) || !may(other, one) {
            pattern.direct(one, other);
        } else if job.rules.required(one).contains(other) || !may(one, other) {
            pattern.direct(other, one);
        } else {
            pattern.join(one, other);
        }
    }
    let mut colliders: Vec<(f64, VariableId, VariableId, VariableId)> = Vec::new();
    for (one, other) in pairs(many) {
        let Some(&(set, p)) = separators.get(&(one, other)) else { continue };
        for middle in adjacent[one.index()].and(adjacent[other.index()]).minus(set).iter() {
            colliders.push((p, one, middle, other));
        }
    }
    colliders.sort_by(|one, two| {
        two.0.total_cmp(&one.0).then_with(|| (one.1, one.2, one.3).cmp(&(two.1, two.2, two.3)))
    });
    let mut against = 0;
    for (_, one, middle, other) in colliders {
        let free = |end: VariableId, pattern: &Pattern| {
            job.rules.allows(end, middle) && !pattern.parents(end).contains(middle)
        };
        let mut next = pattern.clone();
        next.direct(one, middle);
        next.direct(other, middle);
        if free(one, &pattern) && free(other, &pattern) && !has_cycle(&next) {
            pattern = next;
        } else {
            against += 1;
        }
    }
    pattern.close();
    let mut notes = Vec::new();
    if against > 0 {
        let they = if against == 1 {
            "1 v-structure".to_owned()
        } else {
            format!("{against} v-structures")
        };
        notes.push(format!("{they} that the tests found contradict others that they are surer of, and were left out"));
    }
    Found::Pattern(pattern, notes)
}

/// Whether the directed arcs come round.
fn has_cycle(pattern: &Pattern) -> bool {
    let parents = pattern.ids().map(|id| pattern.parents(id).list()).collect();
    crate::graph::Dag::new(parents).is_err()
}
