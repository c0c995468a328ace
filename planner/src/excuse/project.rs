//! A changed initial state goes in whose goal the delete relaxation reaches; a plan or a proof that there is none comes out, and with the proof the few
//! variables that it looked at: whatever else is changed, there is no plan as long as these have their values.
//!
//! Counterexample-guided abstraction (Seipp and Helmert, ICAPS 2013, with projections): only some facts are tracked. A plan that does not care about
//! the others is tried out; where it fails, the facts that it failed on are tracked, too.

use rustc_hash::{FxHashMap, FxHashSet};

use super::open::Open;
use super::vocabulary::{NONE, Vocabulary};
use crate::encode;
use crate::ground;
use crate::grounded::{Axiom, Effect, FactId, Grounded, Literal, Operator};
use crate::limits::{Limits, Stop};
use crate::search::{self, Config, Status};

/// What came out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// There is a plan.
    Solvable,
    /// There is none while these variables have the values that they have.
    Unsolvable(Vec<u32>),
    /// It is not known yet.
    Spent,
    /// It was told to stop.
    Stopped(Stop),
}

/// Which facts are tracked.
struct Tracked<'a> {
    open: &'a Open,
    vocabulary: &'a Vocabulary,
    is: Vec<bool>,
}

impl Tracked<'_> {
    /// Tracks a fact with its variable and with all that decides when it changes.
    fn add(&mut self, fact: FactId, conditions: &Conditions) {
        let mut stack = vec![fact];
        while let Some(fact) = stack.pop() {
            if std::mem::replace(&mut self.is[fact.index()], true) {
                continue;
            }
            let home = self.vocabulary.homes[fact.index()];
            if home != NONE {
                stack.extend(&self.vocabulary.variables[home as usize].facts);
            }
            stack.extend(conditions.of.get(&fact).into_iter().flatten());
        }
    }

    fn all<'b>(&'b self, literals: &'b [Literal]) -> impl Iterator<Item = Literal> + 'b {
        literals.iter().copied().filter(|literal| self.is[literal.fact.index()])
    }

    fn own(&self, operator: &Operator) -> &[lang::model::ObjectId] {
        let range = operator.arguments.start as usize..operator.arguments.end as usize;
        &self.open.grounded.arguments[range]
    }
}

/// For each fact that changes under a condition, or is derived, the facts that decide it.
struct Conditions {
    of: FxHashMap<FactId, Vec<FactId>>,
}

impl Conditions {
    fn new(grounded: &Grounded) -> Self {
        let mut of: FxHashMap<FactId, Vec<FactId>> = FxHashMap::default();
        let facts = |range: &std::ops::Range<u32>| {
            grounded.literals[range.start as usize..range.end as usize]
                .iter()
                .map(|literal| literal.fact)
                .collect::<Vec<_>>()
        };
        for effect in grounded.effects.iter().filter(|effect| !effect.conditions.is_empty()) {
            of.entry(effect.literal.fact).or_default().extend(facts(&effect.conditions));
        }
        for axiom in &grounded.axioms {
            of.entry(axiom.head).or_default().extend(facts(&axiom.conditions));
        }
        for facts in of.values_mut() {
            facts.sort_unstable();
            facts.dedup();
        }
        Self { of }
    }
}

/// Looks for a plan or a proof from `state`, the facts that hold, with as much work as `budget`.
pub fn decide(
    open: &Open,
    vocabulary: &Vocabulary,
    state: &[bool],
    budget: u64,
    limits: &Limits,
) -> Verdict {
    let conditions = Conditions::new(&open.grounded);
    let mut tracked = Tracked { open, vocabulary, is: vec![false; open.count()] };
    let mut work = 0;
    loop {
        if let Some(stop) = limits.stopped() {
            return Verdict::Stopped(stop);
        }
        let (projected, origins) = project(&tracked, state);
        work += projected.effects.len() as u64 + 1;
        let plan = match plan(projected, &origins, &tracked, budget.saturating_sub(work), limits) {
            Planned::Steps(steps, spent) => {
                work += spent;
                steps
            }
            Planned::Nothing => return Verdict::Unsolvable(variables(&tracked)),
            Planned::Spent => return Verdict::Spent,
            Planned::Stopped(stop) => return Verdict::Stopped(stop),
        };
        let missing = failure(&tracked, state, &plan);
        if missing.is_empty() {
            return Verdict::Solvable;
        }
        for fact in missing {
            tracked.add(fact, &conditions);
        }
        if work > budget {
            return Verdict::Spent;
        }
    }
}

/// The variables that are tracked and can be changed. Which new objects there are always counts.
fn variables(tracked: &Tracked<'_>) -> Vec<u32> {
    let all = tracked.vocabulary.variables.iter().enumerate();
    let facts = tracked.open.grounded.facts.len();
    let looked_at = all.filter(|(_, variable)| {
        !variable.edits.is_empty()
            && variable.facts.iter().any(|fact| fact.index() >= facts || tracked.is[fact.index()])
    });
    looked_at.map(|(number, _)| number as u32).collect()
}

/// The problem in which nothing but the tracked facts exists, and the operator behind each of its operators. Operators that come to the same are one.
fn project(tracked: &Tracked<'_>, state: &[bool]) -> (Grounded, Vec<u32>) {
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
    let mut origins = Vec::new();
    let mut seen: FxHashSet<(Vec<Literal>, Vec<(Vec<Literal>, Literal)>)> = FxHashSet::default();
    for (number, operator) in from.operators.iter().enumerate() {
        let own = tracked.own(operator);
        let effects: Vec<(Vec<Literal>, Literal)> = from.effects
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
        let exists = |&object: &u32| state[from.facts.len() + object as usize];
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
            ..operator.clone()
        });
        origins.push(number as u32);
    }
    for axiom in from.axioms.iter().filter(|axiom| tracked.is[axiom.head.index()]) {
        let own = open.arguments(axiom.head);
        let conditions: Vec<Literal> =
            open.demanded(slice(&axiom.conditions), own).map(rename).collect();
        let conditions = push(&mut to.literals, conditions);
        to.axioms.push(Axiom { head: FactId(new[axiom.head.index()]), conditions });
    }
    let goal: Vec<Literal> = open.demanded(&from.goal, &[]).collect();
    to.goal = tracked.all(&goal).map(rename).collect();
    (to, origins)
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
fn plan(
    mut projected: Grounded,
    origins: &[u32],
    tracked: &Tracked<'_>,
    budget: u64,
    limits: &Limits,
) -> Planned {
    // Operators are known again by where their arguments begin, which is where those behind them do.
    let behind: FxHashMap<(u32, u32), Vec<u32>> = {
        let mut behind: FxHashMap<(u32, u32), Vec<u32>> = FxHashMap::default();
        for &origin in origins {
            let operator = &tracked.open.grounded.operators[origin as usize];
            let key = (operator.action.0, operator.arguments.start);
            behind.entry(key).or_default().push(origin);
        }
        behind
    };
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
    let outcome =
        search::run_in_turns(&encoded.task, &config, limits, &mut keep, budget, &mut || None);
    let spent = outcome.statistics.expanded * encoded.task.operators.len() as u64;
    match (found, outcome.status) {
        (Some(steps), _) => {
            let origin = |step: &crate::task::OperatorId| {
                let operator = &projected.operators[encoded.origins[step.index()] as usize];
                behind[&(operator.action.0, operator.arguments.start)][0]
            };
            Planned::Steps(steps.iter().map(origin).collect(), spent)
        }
        (None, Status::Unsolvable) => Planned::Nothing,
        (None, Status::Stopped(stop)) => Planned::Stopped(stop),
        (None, _) => Planned::Spent,
    }
}

/// The groups of which at most one fact holds in the projection, too: one operator adds one fact at most, and needs another, which it deletes.
fn inductive(projected: &Grounded, tracked: &Tracked<'_>) -> Vec<Vec<FactId>> {
    let mut numbers: FxHashMap<(lang::model::PredicateId, &[lang::model::ObjectId]), u32> =
        FxHashMap::default();
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
        if members.len() > 1 {
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
