//! What really happened in a frame of a log, from a world that knows it or a person who annotated it.
//!
//! It lies beside a log and is what segmentation is judged by, and what a decision tree is learned from; nothing that learns operators reads it.

mod json;

pub use json::{Reader, Writer};

use crate::log::{Fact, HandState};

/// What a hand does, as table 3.1 of the thesis names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Deserialize)]
pub enum Activity {
    /// Nothing, or on its way without an aim.
    Idle,
    /// On its way to an object, with nothing in the hand.
    Reach,
    /// It has an object in the hand and rests.
    Take,
    /// It moves an object about.
    Put,
    /// What it holds works on another object.
    Granular,
}

impl Activity {
    /// All of them.
    pub const ALL: [Activity; 5] =
        [Activity::Idle, Activity::Reach, Activity::Take, Activity::Put, Activity::Granular];

    /// Its place in [`Activity::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Its name, as the thesis writes it.
    pub fn name(self) -> &'static str {
        match self {
            Activity::Idle => "Idle",
            Activity::Reach => "Reach",
            Activity::Take => "Take",
            Activity::Put => "Put",
            Activity::Granular => "Granular",
        }
    }
}

impl std::fmt::Display for Activity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// What really happened at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// The time of the frame in seconds.
    pub time: f64,
    /// For each hand of the header what it did.
    pub hands: Vec<(HandState, Activity)>,
    /// What held.
    pub facts: Vec<Fact>,
}
