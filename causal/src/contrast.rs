//! A situation in which success is unlikely goes in; the nearest situations in which it is likely come out (thesis algorithm 2).
//!
//! The search goes from the situation outwards, one interval or one word of one variable at a time, the cheapest first. With equal
//! costs that is algorithm 2's breadth-first search, with two of its printed lines mended: the node that goes into the queue is the
//! child, and the one that is taken out is the first. With other costs it is the weighted search that the thesis leaves to the future.
//! All answers of the least cost are found, not the first alone.
//!
//! A variable that is made of the columns of others is not moved itself: it is computed anew from what was moved.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;
use thiserror::Error;

use crate::derive::Derivation;
use crate::infer::elimination::posterior;
use crate::infer::{InferError, sever};
use crate::network::Network;
use crate::situation::{Outside, Situation, column, state, typical};
use crate::variable::{State, VariableId};

/// What is asked.
#[derive(Debug, Clone)]
pub struct Question<'a> {
    /// The model.
    pub network: &'a Network,
    /// The variable and its state that are success.
    pub goal: (VariableId, State),
    /// The situation.
    pub situation: &'a Situation,
    /// The variables that may be changed, each with the cost of a step.
    pub free: Vec<(VariableId, f64)>,
    /// Success is likely where its probability is greater (epsilon of algorithm 2).
    pub threshold: f64,
    /// A probability that comes from fewer trials is not believed.
    pub least_trials: u64,
    /// As many situations as are looked at.
    pub most: usize,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Contrast {
    /// The probability of success in the situation itself; none where it is not known.
    pub before: Option<f64>,
    /// All answers of the least cost, the most probable first. None where no success is within reach.
    pub answers: Vec<Answer>,
    /// How many situations were looked at.
    pub looked: usize,
    /// How many of them too few trials know.
    pub unsure: usize,
    /// Whether all situations that can be reached were looked at, or all up to the cost of the answers.
    pub complete: bool,
    /// The situations in the order in which they were looked at, the first one first.
    pub trace: Vec<Visit>,
}

/// A situation in which success is likely.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// What is other than in the situation, in the order of the variables.
    pub changes: Vec<Change>,
    /// The probability of success.
    pub probability: f64,
    /// What the changes cost.
    pub cost: f64,
}

/// A variable that is in another state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// The variable.
    pub variable: VariableId,
    /// Its state in the situation.
    pub from: State,
    /// Its state in the answer.
    pub to: State,
}

/// A situation that was looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Visit {
    /// What is other than in the first situation.
    pub changes: Vec<Change>,
    /// The probability of success; none where it is not known.
    pub probability: Option<f64>,
    /// What the changes cost.
    pub cost: f64,
}

/// As many visits as are kept.
const MOST_KEPT: usize = 4096;

/// Costs that differ by less are equal: sums of the same steps in another order.
const EQUAL: f64 = 1e-9;

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ContrastError {
    /// A value that is in no state of its variable.
    #[error(transparent)]
    Outside(#[from] Outside),
    /// A variable that is to be changed, and of which nothing is known.
    #[error("`{0}` may be changed, and its value in this situation is not known")]
    Missing(String),
    /// No variable that may be changed causes success.
    #[error("no variable that may be changed has to do with `{0}` in this model")]
    NothingToChange(String),
    /// An outcome that no trial has.
    #[error("`{0}` is never {1} in this model: no situation is a success")]
    NeverSucceeds(String, String),
    /// Inference failed.
    #[error(transparent)]
    Infer(#[from] InferError),
}

/// Looks for the nearest situations in which success is likely.
pub fn contrast(question: &Question) -> Result<Contrast, ContrastError> {
    let judge = Judge::new(question)?;
    let steps = &judge.free;
    let start: Vec<State> = steps.iter().map(|step| step.state).collect();
    let before = judge.probability(&start)?;
    let mut found = Contrast {
        before: before.believed(),
        answers: Vec::new(),
        looked: 1,
        unsure: usize::from(before.believed().is_none()),
        complete: true,
        trace: vec![judge.visit(&start, &start, before.believed())],
    };
    let mut costs: FxHashMap<Vec<State>, f64> = FxHashMap::default();
    costs.insert(start.clone(), 0.0);
    let mut queue = BinaryHeap::new();
    let mut number = 0;
    let mut push = |queue: &mut BinaryHeap<Waiting>, cost, node| {
        number += 1;
        queue.push(Waiting { cost, number, node });
    };
    let grow = |node: &[State], cost: f64, costs: &mut FxHashMap<Vec<State>, f64>| {
        let mut children = Vec::new();
        for (at, step) in steps.iter().enumerate() {
            for state in step.neighbours(node[at]) {
                let mut child = node.to_vec();
                child[at] = state;
                let cost = judge.cost(&start, &child).max(cost);
                if costs.get(&child).is_none_or(|&known| cost < known - EQUAL) {
                    costs.insert(child.clone(), cost);
                    children.push((cost, child));
                }
            }
        }
        children
    };
    for (cost, child) in grow(&start, 0.0, &mut costs) {
        push(&mut queue, cost, child);
    }
    let mut least = f64::INFINITY;
    while let Some(Waiting { cost, node, .. }) = queue.pop() {
        if cost > least + EQUAL {
            break;
        }
        if cost > costs[&node] + EQUAL {
            continue;
        }
        if found.looked >= question.most {
            found.complete = false;
            break;
        }
        let judged = judge.probability(&node)?;
        found.looked += 1;
        found.unsure += usize::from(judged.believed().is_none());
        if found.trace.len() < MOST_KEPT {
            found.trace.push(judge.visit(&start, &node, judged.believed()));
        }
        match judged.believed() {
            Some(probability) if probability > question.threshold => {
                least = least.min(cost);
                let changes = judge.changes(&start, &node);
                found.answers.push(Answer { changes, probability, cost });
            }
            _ if cost < least - EQUAL => {
                for (cost, child) in grow(&node, cost, &mut costs) {
                    push(&mut queue, cost, child);
                }
            }
            _ => {}
        }
    }
    found.answers.sort_by(|one, other| other.probability.total_cmp(&one.probability));
    Ok(found)
}

/// The situation after an answer: intervals by their middle, series by the whole centroid, words as they are. What is not changed keeps
/// its value (algorithm 3).
pub fn corrected(network: &Network, situation: &Situation, changes: &[Change]) -> Situation {
    let mut after = situation.clone();
    for change in changes {
        let variable = network.variable(change.variable);
        after.insert(column(variable).to_owned(), typical(variable, change.to));
    }
    after
}

/// How probable success is in a situation, as it is.
pub fn probability(question: &Question) -> Result<Option<f64>, ContrastError> {
    let judge = Judge::new(question)?;
    let start: Vec<State> = judge.free.iter().map(|step| step.state).collect();
    Ok(judge.probability(&start)?.believed())
}

/// A situation that waits to be looked at.
struct Waiting {
    cost: f64,
    number: usize,
    node: Vec<State>,
}

impl Ord for Waiting {
    /// The cheapest first, and of those the one that came first.
    fn cmp(&self, other: &Self) -> Ordering {
        let near = (self.cost - other.cost).abs() < EQUAL;
        let by_cost = if near { Ordering::Equal } else { other.cost.total_cmp(&self.cost) };
        by_cost.then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

/// A variable that may be changed.
struct Step {
    variable: VariableId,
    /// Its state in the situation.
    state: State,
    cost: f64,
    arity: usize,
    ordered: bool,
}

impl Step {
    /// The states that are one step away: the intervals beside this one, or any other word.
    fn neighbours(&self, state: State) -> Vec<State> {
        let all = (0..self.arity).map(|one| one as State);
        let near =
            |one: &State| if self.ordered { one.abs_diff(state) == 1 } else { *one != state };
        all.filter(near).collect()
    }
}

/// A probability, and the trials that it comes from.
#[derive(Debug, Clone, Copy)]
struct Judged {
    probability: Option<f64>,
    enough: bool,
}

impl Judged {
    fn believed(self) -> Option<f64> {
        self.probability.filter(|_| self.enough)
    }
}

/// Says how probable success is when some variables are set.
struct Judge<'a> {
    question: &'a Question<'a>,
    /// The model in which nothing causes what is set.
    network: Network,
    /// What causes success.
    causes: Vec<VariableId>,
    free: Vec<Step>,
    /// What is seen and not changed.
    fixed: Vec<(VariableId, State)>,
    /// What is computed from what is changed.
    made: Vec<(VariableId, &'a Derivation)>,
    known: RefCell<FxHashMap<Vec<(VariableId, State)>, Judged>>,
}

impl<'a> Judge<'a> {
    fn new(question: &'a Question<'a>) -> Result<Self, ContrastError> {
        let network = question.network;
        let (goal, success) = question.goal;
        let goal_variable = network.variable(goal);
        let arity = goal_variable.arity();
        let table = network.table(goal);
        if table.probabilities.chunks_exact(arity).all(|row| row[usize::from(success)] <= 0.0) {
            let (name, state) = (goal_variable.name.clone(), goal_variable.label(success));
            return Err(ContrastError::NeverSucceeds(name, state));
        }
        let mut causes = network.graph().ancestors([goal]);
        causes.retain(|&id| id != goal);
        let is_free = |id: VariableId| question.free.iter().any(|&(other, _)| other == id);
        let name = |id: VariableId| network.variable(id).name.as_str();
        let mut made: Vec<(VariableId, &'a Derivation)> = Vec::new();
        for &id in &causes {
            if let Some(from) = &network.variable(id).from {
                let columns = from.columns();
                if !is_free(id)
                    && question.free.iter().any(|&(free, _)| columns.contains(&name(free)))
                {
                    made.push((id, from));
                }
            }
        }
        let mut free = Vec::new();
        for &(id, cost) in &question.free {
            let matters = causes.contains(&id)
                || made.iter().any(|(_, from)| from.columns().contains(&name(id)));
            if id == goal || !matters {
                continue;
            }
            let variable = network.variable(id);
            let Some(state) = state(variable, question.situation)? else {
                return Err(ContrastError::Missing(variable.name.clone()));
            };
            let ordered = variable.is_ordered();
            free.push(Step { variable: id, state, cost, arity: variable.arity(), ordered });
        }
        if free.is_empty() {
            return Err(ContrastError::NothingToChange(goal_variable.name.clone()));
        }
        // What follows from what is changed is not known any more.
        let moved: Vec<VariableId> =
            free.iter().map(|step| step.variable).chain(made.iter().map(|&(id, _)| id)).collect();
        let follows = |id: VariableId| {
            let before = network.graph().ancestors([id]);
            moved.iter().any(|one| before.contains(one))
        };
        let mut fixed = Vec::new();
        for &id in &causes {
            if moved.contains(&id) || follows(id) {
                continue;
            }
            if let Some(state) = state(network.variable(id), question.situation)? {
                fixed.push((id, state));
            }
        }
        let network = sever(network, &moved);
        let known = RefCell::default();
        Ok(Self { question, network, causes, free, fixed, made, known })
    }

    /// The probability of success when the free variables are in these states.
    fn probability(&self, node: &[State]) -> Result<Judged, ContrastError> {
        let mut evidence = self.fixed.clone();
        for (step, &state) in self.free.iter().zip(node) {
            if self.causes.contains(&step.variable) {
                evidence.push((step.variable, state));
            }
        }
        if !self.made.is_empty() {
            let changes = self.changes(&self.start(), node);
            let after = corrected(self.question.network, self.question.situation, &changes);
            for &(id, _) in &self.made {
                match state(self.question.network.variable(id), &after) {
                    Ok(Some(state)) => evidence.push((id, state)),
                    Ok(None) => {}
                    // A value that no trial had is one of which nothing is known.
                    Err(_) => return Ok(Judged { probability: None, enough: false }),
                }
            }
        }
        evidence.sort_unstable();
        if let Some(&judged) = self.known.borrow().get(&evidence) {
            return Ok(judged);
        }
        let judged = self.judge(&evidence)?;
        self.known.borrow_mut().insert(evidence, judged);
        Ok(judged)
    }

    fn judge(&self, evidence: &[(VariableId, State)]) -> Result<Judged, ContrastError> {
        let (goal, success) = self.question.goal;
        let network = &self.network;
        let seen = |id: &VariableId| {
            evidence.iter().find(|(other, _)| other == id).map(|&(_, state)| state)
        };
        let parents = network.graph().parents(goal);
        let states: Vec<Option<State>> = parents.iter().map(seen).collect();
        // The rows that agree with the evidence, and how many trials they have together.
        let rows = match states.iter().copied().collect::<Option<Vec<State>>>() {
            Some(states) => vec![network.row_of(goal, &states)],
            None => (0..network.rows(goal).expect("the rows of a network are numbered"))
                .filter(|&row| {
                    let own = network.states_of(goal, row);
                    own.iter()
                        .zip(&states)
                        .all(|(state, seen)| seen.is_none_or(|one| one == *state))
                })
                .collect(),
        };
        let counts: Option<Vec<&[u64]>> =
            rows.into_iter().map(|row| network.counts(goal, row)).collect();
        let trials = counts.map(|rows| rows.into_iter().flatten().sum::<u64>());
        let enough = trials.is_none_or(|trials| trials >= self.question.least_trials);
        let probability = match posterior(network, goal, evidence) {
            Ok(probabilities) => Some(probabilities[usize::from(success)]),
            Err(InferError::Unknown { .. } | InferError::Impossible) => None,
            Err(error) => return Err(error.into()),
        };
        Ok(Judged { probability, enough })
    }

    fn start(&self) -> Vec<State> {
        self.free.iter().map(|step| step.state).collect()
    }

    fn cost(&self, start: &[State], node: &[State]) -> f64 {
        let steps = self.free.iter().zip(start.iter().zip(node));
        steps
            .map(|(step, (from, to))| {
                let steps = if step.ordered { from.abs_diff(*to) } else { u8::from(from != to) };
                f64::from(steps) * step.cost
            })
            .sum()
    }

    fn changes(&self, start: &[State], node: &[State]) -> Vec<Change> {
        let mut changes: Vec<Change> = self
            .free
            .iter()
            .zip(start.iter().zip(node))
            .filter(|(_, (from, to))| from != to)
            .map(|(step, (&from, &to))| Change { variable: step.variable, from, to })
            .collect();
        changes.sort_by_key(|change| change.variable);
        changes
    }

    fn visit(&self, start: &[State], node: &[State], probability: Option<f64>) -> Visit {
        Visit { changes: self.changes(start, node), probability, cost: self.cost(start, node) }
    }
}
