//! A task goes in; its state space comes out: states by id, their values, their applicable operators, their successors.

use crate::axioms::Evaluator;
use crate::random::Random;
use crate::registry::{Registry, StateId};
use crate::state::{Packer, holds};
use crate::successor::Successors;
use crate::task::{OperatorId, Task};

/// The part of a task's state space seen so far.
#[derive(Debug, Clone)]
pub struct Space<'t> {
    task: &'t Task,
    packer: Packer,
    successors: Successors,
    axioms: Option<Evaluator>,
    registry: Registry,
    /// Words under construction.
    words: Vec<u32>,
    /// Values of a state whose goal cannot be read from its words.
    values: Vec<u32>,
}

impl<'t> Space<'t> {
    /// The space of `task`, still empty.
    pub fn new(task: &'t Task) -> Self {
        let packer = Packer::new(task);
        Self {
            task,
            successors: Successors::new(task),
            axioms: task.has_axioms().then(|| Evaluator::new(task)),
            registry: Registry::new(packer.words()),
            words: vec![0; packer.words()],
            values: task.initial_state.clone(),
            packer,
        }
    }

    /// The task.
    pub fn task(&self) -> &'t Task {
        self.task
    }

    /// How many states were seen.
    pub fn len(&self) -> usize {
        self.registry.len()
    }

    /// Whether none was seen.
    pub fn is_empty(&self) -> bool {
        self.registry.is_empty()
    }

    /// The initial state, registered.
    pub fn initial(&mut self) -> StateId {
        self.packer.pack(&self.task.initial_state, &mut self.words);
        self.registry.insert(&self.words).0
    }

    /// Writes the values of all variables, derived ones too, in `state` into `values`.
    #[inline]
    pub fn load(&mut self, state: StateId, values: &mut [u32]) {
        self.packer.unpack(self.registry.words(state), values);
        if let Some(axioms) = &mut self.axioms {
            axioms.evaluate(values);
        }
    }

    /// Replaces `found` by the operators applicable in a state with these `values`.
    #[inline]
    pub fn applicable(&self, values: &[u32], found: &mut Vec<OperatorId>) {
        found.clear();
        self.successors.applicable(values, found);
    }

    /// The state after `operator` in `state`, whose loaded values are `values`; and whether it is new.
    #[inline]
    pub fn successor(
        &mut self,
        state: StateId,
        values: &[u32],
        operator: OperatorId,
    ) -> (StateId, bool) {
        self.words.copy_from_slice(self.registry.words(state));
        self.packer.apply(self.task, operator, values, &mut self.words);
        self.registry.insert(&self.words)
    }

    /// Whether the goal holds in a state with these loaded `values`.
    #[inline]
    pub fn is_goal(&self, values: &[u32]) -> bool {
        holds(&self.task.goal, values)
    }

    /// Whether the goal holds in `state`, for those who have no values at hand.
    #[inline]
    pub fn is_goal_state(&mut self, state: StateId) -> bool {
        if let Some(goal) = self.packer.is_goal(self.registry.words(state)) {
            return goal;
        }
        let mut values = std::mem::take(&mut self.values);
        self.load(state, &mut values);
        let goal = self.is_goal(&values);
        self.values = values;
        goal
    }

    /// States along random walks from the initial state, the initial one first; without registering any. A walk that is stuck ends there.
    pub fn sample(&mut self, walks: usize, steps: u64, random: &mut Random) -> Vec<Vec<u32>> {
        let mut initial = self.task.initial_state.clone();
        if let Some(axioms) = &mut self.axioms {
            axioms.evaluate(&mut initial);
        }
        let mut samples = vec![initial];
        let mut operators = Vec::new();
        for _ in 0..walks {
            let mut values = samples[0].clone();
            for _ in 0..=random.below(steps) {
                self.applicable(&values, &mut operators);
                if operators.is_empty() {
                    break;
                }
                let operator = operators[random.below(operators.len() as u64) as usize];
                self.packer.pack(&values, &mut self.words);
                self.packer.apply(self.task, operator, &values, &mut self.words);
                self.packer.unpack(&self.words, &mut values);
                if let Some(axioms) = &mut self.axioms {
                    axioms.evaluate(&mut values);
                }
            }
            samples.push(values);
        }
        samples
    }

    /// The operators from the initial state to `state`, where `parent` gives the predecessor of each state and the initial state is its own.
    ///
    /// Nodes do not store operators: between a state and its predecessor stands the cheapest operator that leads there, the first of equals.
    pub fn trace(
        &mut self,
        mut state: StateId,
        parent: impl Fn(StateId) -> StateId,
    ) -> Vec<OperatorId> {
        let mut plan = Vec::new();
        let mut values = self.task.initial_state.clone();
        let mut operators = Vec::new();
        loop {
            let before = parent(state);
            if before == state {
                plan.reverse();
                return plan;
            }
            self.load(before, &mut values);
            self.applicable(&values, &mut operators);
            operators
                .sort_by_key(|&operator| (self.task.operators[operator.index()].cost, operator));
            let step = operators
                .iter()
                .copied()
                .find(|&operator| self.leads_to(before, &values, operator, state));
            plan.push(step.expect("a state is reached from its parent by some operator"));
            state = before;
        }
    }

    fn leads_to(
        &mut self,
        state: StateId,
        values: &[u32],
        operator: OperatorId,
        target: StateId,
    ) -> bool {
        self.words.copy_from_slice(self.registry.words(state));
        self.packer.apply(self.task, operator, values, &mut self.words);
        self.words == self.registry.words(target)
    }
}
