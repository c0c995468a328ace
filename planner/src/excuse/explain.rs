//! A changed initial state goes in from which few states are reached, none of them a goal; facts come out that explain it: as long as these have their values
//! initially, there is no plan, whatever else is changed.
//!
//! Every state that is reached fails to be a goal because of some literal, and every operator that does not apply there does not because of one.
//! Let the facts of one such literal each be tracked, and with a fact whatever decides conditional effects on it. Then what is reached, projected to the tracked
//! facts, is closed under the operators projected likewise: one that applied in the projection alone would have an explanation there. So the projection
//! has no plan. Of several literals the one is taken whose fact explains most, as in greedy set covers.

use std::borrow::Cow;

use rustc_hash::FxHashSet;

use super::open::Open;
use super::project::{Known, Tracked};
use super::vocabulary::NONE;
use crate::grounded::{FactId, Literal};
use crate::limits::Limits;

/// An operator whose objects exist, by number, and what it needs.
struct Usable<'a> {
    operator: u32,
    precondition: Cow<'a, [Literal]>,
}

/// One bit for each fact.
type State = Box<[u64]>;

fn holds(state: &State, literal: Literal) -> bool {
    let fact = literal.fact.index();
    (state[fact / 64] >> (fact % 64) & 1 == 1) == literal.positive
}

/// So many literals are looked at in the time that other work takes for one.
const QUICK: u64 = 16;

/// Tracks what explains that there is no plan from `state`; false if there is one, or if that is more work than `budget`, or there are axioms.
pub(super) fn explain(
    tracked: &mut Tracked<'_>,
    known: &Known,
    state: &[bool],
    budget: u64,
    limits: &Limits,
) -> bool {
    let open = tracked.open;
    if !open.grounded.axioms.is_empty() {
        return false;
    }
    let size = (open.grounded.effects.len() + open.grounded.literals.len()) as u64;
    // Every state is looked at three times, and getting ready is as much.
    let size = size / QUICK + 1;
    if size * 6 > budget {
        return false;
    }
    let usable = usable(open, state);
    let goal: Cow<'_, [Literal]> = open.demanded(&open.grounded.goal, &[]).collect();
    let most = (budget / size / 3) as usize;
    let Some(states) = reached(open, state, &usable, &goal, most, limits) else {
        return false;
    };
    let mut explains = vec![0_u32; open.count()];
    for state in &states {
        for literals in usable.iter().map(|one| &*one.precondition).chain([&*goal]) {
            for literal in literals.iter().filter(|&&literal| !holds(state, literal)) {
                explains[literal.fact.index()] += 1;
            }
        }
    }
    for lone in [true, false] {
        for state in &states {
            for literals in usable.iter().map(|one| &*one.precondition).chain([&*goal]) {
                let mut failing = literals.iter().filter(|&&literal| !holds(state, literal));
                let Some(first) = failing.next() else { continue };
                let mut best = first.fact;
                let (mut settled, mut alone) = (tracked.is[best.index()], true);
                for literal in failing {
                    alone = false;
                    settled |= tracked.is[literal.fact.index()];
                    // What no edit changes costs nothing.
                    let rank = |fact: FactId| {
                        let home = tracked.vocabulary.homes[fact.index()];
                        (home == NONE, explains[fact.index()], std::cmp::Reverse(fact))
                    };
                    if rank(literal.fact) > rank(best) {
                        best = literal.fact;
                    }
                }
                if !settled && (alone || !lone) {
                    tracked.add(best, &known.conditions);
                }
            }
        }
    }
    true
}

/// The operators whose objects exist in a state, without what conditions say of objects that do not.
fn usable<'a>(open: &'a Open, state: &[bool]) -> Vec<Usable<'a>> {
    let grounded = &open.grounded;
    let exists = |&object: &u32| state[grounded.facts.len() + object as usize];
    let mut usable = Vec::with_capacity(grounded.operators.len());
    for (number, operator) in grounded.operators.iter().enumerate() {
        let range = operator.precondition.start as usize..operator.precondition.end as usize;
        let precondition = &grounded.literals[range];
        let own = open.bound(&operator.bound);
        let precondition = if open.objects.is_empty() {
            Cow::Borrowed(precondition)
        } else if open.new_among(own).iter().all(exists) {
            open.demanded(precondition, own).collect()
        } else {
            continue;
        };
        usable.push(Usable { operator: number as u32, precondition });
    }
    usable
}

/// All states that are reached, unless they are more than `most` or one is a goal.
fn reached(
    open: &Open,
    initial: &[bool],
    usable: &[Usable<'_>],
    goal: &[Literal],
    most: usize,
    limits: &Limits,
) -> Option<Vec<State>> {
    let grounded = &open.grounded;
    let mut first = vec![0_u64; open.grounded.facts.len().div_ceil(64)];
    for fact in (0..open.grounded.facts.len()).filter(|&fact| initial[fact]) {
        first[fact / 64] |= 1 << (fact % 64);
    }
    let first = first.into_boxed_slice();
    let mut seen = FxHashSet::from_iter([first.clone()]);
    let mut states = vec![first];
    let mut next = 0;
    while next < states.len() {
        if states.len() > most || limits.stopped().is_some() {
            return None;
        }
        let state = states[next].clone();
        next += 1;
        if goal.iter().all(|&literal| holds(&state, literal)) {
            return None;
        }
        for one in usable {
            if !one.precondition.iter().all(|&literal| holds(&state, literal)) {
                continue;
            }
            let operator = &grounded.operators[one.operator as usize];
            let own = open.bound(&operator.bound);
            let effects =
                &grounded.effects[operator.effects.start as usize..operator.effects.end as usize];
            let mut after = state.clone();
            for positive in [false, true] {
                for effect in effects.iter().filter(|effect| effect.literal.positive == positive) {
                    let fact = effect.literal.fact.index();
                    let range = effect.conditions.start as usize..effect.conditions.end as usize;
                    let mut conditions = open.demanded(&grounded.literals[range], own);
                    if conditions.all(|literal| holds(&state, literal)) {
                        let bit = 1 << (fact % 64);
                        let word = &mut after[fact / 64];
                        *word = if positive { *word | bit } else { *word & !bit };
                    }
                }
            }
            if !seen.contains(&after) {
                seen.insert(after.clone());
                states.push(after);
            }
        }
    }
    Some(states)
}
