//! PDDL text goes in; a checked [`model::Domain`] and [`model::Problem`] come out, with every mistake as a [`diagnostic::Diagnostic`].
//!
//! This crate is pure: it opens no files, reads no clock and prints nothing.
//!
//! ```
//! let mut sources = lang::source::Sources::default();
//! let id = sources.add("domain.pddl", "(define (domain light) (:predicates (lit))\n (:action press :effect (lti)))");
//! let (domain, diagnostics) = lang::read_domain(&sources, id);
//! assert_eq!(domain.actions[0].name.text, "press");
//! assert_eq!(
//!     lang::render::concise(&diagnostics, &sources),
//!     "domain.pddl:2:26: error[E0101] unknown-predicate: unknown predicate `lti`\n"
//! );
//! ```

pub mod source;
pub mod diagnostic;
pub mod lexer;
pub mod tree;
pub mod annotation;
pub mod group;
pub mod ast;
pub mod syntax;
mod near;
mod check;
mod reader;
pub mod model;
pub mod condition;
pub mod symbol;
pub mod portability;
pub mod support;
pub mod lint;
pub mod plan;
pub mod execute;
pub mod multiagent;
pub mod validate;
pub mod print;
pub mod format;
pub mod write;
pub mod factored;
pub mod allow;
pub mod mend;
pub mod render;
pub mod ide;

pub use annotation::annotations;
pub use diagnostic::explain;
pub use near::{did_you_mean, nearest};
pub use reader::{
    Kind, detect, index_domain, index_problem, parse_domain, parse_problem, read_domain,
    read_problem, refusals,
};
