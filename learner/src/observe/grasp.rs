//! Where a hand and the objects near it are, frame by frame, goes in; what it holds, and since which frame, comes out.

use nalgebra::{Isometry3, Vector3};

use super::config::Config;
use super::relation::Body;
use super::shape::Shape;
use crate::log::ObjectId;

/// What is known of a hand at a frame.
pub(super) struct Seen<'a> {
    /// The number of the frame.
    pub frame: u64,
    /// The time in seconds.
    pub time: f64,
    /// The pose of the hand.
    pub pose: Isometry3<f64>,
    /// How closed it is, where that is measured.
    pub grip: Option<f64>,
    /// Whether it moves.
    pub moves: bool,
    /// The frame since which it moves or rests, and the one since which it did the other before.
    pub turned: (u64, u64),
    /// The objects that can be held, with their distances to the hand in metres.
    pub near: &'a [(ObjectId, f64)],
    /// All objects where they are.
    pub bodies: &'a [Body],
}

/// From this frame on the hand holds this, or nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Since {
    /// The number of the frame; it may be an earlier one.
    pub frame: u64,
    /// What is in the hand.
    pub object: Option<ObjectId>,
}

/// An object that keeps its place in the frame of the hand.
#[derive(Debug, Clone, Copy)]
struct Bond {
    object: ObjectId,
    /// Its place in the frame of the hand when the bond began.
    offset: Vector3<f64>,
    /// Its place in the world then.
    place: Vector3<f64>,
    /// The frame in which the bond began.
    frame: u64,
    /// The first frame since in which the hand rested.
    rest: Option<u64>,
    /// The frame in which it last began to move.
    leave: u64,
    /// The time of the last frame in which the hand moved.
    moved: f64,
}

/// Follows one hand.
#[derive(Debug, Default)]
pub(super) struct Grasp {
    held: Option<Bond>,
    /// The frame in which it was taken.
    since: u64,
    /// The last frame in which what is held was where it should be in the hand.
    firm: u64,
    /// What could be held if it moved with the hand.
    bonds: Vec<Bond>,
    /// The objects among which the closing hand had to choose, with the place of the hand then.
    doubt: Option<(Vector3<f64>, Vec<Bond>)>,
    closed: bool,
    /// Since when the grip is neither open nor closed; it began to open or close then.
    between: Option<u64>,
    /// The frame in which the hand closed, while it is closed around nothing.
    closing: Option<u64>,
}

/// How many frames after it closed a hand may still find something between its fingers: tracking and gripper need not agree on the moment.
const LATE: u64 = 8;

/// So many frames after a hand left something behind that may show.
const STRAY: u64 = 30;

impl Grasp {
    /// What the hand holds as far as is known now.
    pub fn held(&self) -> Option<ObjectId> {
        self.held.map(|bond| bond.object)
    }

    /// Takes the next frame; says what changed, the earliest change first.
    pub fn step(&mut self, seen: &Seen<'_>, config: &Config) -> Vec<Since> {
        let mut changes = Vec::new();
        self.follow(seen, config);
        if let Some(grip) = seen.grip {
            self.by_grip(seen, grip, config, &mut changes);
        }
        self.release(seen, config, &mut changes);
        let open = seen.grip.is_some_and(|grip| grip <= config.grip.low);
        if self.held.is_none() && !open {
            self.by_motion(seen, config, &mut changes);
        }
        changes
    }

    /// Keeps the bonds of all near objects: one ends where the object shifts in the hand, and the next begins.
    fn follow(&mut self, seen: &Seen<'_>, config: &Config) {
        self.bonds.retain(|bond| {
            seen.near
                .iter()
                .any(|&(object, distance)| object == bond.object && distance <= config.hold.high)
        });
        for &(object, distance) in seen.near {
            let Some(new) = seen.bond(object) else { continue };
            match self.bonds.iter_mut().find(|bond| bond.object == object) {
                Some(bond) if (bond.offset - new.offset).norm() > config.rigid => *bond = new,
                Some(bond) => {
                    if seen.moves {
                        bond.leave = seen.turned.0;
                        bond.moved = seen.time;
                    } else {
                        bond.rest = bond.rest.or(Some(seen.turned.0.max(bond.frame)));
                    }
                }
                None if distance <= config.hold.low => self.bonds.push(new),
                None => {}
            }
        }
    }

    /// A hand takes what is between its fingers when it closes, and lets go when it opens.
    fn by_grip(&mut self, seen: &Seen<'_>, grip: f64, config: &Config, changes: &mut Vec<Since>) {
        let closed = config.grip.rising(self.closed, grip);
        let closes = closed && !self.closed;
        self.closed = closed;
        let began = self.between.unwrap_or(seen.frame);
        let between = grip > config.grip.low && grip < config.grip.high;
        self.between = between.then_some(began);
        if grip <= config.grip.low {
            self.closing = None;
            if self.held.take().is_some() {
                self.doubt = None;
                self.bonds.clear();
                changes.push(Since { frame: quick(began, seen.frame), object: None });
            }
            return;
        }
        if closes && self.held.is_none() {
            self.closing = Some(quick(began, seen.frame));
        }
        if let Some(frame) = self.closing {
            if seen.frame > frame + LATE || self.held.is_some() {
                self.closing = None;
            } else {
                self.close(seen, config, changes);
            }
        }
        self.decide(seen, config, changes);
    }

    /// Takes the nearest object; of those that are hardly further away the smallest, since a hand in a drawer is also near the drawer.
    fn close(&mut self, seen: &Seen<'_>, config: &Config, changes: &mut Vec<Since>) {
        let within: Vec<(ObjectId, f64)> = seen
            .near
            .iter()
            .copied()
            .filter(|&(_, distance)| distance <= config.hold.low)
            .collect();
        let Some(least) = within.iter().map(|&(_, distance)| distance).min_by(f64::total_cmp)
        else {
            return;
        };
        let radius =
            |object: ObjectId| seen.shape(object).map_or(f64::INFINITY, |shape| shape.radius);
        let Some(&(object, _)) = within
            .iter()
            .filter(|(_, distance)| *distance <= least + 0.01)
            .min_by(|one, other| radius(one.0).total_cmp(&radius(other.0)))
        else {
            return;
        };
        let frame = self.closing.take().unwrap_or(seen.frame);
        self.held = seen.bond(object);
        self.firm = seen.frame;
        let others: Vec<Bond> =
            within.iter().filter_map(|&(object, _)| seen.bond(object)).collect();
        self.doubt = (others.len() > 1).then_some((seen.pose.translation.vector, others));
        changes.push(Since { frame, object: Some(object) });
    }

    /// Once the hand has gone some way, what came along is what was taken.
    fn decide(&mut self, seen: &Seen<'_>, config: &Config, changes: &mut Vec<Since>) {
        let Some((start, bonds)) = &self.doubt else { return };
        if (seen.pose.translation.vector - start).norm() < 2.0 * config.carried {
            return;
        }
        let shift = |bond: &Bond| {
            seen.bond(bond.object).map_or(f64::INFINITY, |now| (now.offset - bond.offset).norm())
        };
        let held = self.held.map(|bond| (bond.object, shift(&bond)));
        let best = bonds.iter().min_by(|one, other| shift(one).total_cmp(&shift(other))).copied();
        self.doubt = None;
        if let (Some((object, far)), Some(best)) = (held, best)
            && best.object != object
            && far > config.rigid
            && shift(&best) <= config.rigid
        {
            self.held = Some(best);
            self.firm = seen.frame;
            changes.push(Since { frame: best.frame, object: Some(best.object) });
        }
    }

    /// What shifts in the hand and stays behind is lost.
    fn release(&mut self, seen: &Seen<'_>, config: &Config, changes: &mut Vec<Since>) {
        let Some(bond) = &mut self.held else { return };
        let Some(now) = seen.bond(bond.object) else { return };
        let shift = (now.offset - bond.offset).norm();
        if shift <= config.rigid {
            if shift <= config.rigid / 2.0 {
                self.firm = seen.frame;
            }
            // It may slip slowly, which is no loss.
            bond.offset += (now.offset - bond.offset) * 0.02;
            return;
        }
        let far = seen
            .near
            .iter()
            .find(|(object, _)| *object == bond.object)
            .is_none_or(|&(_, distance)| distance > config.hold.high);
        let measured = seen.grip.is_some_and(|grip| grip > config.grip.low);
        if shift > 2.0 * config.rigid || far {
            let object = bond.object;
            self.held = None;
            self.doubt = None;
            self.bonds.retain(|bond| bond.object != object);
            let (leave, rest) = seen.turned;
            let still = seen.moves && (rest..leave + STRAY).contains(&self.firm);
            let frame = if still && !measured {
                u64::midpoint(rest.max(self.since), leave)
            } else {
                self.firm + 1
            };
            changes.push(Since { frame, object: None });
        }
    }

    /// What moves with a hand and keeps its place in it is held.
    /// Where no grip is measured, so is that at which a hand stays for long, such as a bottle that it only steadies.
    /// It was taken while the hand rested at it; nothing shows when, and the middle of that time is the best guess.
    fn by_motion(&mut self, seen: &Seen<'_>, config: &Config, changes: &mut Vec<Since>) {
        let carried = |bond: &&Bond| {
            let along = seen
                .shape(bond.object)
                .is_some_and(|shape| (shape.middle() - bond.place).norm() >= config.carried);
            let stays = seen.grip.is_none()
                && bond.rest.is_some()
                && seen.time - bond.moved >= config.settled;
            along || stays
        };
        let distance = |bond: &Bond| {
            seen.near
                .iter()
                .find(|(object, _)| *object == bond.object)
                .map_or(f64::INFINITY, |near| near.1)
        };
        let best = self
            .bonds
            .iter()
            .filter(carried)
            .filter(|bond| distance(bond) <= config.hold.low)
            .min_by(|one, other| distance(one).total_cmp(&distance(other)))
            .copied();
        if let Some(bond) = best {
            self.held = Some(bond);
            self.firm = seen.frame;
            let frame = match bond.rest {
                Some(rest) if bond.leave > rest => u64::midpoint(rest, bond.leave),
                // It is there still; hands close soon after they come to rest.
                Some(rest) => rest + (seen.frame - rest) / 4,
                None => bond.frame,
            };
            self.since = frame;
            changes.push(Since { frame, object: Some(bond.object) });
        }
    }
}

/// The frame in which a grip began to change, if it changed so quickly that it was one movement.
fn quick(began: u64, now: u64) -> u64 {
    if now - began <= LATE { began } else { now }
}

impl Seen<'_> {
    /// Where an object is; none while it is lost.
    fn shape(&self, object: ObjectId) -> Option<&Shape> {
        let body = &self.bodies[object.index()];
        body.shape.as_ref().filter(|_| !body.lost)
    }

    /// The bond to an object that would begin now.
    fn bond(&self, object: ObjectId) -> Option<Bond> {
        let place = self.shape(object)?.middle();
        let offset = self.pose.rotation.inverse() * (place - self.pose.translation.vector);
        let rest = (!self.moves).then_some(self.frame);
        Some(Bond {
            object,
            offset,
            place,
            frame: self.frame,
            rest,
            leave: self.turned.0,
            moved: self.time,
        })
    }
}
