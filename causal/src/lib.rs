//! Trials go in; a causal Bayesian network that predicts, explains and prevents failures comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`derive`]: a variable that is made of the columns of a trial;
//! - [`variable`]: what is set or measured in a trial, and the states that it is in;
//! - [`table`]: trials as states, column by column;
//! - [`count`](mod@count): how often states go together, whoever counts them;
//! - [`graph`]: which variables cause which.

pub mod derive;
pub mod variable;
pub mod table;
pub mod count;
pub mod graph;
