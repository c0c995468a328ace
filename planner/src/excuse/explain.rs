//! A changed initial state goes in from which few states are reached, none of them a goal; facts come out that explain it: as long as these have their values
//! initially, there is no plan, whatever else is changed.
//!
//! Every state that is reached fails to be a goal because of some literal, and every operator that does not apply there does not because of one.
//! Let the facts of one such literal each be tracked, and with a fact whatever decides conditional effects on it. Then what is reached, projected to the tracked
//! facts, is closed under the operators projected likewise: one that applied in the projection alone would have an explanation there. So the projection
//! has no plan. A derived fact is explained by the facts that decide it. Of several literals the one is taken whose fact explains most, as in greedy set covers.

use std::borrow::Cow;

use rustc_hash::{FxHashMap, FxHashSet};

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

/// Tracks what explains that there is no plan from `state`; false if there is one, or if that is more work than `budget`.
pub(super) fn explain(
    tracked: &mut Tracked<'_>,
    known: &Known,
    state: &[bool],
    budget: u64,
    limits: &Limits,
) -> bool {
    let open = tracked.open;
    // Every state is looked at three times, and getting ready is as much.
    let size = (open.grounded.effects.len() + open.grounded.literals.len()) as u64 / QUICK + 1;
    if size * 6 > budget {
        return false;
    }
    let usable = usable(open, state);
    let rules = Rules::new(open, state);
    let goal: Cow<'_, [Literal]> = open.demanded(&open.grounded.goal, &[]).collect();
    let most = (budget / size / 3) as usize;
    let Some(states) = reached(open, state, &usable, &rules, &goal, most, limits) else {
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
            // Derived facts whose value in this state is explained.
            let mut derived = FxHashSet::default();
            for literals in usable.iter().map(|one| &*one.precondition).chain([&*goal]) {
                let settled = |literal: &Literal, tracked: &Tracked<'_>| {
                    tracked.is[literal.fact.index()] || derived.contains(&literal.fact)
                };
                let mut failing = literals.iter().filter(|&&literal| !holds(state, literal));
                let Some(first) = failing.next() else { continue };
                let mut best = first.fact;
                let (mut done, mut alone) = (settled(first, tracked), true);
                for literal in failing {
                    alone = false;
                    done |= settled(literal, tracked);
                    // What no edit changes costs nothing.
                    let rank = |fact: FactId| {
                        let free = tracked.vocabulary.homes[fact.index()] == NONE
                            && !open.grounded.derived[fact.index()];
                        (free, explains[fact.index()], std::cmp::Reverse(fact))
                    };
                    if rank(literal.fact) > rank(best) {
                        best = literal.fact;
                    }
                }
                if !done && (alone || !lone) {
                    rules.track(best, state, tracked, known, &mut derived);
                }
            }
        }
    }
    true
}

/// The axioms whose objects exist in a state.
struct Rules<'a> {
    open: &'a Open,
    /// Heads and bodies, those of lower layers first.
    list: Vec<(FactId, Cow<'a, [Literal]>)>,
    /// Where each layer ends.
    ends: Vec<usize>,
    /// For each derived fact its rules.
    of: FxHashMap<FactId, Vec<usize>>,
}

impl<'a> Rules<'a> {
    fn new(open: &'a Open, state: &[bool]) -> Self {
        let grounded = &open.grounded;
        let exists = |&object: &u32| state[grounded.facts.len() + object as usize];
        let mut rules: Vec<(FactId, Cow<'a, [Literal]>)> = grounded
            .axioms
            .iter()
            .filter(|axiom| open.new_among(open.bound(&axiom.bound)).iter().all(exists))
            .map(|axiom| {
                let range = axiom.conditions.start as usize..axiom.conditions.end as usize;
                let body = open.demanded(&grounded.literals[range], open.bound(&axiom.bound));
                (axiom.head, body.collect())
            })
            .collect();
        // What is asked to be false has to be settled a layer before.
        let mut layers: FxHashMap<FactId, usize> = FxHashMap::default();
        loop {
            let mut changed = false;
            for (head, body) in &rules {
                let below = |literal: &Literal| {
                    let layer = layers.get(&literal.fact).copied().unwrap_or(0);
                    let derived = grounded.derived[literal.fact.index()];
                    layer + usize::from(derived && !literal.positive)
                };
                let layer = body.iter().map(below).max().unwrap_or(0);
                let own = layers.entry(*head).or_insert(0);
                changed |= layer > *own;
                *own = layer.max(*own);
            }
            if !changed {
                break;
            }
        }
        rules.sort_by_key(|(head, _)| layers[head]);
        let mut ends = Vec::new();
        let mut of: FxHashMap<FactId, Vec<usize>> = FxHashMap::default();
        for (number, (head, _)) in rules.iter().enumerate() {
            of.entry(*head).or_default().push(number);
            if rules.get(number + 1).is_none_or(|(next, _)| layers[next] != layers[head]) {
                ends.push(number + 1);
            }
        }
        Self { open, list: rules, ends, of }
    }

    /// Makes true in a state what follows.
    fn derive(&self, state: &mut State) {
        let mut start = 0;
        for &end in &self.ends {
            loop {
                let mut changed = false;
                for (head, body) in &self.list[start..end] {
                    let true_head = Literal { fact: *head, positive: true };
                    if !holds(state, true_head) && body.iter().all(|&one| holds(state, one)) {
                        state[head.index() / 64] |= 1 << (head.index() % 64);
                        changed = true;
                    }
                }
                if !changed {
                    break;
                }
            }
            start = end;
        }
    }

    /// Tracks what decides the value of a fact in a state: for a derived one that is true the facts of one derivation, for one that is false a false
    /// literal of each of its rules. Those that are false together may need one another; those that are true may not, so they go by when they were derived.
    fn track(
        &self,
        fact: FactId,
        state: &State,
        tracked: &mut Tracked<'_>,
        known: &Known,
        derived: &mut FxHashSet<FactId>,
    ) {
        let is_derived = |fact: FactId| self.open.grounded.derived[fact.index()];
        let mut order = None;
        let mut stack = vec![fact];
        while let Some(fact) = stack.pop() {
            if !is_derived(fact) {
                tracked.add(fact, &known.conditions);
                continue;
            }
            if !derived.insert(fact) {
                continue;
            }
            let rules = self.of.get(&fact).into_iter().flatten().map(|&rule| &self.list[rule].1);
            if holds(state, Literal { fact, positive: true }) {
                let order = order.get_or_insert_with(|| self.order(state));
                let rule = order.get(&fact).expect("what holds was derived");
                stack.extend(self.list[*rule].1.iter().map(|literal| literal.fact));
                continue;
            }
            for body in rules {
                let failing = || body.iter().filter(|&&literal| !holds(state, literal));
                let settled = failing().any(|literal| {
                    tracked.is[literal.fact.index()] || derived.contains(&literal.fact)
                });
                let simple = failing().find(|literal| !is_derived(literal.fact));
                if !settled {
                    let chosen = simple.or_else(|| failing().next());
                    stack.push(chosen.expect("a rule of a false fact fails").fact);
                }
            }
        }
    }

    /// For each derived fact that holds in a state the rule by which it does: one of facts that were derived before.
    fn order(&self, full: &State) -> FxHashMap<FactId, usize> {
        let mut first = FxHashMap::default();
        let holds_before = |literal: &Literal, first: &FxHashMap<FactId, usize>| {
            if literal.positive && self.open.grounded.derived[literal.fact.index()] {
                first.contains_key(&literal.fact)
            } else {
                holds(full, *literal)
            }
        };
        loop {
            let before = first.len();
            for (number, (head, body)) in self.list.iter().enumerate() {
                if !first.contains_key(head) && body.iter().all(|one| holds_before(one, &first)) {
                    first.insert(*head, number);
                }
            }
            if first.len() == before {
                return first;
            }
        }
    }
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
    rules: &Rules<'_>,
    goal: &[Literal],
    most: usize,
    limits: &Limits,
) -> Option<Vec<State>> {
    let grounded = &open.grounded;
    let mut first = vec![0_u64; grounded.facts.len().div_ceil(64)];
    let mut derived = first.clone();
    for fact in (0..grounded.facts.len()).filter(|&fact| grounded.derived[fact]) {
        derived[fact / 64] |= 1 << (fact % 64);
    }
    for fact in (0..grounded.facts.len()).filter(|&fact| initial[fact] && !grounded.derived[fact]) {
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
        rules.derive(&mut states[next]);
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
            for (word, derived) in after.iter_mut().zip(&derived) {
                *word &= !derived;
            }
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
