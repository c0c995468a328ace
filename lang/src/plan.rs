//! Plans as plain data: what a planner hands over and what a validator reads; and their files.

mod read;
mod write;
mod joint;
mod gantt;

pub use gantt::gantt;
pub use joint::{JointPlan, write_joint};
pub use read::{Listing, read};
pub use write::{line, write};

use crate::model::{ActionId, ObjectId};

/// One step: an action and an object for each of its parameters.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Step {
    /// The action.
    pub action: ActionId,
    /// As many as the action has parameters.
    pub arguments: Box<[ObjectId]>,
}

/// A sequence of steps.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Plan {
    /// The steps in order.
    pub steps: Vec<Step>,
}
