//! A changed initial state goes in whose goal the delete relaxation reaches; a plan or a proof that there is none comes out, and with the proof the few
//! variables that it looked at: whatever else is changed, there is no plan as long as these have their values.
//!
//! What was proven for one state is then proven for as many as possible: facts that no condition asks to be false never hurt, so they are added to the state as
//! long as there is still no plan, and only what is left out after that can help.
//!
//! Counterexample-guided abstraction (Seipp and Helmert, ICAPS 2013, with projections): only some facts are tracked. A plan that does not care about
//! the others is tried out; where it fails, the facts that it failed on are tracked, too.

use rustc_hash::{FxHashMap, FxHashSet};

use super::explain::explain;
use super::open::Open;
use super::relaxed::{Lists, number};
use super::vocabulary::{NONE, Vocabulary};
use lang::model::{ActionId, ObjectId, PredicateId};

use crate::encode;
use crate::ground;
use crate::grounded::{Axiom, Effect, FactId, Grounded, Literal, Operator};
use crate::limits::{Limits, Stop};
use crate::search::{self, Config, Status};
use crate::solve;

/// What came out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// There is a plan.
    Solvable,
    /// There is none unless one of these literals holds ([`number`]).
    Unsolvable(Vec<u32>),
    /// It is not known yet.
    Spent,
    /// It was told to stop.
    Stopped(Stop),
}

/// Which facts are tracked.
pub(super) struct Tracked<'a> {
    pub(super) open: &'a Open,
    pub(super) vocabulary: &'a Vocabulary,
    pub(super) is: Vec<bool>,
}

impl Tracked<'_> {
    /// Tracks a fact with its variable and with all that decides when it changes.
    pub(super) fn add(&mut self, fact: FactId, conditions: &FxHashMap<FactId, Vec<FactId>>) {
        let mut stack = vec![fact];
        while let Some(fact) = stack.pop() {
            if std::mem::replace(&mut self.is[fact.index()], true) {
                continue;
            }
            let home = self.vocabulary.homes[fact.index()];
            if home != NONE {
                stack.extend(&self.vocabulary.variables[home as usize].facts);
            }
            stack.extend(conditions.get(&fact).into_iter().flatten());
        }
    }

    fn all<'b>(&'b self, literals: &'b [Literal]) -> impl Iterator<Item = Literal> + 'b {
        literals.iter().copied().filter(|literal| self.is[literal.fact.index()])
    }

    fn own(&self, operator: &Operator) -> &[ObjectId] {
        self.open.bound(&operator.bound)
    }
}

/// What every proof needs to know of an open problem.
pub struct Known {
    /// Which facts help whenever they hold.
    helps: Vec<bool>,
    /// For each fact that changes under a condition, or is derived, the facts that decide it.
    pub(super) conditions: FxHashMap<FactId, Vec<FactId>>,
    /// For each fact the operators that change it.
    changed_by: Lists,
}

impl Known {
    /// What there is to know of a ground problem.
    pub fn new(grounded: &Grounded) -> Self {
        let mut conditions: FxHashMap<FactId, Vec<FactId>> = FxHashMap::default();
        let facts = |range: &std::ops::Range<u32>| {
            grounded.literals[range.start as usize..range.end as usize]
                .iter()
                .map(|literal| literal.fact)
                .collect::<Vec<_>>()
        };
        for effect in grounded.effects.iter().filter(|effect| !effect.conditions.is_empty()) {
            conditions.entry(effect.literal.fact).or_default().extend(facts(&effect.conditions));
        }
        for axiom in &grounded.axioms {
            conditions.entry(axiom.head).or_default().extend(facts(&axiom.conditions));
        }
        for facts in conditions.values_mut() {
            facts.sort_unstable();
            facts.dedup();
        }
        let mut changes = Lists::begin();
        let mut list = Vec::new();
        for operator in &grounded.operators {
            let range = operator.effects.start as usize..operator.effects.end as usize;
            list.clear();
            list.extend(grounded.effects[range].iter().map(|effect| effect.literal.fact.0));
            changes.push(&mut list);
        }
        let changed_by = changes.turned(grounded.facts.len());
        Self { helps: helpful(grounded), conditions, changed_by }
    }
}

/// Which facts help whenever they hold: no condition asks for them to be false, and nothing is lost because of them.
fn helpful(grounded: &Grounded) -> Vec<bool> {
    let mut helps = vec![true; grounded.facts.len()];
    let slice =
        |range: &std::ops::Range<u32>| &grounded.literals[range.start as usize..range.end as usize];
    let conditions = grounded
        .operators
        .iter()
        .map(|operator| &operator.precondition)
        .chain(grounded.effects.iter().map(|effect| &effect.conditions))
        .chain(grounded.axioms.iter().map(|axiom| &axiom.conditions));
    let asked = conditions.flat_map(slice).chain(&grounded.goal);
    for literal in asked.filter(|literal| !literal.positive) {
        helps[literal.fact.index()] = false;
    }
    for effect in grounded.effects.iter().filter(|effect| !effect.literal.positive) {
        for literal in slice(&effect.conditions) {
            helps[literal.fact.index()] = false;
        }
    }
    // What makes a fact true that may hurt may hurt, too, if it is derived.
    loop {
        let mut changed = false;
        for axiom in &grounded.axioms {
            if !helps[axiom.head.index()] {
                for literal in slice(&axiom.conditions) {
                    changed |= std::mem::replace(&mut helps[literal.fact.index()], false);
                }
            }
        }
        if !changed {
            return helps;
        }
    }
}

/// How often a proof is tried to be made to say more, and how much of the work for a proof each try gets.
const TRIES: usize = 12;
const SHARE: u64 = 2;

/// So much work an explanation gets in any case.
const EXPLAIN: u64 = 1_000_000;

/// Looks for a plan or a proof from `state`, the facts that hold, with as much work as `budget`; without `abstracts` only for a proof by [`explain`].
pub fn decide(
    open: &Open,
    vocabulary: &Vocabulary,
    known: &Known,
    state: &[bool],
    abstracts: bool,
    budget: u64,
    limits: &Limits,
) -> Verdict {
    let helps = &known.helps;
    let mut search = Search { open, vocabulary, known, limits, abstracts };
    let mut proof = match search.prove(state, budget) {
        Ok(proof) => proof,
        Err(verdict) => return verdict,
    };
    let mut full = state.to_vec();
    // What can be made true, helps, and is looked at by the proof: all of it at once, then in smaller and smaller parts.
    let candidates: Vec<usize> = (0..helps.len())
        .filter(|&fact| {
            helps[fact] && vocabulary.makers[fact] != NONE && !full[fact] && proof[fact]
        })
        .collect();
    let mut parts = vec![candidates];
    let mut tries = 0;
    while let Some(part) = parts.pop() {
        if part.is_empty() || tries == TRIES {
            continue;
        }
        tries += 1;
        let mut more = full.clone();
        for &fact in &part {
            more[fact] = true;
        }
        if let Ok(larger) = search.prove(&more, budget / SHARE) {
            (full, proof) = (more, larger);
        } else if part.len() > 1 {
            let (left, right) = part.split_at(part.len() / 2);
            parts.extend([right.to_vec(), left.to_vec()]);
        }
    }
    Verdict::Unsolvable(clause(open, vocabulary, helps, &full, &proof))
}

/// What would have to hold for the proof not to apply.
fn clause(
    open: &Open,
    vocabulary: &Vocabulary,
    helps: &[bool],
    state: &[bool],
    proof: &[bool],
) -> Vec<u32> {
    let facts = open.grounded.facts.len();
    let mut literals = Vec::new();
    for fact in 0..open.count() {
        // Which new objects there are always counts.
        let counts = fact >= facts || proof[fact];
        if vocabulary.homes[fact] == NONE || !counts {
            continue;
        }
        if !state[fact] {
            literals.push(number(FactId(fact as u32), true));
        } else if fact < facts && !helps[fact] {
            literals.push(number(FactId(fact as u32), false));
        }
    }
    literals
}

struct Search<'a> {
    open: &'a Open,
    vocabulary: &'a Vocabulary,
    known: &'a Known,
    limits: &'a Limits,
    /// Whether abstraction is tried: not where it was too much work before.
    abstracts: bool,
}

impl Search<'_> {
    /// The facts that a proof looks at, by abstraction or else by explanation; or what came out instead. Where there are axioms, abstraction takes in
    /// whatever they might depend on, so that an explanation may say more: the proof that looks at fewer facts is taken.
    fn prove(&mut self, state: &[bool], budget: u64) -> Result<Vec<bool>, Verdict> {
        let mut proof = None;
        if self.abstracts {
            match self.abstracted(state, budget / 2) {
                Err(Verdict::Spent) => self.abstracts = false,
                Ok(facts) if !self.open.grounded.axioms.is_empty() => proof = Some(facts),
                other => return other,
            }
        }
        let (open, vocabulary) = (self.open, self.vocabulary);
        let mut tracked = Tracked { open, vocabulary, is: vec![false; open.count()] };
        let budget = budget.max(EXPLAIN);
        let explained = explain(&mut tracked, self.known, state, budget, self.limits);
        let size = |facts: &[bool]| {
            (0..facts.len()).filter(|&fact| facts[fact] && vocabulary.homes[fact] != NONE).count()
        };
        match proof {
            Some(facts) if !explained || size(&facts) <= size(&tracked.is) => Ok(facts),
            _ if explained => Ok(tracked.is),
            _ => Err(Verdict::Spent),
        }
    }

    /// The facts that a proof looks at which begins without any and takes in those that plans fail on.
    fn abstracted(&self, state: &[bool], budget: u64) -> Result<Vec<bool>, Verdict> {
        let (open, vocabulary, limits) = (self.open, self.vocabulary, self.limits);
        let mut tracked = Tracked { open, vocabulary, is: vec![false; open.count()] };
        let mut work = 0;
        loop {
            if let Some(stop) = limits.stopped() {
                return Err(Verdict::Stopped(stop));
            }
            let (projected, scanned) = project(&tracked, state, &self.known.changed_by);
            work += (projected.effects.len() + projected.literals.len()) as u64 + scanned + 1;
            let left = budget.saturating_sub(work);
            let plan = match plan(projected, &tracked, left, limits) {
                Planned::Steps(steps, spent) => {
                    work += spent;
                    steps
                }
                Planned::Nothing => return Ok(tracked.is),
                Planned::Spent => return Err(Verdict::Spent),
                Planned::Stopped(stop) => return Err(Verdict::Stopped(stop)),
            };
            let missing = failure(&tracked, state, &plan);
            if missing.is_empty() {
                return Err(Verdict::Solvable);
            }
            for fact in missing {
                tracked.add(fact, &self.known.conditions);
            }
            if work > budget {
                return Err(Verdict::Spent);
            }
        }
    }
}

/// What an effect needs, and what it does.
type Conditional = (Vec<Literal>, Literal);

/// The problem in which nothing but the tracked facts exists. Operators that come to the same are one; the action of each is the number of one that it
/// stands for. The second part of the result is how many operators were looked at.
fn project(tracked: &Tracked<'_>, state: &[bool], changed_by: &Lists) -> (Grounded, u64) {
    let open = tracked.open;
    let from = &open.grounded;
    let mut new = vec![NONE; from.facts.len()];
    let mut to = Grounded::default();
    for (number, fact) in from.facts.iter().enumerate().filter(|&(number, _)| tracked.is[number]) {
        new[number] = to.facts.len() as u32;
        to.facts.push(fact.clone());
        to.initial.push(state[number]);
        to.derived.push(from.derived[number]);
    }
    to.arguments.clone_from(&from.arguments);
    let rename = |literal: Literal| Literal { fact: FactId(new[literal.fact.index()]), ..literal };
    let slice =
        |range: &std::ops::Range<u32>| &from.literals[range.start as usize..range.end as usize];
    let exists = |&object: &u32| state[from.facts.len() + object as usize];
    let mut seen: FxHashSet<(Vec<Literal>, Vec<Conditional>)> = FxHashSet::default();
    let mut changing: Vec<u32> = (0..from.facts.len() as u32)
        .filter(|&fact| tracked.is[fact as usize])
        .flat_map(|fact| changed_by.of(fact).iter().copied())
        .collect();
    changing.sort_unstable();
    changing.dedup();
    let scanned = changing.len() as u64;
    for number in changing {
        let operator = &from.operators[number as usize];
        let own = tracked.own(operator);
        let effects: Vec<Conditional> = from.effects
            [operator.effects.start as usize..operator.effects.end as usize]
            .iter()
            .filter(|effect| tracked.is[effect.literal.fact.index()])
            .map(|effect| {
                let conditions = open
                    .demanded(slice(&effect.conditions), own)
                    .filter(|literal| tracked.is[literal.fact.index()])
                    .map(rename)
                    .collect();
                (conditions, rename(effect.literal))
            })
            .collect();
        if effects.is_empty() || !open.new_among(own).iter().all(exists) {
            continue;
        }
        let precondition: Vec<Literal> = open
            .demanded(slice(&operator.precondition), own)
            .filter(|literal| tracked.is[literal.fact.index()])
            .map(rename)
            .collect();
        if !seen.insert((precondition.clone(), effects.clone())) {
            continue;
        }
        let start = to.effects.len() as u32;
        let before = push(&mut to.literals, precondition);
        for (conditions, literal) in effects {
            let conditions = push(&mut to.literals, conditions);
            to.effects.push(Effect { conditions, literal });
        }
        to.operators.push(Operator {
            precondition: before,
            effects: start..to.effects.len() as u32,
            cost: 1,
            // By this it is known again, whatever else becomes of it.
            action: ActionId(number),
            ..operator.clone()
        });
    }
    for axiom in from.axioms.iter().filter(|axiom| tracked.is[axiom.head.index()]) {
        let own = open.bound(&axiom.bound);
        if !open.new_among(own).iter().all(exists) {
            continue;
        }
        let conditions: Vec<Literal> =
            open.demanded(slice(&axiom.conditions), own).map(rename).collect();
        let conditions = push(&mut to.literals, conditions);
        let head = FactId(new[axiom.head.index()]);
        to.axioms.push(Axiom { head, bound: 0..0, conditions });
    }
    let goal: Vec<Literal> = open.demanded(&from.goal, &[]).collect();
    to.goal = tracked.all(&goal).map(rename).collect();
    (to, scanned)
}

fn push(pool: &mut Vec<Literal>, literals: Vec<Literal>) -> std::ops::Range<u32> {
    let start = pool.len() as u32;
    pool.extend(literals);
    start..pool.len() as u32
}

enum Planned {
    /// By operators of the open problem, and how much work it was.
    Steps(Vec<u32>, u64),
    Nothing,
    Spent,
    Stopped(Stop),
}

/// Plans in a projection.
fn plan(mut projected: Grounded, tracked: &Tracked<'_>, budget: u64, limits: &Limits) -> Planned {
    if projected.goal.is_empty() {
        return Planned::Steps(Vec::new(), 0);
    }
    if !ground::simplify(&mut projected) {
        return Planned::Nothing;
    }
    let groups = inductive(&projected, tracked);
    let encoded = match encode::encode(&projected, &groups, limits) {
        Ok(encoded) if encoded.unsolvable => return Planned::Nothing,
        Ok(encoded) => encoded,
        Err(stop) => return Planned::Stopped(stop),
    };
    let mut found = None;
    let mut keep = |steps: &[crate::task::OperatorId], _: u64| found = Some(steps.to_vec());
    let config = Config::default();
    let weight = solve::weight(&projected);
    let share = budget / weight;
    let outcome =
        search::run_in_turns(&encoded.task, &config, limits, &mut keep, share, &mut || None);
    let spent = outcome.statistics.expanded * encoded.task.operators.len() as u64 * weight;
    match (found, outcome.status) {
        (Some(steps), _) => {
            let origin = |step: &crate::task::OperatorId| {
                projected.operators[encoded.origins[step.index()] as usize].action.0
            };
            Planned::Steps(steps.iter().map(origin).collect(), spent)
        }
        (None, Status::Unsolvable) => Planned::Nothing,
        (None, Status::Stopped(stop)) => Planned::Stopped(stop),
        (None, _) => Planned::Spent,
    }
}

/// The groups of which at most one fact holds in the projection, too: at most one does initially, and an operator adds one at most and needs another, which it deletes.
fn inductive(projected: &Grounded, tracked: &Tracked<'_>) -> Vec<Vec<FactId>> {
    let mut numbers: FxHashMap<(PredicateId, &[ObjectId]), u32> = FxHashMap::default();
    for (number, fact) in projected.facts.iter().enumerate() {
        let range = fact.arguments.start as usize..fact.arguments.end as usize;
        numbers.insert((fact.predicate, &projected.arguments[range]), number as u32);
    }
    let open = tracked.open;
    let facts = open.grounded.facts.len();
    let mut groups: Vec<Vec<FactId>> = Vec::new();
    for variable in tracked.vocabulary.variables.iter().filter(|variable| variable.facts.len() > 1)
    {
        let members: Vec<FactId> = variable
            .facts
            .iter()
            .filter(|fact| fact.index() < facts && tracked.is[fact.index()])
            .filter_map(|&fact| {
                let ground = &open.grounded.facts[fact.index()];
                numbers.get(&(ground.predicate, open.arguments(fact))).map(|&number| FactId(number))
            })
            .collect();
        let holding = members.iter().filter(|fact| projected.initial[fact.index()]).count();
        if members.len() > 1 && holding <= 1 {
            groups.push(members);
        }
    }
    let mut of: Vec<u32> = vec![NONE; projected.facts.len()];
    for (number, group) in groups.iter_mut().enumerate() {
        group.sort_unstable();
        for fact in group.iter() {
            of[fact.index()] = number as u32;
        }
    }
    let mut sound = vec![true; groups.len()];
    for operator in &projected.operators {
        let effects =
            &projected.effects[operator.effects.start as usize..operator.effects.end as usize];
        let needed = &projected.literals
            [operator.precondition.start as usize..operator.precondition.end as usize];
        let mut added: Vec<(u32, FactId)> = Vec::new();
        for effect in effects.iter().filter(|effect| effect.literal.positive) {
            let fact = effect.literal.fact;
            let group = of[fact.index()];
            if group == NONE {
                continue;
            }
            let takes = needed.iter().any(|literal| {
                let holds = literal.positive && of[literal.fact.index()] == group;
                let deleted = effects.iter().any(|other| {
                    !other.literal.positive
                        && other.literal.fact == literal.fact
                        && other.conditions.is_empty()
                });
                holds && (deleted || literal.fact == fact)
            });
            let other = added.iter().any(|&(one, before)| one == group && before != fact);
            sound[group as usize] &= takes && !other;
            added.push((group, fact));
        }
    }
    let mut number = 0;
    groups.retain(|_| {
        number += 1;
        sound[number - 1]
    });
    groups
}

/// What a plan of the projection fails on when it is tried out: facts that are not tracked. None if it does not fail.
fn failure(tracked: &Tracked<'_>, state: &[bool], plan: &[u32]) -> Vec<FactId> {
    let grounded = &tracked.open.grounded;
    let slice =
        |range: &std::ops::Range<u32>| &grounded.literals[range.start as usize..range.end as usize];
    let mut state = state.to_vec();
    let unmet = |literals: &mut dyn Iterator<Item = Literal>, state: &[bool]| -> Vec<FactId> {
        literals
            .filter(|literal| {
                !tracked.is[literal.fact.index()]
                    && (grounded.derived[literal.fact.index()]
                        || state[literal.fact.index()] != literal.positive)
            })
            .map(|literal| literal.fact)
            .collect()
    };
    for &step in plan {
        let operator = &grounded.operators[step as usize];
        let own = tracked.own(operator);
        let missing = unmet(&mut tracked.open.demanded(slice(&operator.precondition), own), &state);
        if !missing.is_empty() {
            return missing;
        }
        let before = state.clone();
        let effects =
            &grounded.effects[operator.effects.start as usize..operator.effects.end as usize];
        for positive in [false, true] {
            for effect in effects.iter().filter(|effect| effect.literal.positive == positive) {
                let mut conditions = tracked.open.demanded(slice(&effect.conditions), own);
                // What a derived fact is does not matter here: whatever depends on it is tracked, and the projection knows it.
                if conditions.all(|literal| before[literal.fact.index()] == literal.positive) {
                    state[effect.literal.fact.index()] = positive;
                }
            }
        }
    }
    unmet(&mut tracked.open.demanded(&grounded.goal, &[]), &state)
}
