//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`log`]: frames of hands and objects, as they were tracked;
//! - [`truth`]: what really happened in a frame, where somebody knows it;
//! - [`trace`]: symbolic states and the actions between them, and their text;
//! - [`rule`]: what the actions of traces demand and do;
//! - [`mod@write`]: what was learned as a domain.

pub mod log;
pub mod truth;
pub mod trace;
pub mod rule;
pub mod write;
