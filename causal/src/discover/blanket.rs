//! Markov blankets: what makes a variable independent of all others. Grow-Shrink (Margaritis 2003), IAMB (Tsamardinos et al. 2003),
//! and the parents and children of max-min hill climbing (Tsamardinos et al. 2006).

use super::climb::Candidates;
use super::constraint::{Separators, is_required, link, orient, pairs};
use super::{Found, Job};
use crate::independence::Verdict;
use crate::set::Set;
use crate::variable::VariableId;

/// Conditions are sought among sets up to this size.
const MOST_GIVEN: usize = 4;

/// Learns a pattern from blankets that grow by the first variable that is dependent, in the order of how strongly it is so alone.
pub fn grow_shrink(job: &Job) -> Found {
    from_blankets(job, |id| {
        let others = ranked(job, id, Set::first(job.scorer.len()).without(id), Set::EMPTY);
        let mut blanket = Set::EMPTY;
        while let Some(next) = others.iter().copied().find(|&other| {
            !blanket.contains(other) && job.tester.test(id, other, blanket).p < job.alpha
        }) {
            blanket = blanket.with(next);
        }
        shrink(job, id, blanket)
    })
}

/// Learns a pattern from blankets that grow by whatever is most dependent given the blanket so far.
pub fn iamb(job: &Job) -> Found {
    from_blankets(job, |id| {
        let mut blanket = Set::EMPTY;
        loop {
            let others = Set::first(job.scorer.len()).without(id).minus(blanket);
            let Some(&next) = ranked(job, id, others, blanket).first() else { break };
            if job.tester.test(id, next, blanket).p >= job.alpha {
                break;
            }
            blanket = blanket.with(next);
        }
        shrink(job, id, blanket)
    })
}

/// Variables by how surely they depend on one, given a set.
fn ranked(job: &Job, id: VariableId, others: Set, given: Set) -> Vec<VariableId> {
    let tests: Vec<_> = others.iter().map(|other| (id, other, given)).collect();
    job.tester.prepare(&tests);
    let mut others: Vec<(Verdict, VariableId)> =
        others.iter().map(|other| (job.tester.test(id, other, given), other)).collect();
    others.sort_by(|(one, a), (two, b)| by_dependence(one, two).then_with(|| a.cmp(b)));
    others.into_iter().map(|(_, other)| other).collect()
}

/// The surer dependence first: by p-value, and where both are as good as zero by strength for each degree of freedom.
fn by_dependence(one: &Verdict, other: &Verdict) -> std::cmp::Ordering {
    let strength = |verdict: &Verdict| verdict.strength / verdict.freedom.max(1) as f64;
    one.p.total_cmp(&other.p).then_with(|| strength(other).total_cmp(&strength(one)))
}

/// Takes away what is independent given the rest.
fn shrink(job: &Job, id: VariableId, mut blanket: Set) -> Set {
    while let Some(needless) = blanket
        .iter()
        .find(|&other| job.tester.test(id, other, blanket.without(other)).p >= job.alpha)
    {
        blanket = blanket.without(needless);
    }
    blanket
}

/// From the blanket of each variable to arcs: those whose ends no part of the smaller blanket makes independent.
fn from_blankets(job: &Job, blanket: impl Fn(VariableId) -> Set) -> Found {
    let many = job.scorer.len();
    let blankets: Vec<Set> = (0..many as u16).map(|id| blanket(VariableId(id))).collect();
    let mut adjacent = vec![Set::EMPTY; many];
    let mut separators = Separators::default();
    for (one, other) in pairs(many) {
        let may = job.rules.allows(one, other) || job.rules.allows(other, one);
        if is_required(job, one, other) {
            link(&mut adjacent, one, other);
            continue;
        }
        if !may {
            continue;
        }
        let (mine, theirs) = (blankets[one.index()], blankets[other.index()]);
        if !mine.contains(other) || !theirs.contains(one) {
            // What is outside a blanket is independent given it.
            let smaller =
                [mine.without(other), theirs.without(one)].into_iter().min_by_key(|set| set.len());
            let set = smaller.expect("there are two");
            separators.insert((one, other), (set, job.tester.test(one, other, set).p));
            continue;
        }
        let smaller =
            if mine.len() <= theirs.len() { mine.without(other) } else { theirs.without(one) };
        match separator(job, one, other, smaller) {
            None => link(&mut adjacent, one, other),
            Some(found) => {
                separators.insert((one, other), found);
            }
        }
    }
    orient(job, &adjacent, &separators)
}

/// The part of a set that makes two variables independent with the highest p-value, of the smallest size that does.
fn separator(job: &Job, one: VariableId, other: VariableId, among: Set) -> Option<(Set, f64)> {
    for size in 0..=among.len().min(MOST_GIVEN) {
        let sets = among.subsets(size);
        let tests: Vec<_> = sets.iter().map(|&set| (one, other, set)).collect();
        job.tester.prepare(&tests);
        let found = sets
            .into_iter()
            .map(|set| (set, job.tester.test(one, other, set).p))
            .filter(|&(_, p)| p >= job.alpha)
            .reduce(|best, next| if next.1 > best.1 { next } else { best });
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Max-min parents and children: for each variable those that nothing makes independent of it; each of both ends must say so.
pub fn max_min(job: &Job) -> Candidates {
    let many = job.scorer.len();
    let found: Vec<Set> =
        (0..many as u16).map(|id| parents_and_children(job, VariableId(id))).collect();
    let candidates = (0..many as u16).map(|id| {
        let id = VariableId(id);
        let both: Set =
            found[id.index()].iter().filter(|other| found[other.index()].contains(id)).collect();
        both.union(job.rules.required(id)).and(job.rules.allowed(id))
    });
    Candidates(candidates.collect())
}

fn parents_and_children(job: &Job, id: VariableId) -> Set {
    let mut chosen = Set::EMPTY;
    // The weakest that each other variable's dependence was seen to be.
    let mut open: Vec<(VariableId, Verdict)> = Set::first(job.scorer.len())
        .without(id)
        .iter()
        .map(|other| (other, job.tester.test(id, other, Set::EMPTY)))
        .collect();
    loop {
        open.retain(|(_, verdict)| verdict.p < job.alpha);
        open.sort_by(|(a, one), (b, two)| by_dependence(one, two).then_with(|| a.cmp(b)));
        if open.is_empty() {
            break;
        }
        let (next, _) = open.remove(0);
        // The new sets of conditions are those with the variable that came last.
        let before = chosen;
        chosen = chosen.with(next);
        for size in 0..=before.len().min(MOST_GIVEN - 1) {
            for set in before.subsets(size) {
                let given = set.with(next);
                let tests: Vec<_> = open.iter().map(|&(other, _)| (id, other, given)).collect();
                job.tester.prepare(&tests);
                for (other, weakest) in &mut open {
                    let verdict = job.tester.test(id, *other, given);
                    if by_dependence(weakest, &verdict).is_lt() {
                        *weakest = verdict;
                    }
                }
                open.retain(|(_, verdict)| verdict.p < job.alpha);
            }
        }
    }
    chosen
        .iter()
        .filter(|&other| separator(job, id, other, chosen.without(other)).is_none())
        .collect()
}
