//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`log`]: frames of hands and objects, as they were tracked;
//! - [`truth`]: what really happened in a frame, where somebody knows it;
//! - [`waypoints`]: where hands came in an action, so that a world can do it again.

pub mod log;
pub mod truth;
pub mod waypoints;
