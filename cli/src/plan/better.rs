//! A joint plan goes in; better ones come out, by other searches whose plans are merged too, and by the search for an optimal one as far as it gets.

use lang::multiagent::{Means, Objective};
use lang::plan::JointPlan;
use lang::validate::joint::{self as judge, Verdict};
use planner::heuristics::Kind;
use planner::search::{Status, Strategy};
use rust_decimal::Decimal;

use super::joint::{Planning, Stage};
use crate::pipeline;

/// Searches that often find other plans than the first one does.
const OTHERS: [Strategy; 4] = [
    Strategy::Novelty,
    Strategy::Lazy(Kind::Ff),
    Strategy::Lazy(Kind::Hadd),
    Strategy::Eager(Kind::Ff),
];

/// How much is done for a better plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// The work for each of the other searches; none are made without it.
    pub(super) others: Option<u64>,
    /// The work for the optimal search; any amount without it.
    pub(super) optimal: Option<u64>,
    /// How many operators its task may have.
    pub(super) operators: u64,
}

impl Planning<'_> {
    /// Hands each plan that is better than `best` and those before to `found`; whether the last of them is proved optimal.
    pub(super) fn improve(
        &self,
        best: &JointPlan,
        small: Option<&Stage>,
        effort: Effort,
        found: &mut dyn FnMut(&JointPlan),
    ) -> bool {
        let objective = self.objective();
        let mut least = self.measure(best, objective);
        let mut take = |plan: &JointPlan| {
            let measure = self.measure(plan, objective);
            if measure < least {
                least = measure;
                found(plan);
            }
        };
        for (strategy, stage) in
            OTHERS.into_iter().filter_map(|one| small.map(|stage| (one, stage)))
        {
            let Some(work) = effort.others else { break };
            if let (Some(plan), _) = self.bounded(stage, strategy, Some(work)) {
                take(&plan);
            }
        }
        let means = if objective == Objective::Steps { Means::Block } else { Means::Complete };
        if small.is_some_and(|stage| stage.ready.operators() > effort.operators) {
            return false;
        }
        let Ok(compiled) = self.compile(means, Some(objective)) else { return false };
        if effort.optimal.is_some()
            && pipeline::has_many_axioms(&compiled.domain, &compiled.problem)
        {
            return false;
        }
        let Ok(stage) = self.stage(compiled) else { return false };
        let strategy = Strategy::AStar(Self::bound(objective));
        let (plan, solved) = self.bounded(&stage, strategy, effort.optimal);
        if let Some(plan) = plan {
            take(&plan);
        }
        solved && stage.compiled.complete
    }

    /// The merged plan that a search finds with so much work, and whether it came to its end.
    fn bounded(
        &self,
        stage: &Stage,
        strategy: Strategy,
        work: Option<u64>,
    ) -> (Option<JointPlan>, bool) {
        let mut plan = None;
        let found = |plain| plan = Some(stage.compiled.decode(&plain));
        let (config, work) = (self.config(strategy), work.unwrap_or(u64::MAX));
        let end =
            pipeline::search_in_turns(&stage.ready, &config, self.watch, found, work, || None);
        (plan.map(|plan| self.merged(&plan)), end.status == Status::Solved)
    }

    /// What counts first, and what decides between equals.
    fn measure(&self, plan: &JointPlan, objective: Objective) -> (Decimal, Decimal) {
        let steps = Decimal::from(plan.steps.len());
        let actions = Decimal::from(plan.actions());
        match objective {
            Objective::Steps => (steps, actions),
            Objective::Actions => (actions, steps),
            Objective::Cost => match judge::judge(self.executor, plan, self.concurrency) {
                Verdict::Valid(success) => (success.cost, steps),
                // It will be refused, so it is no better than any.
                Verdict::Invalid(_) => (Decimal::MAX, steps),
            },
        }
    }
}
