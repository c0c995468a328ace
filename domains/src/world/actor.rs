//! Movements go in; step by step the pose of a hand comes out, and what it is about.

use super::motion::Way;
use super::skill::Act;
use super::stage::{STEP, Stage};
use learner::log::{HandId, ObjectId};
use nalgebra::Isometry3;
use std::collections::VecDeque;

/// A hand that carries out movements one after another.
#[derive(Debug)]
pub(crate) struct Actor {
    hand: HandId,
    queue: VecDeque<Act>,
    /// The way under way, and for how long.
    way: Option<(Box<Way>, f64)>,
    /// How long it still rests, in seconds.
    rest: f64,
    /// What it approaches or works on, until its hand opens or closes, or it goes elsewhere.
    about: Option<ObjectId>,
    pose: Isometry3<f64>,
}

impl Actor {
    /// A hand at rest.
    pub(crate) fn new(stage: &Stage, hand: HandId) -> Self {
        let pose = stage.hand(hand);
        Self { hand, queue: VecDeque::new(), way: None, rest: 0.0, about: None, pose }
    }

    /// Nothing is left to do.
    pub(crate) fn idle(&self) -> bool {
        self.queue.is_empty() && self.way.is_none() && self.rest <= 0.0
    }

    /// What the hand approaches or works on.
    pub(crate) fn about(&self) -> Option<ObjectId> {
        self.about
    }

    /// Where the hand shall be.
    pub(crate) fn pose(&self) -> Isometry3<f64> {
        self.pose
    }

    /// More to do.
    pub(crate) fn add(&mut self, acts: Vec<Act>) {
        self.queue.extend(acts);
    }

    /// One step of the world's.
    pub(crate) fn step(&mut self, stage: &mut Stage) {
        if self.rest > 0.0 {
            self.rest -= STEP;
            return;
        }
        if self.way.is_none() {
            match self.queue.pop_front() {
                Some(Act::Go { way, about }) => {
                    self.about = about;
                    self.way = Some((way, 0.0));
                }
                Some(Act::Grip(closed)) => {
                    stage.grip(self.hand, closed);
                    self.about = None;
                }
                Some(Act::Rest(time)) => self.rest = time,
                None => {}
            }
        }
        if let Some((way, elapsed)) = &mut self.way {
            *elapsed += STEP;
            self.pose = way.at(*elapsed);
            if *elapsed >= way.duration {
                self.way = None;
            }
        }
    }
}
