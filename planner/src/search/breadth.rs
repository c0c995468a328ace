//! Breadth-first search (Moore 1959): states in the order in which they are first reached, so plans have the fewest steps.
//!
//! The registry numbers states in just this order, so there is no open list; a state costs its packed words, its parent and its place in the hash table.

use super::{End, Profile, Run};
use crate::registry::StateId;
use crate::segmented::Segmented;
use crate::space::Space;

/// How it is listed.
pub fn profile() -> Profile {
    Profile {
        name: "breadth",
        summary: "breadth-first: plans with the fewest steps",
        source: "Moore 1959",
        optimal: false,
    }
}

/// Runs until a plan is found.
pub(super) fn search(space: &mut Space, run: &mut Run) -> End {
    let initial = space.initial();
    let mut parents = Segmented::new(0);
    parents.push(initial.0);
    let mut values = space.task().initial_state.clone();
    let mut operators = Vec::new();
    if space.is_goal_state(initial) {
        return run.solved(space, initial, |state| StateId(parents.get(state.index())));
    }
    let mut next = 0;
    while next < space.len() {
        if let Some(end) = run.stopped(space) {
            return end;
        }
        let state = StateId(next as u32);
        next += 1;
        run.statistics.expanded += 1;
        space.load(state, &mut values);
        space.applicable(&values, &mut operators);
        for &operator in &operators {
            run.statistics.generated += 1;
            let (child, is_new) = space.successor(state, &values, operator);
            if is_new {
                parents.push(state.0);
                if space.is_goal_state(child) {
                    return run.solved(space, child, |state| StateId(parents.get(state.index())));
                }
            }
        }
    }
    End::Exhausted
}
