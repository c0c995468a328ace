//! Greedy best-first search, eager: a state is evaluated when it is generated, and expanded by its own estimate.
//!
//! Ties: the oldest first. States are never re-opened, so a plan is as good as the first way to each of its states.

use super::node::{Node, Nodes, Status};
use super::{End, Profile, Run};
use crate::heuristics::{DEAD_END, Heuristic};
use crate::open::{Open, Order};
use crate::registry::StateId;
use crate::space::Space;

/// How it is listed.
pub fn profile() -> Profile {
    Profile {
        name: "eager",
        summary: "greedy best-first: the state with the smallest estimate, ties to the oldest",
        source: "Doran and Michie 1966; Pearl, Heuristics, 1984",
        optimal: false,
    }
}

/// Runs until a plan is found.
pub(super) fn search(space: &mut Space, heuristic: &mut dyn Heuristic, run: &mut Run) -> End {
    let mut nodes = Nodes::default();
    let mut open: Open<u32> = Open::new(Order::Fifo);
    let mut values = space.task().initial_state.clone();
    let mut child_values = values.clone();
    let mut operators = Vec::new();
    let initial = space.initial();
    space.load(initial, &mut values);
    let estimate = heuristic.evaluate(&values);
    run.initial(estimate);
    if estimate == DEAD_END {
        return End::Exhausted;
    }
    nodes.set(initial, Node { status: Status::Open, cost: 0, parent: initial });
    if space.is_goal(&values) {
        return run.solved(space, initial, |state| nodes.parent(state));
    }
    open.push((estimate, 0), initial.0);
    let mut best = estimate;
    while let Some((_, state)) = open.pop() {
        if let Some(end) = run.stopped(space) {
            return end;
        }
        let state = StateId(state);
        run.statistics.expanded += 1;
        space.load(state, &mut values);
        space.applicable(&values, &mut operators);
        heuristic.enter(&values);
        for &operator in &operators {
            run.statistics.generated += 1;
            let (child, is_new) = space.successor(state, &values, operator);
            if !is_new {
                continue;
            }
            if run.limits.stopped().is_some() {
                break;
            }
            // No cost is kept: the way to a state is the first one found.
            nodes.set(child, Node { status: Status::Open, cost: 0, parent: state });
            space.load(child, &mut child_values);
            if space.is_goal(&child_values) {
                return run.solved(space, child, |state| nodes.parent(state));
            }
            run.statistics.evaluated += 1;
            let estimate = heuristic.evaluate_child(operator, &child_values);
            if estimate == DEAD_END {
                run.statistics.dead_ends += 1;
                continue;
            }
            if estimate < best {
                best = estimate;
                run.reached(best);
            }
            open.push((estimate, 0), child.0);
        }
    }
    End::Exhausted
}
