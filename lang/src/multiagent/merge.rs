//! A valid joint plan goes in; one that leads to the same end in fewer joint steps comes out.
//!
//! Each joint step moves forward to the earliest joint step that it can become a part of: the parts must be able to act together there,
//! all that comes after must stay applicable, and the state in the end must be the same.

use crate::execute::joint::Concurrency;
use crate::execute::{Executor, State};
use crate::plan::{JointPlan, Step};

/// How far back a joint step may move, so that long plans take no longer than they must.
const FARTHEST: usize = 64;

/// Moves joint steps of `plan` together, in joint steps of at most `size` parts.
pub fn merge(
    executor: &Executor<'_>,
    plan: &JointPlan,
    concurrency: Concurrency,
    size: usize,
) -> JointPlan {
    let mut merger =
        Merger { executor, concurrency, states: vec![executor.initial()], steps: Vec::new() };
    for parts in &plan.steps {
        if !merger.join(parts, size) {
            let mut state = merger.last().clone();
            executor.apply_joint(&mut state, parts);
            merger.steps.push(parts.clone());
            merger.states.push(state);
        }
    }
    JointPlan { steps: merger.steps }
}

struct Merger<'a> {
    executor: &'a Executor<'a>,
    concurrency: Concurrency,
    /// The state before each joint step, and the one behind the last.
    states: Vec<State>,
    steps: Vec<Vec<Step>>,
}

impl Merger<'_> {
    fn last(&self) -> &State {
        self.states.last().expect("the initial state is there")
    }

    /// Takes up `parts` into an earlier joint step; false if there is none that can.
    fn join(&mut self, parts: &[Step], size: usize) -> bool {
        let mut wanted = self.last().clone();
        self.executor.apply_joint(&mut wanted, parts);
        let wanted = wanted.facts();
        let first = self.steps.len().saturating_sub(FARTHEST);
        for at in first..self.steps.len() {
            let busy = self.steps[at].iter().any(|one| {
                parts.iter().any(|other| self.executor.agent(one) == self.executor.agent(other))
            });
            if busy || self.steps[at].len() + parts.len() > size {
                continue;
            }
            let mut joined = self.steps[at].clone();
            joined.extend(parts.iter().cloned());
            if let Some(states) = self.follow(at, &joined, &wanted) {
                self.steps[at] = joined;
                self.states.truncate(at + 1);
                self.states.extend(states);
                return true;
            }
        }
        false
    }

    /// The states behind `joined` in place of the joint step `at` and behind all that follow, if all goes through and ends as wanted.
    fn follow(
        &self,
        at: usize,
        joined: &[Step],
        wanted: &[crate::model::Fact],
    ) -> Option<Vec<State>> {
        let mut state = self.states[at].clone();
        let mut states = Vec::new();
        let rest = self.steps[at + 1..].iter().map(Vec::as_slice);
        for parts in std::iter::once(joined).chain(rest) {
            self.executor.join(&state, parts, self.concurrency).ok()?;
            self.executor.apply_joint(&mut state, parts);
            states.push(state.clone());
        }
        (state.facts() == wanted).then_some(states)
    }
}
