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
    /// Estimates by state, unless the heuristic is constant.
    estimates: Segmented<u32>,
    weight: u32,
}

impl Frontier {
    fn push(&mut self, state: StateId, cost: u32, estimate: u32) {
        self.open
            .push((cost.saturating_add(estimate.saturating_mul(self.weight)), estimate), state.0);
    }
}

/// Runs until a plan is found. States whose cost plus estimate reach that of a plan found before are left out; with a weight that is sound only
/// for admissible heuristics, which the caller sees to.
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
    let mut values = space.task().initial_state.clone();
    let mut child_values = values.clone();
    let mut operators: Vec<OperatorId> = Vec::new();
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
    while let Some(((f, _), state)) = frontier.open.pop() {
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
        heuristic.enter(&values);
        let own_estimate =
            if constant.is_none() { frontier.estimates.get(state.index()) } else { 0 };
        for &operator in &operators {
            run.statistics.generated += 1;
            let operator_cost = space.task().operators[operator.index()].cost;
            let cost = node.cost.saturating_add(operator_cost);
            if cost > MOST_COST {
                run.overflow = true;
                continue;
            }
            if run.is_too_much(u64::from(cost)) {
                continue;
            }
            let (child, is_new) = space.successor(state, &values, operator);
            if is_new {
                let estimate = if let Some(constant) = constant {
                    if space.is_goal_state(child) { 0 } else { constant }
                } else {
                    if run.limits.stopped().is_some() {
                        break;
                    }
                    space.load(child, &mut child_values);
                    run.statistics.evaluated += 1;
                    let estimate = heuristic.evaluate_child(operator, &child_values);
                    let estimate = if weight == 1 {
                        estimate.max(own_estimate.saturating_sub(operator_cost))
                    } else {
                        estimate
                    };
                    frontier.estimates.push(estimate);
                    estimate
                };
                if estimate == DEAD_END {
                    run.statistics.dead_ends += 1;
                    frontier
                        .nodes
                        .set(child, Node { status: Status::DeadEnd, cost, parent: state });
                } else {
                    frontier.nodes.set(child, Node { status: Status::Open, cost, parent: state });
                    frontier.push(child, cost, estimate);
                }
                continue;
            }
            let known = frontier.nodes.get(child);
            if known.status != Status::DeadEnd && cost < known.cost {
                if known.status == Status::Closed {
                    run.statistics.reopened += 1;
                }
                let estimate = match constant {
                    Some(constant) if !space.is_goal_state(child) => constant,
                    Some(_) => 0,
                    None => frontier.estimates.get(child.index()),
                };
                frontier.nodes.set(child, Node { status: Status::Open, cost, parent: state });
                frontier.push(child, cost, estimate);
            }
        }
    }
    End::Exhausted
}
