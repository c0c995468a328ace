//! What a search knows of a state, in 8 bytes: its status, the cost of the best way to it, and its parent on that way.
//!
//! The operator is not stored: it is found again when a plan is read off ([`crate::space::Space::trace`]).

use crate::registry::StateId;
use crate::segmented::Segmented;

/// The largest cost that a node can hold.
pub const MOST_COST: u32 = (1 << 30) - 1;

/// How far a search is with a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// It waits in the open list.
    Open,
    /// It is expanded.
    Closed,
    /// The goal cannot be reached from it.
    DeadEnd,
}

/// A state's node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// How far the search is with it.
    pub status: Status,
    /// The cost of the best way found; at most [`MOST_COST`].
    pub cost: u32,
    /// The state before on that way; the initial state is its own parent.
    pub parent: StateId,
}

/// The nodes of all registered states.
#[derive(Debug, Clone)]
pub struct Nodes {
    table: Segmented<u64>,
}

impl Default for Nodes {
    fn default() -> Self {
        Self { table: Segmented::new(0) }
    }
}

impl Nodes {
    /// The node of a state.
    #[inline]
    pub fn get(&self, state: StateId) -> Node {
        let bits = self.table.get(state.index());
        let status = match bits >> 62 {
            0 => Status::Open,
            1 => Status::Closed,
            _ => Status::DeadEnd,
        };
        Node { status, cost: (bits >> 32) as u32 & MOST_COST, parent: StateId(bits as u32) }
    }

    /// Sets the node of a state: of one that has a node, or of the one registered next.
    #[inline]
    pub fn set(&mut self, state: StateId, node: Node) {
        debug_assert!(node.cost <= MOST_COST, "the caller checks for overflow");
        let status = match node.status {
            Status::Open => 0_u64,
            Status::Closed => 1,
            Status::DeadEnd => 2,
        };
        let bits = status << 62 | u64::from(node.cost) << 32 | u64::from(node.parent.0);
        if state.index() == self.table.len() {
            self.table.push(bits);
        } else {
            self.table.set(state.index(), bits);
        }
    }

    /// The parent of a state.
    pub fn parent(&self, state: StateId) -> StateId {
        self.get(state).parent
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_COST, Node, Nodes, Status};
    use crate::registry::StateId;

    #[test]
    fn a_node_comes_back_as_it_was_set() {
        let mut nodes = Nodes::default();
        let all = [
            Node { status: Status::Open, cost: 0, parent: StateId(0) },
            Node { status: Status::Closed, cost: MOST_COST, parent: StateId(u32::MAX) },
            Node { status: Status::DeadEnd, cost: 7, parent: StateId(1) },
        ];
        for (node, state) in all.into_iter().zip(0..) {
            nodes.set(StateId(state), node);
        }
        nodes.set(StateId(0), Node { status: Status::DeadEnd, cost: 5, parent: StateId(9) });
        assert_eq!(
            nodes.get(StateId(0)),
            Node { status: Status::DeadEnd, cost: 5, parent: StateId(9) }
        );
        assert_eq!([nodes.get(StateId(1)), nodes.get(StateId(2))], all[1..]);
    }
}
