//! The rooms of the planner in a row: a checked task goes in, plans leave through a callback, and how it ended comes out.
//!
//! This is the one place where the command line and the planner meet.

use std::time::Duration;

use lang::model::{Domain, Problem};
use lang::plan::Plan;
use planner::encode::{Decoder, Encoded};
use planner::grounded::Grounded;
use planner::normalize;
use planner::sas::write::Names;
use planner::search::{self, Config, Statistics, Status};
use planner::solve::{self, Obstacle, Prepared};
use planner::task::OperatorId;

use crate::limits::{Watch, cpu_time};

/// Whether conditions of a domain become axioms that it does not have itself, which may make grounding long.
pub fn has_many_axioms(domain: &Domain, problem: &Problem) -> bool {
    let normal = normalize::normalize(domain, problem);
    normal.is_ok_and(|normal| normal.rules.len() > domain.axioms.len())
}

/// A ground task.
#[derive(Debug)]
pub struct Task {
    /// With finite-domain variables.
    pub encoded: Encoded,
    /// Before it had them.
    pub grounded: Grounded,
    /// What its parts are called.
    pub names: Names,
}

/// A task to be searched, and the way back from its operators.
#[derive(Debug)]
pub struct Ready {
    task: planner::task::Task,
    decoder: Decoder,
}

/// How a search ended.
#[derive(Debug)]
pub struct End {
    /// With what.
    pub status: Status,
    /// Whether the last plan is proved to be an optimal one.
    pub optimal: bool,
    /// What it did.
    pub statistics: Statistics,
    /// CPU time that it took.
    pub time: Duration,
}

impl End {
    /// The same, of a task that may lack plans of what it stands for: that it has none proves nothing, nor that one is optimal in it.
    #[must_use]
    pub fn of_part(self) -> Self {
        let status =
            if self.status == Status::Unsolvable { Status::Incomplete } else { self.status };
        Self { status, optimal: false, ..self }
    }

    /// That a goal which is out of reach ends the search before it begins.
    pub fn unreachable() -> Self {
        let statistics = Statistics::default();
        Self { status: Status::Unsolvable, optimal: false, statistics, time: Duration::ZERO }
    }
}

/// Grounds a problem.
pub fn ground(domain: &Domain, problem: &Problem, watch: &Watch) -> Result<Task, Obstacle> {
    let Prepared { normal, grounded, encoded } = solve::prepare(domain, problem, &watch.limits)?;
    Ok(Task { encoded, grounded, names: Names::new(domain, problem, &normal) })
}

impl Task {
    /// Leaves only what search needs.
    pub fn ready(self) -> Ready {
        let decoder = self.encoded.decoder(self.grounded);
        Ready { task: self.encoded.task, decoder }
    }
}

impl Ready {
    /// How many operators the task has.
    pub fn operators(&self) -> u64 {
        self.task.operators.len() as u64
    }
}

/// Searches a task; every plan that is cheaper than those before goes to `found`.
pub fn search(ready: &Ready, config: &Config, watch: &Watch, found: impl FnMut(Plan)) -> End {
    search_in_turns(ready, config, watch, found, u64::MAX, || None)
}

/// As [`search()`], but after the work `budget` it asks `more` how much it may do on top, and gives up without an answer.
pub fn search_in_turns(
    ready: &Ready,
    config: &Config,
    watch: &Watch,
    mut found: impl FnMut(Plan),
    budget: u64,
    mut more: impl FnMut() -> Option<u64>,
) -> End {
    watch.searching();
    let start = cpu_time();
    let mut on_plan = |operators: &[OperatorId], _: u64| found(ready.decoder.plan(operators));
    let (task, limits) = (&ready.task, &watch.limits);
    let outcome = search::run_in_turns(task, config, limits, &mut on_plan, budget, &mut more);
    End {
        status: outcome.status,
        optimal: outcome.optimal,
        statistics: outcome.statistics,
        time: cpu_time().saturating_sub(start),
    }
}
