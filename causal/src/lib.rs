//! Trials go in; a causal Bayesian network that predicts, explains and prevents failures comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`variable`]: what is set or measured in a trial, and the states that it is in;
//! - [`table`]: trials as states, column by column;
//! - [`count`](mod@count): how often states go together, whoever counts them;
//! - [`graph`]: which variables cause which.

pub mod variable;
pub mod table;
pub mod count;
pub mod graph;
