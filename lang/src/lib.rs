//! PDDL text goes in; a checked [`model::Domain`] and [`model::Problem`] come out, with every mistake as a [`diagnostic::Diagnostic`].
//!
//! This crate is pure: it opens no files, reads no clock and prints nothing.

pub mod source;
pub mod diagnostic;
pub mod lexer;
pub mod tree;
pub mod ast;
pub mod syntax;
mod near;
mod check;
mod reader;
pub mod model;
pub mod plan;
pub mod execute;
pub mod validate;
pub mod print;
pub mod render;

pub use diagnostic::explain;
pub use reader::{Kind, detect, parse_domain, parse_problem, read_domain, read_problem};
