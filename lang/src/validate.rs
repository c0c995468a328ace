//! A plan goes in; whether it is valid, and the story of its failure if it is not, come out.
//!
//! Everything rests on [`crate::execute`] alone.

mod words;
mod explain;
mod repair;
mod told;
mod story;
pub mod joint;

use rust_decimal::Decimal;

use explain::Site;
pub use explain::{Part, What};
pub use repair::Repair;
pub use story::{lines, story};

use crate::execute::{Change, Executor, Misfit, State, Undefined, Unstratified, bind};
use crate::model::{Domain, Problem};
use crate::plan::Plan;
use crate::source::Span;

/// What there is to say about a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Every step is applicable where it comes, and the goal holds in the end.
    Valid(Success),
    /// It fails.
    Invalid(Failure),
}

/// What a valid plan costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Success {
    /// How many steps it has.
    pub steps: usize,
    /// The sum of the steps' costs.
    pub cost: Decimal,
    /// The metric's value in the end: the cost and the initial value of the metric's function.
    pub value: Decimal,
}

/// Where a plan fails. Steps are counted from 0 here, and from 1 in what a person reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// At this step.
    Step(usize),
    /// Behind the last step, where the goal does not hold.
    Goal,
}

/// Why it fails there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cause {
    /// The step is not an instance of its action.
    Misfit(Misfit),
    /// The step's cost is not defined.
    Undefined(Undefined),
    /// These parts of the condition are false.
    False(Vec<Part>),
}

/// Why a plan is not valid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Where it fails.
    pub place: Place,
    /// Why.
    pub cause: Cause,
    /// The false part of the precondition or of the goal, the first of several; else the action's name.
    pub span: Span,
    /// What would mend it.
    pub repair: Repair,
}

/// Executes `plan` step by step and then asks for the goal.
pub fn validate(domain: &Domain, problem: &Problem, plan: &Plan) -> Result<Verdict, Unstratified> {
    Ok(judge(&Executor::new(domain, problem)?, plan))
}

/// As [`validate`], with an executor that may serve for many plans.
pub fn judge(executor: &Executor<'_>, plan: &Plan) -> Verdict {
    let mut run = Run { executor, plan, state: executor.initial(), history: Vec::new() };
    match run.execute() {
        Ok(success) => Verdict::Valid(success),
        Err((place, cause)) => Verdict::Invalid(run.failure(place, cause)),
    }
}

/// Whether `plan` is valid, without any reasons.
pub fn is_valid(executor: &Executor<'_>, plan: &Plan) -> bool {
    Run { executor, plan, state: executor.initial(), history: Vec::new() }.execute().is_ok()
}

/// A plan under execution.
#[derive(Debug)]
struct Run<'a> {
    executor: &'a Executor<'a>,
    plan: &'a Plan,
    state: State,
    /// What each step so far has changed.
    history: Vec<Change>,
}

impl Run<'_> {
    fn execute(&mut self) -> Result<Success, (Place, Option<Cause>)> {
        let executor = self.executor;
        let mut cost = Decimal::ZERO;
        for (at, step) in self.plan.steps.iter().enumerate() {
            let place = Place::Step(at);
            executor.fits(step).map_err(|misfit| (place, Some(Cause::Misfit(misfit))))?;
            if !executor.applicable(&self.state, step) {
                return Err((place, None));
            }
            let step_cost = executor.cost(&self.state, step);
            cost = cost.saturating_add(
                step_cost.map_err(|undefined| (place, Some(Cause::Undefined(undefined))))?,
            );
            self.history.push(executor.apply(&mut self.state, step));
        }
        if !executor.goal(&self.state) {
            return Err((Place::Goal, None));
        }
        let value = cost.saturating_add(executor.initial_value());
        Ok(Success { steps: self.plan.steps.len(), cost, value })
    }

    /// The condition at `place`.
    fn site(&self, place: Place) -> Site<'_> {
        let problem = self.executor.problem();
        let (scope, formula, binding) = match place {
            Place::Step(at) => {
                let step = &self.plan.steps[at];
                let action = &self.executor.domain().actions[step.action.index()];
                (&action.scope, &action.precondition, bind(&action.scope, step))
            }
            Place::Goal => {
                let scope = &problem.goal_scope;
                (scope, &problem.goal, vec![None; scope.variables.len()])
            }
        };
        let (executor, state, history) = (self.executor, &self.state, &self.history);
        Site { executor, state, history, scope, formula, binding, joint: None }
    }

    fn failure(&self, place: Place, cause: Option<Cause>) -> Failure {
        let executor = self.executor;
        if let Some(cause) = cause {
            let Place::Step(at) = place else {
                unreachable!("only a condition can fail at the goal")
            };
            let action = &executor.domain().actions[self.plan.steps[at].action.index()];
            let span = match &cause {
                Cause::Undefined(undefined) => undefined.span,
                Cause::Misfit(_) | Cause::False(_) => action.name.span,
            };
            return Failure { place, cause, span, repair: Repair::None };
        }
        let parts = explain::parts(&self.site(place));
        let span = parts.first().expect("a condition that fails has a false part").span;
        let repair = repair::search(self, place, &parts);
        Failure { place, cause: Cause::False(parts), span, repair }
    }
}
