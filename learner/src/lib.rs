//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`log`]: frames of hands and objects, as they were tracked;
//! - [`truth`]: what really happened in a frame, where somebody knows it;
//! - [`observe`]: what each hand does and which facts hold, frame by frame;
//! - [`segment`]: the activities in which each hand spends its time;
//! - [`waypoints`]: where hands came in an action, so that a world can do it again.

pub mod log;
pub mod truth;
pub mod observe;
pub mod segment;
pub mod waypoints;
