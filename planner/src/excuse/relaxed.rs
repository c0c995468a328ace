//! Delete relaxation over literals, forwards and backwards: an initial state goes in; whether the goal is in reach when nothing is ever lost comes out, and
//! if not, what of the initial state would have to be different (cores).
//!
//! A fact and its negation are two literals, of which each stays once it is reached. The negation of a derived fact counts as reached.

use super::open::Open;
use crate::grounded::{FactId, Literal};
use crate::limits::{Limits, Stop};

/// A literal as a number: twice the fact, and one more for its negation.
pub fn number(fact: FactId, positive: bool) -> u32 {
    fact.0 * 2 + u32::from(!positive)
}

/// A list of lists.
#[derive(Debug, Default)]
pub struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// No lists yet.
    pub fn begin() -> Self {
        Self { starts: vec![0], items: Vec::new() }
    }

    /// Adds a list; its items come out sorted, each once.
    pub fn push(&mut self, list: &mut Vec<u32>) {
        list.sort_unstable();
        list.dedup();
        self.items.extend_from_slice(list);
        self.starts.push(self.items.len() as u32);
    }

    fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// For each of `count` items the lists that it is in.
    pub fn turned(&self, count: usize) -> Self {
        let mut starts = vec![0_u32; count + 1];
        for &item in &self.items {
            starts[item as usize + 1] += 1;
        }
        for item in 0..count {
            starts[item + 1] += starts[item];
        }
        let mut next = starts.clone();
        let mut items = vec![0; self.items.len()];
        for list in 0..self.len() as u32 {
            for &item in self.of(list) {
                items[next[item as usize] as usize] = list;
                next[item as usize] += 1;
            }
        }
        Self { starts, items }
    }

    /// The items of a list.
    #[inline]
    pub fn of(&self, key: u32) -> &[u32] {
        &self.items[self.starts[key as usize] as usize..self.starts[key as usize + 1] as usize]
    }
}

/// A relaxed problem, and what is reached in it so far.
#[derive(Debug)]
pub struct Relaxed {
    /// For each rule what it needs and adds.
    needs: Lists,
    adds: Lists,
    /// For each literal the rules that need and add it.
    needed_by: Lists,
    added_by: Lists,
    goal: Vec<u32>,
    is_goal: Vec<bool>,
    reached: Vec<bool>,
    missing: Vec<u32>,
    goals_missing: u32,
    /// What is reached, in this order; the rules of the first `done` are triggered.
    trail: Vec<u32>,
    done: usize,
    /// How many needs of rules were looked at so far.
    work: u64,
}

/// How many operators are looked at between two looks at the limits.
const RULES_PER_POLL: usize = 1 << 12;

/// The work after which a core is left as large as it is.
const EFFORT: u64 = 20_000_000;

/// Into how many parts a core is divided first.
const PARTS: usize = 32;

impl Relaxed {
    /// The relaxation of an open problem; nothing is reached yet. An operator with effects under several conditions is one rule for the literal that says
    /// that it applies, behind all others, and one rule for each condition.
    ///
    /// # Errors
    /// Why it was stopped, if it was.
    pub fn new(open: &Open, limits: &Limits) -> Result<Self, Stop> {
        let grounded = &open.grounded;
        let facts = grounded.facts.len() as u32;
        let slice = |range: &std::ops::Range<u32>| {
            &grounded.literals[range.start as usize..range.end as usize]
        };
        let literal = |literal: Literal| {
            let free = !literal.positive && grounded.derived[literal.fact.index()];
            (!free).then(|| number(literal.fact, literal.positive))
        };
        let (mut needs, mut adds) = (Lists::begin(), Lists::begin());
        let mut literals = open.count() * 2;
        let (mut base, mut added) = (Vec::new(), Vec::new());
        for (number_of_operator, operator) in grounded.operators.iter().enumerate() {
            if number_of_operator.is_multiple_of(RULES_PER_POLL)
                && let Some(stop) = limits.stopped()
            {
                return Err(stop);
            }
            let own = open.bound(&operator.bound);
            base.clear();
            base.extend(open.demanded(slice(&operator.precondition), own).filter_map(literal));
            base.extend(
                open.new_among(own).iter().map(|&object| number(FactId(facts + object), true)),
            );
            let mut effects: Vec<&crate::grounded::Effect> = grounded.effects
                [operator.effects.start as usize..operator.effects.end as usize]
                .iter()
                .collect();
            effects.sort_by_key(|effect| (effect.conditions.start, effect.conditions.end));
            let same = |left: &&crate::grounded::Effect, right: &&crate::grounded::Effect| {
                slice(&left.conditions) == slice(&right.conditions)
            };
            let several = effects.chunk_by(same).nth(1).is_some();
            if several {
                needs.push(&mut base);
                adds.push(&mut vec![literals as u32]);
                base.clear();
                base.push(literals as u32);
                literals += 1;
            }
            for group in effects.chunk_by(same) {
                let mut asked = base.clone();
                asked.extend(open.demanded(slice(&group[0].conditions), own).filter_map(literal));
                needs.push(&mut asked);
                added.clear();
                added.extend(
                    group.iter().map(|effect| number(effect.literal.fact, effect.literal.positive)),
                );
                adds.push(&mut added);
            }
        }
        for axiom in &grounded.axioms {
            let own = open.bound(&axiom.bound);
            base.clear();
            base.extend(open.demanded(slice(&axiom.conditions), own).filter_map(literal));
            base.extend(
                open.new_among(own).iter().map(|&object| number(FactId(facts + object), true)),
            );
            needs.push(&mut base);
            adds.push(&mut vec![number(axiom.head, true)]);
        }
        if let Some(stop) = limits.stopped() {
            return Err(stop);
        }
        let rules = needs.len() as u32;
        let goal: Vec<u32> = open.demanded(&grounded.goal, &[]).filter_map(literal).collect();
        let mut is_goal = vec![false; literals];
        for &goal in &goal {
            is_goal[goal as usize] = true;
        }
        let mut relaxed = Self {
            missing: (0..rules).map(|rule| needs.of(rule).len() as u32).collect(),
            needed_by: needs.turned(literals),
            added_by: adds.turned(literals),
            adds,
            needs,
            goals_missing: is_goal.iter().filter(|&&goal| goal).count() as u32,
            goal,
            is_goal,
            reached: vec![false; literals],
            trail: Vec::new(),
            done: 0,
            work: 0,
        };
        for rule in 0..rules {
            if relaxed.missing[rule as usize] == 0 {
                relaxed.fire(rule);
            }
        }
        relaxed.run();
        Ok(relaxed)
    }

    fn fire(&mut self, rule: u32) {
        let range = self.adds.starts[rule as usize]..self.adds.starts[rule as usize + 1];
        for at in range {
            self.push(self.adds.items[at as usize]);
        }
    }

    fn push(&mut self, literal: u32) {
        if !std::mem::replace(&mut self.reached[literal as usize], true) {
            self.goals_missing -= u32::from(self.is_goal[literal as usize]);
            self.trail.push(literal);
        }
    }

    fn run(&mut self) {
        while self.done < self.trail.len() {
            let literal = self.trail[self.done];
            self.done += 1;
            let range = self.needed_by.starts[literal as usize] as usize
                ..self.needed_by.starts[literal as usize + 1] as usize;
            self.work += range.len() as u64 + 1;
            for at in range {
                let rule = self.needed_by.items[at];
                self.missing[rule as usize] -= 1;
                if self.missing[rule as usize] == 0 {
                    self.fire(rule);
                }
            }
        }
    }

    /// Whether the goal is reached.
    pub fn solved(&self) -> bool {
        self.goals_missing == 0
    }

    /// Whether a literal is reached.
    pub fn has(&self, literal: u32) -> bool {
        self.reached[literal as usize]
    }

    /// Adds literals and what follows; the result undoes it.
    pub fn add(&mut self, literals: impl IntoIterator<Item = u32>) -> usize {
        let mark = self.trail.len();
        for literal in literals {
            self.push(literal);
        }
        self.run();
        mark
    }

    /// Takes back what was reached since `mark`.
    pub fn undo(&mut self, mark: usize) {
        for literal in self.trail.drain(mark..) {
            self.reached[literal as usize] = false;
            self.goals_missing += u32::from(self.is_goal[literal as usize]);
            for &rule in self.needed_by.of(literal) {
                self.missing[rule as usize] += 1;
            }
        }
        self.done = mark;
    }

    /// Literals of which at least one must be reached before the goal can be, none of them reached: those of `wanted` among what leads to one chosen
    /// unreached need of every rule, backwards from the goal (as the cuts of LM-cut are found, Helmert and Domshlak, ICAPS 2009).
    fn zone(&self, wanted: &[bool]) -> Vec<u32> {
        let mut inside = vec![false; self.reached.len()];
        let mut core = Vec::new();
        let mut stack = Vec::new();
        // What may be changed makes a core larger, and so does what many rules add.
        let is_wanted = |literal: u32| wanted.get(literal as usize) == Some(&true);
        let price = |&literal: &u32| {
            let ways = self.added_by.of(literal).len() as u32;
            (u32::from(is_wanted(literal)) + ways, literal)
        };
        let unreached = |literal: &u32| !self.reached[*literal as usize];
        let first = self.goal.iter().copied().filter(unreached).min_by_key(price);
        stack.extend(first);
        for &literal in &stack {
            inside[literal as usize] = true;
        }
        while let Some(literal) = stack.pop() {
            if is_wanted(literal) {
                core.push(literal);
            }
            for &rule in self.added_by.of(literal) {
                let needs = self.needs.of(rule);
                if needs.iter().any(|&need| inside[need as usize]) {
                    continue;
                }
                let need = needs.iter().copied().filter(unreached).min_by_key(price);
                let need = need.expect("a rule whose needs are all reached has fired");
                inside[need as usize] = true;
                stack.push(need);
            }
        }
        core
    }

    /// Cores of the state whose literals are added already: sets of `wanted` literals of which any state that has a plan has at least one. All are
    /// minimal as long as `effort` lasts, and none shares a literal with another. An empty core says that nothing helps. What is reached is left as it was.
    ///
    /// # Errors
    /// Why it was stopped, if it was.
    pub fn cores(
        &mut self,
        wanted: &[bool],
        all: &[u32],
        limits: &Limits,
    ) -> Result<Vec<Vec<u32>>, Stop> {
        let start = self.trail.len();
        let mut cores = Vec::new();
        while !self.solved() {
            let zone = self.zone(wanted);
            let core = self.minimal(&zone, all, limits)?;
            let hopeless = core.is_empty();
            self.add(core.iter().copied());
            cores.push(core);
            if hopeless {
                break;
            }
        }
        self.undo(start);
        Ok(cores)
    }

    /// Sorts a core, none of whose literals is reached, so that what leads to most of the others comes first: causes before what they cause.
    pub fn causes_first(&mut self, core: &mut [u32]) {
        let mut rank = |&literal: &u32, core: &[u32]| {
            let mark = self.add([literal]);
            let count = core.iter().filter(|&&other| self.has(other)).count();
            self.undo(mark);
            count
        };
        let mut ranked: Vec<(usize, u32)> =
            core.iter().map(|literal| (rank(literal, core), *literal)).collect();
        ranked.sort_by_key(|&(count, literal)| (std::cmp::Reverse(count), literal));
        for (place, (_, literal)) in core.iter_mut().zip(ranked) {
            *place = literal;
        }
    }

    /// A subset of a core that is one, too, and of which no literal can be left out, unless that is too much work: parts of it are left out at once as
    /// long as that works, then halves of these.
    fn minimal(&mut self, core: &[u32], all: &[u32], limits: &Limits) -> Result<Vec<u32>, Stop> {
        let mut inside = vec![false; self.reached.len()];
        for &literal in core {
            inside[literal as usize] = true;
        }
        let start = self.add(all.iter().copied().filter(|&literal| !inside[literal as usize]));
        let most = self.work.saturating_add(EFFORT);
        let mut kept = Vec::new();
        let size = (core.len() / PARTS).max(1);
        let mut parts: Vec<&[u32]> = core.chunks(size).rev().collect();
        while let Some(part) = parts.pop() {
            if let Some(stop) = limits.stopped() {
                return Err(stop);
            }
            if self.work > most {
                kept.extend_from_slice(part);
                continue;
            }
            let mark = self.add(part.iter().copied());
            if self.solved() {
                self.undo(mark);
                if let [literal] = part {
                    kept.push(*literal);
                } else {
                    let (left, right) = part.split_at(part.len() / 2);
                    parts.extend([right, left]);
                }
            }
        }
        self.undo(start);
        Ok(kept)
    }
}
