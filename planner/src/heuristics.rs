//! The values of a state go in; an estimate of the cost from there to the goal comes out.
//!
//! One file each: it opens with the paper, and states as data what may be relied on ([`Profile`]).

pub mod blind;
pub mod goalcount;
mod queue;
mod relaxed;
pub mod hmax;
pub mod hadd;
pub mod ff;
pub mod lmcut;

use crate::task::{OperatorId, Task};

/// The estimate of a state from which the goal cannot be reached.
pub const DEAD_END: u32 = u32::MAX;

/// What may be relied on.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is an independent promise, printed as a column of its own"
)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Profile {
    /// As it is called on the command line.
    pub name: &'static str,
    /// What it estimates, in a sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Never more than the cost of a cheapest plan.
    pub admissible: bool,
    /// Falls along an operator by at most its cost.
    pub consistent: bool,
    /// Calls only such states dead ends as are.
    pub safe: bool,
    /// Keeps all of this where the task has conditional effects.
    pub conditional_effects: bool,
    /// Keeps all of this where the task has axioms.
    pub axioms: bool,
    /// Names preferred operators.
    pub preferred: bool,
}

/// Which cost an operator counts with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Costs {
    /// Its own.
    Metric,
    /// Always 1.
    Unit,
    /// Its own plus 1, unless all are 1 anyway.
    PlusOne,
}

impl Costs {
    /// The cost of `operator` as counted.
    #[inline]
    pub fn of(self, task: &Task, operator: OperatorId) -> u32 {
        let cost = task.operators[operator.index()].cost;
        match self {
            Self::Unit => 1,
            Self::PlusOne if task.uses_metric => cost.saturating_add(1),
            Self::Metric | Self::PlusOne => cost,
        }
    }
}

/// An estimator for the states of one task, with the space that it needs.
pub trait Heuristic {
    /// The estimate for a state, given the values of all variables; [`DEAD_END`] for infinity.
    fn evaluate(&mut self, values: &[u32]) -> u32;

    /// Operators that the last evaluation found helpful, in ascending order. Whoever uses them keeps to the applicable ones: a heuristic that takes
    /// negated derived facts for granted may name others.
    fn preferred(&self) -> &[OperatorId] {
        &[]
    }

    /// Says that the states evaluated next by [`Self::evaluate_child`] are successors of this one.
    fn enter(&mut self, _values: &[u32]) {}

    /// As [`Self::evaluate`], for the state after `operator` in the state entered last.
    fn evaluate_child(&mut self, _operator: OperatorId, values: &[u32]) -> u32 {
        self.evaluate(values)
    }

    /// Adapts to the task, given states like those that will be evaluated, the initial one first.
    fn tune(&mut self, _samples: &[Vec<u32>]) {}

    /// The estimate of every state that is no goal, if they all have the same.
    fn constant(&self) -> Option<u32> {
        None
    }
}

/// A heuristic by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// [`blind`].
    Blind,
    /// [`goalcount`].
    GoalCount,
    /// [`hmax`].
    Hmax,
    /// [`hadd`].
    Hadd,
    /// [`ff`].
    Ff,
    /// [`lmcut`].
    LmCut,
}

impl Kind {
    /// All, in the order of [`list`].
    pub const ALL: [Self; 6] =
        [Self::Blind, Self::GoalCount, Self::Hmax, Self::Hadd, Self::Ff, Self::LmCut];

    /// What may be relied on.
    pub fn profile(self) -> Profile {
        match self {
            Self::Blind => blind::profile(),
            Self::GoalCount => goalcount::profile(),
            Self::Hmax => hmax::profile(),
            Self::Hadd => hadd::profile(),
            Self::Ff => ff::profile(),
            Self::LmCut => lmcut::profile(),
        }
    }

    /// The heuristic of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.profile().name == name)
    }

    /// Whether it keeps its promises on this task.
    pub fn supports(self, task: &Task) -> bool {
        let profile = self.profile();
        (profile.conditional_effects || !task.has_conditional_effects())
            && (profile.axioms || !task.has_axioms())
    }

    /// Sets it up for a task.
    pub fn build(self, task: &Task, costs: Costs) -> Box<dyn Heuristic> {
        match self {
            Self::Blind => Box::new(blind::Blind::new(task, costs)),
            Self::GoalCount => Box::new(goalcount::GoalCount::new(task)),
            Self::Hmax => Box::new(hmax::Hmax::new(task, costs)),
            Self::Hadd => Box::new(hadd::Hadd::new(task, costs)),
            Self::Ff => Box::new(ff::Ff::new(task, costs)),
            Self::LmCut => Box::new(lmcut::LmCut::new(task, costs)),
        }
    }
}

/// The profiles of all heuristics.
pub fn list() -> Vec<Profile> {
    Kind::ALL.into_iter().map(Kind::profile).collect()
}
