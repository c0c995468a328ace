//! A task and a configuration go in; plans leave through a callback, and what is certain about the task comes out.
//!
//! Every engine is deterministic: equal task, configuration and seed give equal plans. None reads a clock: [`Limits`] tells them to stop.

pub mod node;
pub mod astar;
pub mod eager;
pub mod lazy;
pub mod breadth;
pub mod novelty;

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use crate::axioms::Evaluator;
use crate::heuristics::{Costs, DEAD_END, Kind};
use crate::limits::{Limits, Stop};
use crate::random::Random;
use crate::registry::StateId;
use crate::space::Space;
use crate::task::{OperatorId, Task};

/// What to search with.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Strategy {
    /// What [`choose`] takes for optimal plans.
    Optimal,
    /// What [`choose`] takes for a first plan.
    #[default]
    First,
    /// A* with re-opening.
    AStar(Kind),
    /// Greedy best-first, eager.
    Eager(Kind),
    /// Greedy best-first, lazy, with preferred operators.
    Lazy(Kind),
    /// Breadth-first.
    Breadth,
    /// Best-first width search.
    Novelty,
}

/// A configuration.
#[derive(Debug, Clone, Default)]
pub struct Config {
    /// What to search with.
    pub strategy: Strategy,
    /// Whether to go on for cheaper plans after the first.
    pub anytime: bool,
    /// Where randomness is used, it starts here.
    pub seed: u64,
    /// Where to count along, for someone who watches.
    pub progress: Option<Arc<Progress>>,
}

/// Counters that another thread may read while the search runs. Brought up to date every few hundred expansions.
#[derive(Debug, Default)]
pub struct Progress {
    /// States expanded.
    pub expanded: AtomicU64,
    /// States evaluated.
    pub evaluated: AtomicU64,
    /// States registered.
    pub registered: AtomicU64,
    /// The lower bound on the cost that A* has reached, or the smallest estimate that a greedy search has seen.
    pub reached: AtomicU32,
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// There is a plan: it went through the callback.
    Solved,
    /// There is none: the space of reachable states is exhausted.
    Unsolvable,
    /// None was found, and that proves nothing: costs grew beyond what a node can hold.
    Incomplete,
    /// None was found within the budget.
    Spent,
    /// None was found before the search was told to stop.
    Stopped(Stop),
}

/// How a search ended, and what it did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
    /// Whether the cheapest of the plans that went through the callback is proved to be an optimal one.
    pub optimal: bool,
    /// What it did.
    pub statistics: Statistics,
}

/// What a search did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// States expanded.
    pub expanded: u64,
    /// Of these, expanded before A* began with its last value of f: those that any tie-breaking expands.
    pub expanded_before_last: u64,
    /// Evaluations of a heuristic.
    pub evaluated: u64,
    /// Successors generated.
    pub generated: u64,
    /// States expanded again over a cheaper way.
    pub reopened: u64,
    /// States found to be dead ends.
    pub dead_ends: u64,
    /// Different states seen.
    pub registered: u64,
    /// The estimate of the initial state; `None` where it is a dead end or was not estimated.
    pub initial_h: Option<u32>,
}

/// An engine, as listed for users.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Profile {
    /// As it is called on the command line.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Whether its plans are optimal, given an admissible heuristic.
    pub optimal: bool,
}

/// The profiles of all engines.
pub fn list() -> Vec<Profile> {
    vec![
        astar::profile(),
        eager::profile(),
        lazy::profile(),
        breadth::profile(),
        novelty::profile(),
    ]
}

/// The strategy that is run for a configuration: one that names an engine.
///
/// Optimal plans come from A* with LM-cut, which keeps its promises under conditional effects and axioms. Only where axioms hide the goal from it, so that
/// it says no more of the initial state than that some operator is needed, the blind search is taken: it looks at ten times as many states a second.
pub fn choose(task: &Task, strategy: Strategy) -> Strategy {
    match strategy {
        Strategy::Optimal if task.has_axioms() => {
            let mut values = task.initial_state.clone();
            Evaluator::new(task).evaluate(&mut values);
            let estimate = |kind: Kind| kind.build(task, Costs::Metric).evaluate(&values);
            let tells_nothing = estimate(Kind::LmCut) <= estimate(Kind::Blind);
            Strategy::AStar(if tells_nothing { Kind::Blind } else { Kind::LmCut })
        }
        Strategy::Optimal => Strategy::AStar(Kind::LmCut),
        Strategy::First => Strategy::Lazy(Kind::Ff),
        named => named,
    }
}

/// How many states a heuristic is tuned on, and how far from the initial state they are at most.
const WALKS: usize = 40;
const STEPS: u64 = 30;

/// Searches for plans. Each plan that is cheaper than those before goes to `on_plan` with its cost.
pub fn run(
    task: &Task,
    config: &Config,
    limits: &Limits,
    on_plan: &mut dyn FnMut(&[OperatorId], u64),
) -> Outcome {
    run_in_turns(task, config, limits, on_plan, u64::MAX, &mut || None)
}

/// As [`run`], but when it has done the work `budget` it asks `more` how much it may do on top; without an answer it gives up.
///
/// Work is counted, not timed: an evaluation of a heuristic is as much as the task has operators, other things are measured by that.
pub fn run_in_turns(
    task: &Task,
    config: &Config,
    limits: &Limits,
    on_plan: &mut dyn FnMut(&[OperatorId], u64),
    budget: u64,
    more: &mut dyn FnMut() -> Option<u64>,
) -> Outcome {
    let mut run = Run {
        limits,
        progress: config.progress.as_deref(),
        budget,
        work: 0,
        more,
        statistics: Statistics::default(),
        on_plan,
        best: None,
        overflow: false,
    };
    let strategy = choose(task, config.strategy);
    let mut end = first(task, strategy, config, &mut run);
    let mut optimal = end == End::Solved
        && match strategy {
            Strategy::AStar(kind) => kind.profile().admissible,
            Strategy::Breadth => !task.uses_metric,
            _ => false,
        };
    if config.anytime && end == End::Solved && !optimal {
        end = improve(task, &mut run);
        optimal = end == End::Exhausted && !run.overflow;
    }
    let status = match end {
        _ if run.best.is_some() => Status::Solved,
        End::Stopped(stop) => Status::Stopped(stop),
        End::Spent => Status::Spent,
        _ if run.overflow => Status::Incomplete,
        _ => Status::Unsolvable,
    };
    Outcome { status, optimal, statistics: run.statistics }
}

/// Runs the engine that `strategy` names until its first plan.
fn first(task: &Task, strategy: Strategy, config: &Config, run: &mut Run) -> End {
    let mut space = Space::new(task);
    let end = match strategy {
        Strategy::AStar(kind) => {
            let mut heuristic = kind.build(task, Costs::Metric);
            heuristic.tune(&space.sample(WALKS, STEPS, &mut Random::new(config.seed)));
            astar::search(&mut space, heuristic.as_mut(), 1, run)
        }
        Strategy::Eager(kind) => {
            let mut heuristic = kind.build(task, Costs::Unit);
            eager::search(&mut space, heuristic.as_mut(), run)
        }
        Strategy::Lazy(kind) => {
            let mut heuristics = [kind.build(task, Costs::Unit)];
            lazy::search(
                &mut space,
                &mut heuristics,
                lazy::Options { weight: None, costs: Costs::Unit },
                run,
            )
        }
        Strategy::Novelty => novelty::search(&mut space, run),
        _ => breadth::search(&mut space, run),
    };
    run.statistics.registered += space.len() as u64;
    end
}

/// The weights of the searches for cheaper plans, as LAMA has them (Richter, Thayer and Ruml, ICAPS 2010). The last is kept until nothing is left.
const WEIGHTS: [u32; 4] = [5, 3, 2, 1];

/// Looks for cheaper plans, each time from the start, without any state that costs as much as the best plan.
/// Ends only when told to, or when there is no cheaper plan.
fn improve(task: &Task, run: &mut Run) -> End {
    if run.best == Some(0) {
        return End::Exhausted;
    }
    // An operator that costs nothing still is a step to the heuristic, or it would see no difference along a plateau of them.
    let mut heuristics = [Kind::Ff.build(task, Costs::PlusOne)];
    let mut weights = WEIGHTS.into_iter();
    let mut weight = WEIGHTS[0];
    loop {
        weight = weights.next().unwrap_or(weight);
        let mut space = Space::new(task);
        let options = lazy::Options { weight: Some(weight), costs: Costs::Metric };
        let end = lazy::search(&mut space, &mut heuristics, options, run);
        run.statistics.registered += space.len() as u64;
        if end != End::Solved {
            return end;
        }
    }
}

/// Why an engine returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// It found a plan.
    Solved,
    /// Nothing is left to expand.
    Exhausted,
    /// It has used up its budget.
    Spent,
    /// It was told to stop.
    Stopped(Stop),
}

/// What all engines of a run share.
struct Run<'a> {
    limits: &'a Limits,
    progress: Option<&'a Progress>,
    /// How much work may be done, and how much has been.
    budget: u64,
    work: u64,
    more: &'a mut dyn FnMut() -> Option<u64>,
    statistics: Statistics,
    on_plan: &'a mut dyn FnMut(&[OperatorId], u64),
    /// The cost of the cheapest plan so far.
    best: Option<u64>,
    /// Whether a state was left out because its cost does not fit a node.
    overflow: bool,
}

impl Run<'_> {
    /// Whether to stop; to be asked at every expansion.
    #[inline]
    fn stopped(&mut self, space: &Space) -> Option<End> {
        if self.statistics.expanded.is_multiple_of(256) {
            self.publish(space);
        }
        self.work += space.task().operators.len() as u64 + 1;
        if self.work >= self.budget {
            self.publish(space);
            match (self.more)() {
                Some(more) => self.budget = self.budget.saturating_add(more),
                None => return Some(End::Spent),
            }
        }
        self.limits.stopped().map(End::Stopped)
    }

    fn publish(&self, space: &Space) {
        if let Some(progress) = self.progress {
            progress.expanded.store(self.statistics.expanded, Ordering::Relaxed);
            progress.evaluated.store(self.statistics.evaluated, Ordering::Relaxed);
            progress.registered.store(space.len() as u64, Ordering::Relaxed);
        }
    }

    /// Says which bound or estimate is reached.
    fn reached(&self, value: u32) {
        if let Some(progress) = self.progress {
            progress.reached.store(value, Ordering::Relaxed);
        }
    }

    /// Notes the estimate of the initial state.
    fn initial(&mut self, estimate: u32) {
        self.statistics.evaluated += 1;
        if self.statistics.evaluated == 1 {
            self.statistics.initial_h = (estimate != DEAD_END).then_some(estimate);
        }
        if estimate == DEAD_END {
            self.statistics.dead_ends += 1;
        } else {
            self.reached(estimate);
        }
    }

    /// Reads the plan to `goal` off and hands it on, if it is cheaper than those before.
    fn solved(
        &mut self,
        space: &mut Space,
        goal: StateId,
        parent: impl Fn(StateId) -> StateId,
    ) -> End {
        let plan = space.trace(goal, parent);
        let cost = plan
            .iter()
            .map(|operator| u64::from(space.task().operators[operator.index()].cost))
            .sum();
        if self.best.is_none_or(|best| cost < best) {
            self.best = Some(cost);
            (self.on_plan)(&plan, cost);
        }
        End::Solved
    }

    /// Whether a plan of at least this cost is of no use.
    #[inline]
    fn is_too_much(&self, cost: u64) -> bool {
        self.best.is_some_and(|best| cost >= best)
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Optimal => formatter.write_str("optimal"),
            Self::First => formatter.write_str("first"),
            Self::AStar(kind) => write!(formatter, "astar({})", kind.profile().name),
            Self::Eager(kind) => write!(formatter, "eager({})", kind.profile().name),
            Self::Lazy(kind) => write!(formatter, "lazy({})", kind.profile().name),
            Self::Breadth => formatter.write_str("breadth"),
            Self::Novelty => formatter.write_str("bfws"),
        }
    }
}

impl FromStr for Strategy {
    type Err = String;

    /// Reads what [`fmt::Display`] writes: `optimal`, `breadth`, `bfws`, `astar(lmcut)`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, heuristic) = match text.strip_suffix(')').and_then(|text| text.split_once('(')) {
            Some((name, heuristic)) => {
                let kind = Kind::named(heuristic)
                    .ok_or_else(|| format!("there is no heuristic `{heuristic}`"))?;
                (name, Some(kind))
            }
            None => (text, None),
        };
        match (name, heuristic) {
            ("optimal", None) => Ok(Self::Optimal),
            ("first", None) => Ok(Self::First),
            ("breadth", None) => Ok(Self::Breadth),
            ("bfws", None) => Ok(Self::Novelty),
            ("astar", Some(kind)) => Ok(Self::AStar(kind)),
            ("eager", Some(kind)) => Ok(Self::Eager(kind)),
            ("lazy", Some(kind)) => Ok(Self::Lazy(kind)),
            _ => Err(format!("there is no search `{text}`")),
        }
    }
}
