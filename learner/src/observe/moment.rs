//! What is known of one frame while observation looks ahead: filled in from the front, changed by what is found out later, and given out at the back.

use nalgebra::Vector3;

use super::relation::Flip;
use crate::log::{Fact, HandState, ObjectId};

/// One frame between the front and the back.
#[derive(Debug)]
pub(super) struct Moment {
    /// The time in seconds.
    pub time: f64,
    /// The hands in the order of the header.
    pub hands: Vec<HandMoment>,
    /// What changed in the geometry of the objects.
    pub flips: Vec<Flip>,
    /// The objects that were never seen before.
    pub met: Vec<ObjectId>,
    /// What the log itself says, where it says something.
    pub facts: Option<Vec<Fact>>,
}

/// A hand at one frame.
#[derive(Debug)]
pub(super) struct HandMoment {
    /// Where it is; none where it is lost.
    pub place: Option<Vector3<f64>>,
    /// Whether it moves.
    pub moves: bool,
    /// What it holds.
    pub in_hand: Option<ObjectId>,
    /// What it acts on; known when the moment is given out.
    pub acted_on: Option<ObjectId>,
    /// What the log itself says of it.
    pub given: Option<HandState>,
    /// Its teach mode is on.
    pub teach: bool,
    /// The distances of the hand to all objects in metres; not numbers where unknown.
    pub bare: Vec<f32>,
    /// What the hand was thought to hold when `gaps` were measured.
    pub holding: Option<ObjectId>,
    /// The distances of what the hand holds to all objects in metres; empty if it holds nothing.
    pub gaps: Vec<f32>,
}
