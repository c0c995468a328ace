//! PDDL text goes in; a checked [`model::Domain`] and [`model::Problem`] come out, with every mistake as a [`diagnostic::Diagnostic`].
//!
//! This crate is pure: it opens no files, reads no clock and prints nothing.

pub mod source;
pub mod diagnostic;
pub mod model;
pub mod plan;
pub mod execute;
pub mod validate;
