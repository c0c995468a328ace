//! What is open and what may be changed go in; the cheapest sets of edits with which there is a plan come out.

use lang::execute::Executor;
use lang::model::{Fact, ObjectId, Problem};
use lang::plan::Plan;
use lang::validate;
use rustc_hash::FxHashSet;

use super::hitting::{Hitting, Next, NodeId};
use super::normality::Oddness;
use super::open::Open;
use super::project;
use super::relaxed::{Relaxed, number};
use super::vocabulary::Vocabulary;
use super::{Asked, Change, Excuse, Why};
use crate::grounded::FactId;
use crate::limits::Stop;
use crate::normalize::Unsupported;
use crate::solve::{Answer, solve};

/// How much work a set of edits gets when it is tried for the first time, and by what that grows.
const EFFORT: u64 = 4_000_000;
const GROWTH: u64 = 8;

/// How much work a proof that says more gets in any case.
const GENERAL: u64 = 200_000;

/// So many sets are tried for excuses that cost as little as one that is known, unless all are wanted.
const TIES: usize = 100;

/// How often a set is tried that can be no cheaper than an excuse that is known.
const TRIES_OF_TIES: u32 = 3;

/// So many sets are tried beyond the bound of a stage, for an excuse to fall back on.
const TRIES_BEYOND: usize = 40;

/// Sets of changes that search has shown to be of no use, by what they make false and true.
pub type Refuted = FxHashSet<Vec<(Option<Fact>, Option<Fact>)>>;

/// Excuses of one cost.
#[derive(Debug)]
pub struct Found {
    pub excuses: Vec<Excuse>,
    pub cost: u32,
    pub complete: bool,
}

/// How a stage ended.
#[derive(Debug)]
pub enum End {
    /// The problem has a plan as it is.
    Solvable(Plan),
    /// Everything within the bounds was looked at, or enough was found.
    Done,
    /// It was told to stop.
    Stopped(Stop),
}

/// What one search says of a set of edits.
#[derive(Debug)]
enum Verdict {
    Plan(Box<Problem>, Plan),
    /// It is ruled out, and perhaps others: one of these literals has to hold.
    Ruled(Vec<u32>),
    Undecided,
    Stopped(Stop),
}

/// The search for excuses among the facts that are open.
pub struct Stage<'a> {
    asked: Asked<'a>,
    open: &'a Open,
    vocabulary: &'a Vocabulary,
    relaxed: Relaxed,
    /// Literals that some edit makes true or leaves true, as a set and as a list.
    wanted: Vec<bool>,
    all: Vec<u32>,
    hitting: Hitting<'a>,
    /// Whether the problem is known to have no plan as it is.
    pub unsolvable: bool,
    refuted: &'a mut Refuted,
    /// Which facts some operator makes true, and which are in reach initially if nothing is ever lost.
    made: Vec<bool>,
    in_reach: Vec<bool>,
    /// What proofs need to know; made when it is first asked for.
    known: Option<project::Known>,
    /// How much work a proof gets that says more, where it is proven already that there is no plan.
    patience: u64,
    excuses: Vec<Excuse>,
    complete: bool,
    /// Cores from delete relaxation, nogoods from failed searches, sets that were tried by search.
    pub cores: usize,
    pub nogoods: usize,
    pub tried: usize,
    /// Where the look for ties ends.
    last_tried: usize,
}

impl<'a> Stage<'a> {
    pub fn new(
        asked: Asked<'a>,
        open: &'a Open,
        vocabulary: &'a Vocabulary,
        oddness: &'a [Oddness],
        refuted: &'a mut Refuted,
        unsolvable: bool,
    ) -> Result<Self, Stop> {
        let mut wanted = vec![false; open.count() * 2];
        for edit in &vocabulary.edits {
            let variable = &vocabulary.variables[edit.variable as usize];
            if let Some(fact) = edit.to {
                wanted[number(fact, true) as usize] = true;
                wanted[number(fact, false) as usize] = true;
            }
            if let Some(fact) = variable.initial {
                wanted[number(fact, true) as usize] = true;
                wanted[number(fact, false) as usize] = true;
            }
        }
        let all = (0..wanted.len() as u32).filter(|&literal| wanted[literal as usize]).collect();
        let mut relaxed = Relaxed::new(open, asked.limits)?;
        let fixed = (0..open.count() as u32).filter_map(|fact| {
            let fact = FactId(fact);
            let literal = number(fact, open.initial[fact.index()]);
            let derived = open.grounded.derived.get(fact.index()) == Some(&true);
            (!derived && !wanted[literal as usize]).then_some(literal)
        });
        relaxed.add(fixed.collect::<Vec<_>>());
        let mut made = vec![false; open.count()];
        for effect in open.grounded.effects.iter().filter(|effect| effect.literal.positive) {
            made[effect.literal.fact.index()] = true;
        }
        let mark = relaxed.add(true_of(&open.initial, &wanted));
        let in_reach =
            (0..open.count() as u32).map(|fact| relaxed.has(number(FactId(fact), true))).collect();
        relaxed.undo(mark);
        Ok(Self {
            asked,
            open,
            vocabulary,
            relaxed,
            wanted,
            all,
            hitting: Hitting::new(vocabulary, asked.question.most_edits, oddness),
            unsolvable,
            refuted,
            made,
            in_reach,
            known: None,
            patience: EFFORT,
            excuses: Vec::new(),
            complete: true,
            cores: 0,
            nogoods: 0,
            tried: 0,
            last_tried: usize::MAX,
        })
    }

    /// What was found, if anything.
    pub fn take(&mut self) -> Option<Found> {
        let excuses = std::mem::take(&mut self.excuses);
        let cost = excuses.first()?.cost;
        Some(Found { excuses, cost, complete: self.complete })
    }

    /// Looks at sets of edits that cost `most` at most, until enough are found.
    pub fn run(&mut self, most: u32) -> Result<End, Unsupported> {
        loop {
            let most = self.excuses.first().map_or(most, |excuse| excuse.cost);
            match self.step(most)? {
                None => {}
                Some(end) => return Ok(end),
            }
        }
    }

    /// Goes on for one excuse, whatever it costs, but not for long: adds whatever mends what is wrong until there is a plan, then leaves out what is not
    /// needed.
    pub fn run_beyond(&mut self) -> Result<(), Unsupported> {
        let mut edits = Vec::new();
        for _ in 0..TRIES_BEYOND {
            if self.asked.limits.stopped().is_some() || !self.hitting.complete(&mut edits) {
                return Ok(());
            }
            if self.is_excuse(&edits)? {
                break;
            }
        }
        let mut kept = edits.clone();
        for edit in edits {
            let fewer: Vec<u32> = kept.iter().copied().filter(|&one| one != edit).collect();
            if self.asked.limits.stopped().is_none()
                && self.hitting.is_complete(&fewer)
                && self.is_excuse(&fewer)?
            {
                kept = fewer;
            }
        }
        self.excuses.clear();
        if kept.len() <= self.asked.question.most_edits && self.is_excuse(&kept)? {
            self.complete = false;
        }
        Ok(())
    }

    /// Tries a set of edits and learns from it; whether it is an excuse, which is kept then.
    fn is_excuse(&mut self, edits: &[u32]) -> Result<bool, Unsupported> {
        let mut edits = edits.to_vec();
        edits.sort_unstable();
        let state = self.vocabulary.state(self.open, &edits);
        if self.cut(&state) != Ok(false) {
            return Ok(false);
        }
        self.tried += 1;
        match self.judge(&edits, &state, 0)? {
            Verdict::Plan(problem, plan) if !edits.is_empty() => {
                self.excuses.clear();
                self.keep(&edits, *problem, plan);
                Ok(true)
            }
            Verdict::Ruled(clause) => {
                self.hitting.demand(clause);
                self.nogoods += 1;
                Ok(false)
            }
            _ => Ok(false),
        }
    }

    /// Looks at the next set of edits; says how the stage ends, if it does.
    fn step(&mut self, most: u32) -> Result<Option<End>, Unsupported> {
        if let Some(stop) = self.asked.limits.stopped() {
            self.complete = false;
            return Ok(Some(End::Stopped(stop)));
        }
        let (next, tried) = self.hitting.next(most, self.asked.limits);
        let (node, edits) = match next {
            Next::Edits(node, edits) => (node, edits),
            Next::Nothing => return Ok(Some(End::Done)),
            Next::Stopped(stop) => {
                self.complete = false;
                return Ok(Some(End::Stopped(stop)));
            }
        };
        let known = self.excuses.len();
        let tired = known > 0
            && self.tried >= self.last_tried
            && self.asked.question.most_excuses != usize::MAX;
        if known >= self.asked.question.most_excuses || tired {
            self.complete = false;
            return Ok(Some(End::Done));
        }
        let state = self.vocabulary.state(self.open, &edits);
        match self.cut(&state) {
            Ok(true) => {
                self.unsolvable |= edits.is_empty();
                self.hitting.postpone(node, self.cost(&edits), tried, edits.len());
                return Ok(None);
            }
            Ok(false) => {}
            Err(stop) => return Ok(Some(End::Stopped(stop))),
        }
        self.tried += 1;
        let verdict = self.judge(&edits, &state, tried)?;
        Ok(self.settle(verdict, node, &edits, tried))
    }

    /// Takes a verdict in; says how the stage ends, if it does.
    fn settle(&mut self, verdict: Verdict, node: NodeId, edits: &[u32], tried: u32) -> Option<End> {
        let cost = self.cost(edits);
        match verdict {
            Verdict::Plan(_, plan) if edits.is_empty() => return Some(End::Solvable(plan)),
            Verdict::Plan(problem, plan) => {
                self.keep(edits, *problem, plan);
                self.last_tried = self.last_tried.min(self.tried + TIES);
            }
            Verdict::Ruled(clause) => {
                self.unsolvable |= edits.is_empty();
                self.nogoods += 1;
                self.hitting.demand(clause);
                self.hitting.postpone(node, cost, tried, edits.len());
            }
            Verdict::Undecided => {
                if !self.excuses.is_empty() && tried + 1 >= TRIES_OF_TIES {
                    self.complete = false;
                } else {
                    self.hitting.postpone(node, cost, tried + 1, edits.len());
                }
            }
            Verdict::Stopped(stop) => {
                self.complete = false;
                self.hitting.postpone(node, cost, tried, edits.len());
                return Some(End::Stopped(stop));
            }
        }
        None
    }

    fn cost(&self, edits: &[u32]) -> u32 {
        edits.iter().map(|&edit| self.vocabulary.edits[edit as usize].cost).sum()
    }

    /// Demands the cores of a state, if delete relaxation gives any.
    fn cut(&mut self, state: &[bool]) -> Result<bool, Stop> {
        let mark = self.relaxed.add(true_of(state, &self.wanted));
        let cut = !self.relaxed.solved();
        if cut {
            let cores = self.relaxed.cores(&self.wanted, &self.all, self.asked.limits);
            let cores = match cores {
                Ok(cores) => cores,
                Err(stop) => {
                    self.relaxed.undo(mark);
                    return Err(stop);
                }
            };
            self.cores += cores.len();
            for mut core in cores {
                if core.len() <= 64 {
                    self.relaxed.causes_first(&mut core);
                }
                self.hitting.demand(core);
            }
        }
        self.relaxed.undo(mark);
        Ok(cut)
    }

    /// That something is otherwise than after `edits`.
    fn differs(&self, edits: &[u32]) -> Vec<u32> {
        let state = self.vocabulary.state(self.open, edits);
        let changeable =
            self.vocabulary.variables.iter().filter(|variable| !variable.edits.is_empty());
        let facts = changeable.flat_map(|variable| &variable.facts);
        facts.map(|&fact| number(fact, !state[fact.index()])).collect()
    }

    /// What some edits make false and true.
    fn signature(&self, edits: &[u32]) -> Vec<(Option<Fact>, Option<Fact>)> {
        let fact = |fact: Option<FactId>| Vocabulary::fact(self.open, fact?);
        let mut signature: Vec<_> = edits
            .iter()
            .map(|&edit| &self.vocabulary.edits[edit as usize])
            .map(|edit| (fact(edit.from), fact(edit.to)))
            .collect();
        signature.sort();
        signature
    }

    /// Looks for a plan with some edits.
    fn judge(&mut self, edits: &[u32], state: &[bool], tried: u32) -> Result<Verdict, Unsupported> {
        let (changed, _) = self.changed(edits);
        let budget = EFFORT.saturating_mul(GROWTH.saturating_pow(tried));
        let signature = self.signature(edits);
        let known = self.refuted.contains(&signature) || edits.is_empty() && self.unsolvable;
        let answer = if known {
            Answer::Unsolvable(0)
        } else {
            solve(self.asked.domain, &changed, false, budget, self.asked.limits)?
        };
        let proof = match answer {
            Answer::Plan(plan) if plan.steps.is_empty() && !edits.is_empty() => {
                // What satisfies the goal at once is no excuse. Whatever else is changed besides costs more.
                return Ok(Verdict::Ruled(self.differs(edits)));
            }
            Answer::Plan(plan) => return Ok(Verdict::Plan(Box::new(changed), plan)),
            Answer::Stopped(stop) => return Ok(Verdict::Stopped(stop)),
            Answer::Unsolvable(work) => {
                self.refuted.insert(signature);
                Some(work)
            }
            Answer::Spent => None,
        };
        // Where it is known already that there is no plan, a proof that says more is worth as much work as that was, and some more as long as such proofs
        // are found.
        let budget = proof.map_or(budget / 4, |work| budget.min(4 * work + self.patience));
        let known = self.known.get_or_insert_with(|| project::Known::new(&self.open.grounded));
        let Asked { question, limits, .. } = self.asked;
        let abstracts = question.abstraction;
        let verdict =
            project::decide(self.open, self.vocabulary, known, state, abstracts, budget, limits);
        if proof.is_some() {
            let says_more = matches!(&verdict, project::Verdict::Unsolvable(clause)
                if clause.len() * 2 < self.differs(edits).len());
            self.patience = if says_more {
                EFFORT.min(self.patience * 2)
            } else {
                GENERAL.max(self.patience / 2)
            };
        }
        Ok(match verdict {
            project::Verdict::Unsolvable(clause) => Verdict::Ruled(clause),
            project::Verdict::Stopped(stop) if proof.is_none() => Verdict::Stopped(stop),
            _ if proof.is_some() => Verdict::Ruled(self.differs(edits)),
            _ => Verdict::Undecided,
        })
    }

    /// The problem after some edits, and its new objects by their number there.
    fn changed(&self, edits: &[u32]) -> (Problem, Vec<(ObjectId, ObjectId)>) {
        let mut problem = self.asked.problem.clone();
        let mut renamed = Vec::new();
        for &edit in edits {
            if let Some(object) = self.vocabulary.edits[edit as usize].object {
                renamed.push((object, ObjectId(problem.objects.len() as u32)));
                problem.objects.push(self.open.problem.objects[object.index()].clone());
            }
        }
        for &edit in edits {
            let edit = &self.vocabulary.edits[edit as usize];
            if let Some(fact) = self.renamed(edit.from, &renamed) {
                problem.init.retain(|other| *other != fact);
            }
        }
        for &edit in edits {
            let edit = &self.vocabulary.edits[edit as usize];
            problem.init.extend(self.renamed(edit.to, &renamed));
        }
        (problem, renamed)
    }

    /// A fact with the numbers that new objects have in a changed problem; nothing for what says that an object exists.
    fn renamed(&self, fact: Option<FactId>, renamed: &[(ObjectId, ObjectId)]) -> Option<Fact> {
        let mut fact = Vocabulary::fact(self.open, fact?)?;
        for argument in &mut fact.arguments {
            if let Some(&(_, new)) = renamed.iter().find(|(old, _)| old == argument) {
                *argument = new;
            }
        }
        Some(fact)
    }

    /// Keeps an excuse, if the executor agrees that its plan is one.
    fn keep(&mut self, edits: &[u32], problem: Problem, plan: Plan) {
        let executor = Executor::new(self.asked.domain, &problem);
        let valid = executor.is_ok_and(|executor| validate::is_valid(&executor, &plan));
        assert!(valid, "the executor accepts every plan of the planner");
        let (_, renamed) = self.changed(edits);
        let changes = edits
            .iter()
            .map(|&edit| {
                let edit = &self.vocabulary.edits[edit as usize];
                let object = edit.object.map(|object| {
                    let new = renamed.iter().find(|(old, _)| *old == object);
                    let new = new.expect("every new object is renamed").1;
                    (new, problem.objects[new.index()].types[0])
                });
                Change {
                    from: self.renamed(edit.from, &renamed),
                    to: self.renamed(edit.to, &renamed),
                    object,
                    cost: edit.cost,
                    origin: self.vocabulary.variables[edit.variable as usize].origin,
                    why: match edit.to {
                        Some(_) if edit.object.is_some() => Why::Other,
                        Some(fact) if !self.made[fact.index()] => Why::NoAction,
                        Some(fact) if !self.in_reach[fact.index()] => Why::OutOfReach,
                        Some(_) => Why::TooLate,
                        None => Why::Other,
                    },
                }
            })
            .collect();
        let cost = self.cost(edits);
        let excuse = Excuse { changes, cost, problem, plan, level: 0, follows_from: Vec::new() };
        self.excuses.push(excuse);
    }
}

impl Stage<'_> {
    /// The facts of the goal that are out of reach initially, even if nothing were ever lost.
    pub fn missing(&self) -> Vec<Fact> {
        let goals = self.open.grounded.goal.iter().filter(|literal| literal.positive);
        // What stands for a disjunction in the goal has no name.
        let named = |fact: FactId| {
            let predicate = self.open.grounded.facts[fact.index()].predicate;
            predicate.index() < self.asked.domain.predicates.len()
        };
        let missing =
            goals.filter(|literal| !self.in_reach[literal.fact.index()] && named(literal.fact));
        missing.filter_map(|literal| Vocabulary::fact(self.open, literal.fact)).collect()
    }

    /// No set of edits that is still to be looked at costs less.
    pub fn bound(&self) -> Option<u32> {
        self.hitting.bound()
    }
}

/// The literals of a state, as far as they are wanted.
fn true_of(state: &[bool], wanted: &[bool]) -> Vec<u32> {
    (0..state.len() as u32)
        .map(|fact| number(FactId(fact), state[fact as usize]))
        .filter(|&literal| wanted[literal as usize])
        .collect()
}
