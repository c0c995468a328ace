//! The rooms of the planner in a row: a checked problem goes in; a task that is ready for search, or a plan, comes out.

use lang::model::{Domain, Problem};
use lang::plan::Plan;

use crate::encode::{self, Encoded};
use crate::ground::{self, Outcome};
use crate::grounded::Grounded;
use crate::invariants;
use crate::limits::{Limits, Stop};
use crate::normal::Normal;
use crate::normalize::{self, Unsupported};
use crate::search::{self, Config, Status, Strategy};

/// A task, with what it was made from.
#[derive(Debug)]
pub struct Prepared {
    /// The normal form.
    pub normal: Normal,
    /// The ground problem.
    pub grounded: Grounded,
    /// With finite-domain variables.
    pub encoded: Encoded,
}

/// Why there is no task to search.
#[derive(Debug)]
pub enum Obstacle {
    /// The planner does not plan this.
    Unsupported(Unsupported),
    /// The goal cannot be reached even when deletes are ignored.
    Unreachable,
    /// It was told to stop, while doing this.
    Stopped(Stop, &'static str),
}

/// Makes the task of a problem.
///
/// # Errors
/// Why there is none.
pub fn prepare(domain: &Domain, problem: &Problem, limits: &Limits) -> Result<Prepared, Obstacle> {
    let normal = normalize::normalize(domain, problem).map_err(Obstacle::Unsupported)?;
    let grounded = match ground::ground(domain, problem, &normal, limits) {
        Ok(Outcome::Grounded(grounded)) => *grounded,
        Ok(Outcome::Unsolvable) => return Err(Obstacle::Unreachable),
        Err(interrupted) => return Err(Obstacle::Stopped(interrupted.stop, interrupted.phase)),
    };
    let groups = invariants::groups(domain, problem, &normal, &grounded, limits);
    let encoded = encode::encode(&grounded, &groups, limits);
    let encoded = encoded.map_err(|stop| Obstacle::Stopped(stop, "making variables"))?;
    if encoded.unsolvable {
        return Err(Obstacle::Unreachable);
    }
    Ok(Prepared { normal, grounded, encoded })
}

/// What is known of a problem after a look for plans.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// There is a plan: the best that was found.
    Plan(Plan),
    /// There is none, and so much work it was to know that.
    Unsolvable(u64),
    /// None was found within the budget.
    Spent,
    /// None was found before the run was told to stop.
    Stopped(Stop),
}

/// Looks for a plan with as much work as `budget` ([`search::run_in_turns`] says what work is, [`weight`] what it is multiplied by here); with `better`,
/// goes on for cheaper ones until it is spent. Otherwise half of the budget is for a search by novelty, where it is bounded and the first search finds nothing.
///
/// # Errors
/// What the planner does not plan.
pub fn solve(
    domain: &Domain,
    problem: &Problem,
    better: bool,
    budget: u64,
    limits: &Limits,
) -> Result<Answer, Unsupported> {
    let prepared = match prepare(domain, problem, limits) {
        Ok(prepared) => prepared,
        Err(Obstacle::Unsupported(unsupported)) => return Err(unsupported),
        Err(Obstacle::Unreachable) => return Ok(Answer::Unsolvable(0)),
        Err(Obstacle::Stopped(stop, _)) => return Ok(Answer::Stopped(stop)),
    };
    let weight = weight(&prepared.grounded);
    let ways: &[Strategy] = if better || budget == u64::MAX {
        &[Strategy::First]
    } else {
        &[Strategy::First, Strategy::Novelty]
    };
    let share = budget / ways.len() as u64 / weight;
    let task = &prepared.encoded.task;
    let mut answer = Answer::Spent;
    for &strategy in ways {
        let config = Config { anytime: better, strategy, ..Config::default() };
        let mut best = None;
        let mut keep = |operators: &[_], _| best = Some(operators.to_vec());
        let end = search::run_in_turns(task, &config, limits, &mut keep, share, &mut || None);
        answer = match (best, end.status) {
            (Some(operators), _) => {
                let decoder = prepared.encoded.decoder(prepared.grounded);
                return Ok(Answer::Plan(decoder.plan(&operators)));
            }
            (None, Status::Unsolvable) => {
                let size = task.operators.len() as u64 + 1;
                Answer::Unsolvable(end.statistics.expanded * size * weight)
            }
            (None, Status::Stopped(stop)) => Answer::Stopped(stop),
            (None, _) => continue,
        };
        break;
    }
    Ok(answer)
}

/// So many effects and literals a usual operator has.
const USUAL: usize = 16;

/// How much more work the operators of a ground problem are than usual ones.
pub fn weight(grounded: &Grounded) -> u64 {
    let size = grounded.effects.len() + grounded.literals.len();
    (size / (grounded.operators.len() + 1) / USUAL).max(1) as u64
}
