//! A problem goes in that has no plan; the smallest changes of its initial state with which it has one come out: its *excuses*.
//!
//! After Göbelbecker, Keller, Eyerich, Brenner and Nebel ("Coming up with good excuses", ICAPS 2010) and definitions 2 and 3 of the thesis. An edit changes
//! one variable, which is a group of facts that exclude each other ([`vocabulary`]), so that no edit leads to an impossible world.
//! Sets of edits come in the order of their cost ([`hitting`]). Each is tried first under delete relaxation, which gives cores where it fails
//! ([`relaxed`]), then by search; where search fails, what it failed on is a nogood ([`project`]). So the first set that has a plan is a cheapest one.
//!
//! Facts that are dear to change are not opened before it is known that the cheap ones do not suffice.

mod policy;
mod open;
pub mod vocabulary;
mod presume;
mod relaxed;
mod hitting;
mod project;
mod explain;
mod normality;
mod stage;
mod rank;
mod export;
pub mod goals;
pub mod operators;

use std::collections::BTreeSet;

use lang::model::{Domain, Fact, ObjectId, PredicateId, Problem, TypeId};
use lang::plan::Plan;

use crate::invariants::{self, Candidate};
use crate::limits::{Limits, Stop};
use crate::normal::Term;
use crate::normalize::Unsupported;
use crate::solve::{Answer, solve};
pub use export::{Export, export};
use open::{Obstacle, Open};
pub use policy::{KIND, OBJECT, Policy, STATIC};
use stage::{End, Found, Refuted, Stage};
pub use vocabulary::Origin;
use vocabulary::Vocabulary;

/// What is asked for.
#[derive(Debug, Clone)]
pub struct Question {
    /// What may be changed.
    pub policy: Policy,
    /// No excuse has more edits.
    pub most_edits: usize,
    /// So many excuses are wanted at most.
    pub most_excuses: usize,
    /// Work for improving the plan of each excuse and for ranking.
    pub polish: u64,
    /// Whether what a search failed on is looked for by abstraction first, which says most, and not only by looking at all states that were reached.
    pub abstraction: bool,
}

impl Default for Question {
    fn default() -> Self {
        Self {
            policy: Policy::default(),
            most_edits: 64,
            most_excuses: 10,
            polish: 2_000_000,
            abstraction: true,
        }
    }
}

/// A change of one variable.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// What holds in the initial state and would not.
    pub from: Option<Fact>,
    /// What would hold.
    pub to: Option<Fact>,
    /// The object that would exist, and its type; its name is in [`Excuse::problem`].
    pub object: Option<(ObjectId, TypeId)>,
    /// What it costs.
    pub cost: u32,
    /// From where it is known what excludes what.
    pub origin: Origin,
    /// Why it is needed.
    pub why: Why,
}

/// Why what a change makes true does not come about by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// No action makes it true, whatever is changed.
    NoAction,
    /// What would make it true is out of reach.
    OutOfReach,
    /// It can be made true, but not so that the goal is reached.
    TooLate,
    /// It makes something false, or an object exist.
    Other,
}

/// A set of changes with which there is a plan.
#[derive(Debug, Clone)]
pub struct Excuse {
    /// The changes.
    pub changes: Vec<Change>,
    /// What they cost together.
    pub cost: u32,
    /// The problem that they make. Its objects are those of the problem that was asked about, then the new ones.
    pub problem: Problem,
    /// A plan for it.
    pub plan: Plan,
    /// How deep a cause it is: 0 for those that no other explains; others follow from one of the level before by a plan of their own problem.
    pub level: u32,
    /// The excuses, by number, from whose states a plan leads to this one's.
    pub follows_from: Vec<usize>,
}

/// What a run did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Facts of the ground problem in which all that may be changed is open.
    pub facts: usize,
    /// Its operators.
    pub operators: usize,
    /// Variables that can be changed.
    pub variables: usize,
    /// Ways to change one.
    pub edits: usize,
    /// Cores from delete relaxation.
    pub cores: usize,
    /// Nogoods from failed searches.
    pub nogoods: usize,
    /// Sets of edits that were tried by search.
    pub tried: usize,
}

/// What is known in the end.
#[derive(Debug, Clone)]
pub enum Outcome {
    /// The problem has a plan as it is.
    Solvable(Plan),
    /// It has none, and these are its cheapest excuses, the deepest causes first.
    Excuses {
        /// The facts of the goal that are out of reach, even if nothing were ever lost.
        missing: Vec<Fact>,
        /// The excuses.
        list: Vec<Excuse>,
        /// Whether it is proven that there is none cheaper.
        proven: bool,
        /// Whether these are all that cost as much.
        complete: bool,
    },
    /// It has none, and no excuse within the bounds helps.
    None {
        /// Whether presumed groups rule some sets of edits out.
        presumed: bool,
    },
    /// It has no plan; whether an excuse exists is not known.
    Unknown {
        /// No excuse costs less.
        bound: u32,
        /// Why it ended.
        reason: Unfinished,
    },
    /// It is not known whether it has a plan.
    Undecided(Stop),
}

/// Why nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfinished {
    /// It was told to stop.
    Stopped(Stop),
    /// The ground problem would be too large with everything that may be changed.
    Large,
}

/// Finds the cheapest excuses of a problem.
///
/// # Errors
/// What the planner does not plan.
pub fn find(
    domain: &Domain,
    problem: &Problem,
    question: &Question,
    limits: &Limits,
) -> Result<(Outcome, Statistics), Unsupported> {
    let mut run = Run {
        asked: Asked { domain, problem, question, limits },
        statistics: Statistics::default(),
        refuted: Refuted::default(),
        unsolvable: false,
        presumed: false,
        bound: 0,
        best: None,
        invariants: None,
        exhausted: false,
    };
    let hopeless = out_of_reach(domain, problem, &question.policy)?;
    for stage in stages(domain, problem, &question.policy)? {
        if hopeless {
            break;
        }
        if let Some(outcome) = run.stage(stage)? {
            return Ok((outcome, run.statistics));
        }
        if run.exhausted {
            break;
        }
    }
    let outcome = match run.best.take() {
        // Nothing that is dearer to change makes it cheaper.
        Some((found, missing)) => run.excuses(found, missing, true),
        None => Outcome::None { presumed: run.presumed },
    };
    Ok((outcome, run.statistics))
}

/// Whether the goal asks for a fact that does not hold, that no effect makes true and that must not be changed: then there is no need to look further.
fn out_of_reach(domain: &Domain, problem: &Problem, policy: &Policy) -> Result<bool, Unsupported> {
    let normal = crate::normalize::normalize(domain, problem)?;
    let fits =
        |term: &Term, object: &Term, variables: &[crate::normal::Variable]| match (term, object) {
            (Term::Object(one), Term::Object(other)) => one == other,
            (Term::Variable(variable), Term::Object(object)) => domain
                .has_type(&problem.objects[object.index()], &variables[*variable as usize].types),
            _ => true,
        };
    let lost = |literal: &crate::normal::Literal| {
        let atom = &literal.atom;
        let derived =
            normal.predicates[atom.predicate.index()].kind == crate::normal::Kind::Derived;
        let arguments = atom.arguments.iter().map(|term| match term {
            Term::Object(object) => Some(*object),
            Term::Variable(_) => None,
        });
        let Some(arguments) = arguments.collect::<Option<Vec<ObjectId>>>() else { return false };
        let fact = Fact { predicate: atom.predicate, arguments: arguments.into() };
        if derived || problem.init.contains(&fact) == literal.positive {
            return false;
        }
        !normal.schemas.iter().any(|schema| {
            schema.effects.iter().any(|effect| {
                let made = &effect.literal.atom;
                let mut pairs = made.arguments.iter().zip(&atom.arguments);
                effect.literal.positive == literal.positive
                    && made.predicate == atom.predicate
                    && pairs.all(|(term, object)| fits(term, object, &schema.variables))
            })
        })
    };
    Ok(!policy.goal && normal.goal.literals.iter().any(lost))
}

/// What is asked, of which task, and how long.
#[derive(Clone, Copy)]
struct Asked<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    question: &'a Question,
    limits: &'a Limits,
}

/// What is known from the stages so far.
struct Run<'a> {
    asked: Asked<'a>,
    statistics: Statistics,
    refuted: Refuted,
    unsolvable: bool,
    presumed: bool,
    /// No excuse costs less.
    bound: u32,
    /// The cheapest excuses so far, of which it is not known whether there are cheaper ones; and which goals are out of reach.
    best: Option<(Found, Vec<Fact>)>,
    /// What the actions keep, of all stages.
    invariants: Option<Vec<Candidate>>,
    /// Whether the last stage left nothing out, so that there is no more to find.
    exhausted: bool,
}

/// What the actions keep, by the first stage that can be opened.
fn known(domain: &Domain, open: &Open, limits: &Limits) -> Vec<Candidate> {
    invariants::lifted(domain, &open.problem, &open.normal, &open.grounded, limits)
}

impl Run<'_> {
    /// Opens what a stage opens and looks for excuses within its bound; the outcome, if that settles it.
    fn stage(&mut self, stage: Level) -> Result<Option<Outcome>, Unsupported> {
        let Level { most, bound, last } = stage;
        let Asked { domain, problem, question, limits } = self.asked;
        let policy = &question.policy;
        let open = match Open::new(domain, problem, policy, most, bound, limits) {
            Ok(open) => open,
            Err(Obstacle::Unsupported(unsupported)) => return Err(unsupported),
            Err(Obstacle::Hopeless { narrow }) => {
                self.unsolvable = true;
                self.exhausted = last && !narrow;
                self.bound = bound.saturating_add(1);
                return Ok(None);
            }
            Err(Obstacle::Stopped(stop)) => return Ok(Some(self.end(Unfinished::Stopped(stop)))),
            Err(Obstacle::Large) => {
                let answer = solve(domain, problem, false, u64::MAX, limits)?;
                self.unsolvable |= matches!(answer, Answer::Unsolvable(_));
                return Ok(Some(match answer {
                    Answer::Plan(plan) => Outcome::Solvable(plan),
                    _ => self.end(Unfinished::Large),
                }));
            }
        };
        // What excludes what does not depend on what is open.
        let invariants = self.invariants.get_or_insert_with(|| known(domain, &open, limits));
        let vocabulary = Vocabulary::new(&open, domain, invariants, policy);
        self.presumed |= vocabulary.groups.iter().any(|group| group.origin == Origin::Presumed);
        let mut refuted = std::mem::take(&mut self.refuted);
        let oddness = normality::oddness(&open, domain, &vocabulary);
        let begun =
            Stage::new(self.asked, &open, &vocabulary, &oddness, &mut refuted, self.unsolvable);
        let mut stage = match begun {
            Ok(stage) => stage,
            Err(stop) => return Ok(Some(self.end(Unfinished::Stopped(stop)))),
        };
        let known = self.best.as_ref().map_or(u32::MAX, |(best, _)| best.cost);
        // Where nothing was left out, the bound means nothing.
        let whole = last && !open.narrow;
        let end = stage.run(if whole { u32::MAX } else { bound }.min(known))?;
        let found = stage.take();
        if let (End::Done, None, false, None) = (&end, &found, whole, &self.best) {
            stage.run_beyond()?;
        }
        let beyond = stage.take();
        let (missing, reached) = (stage.missing(), stage.bound());
        self.unsolvable = stage.unsolvable;
        self.count(&stage, &open, &vocabulary);
        self.refuted = refuted;
        Ok(match end {
            End::Solvable(plan) => Some(Outcome::Solvable(plan)),
            End::Stopped(stop) => {
                if let Some(found) = found {
                    // All that could be cheaper was looked at before.
                    return Ok(Some(self.excuses(found, missing, true)));
                }
                // What is not open, or was too dear to be opened, costs more than the bound.
                let most = if whole { u32::MAX } else { bound.saturating_add(1) };
                self.bound = self.bound.max(reached.unwrap_or(0).min(most));
                Some(self.end(Unfinished::Stopped(stop)))
            }
            End::Done => {
                if let Some(found) = found {
                    return Ok(Some(self.excuses(found, missing, true)));
                }
                self.exhausted = whole;
                self.bound = bound.saturating_add(1);
                let better = |found: &Found| {
                    self.best.as_ref().is_none_or(|(best, _)| found.cost < best.cost)
                };
                if let Some(found) = beyond.filter(better) {
                    self.best = Some((found, missing));
                }
                None
            }
        })
    }

    fn count(&mut self, stage: &Stage<'_>, open: &Open, vocabulary: &Vocabulary) {
        let statistics = &mut self.statistics;
        statistics.facts = open.grounded.facts.len();
        statistics.operators = open.grounded.operators.len();
        let changeable = vocabulary.variables.iter().filter(|one| !one.edits.is_empty());
        statistics.variables = changeable.count();
        statistics.edits = vocabulary.edits.len();
        statistics.cores += stage.cores;
        statistics.nogoods += stage.nogoods;
        statistics.tried += stage.tried;
    }

    /// The outcome where no more can be found out.
    fn end(&mut self, reason: Unfinished) -> Outcome {
        match (self.best.take(), reason) {
            (Some((found, missing)), _) => {
                let proven = found.cost <= self.bound;
                self.excuses(found, missing, proven)
            }
            (None, Unfinished::Stopped(stop)) if !self.unsolvable => Outcome::Undecided(stop),
            (None, _) => Outcome::Unknown { bound: self.bound, reason },
        }
    }

    fn excuses(&self, found: Found, missing: Vec<Fact>, proven: bool) -> Outcome {
        let Found { excuses, complete, .. } = found;
        let list = rank::rank(self.asked, excuses);
        Outcome::Excuses { missing, list, proven, complete }
    }
}

/// What is opened at a time.
#[derive(Debug, Clone, Copy)]
struct Level {
    /// What costs so much at most to change is open.
    most: u32,
    /// Excuses of this cost and less are found for sure.
    bound: u32,
    /// Whether everything is open.
    last: bool,
}

/// The levels, in the order in which they are tried: each opens what costs a bit more; when all is open the bound grows by half.
fn stages(
    domain: &Domain,
    problem: &Problem,
    policy: &Policy,
) -> Result<impl Iterator<Item = Level> + use<>, Unsupported> {
    let normal = crate::normalize::normalize(domain, problem)?;
    let price = |number: usize| {
        let changes = normal.predicates[number].kind != crate::normal::Kind::Static;
        policy.cost(domain, PredicateId(number as u32), changes)
    };
    let mut costs: BTreeSet<u32> = (0..domain.predicates.len()).filter_map(price).collect();
    if policy.objects > 0 {
        costs.insert(policy.object_cost);
    }
    let costs: Vec<u32> = if costs.is_empty() { vec![1] } else { costs.into_iter().collect() };
    let dearest = costs[costs.len() - 1];
    let first: Vec<Level> = costs
        .windows(2)
        .map(|pair| Level { most: pair[0], bound: pair[1] - 1, last: false })
        .collect();
    // What a purse affords grows much faster than the purse, so that a bound is not raised by more than half of it.
    let start = dearest.saturating_mul(2).saturating_sub(1);
    let bounds = std::iter::successors(Some(start), |&bound| {
        (bound < u32::MAX).then(|| bound.saturating_add(bound.div_ceil(2)))
    });
    let all = bounds.map(move |bound| Level { most: dearest, bound, last: true });
    Ok(first.into_iter().chain(all))
}

/// All that may be changed, said in facts of the problem.
#[derive(Debug, Clone)]
pub struct Catalogue {
    /// The variables that can be changed.
    pub variables: Vec<Choice>,
    /// The groups that no change may break, and whether exactly one of their facts holds.
    pub groups: Vec<(Vec<Fact>, bool)>,
}

/// A variable that can be changed.
#[derive(Debug, Clone)]
pub struct Choice {
    /// What holds initially.
    pub from: Option<Fact>,
    /// What may hold instead, and what that costs.
    pub to: Vec<(Option<Fact>, u32)>,
    /// From where it is known that these exclude each other.
    pub origin: Origin,
}

/// What may be changed for `most` a change at most; without new objects. Nothing where the goal is out of reach even so.
///
/// # Errors
/// What the planner does not plan, or why it ended.
pub fn catalogue(
    domain: &Domain,
    problem: &Problem,
    policy: &Policy,
    most: u32,
    limits: &Limits,
) -> Result<Option<Catalogue>, CatalogueError> {
    let policy = Policy { objects: 0, ..policy.clone() };
    let mut invariants = None;
    let mut opened = None;
    let stages = stages(domain, problem, &policy).map_err(CatalogueError::Unsupported)?;
    for level in stages.take_while(|level| level.most <= most) {
        let open = match Open::new(domain, problem, &policy, level.most, level.bound, limits) {
            Ok(open) => open,
            Err(Obstacle::Hopeless { .. }) => continue,
            Err(Obstacle::Unsupported(unsupported)) => {
                return Err(CatalogueError::Unsupported(unsupported));
            }
            Err(Obstacle::Large) => return Err(CatalogueError::Unfinished(Unfinished::Large)),
            Err(Obstacle::Stopped(stop)) => {
                return Err(CatalogueError::Unfinished(Unfinished::Stopped(stop)));
            }
        };
        invariants.get_or_insert_with(|| known(domain, &open, limits));
        opened = Some(open);
        if level.bound >= most {
            break;
        }
    }
    let (Some(open), Some(invariants)) = (opened, invariants) else { return Ok(None) };
    let vocabulary = Vocabulary::new(&open, domain, &invariants, &policy);
    let fact = |fact: Option<crate::grounded::FactId>| Vocabulary::fact(&open, fact?);
    let choice = |variable: &vocabulary::Variable| Choice {
        from: fact(variable.initial),
        to: variable
            .edits
            .iter()
            .map(|&edit| &vocabulary.edits[edit as usize])
            .map(|edit| (fact(edit.to), edit.cost))
            .collect(),
        origin: variable.origin,
    };
    let changeable = vocabulary.variables.iter().filter(|one| !one.edits.is_empty());
    let group = |group: &vocabulary::Group| {
        let facts = group.facts.iter().filter_map(|&one| Vocabulary::fact(&open, one)).collect();
        (facts, group.exactly)
    };
    Ok(Some(Catalogue {
        variables: changeable.map(choice).collect(),
        groups: vocabulary.groups.iter().map(group).collect(),
    }))
}

/// Why there is no catalogue.
#[derive(Debug)]
pub enum CatalogueError {
    /// The planner does not plan this.
    Unsupported(Unsupported),
    /// It did not come to its end.
    Unfinished(Unfinished),
}
