//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`log`]: frames of hands and objects, as they were tracked;
//! - [`truth`]: what really happened in a frame, where somebody knows it;
//! - [`observe`](mod@observe): what each hand does and which facts hold, frame by frame;
//! - [`segment`]: the activities in which each hand spends its time;
//! - [`trace`]: symbolic states and the actions between them, and their text;
//! - [`operators`]: from what was observed to a trace with named actions;
//! - [`waypoints`]: how an action is carried out, as data;
//! - [`rule`]: what the actions of traces demand and do;
//! - [`invariant`]: which facts exclude each other;
//! - [`write`](mod@write): what was learned as a domain;
//! - [`extend`](mod@extend): what was learned as part of a domain that was there;
//! - [`moves`]: several who go to the same places;
//! - [`problem`]: what was observed as a problem.

pub mod log;
pub mod truth;
pub mod observe;
pub mod segment;
pub mod trace;
pub mod operators;
pub mod waypoints;
pub mod rule;
pub mod invariant;
pub mod write;
pub mod extend;
pub mod moves;
pub mod problem;
