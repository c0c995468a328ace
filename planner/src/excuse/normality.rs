//! An open problem goes in; for each edit comes out how odd the initial state would look after it, judged by what most of that state looks like.
//!
//! Of edits that cost the same, those are tried first that mend the pattern: where each cube but one has a place, the one that has none gets one before
//! another gets a second. It only orders what is tried; nothing is left out for it.

use std::collections::BTreeMap;

use lang::model::{Domain, PredicateId, TypeId};

use super::open::Open;
use super::vocabulary::{NONE, Vocabulary, by_predicate, gather};
use crate::grounded::FactId;

/// How odd an edit is.
#[derive(Debug, Clone, Copy)]
pub struct Oddness {
    /// More where it makes two of what there is one of elsewhere.
    more: i32,
    /// The gap that it fills, if any.
    gap: u32,
}

/// How odd each edit is.
pub(super) fn oddness(open: &Open, domain: &Domain, vocabulary: &Vocabulary) -> Vec<Oddness> {
    let mut odd = vec![Oddness { more: 0, gap: NONE }; vocabulary.edits.len()];
    let facts = by_predicate(open);
    let holds = |fact: &FactId| open.initial[fact.index()];
    let usual = usual_counts(open, domain, &facts);
    let mut gaps = 0;
    for (&predicate, facts) in &facts {
        if let Some(&usual) = usual.get(&predicate) {
            judge(vocabulary, facts, usual, &holds, &mut gaps, &mut odd);
        }
        let arity = facts.first().map_or(0, |&fact| open.arguments(fact).len());
        for counted in 0..arity {
            let groups = gather(facts.iter().map(|&fact| {
                let mut key = open.arguments(fact).to_vec();
                key.remove(counted);
                (key, fact)
            }));
            let counts = groups.iter().map(|group| group.iter().filter(|one| holds(one)).count());
            let ones = counts.filter(|&count| count == 1).count();
            if groups.len() > 2 && ones * 3 >= groups.len() * 2 {
                for group in &groups {
                    judge(vocabulary, group, 1, &holds, &mut gaps, &mut odd);
                }
            }
        }
    }
    odd
}

/// How odd some edits are together: less for each gap that they fill, more for each that they fill again.
pub(super) fn of(oddness: &[Oddness], edits: &[u32]) -> i32 {
    let mut sum = 0;
    for (at, &edit) in edits.iter().enumerate() {
        let Oddness { more, gap } = oddness[edit as usize];
        sum += more;
        if gap != NONE {
            let filled = edits[..at].iter().any(|&other| oddness[other as usize].gap == gap);
            sum += if filled { 1 } else { -1 };
        }
    }
    sum
}

/// How many facts hold of a predicate, where most predicates with the same parameters have as many.
fn usual_counts(
    open: &Open,
    domain: &Domain,
    facts: &BTreeMap<PredicateId, Vec<FactId>>,
) -> BTreeMap<PredicateId, usize> {
    let mut alike: BTreeMap<Vec<&[TypeId]>, Vec<(PredicateId, usize)>> = BTreeMap::new();
    for (&predicate, facts) in facts {
        let Some(declaration) = domain.predicates.get(predicate.index()) else { continue };
        let types = declaration.parameters.iter().map(|one| one.types.as_slice()).collect();
        let count = facts.iter().filter(|fact| open.initial[fact.index()]).count();
        alike.entry(types).or_default().push((predicate, count));
    }
    let mut usual = BTreeMap::new();
    for (types, predicates) in alike {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for &(_, count) in &predicates {
            *counts.entry(count).or_default() += 1;
        }
        let (count, times) = counts.into_iter().max_by_key(|one| one.1).unwrap_or((0, 0));
        if !types.is_empty() && count > 0 && predicates.len() > 2 && times * 2 > predicates.len() {
            usual.extend(predicates.into_iter().map(|(predicate, _)| (predicate, count)));
        }
    }
    usual
}

/// Judges the edits that make facts of a group true, of which `usual` hold elsewhere.
fn judge(
    vocabulary: &Vocabulary,
    group: &[FactId],
    usual: usize,
    holds: &dyn Fn(&FactId) -> bool,
    gaps: &mut u32,
    odd: &mut [Oddness],
) {
    let holding = group.iter().filter(|fact| holds(fact)).count();
    *gaps += 1;
    for fact in group {
        let maker = vocabulary.makers[fact.index()];
        let Some(edit) = vocabulary.edits.get(maker as usize) else { continue };
        let leaves = edit.from.is_some_and(|from| group.contains(&from));
        let one = &mut odd[maker as usize];
        if holding < usual {
            one.gap = *gaps;
        } else if holding + 1 - usize::from(leaves) > usual {
            one.more += 1;
        }
    }
}
