//! A world of trials and a seed go in; what was set in each trial and what came of it come out.
//!
//! A trial is set up at random, and then physics decides. What is set and what chance does are drawn apart: the same trial can be run
//! again with something corrected, and all else, down to how the gripper trembles, is as it was.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`Column`], [`World`]: what a trial consists of, and who runs it;
//! - [`stack`]: cubes put onto each other;
//! - [`trials`]: many trials, on all cores.
//!
//! ```
//! use domains::trial::stack::{Parameters, Stack};
//! use domains::trial::{World, noise};
//!
//! let stack = Stack::new(1, Parameters::default()).unwrap();
//! // xOff, yOff, dropOff in cm and two colours: in the middle it stays, off the edge it does not.
//! assert_eq!(stack.run(&[0.0, 0.0, 1.0, 0.0, 0.0], noise(1, 0)), [1.0]);
//! assert_eq!(stack.run(&[2.9, 0.0, 1.0, 0.0, 0.0], noise(1, 0)), [0.0]);
//! ```

pub mod stack;

use std::ops::Range;

use causal::variable::Role;
use rayon::prelude::*;

pub use crate::chance::Chance;

/// What is set or measured in the trials of a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What it is called.
    pub name: String,
    /// The unit of its numbers.
    pub unit: Option<&'static str>,
    /// The values that it takes.
    pub values: Values,
    /// Whether it is set or measured.
    pub role: Role,
    /// What it is, in words.
    pub what: String,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers between two, each as likely where they are drawn.
    Between(f64, f64),
    /// One of these words, each as likely where they are drawn. Its number stands for it.
    Words(Vec<&'static str>),
}

/// A world in which trials are run.
pub trait World: Sync {
    /// What is set in a trial, and then what is measured.
    fn columns(&self) -> Vec<Column>;

    /// Runs a trial: of the values that are set, in the order of the columns, it makes those that are measured.
    fn run(&self, set: &[f64], noise: Chance) -> Vec<f64>;

    /// Draws what is set. Numbers are rounded to a ten-thousandth of their unit, so that a file says exactly what was done.
    fn draw(&self, seed: u64, trial: u64) -> Vec<f64> {
        let mut chance = Chance::new("set", &[seed, trial]);
        let set = self.columns().into_iter().filter(|column| column.role == Role::Treatment);
        set.map(|column| match column.values {
            Values::Between(low, high) => (chance.within((low, high)) * 1e4).round() / 1e4,
            Values::Words(words) => chance.below(words.len()) as f64,
        })
        .collect()
    }
}

/// What chance does in a trial, whatever is set.
pub fn noise(seed: u64, trial: u64) -> Chance {
    Chance::new("noise", &[seed, trial])
}

/// Runs trials with these numbers, each as its number and the seed say and none as another thread does: what is set, and then what is
/// measured. `done` is called after each.
pub fn trials(
    world: &dyn World,
    seed: u64,
    numbers: Range<u64>,
    done: &(dyn Fn() + Sync),
) -> Vec<Vec<f64>> {
    let one = |trial: u64| {
        let mut row = world.draw(seed, trial);
        let measured = world.run(&row, noise(seed, trial));
        row.extend(measured);
        done();
        row
    };
    numbers.into_par_iter().map(one).collect()
}
