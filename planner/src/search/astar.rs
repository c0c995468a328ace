//! A* (Hart, Nilsson and Raphael 1968): expands by f = g + w·h, and a state again when a cheaper way to it turns up.
//!
//! Ties: of equal f the smaller h first, of equal h the newest first, which dives through plateaus of operators that cost nothing
//! (Asai and Fukunaga, AAAI 2016). With weight 1 and an admissible heuristic the plan is optimal, whether the heuristic is consistent or not.
//! A state's estimate is raised to that of the parent less the operator's cost (pathmax, Méro 1984), which keeps it admissible.

use super::node::{MOST_COST, Node, Nodes, Status};
use super::{End, Profile, Run};
use crate::heuristics::{DEAD_END, Heuristic};
use crate::open::{Open, Order};
use crate::registry::StateId;
use crate::segmented::Segmented;
use crate::space::Space;
use crate::task::OperatorId;

/// How it is listed.
pub fn profile() -> Profile {
    Profile {
        name: "astar",
        summary: "A* with re-opening; ties go to the smaller estimate, then to the newest",
        source: "Hart, Nilsson and Raphael 1968",
        optimal: true,
    }
}

/// What A* holds besides the space.
struct Frontier {
    nodes: Nodes,
    open: Open<u32>,
    /// Estimates by state; empty where the heuristic is constant.
    estimates: Segmented<u32>,
    weight: u32,
}

impl Frontier {
    #[inline]
    fn push(&mut self, state: StateId, cost: u32, estimate: u32) {
        self.open
            .push((cost.saturating_add(estimate.saturating_mul(self.weight)), estimate), state.0);
    }

    /// The estimate of a known state; `None` if it is still to be evaluated.
    #[inline]
    fn estimate(&self, space: &mut Space, state: StateId, constant: Option<u32>) -> Option<u32> {
        match constant {
            Some(constant) => Some(if space.is_goal_state(state) { 0 } else { constant }),
            None => {
                (state.index() < self.estimates.len()).then(|| self.estimates.get(state.index()))
            }
        }
    }
}

/// Runs until a plan is found. States whose cost reaches that of a plan found before are left out, and so are those whose estimate added to it does,
/// if the heuristic is admissible.
pub(super) fn search(
    space: &mut Space,
    heuristic: &mut dyn Heuristic,
    weight: u32,
    run: &mut Run,
) -> End {
    let mut frontier = Frontier {
        nodes: Nodes::default(),
        open: Open::new(Order::Lifo),
        estimates: Segmented::new(0),
        weight,
    };
    let task = space.task();
    let mut values = task.initial_state.clone();
    let mut child_values = values.clone();
    let mut operators: Vec<OperatorId> = Vec::new();
    let mut fresh: Vec<(StateId, OperatorId)> = Vec::new();
    let constant = heuristic.constant();
    let initial = space.initial();
    space.load(initial, &mut values);
    let estimate = heuristic.evaluate(&values);
    run.initial(estimate);
    if estimate == DEAD_END {
        return End::Exhausted;
    }
    frontier.nodes.set(initial, Node { status: Status::Open, cost: 0, parent: initial });
    if constant.is_none() {
        frontier.estimates.push(estimate);
    }
    frontier.push(initial, 0, estimate);
    let mut bound = 0;
    while let Some(((f, own_estimate), state)) = frontier.open.pop() {
        let state = StateId(state);
        let node = frontier.nodes.get(state);
        if node.status != Status::Open {
            continue;
        }
        if let Some(end) = run.stopped(space) {
            return end;
        }
        if f > bound {
            bound = f;
            run.reached(bound);
            run.statistics.expanded_before_last = run.statistics.expanded;
        }
        space.load(state, &mut values);
        frontier.nodes.set(state, Node { status: Status::Closed, ..node });
        if space.is_goal(&values) {
            return run.solved(space, state, |state| frontier.nodes.parent(state));
        }
        run.statistics.expanded += 1;
        space.applicable(&values, &mut operators);
        fresh.clear();
        for &operator in &operators {
            run.statistics.generated += 1;
            let cost = node.cost.saturating_add(task.operators[operator.index()].cost);
            if cost > MOST_COST {
                run.overflow = true;
                continue;
            }
            if run.is_too_much(u64::from(cost)) {
                continue;
            }
            let (child, is_new) = space.successor(state, &values, operator);
            if is_new {
                frontier.nodes.set(child, Node { status: Status::Open, cost, parent: state });
                fresh.push((child, operator));
                continue;
            }
            let known = frontier.nodes.get(child);
            if known.status != Status::DeadEnd && cost < known.cost {
                run.statistics.reopened += u64::from(known.status == Status::Closed);
                frontier.nodes.set(child, Node { status: Status::Open, cost, parent: state });
                if let Some(estimate) = frontier.estimate(space, child, constant) {
                    frontier.push(child, cost, estimate);
                }
            }
        }
        // Evaluated together: a heuristic may share work among successors, which pays from two on.
        let shares = fresh.len() > 1 && constant.is_none();
        if shares {
            heuristic.enter(&values);
        }
        for &(child, operator) in &fresh {
            let estimate = if let Some(estimate) = frontier.estimate(space, child, constant) {
                estimate
            } else {
                if let Some(end) = run.stopped(space) {
                    return end;
                }
                space.load(child, &mut child_values);
                run.statistics.evaluated += 1;
                let estimate = if shares {
                    heuristic.evaluate_child(operator, &child_values)
                } else {
                    heuristic.evaluate(&child_values)
                };
                let least = own_estimate.saturating_sub(task.operators[operator.index()].cost);
                let estimate = if weight == 1 { estimate.max(least) } else { estimate };
                frontier.estimates.push(estimate);
                estimate
            };
            let node = frontier.nodes.get(child);
            if estimate == DEAD_END {
                run.statistics.dead_ends += 1;
                frontier.nodes.set(child, Node { status: Status::DeadEnd, ..node });
            } else {
                frontier.push(child, node.cost, estimate);
            }
        }
    }
    End::Exhausted
}
