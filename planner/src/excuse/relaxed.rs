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
struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// The lists of the second numbers by the first, of which there are `count`.
    fn new(count: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; count + 1];
        for &(key, _) in &pairs {
            starts[key as usize + 1] += 1;
        }
        for key in 0..count {
            starts[key + 1] += starts[key];
        }
        Self { starts, items: pairs.into_iter().map(|(_, item)| item).collect() }
    }

    #[inline]
    fn of(&self, key: u32) -> &[u32] {
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
}

impl Relaxed {
    /// The relaxation of an open problem; nothing is reached yet.
    pub fn new(open: &Open) -> Self {
        let grounded = &open.grounded;
        let facts = grounded.facts.len() as u32;
        let literal = |literal: Literal| {
            let free = !literal.positive && grounded.derived[literal.fact.index()];
            (!free).then(|| number(literal.fact, literal.positive))
        };
        let (mut needs, mut adds) = (Vec::new(), Vec::new());
        let mut rules = 0;
        for operator in &grounded.operators {
            let own = &grounded.arguments
                [operator.arguments.start as usize..operator.arguments.end as usize];
            let slice = |range: &std::ops::Range<u32>| {
                &grounded.literals[range.start as usize..range.end as usize]
            };
            let mut base: Vec<u32> =
                open.demanded(slice(&operator.precondition), own).filter_map(literal).collect();
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
            for group in effects.chunk_by(same) {
                let conditions = open.demanded(slice(&group[0].conditions), own);
                needs.extend(
                    base.iter().copied().chain(conditions.filter_map(literal)).map(|n| (rules, n)),
                );
                adds.extend(
                    group.iter().map(|effect| {
                        (rules, number(effect.literal.fact, effect.literal.positive))
                    }),
                );
                rules += 1;
            }
        }
        for axiom in &grounded.axioms {
            let conditions =
                &grounded.literals[axiom.conditions.start as usize..axiom.conditions.end as usize];
            let own = open.arguments(axiom.head);
            needs.extend(open.demanded(conditions, own).filter_map(literal).map(|n| (rules, n)));
            adds.push((rules, number(axiom.head, true)));
            rules += 1;
        }
        let goal: Vec<u32> = open.demanded(&grounded.goal, &[]).filter_map(literal).collect();
        let literals = open.count() * 2;
        let flip = |pairs: &[(u32, u32)]| pairs.iter().map(|&(a, b)| (b, a)).collect::<Vec<_>>();
        let (needed_by, added_by) =
            (Lists::new(literals, flip(&needs)), Lists::new(literals, flip(&adds)));
        let needs = Lists::new(rules as usize, needs);
        let mut is_goal = vec![false; literals];
        for &goal in &goal {
            is_goal[goal as usize] = true;
        }
        let mut relaxed = Self {
            missing: (0..rules).map(|rule| needs.of(rule).len() as u32).collect(),
            adds: Lists::new(rules as usize, adds),
            needs,
            needed_by,
            added_by,
            goals_missing: is_goal.iter().filter(|&&goal| goal).count() as u32,
            goal,
            is_goal,
            reached: vec![false; literals],
            trail: Vec::new(),
            done: 0,
        };
        for rule in 0..rules {
            if relaxed.missing[rule as usize] == 0 {
                relaxed.fire(rule);
            }
        }
        relaxed.run();
        relaxed
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
        let price = |&literal: &u32| {
            let ways = self.added_by.of(literal).len() as u32;
            (u32::from(wanted[literal as usize]) + ways, literal)
        };
        let unreached = |literal: &u32| !self.reached[*literal as usize];
        let first = self.goal.iter().copied().filter(unreached).min_by_key(price);
        stack.extend(first);
        for &literal in &stack {
            inside[literal as usize] = true;
        }
        while let Some(literal) = stack.pop() {
            if wanted[literal as usize] {
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

    /// A subset of a core that is one, too, and of which no literal can be left out.
    fn minimal(&mut self, core: &[u32], all: &[u32], limits: &Limits) -> Result<Vec<u32>, Stop> {
        let mut inside = vec![false; self.reached.len()];
        for &literal in core {
            inside[literal as usize] = true;
        }
        let start = self.add(all.iter().copied().filter(|&literal| !inside[literal as usize]));
        let mut kept = Vec::new();
        for &literal in core {
            if let Some(stop) = limits.stopped() {
                return Err(stop);
            }
            let mark = self.add([literal]);
            if self.solved() {
                self.undo(mark);
                kept.push(literal);
            }
        }
        self.undo(start);
        Ok(kept)
    }
}
