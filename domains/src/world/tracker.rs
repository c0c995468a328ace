//! A physical world goes in; the frame that a tracker with noise and gaps would log comes out.

use super::person::Person;
use super::stage::Stage;
use crate::chance::Chance;
use learner::log::{Frame, HandSample, Motion, ObjectSample};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Frames in a second.
pub const RATE: f64 = 90.0;
/// Nothing is lost before this time in seconds, so that the first frames show everything.
const CALM: f64 = 0.3;
/// How long the slow part of the noise remembers, in seconds.
const DRIFT: f64 = 0.8;

/// What the tracker knows of one body.
#[derive(Debug, Clone)]
struct Track {
    /// The slow part of the noise.
    drift: Vector3<f64>,
    /// For how many frames it is still lost.
    lost: u32,
    /// How far a hand is closed, as it is measured.
    closed: f64,
}

/// A tracker of hands and things.
pub(crate) struct Tracker {
    chance: Chance,
    hands: Vec<Track>,
    objects: Vec<Track>,
    frames: u32,
}

impl Tracker {
    /// A tracker of a world for a person.
    pub(crate) fn new(stage: &Stage, person: &Person, seed: u64) -> Self {
        let fresh = Track { drift: Vector3::zeros(), lost: 0, closed: 0.0 };
        Self {
            chance: Chance::new("tracker", &[u64::from(person.number), seed]),
            hands: vec![fresh.clone(); stage.hands().count()],
            objects: vec![fresh; stage.objects().count()],
            frames: 0,
        }
    }

    /// The next frame; `teach` says of which hands the teach mode is on.
    pub(crate) fn see(&mut self, stage: &Stage, person: &Person, teach: &[bool]) -> Frame {
        let time = f64::from(self.frames) / RATE;
        self.frames += 1;
        let hands = stage
            .hands()
            .map(|hand| {
                let track = &mut self.hands[hand.index()];
                let aim = f64::from(u8::from(stage.closed(hand)));
                // Fingers need about a twentieth of a second.
                track.closed += (aim - track.closed) * 0.2;
                let (closed, lost) = (track.closed, self.chance.happens(person.lost / RATE));
                if !seen(track, lost, time, person, &mut self.chance) {
                    return None;
                }
                let pose = noisy(&stage.hand(hand), track, person, &mut self.chance);
                let grip = person
                    .measures_grip
                    .then(|| (closed + 4.0 * person.noise * self.chance.normal()).clamp(0.0, 1.0));
                let teach = teach[hand.index()];
                Some(HandSample { pose, grip, teach, given: None })
            })
            .collect();
        let objects = stage
            .objects()
            .map(|object| {
                let thing = stage.thing(object);
                let track = &mut self.objects[object.index()];
                if thing.object.fixed {
                    // What never moves was measured once and well.
                    let pose = stage.pose(object);
                    return Some(ObjectSample { pose, joints: Vec::new(), seen: 1.0 });
                }
                let lost = self.chance.happens(person.lost / RATE);
                if !seen(track, lost, time, person, &mut self.chance) {
                    return None;
                }
                let pose = noisy(&stage.pose(object), track, person, &mut self.chance);
                let joints = stage
                    .joints(object)
                    .into_iter()
                    .zip(&thing.object.joints)
                    .map(|(value, joint)| {
                        let deviation = match joint.motion {
                            Motion::Slides => person.noise,
                            Motion::Turns => person.turn_noise,
                        };
                        value + deviation * self.chance.normal()
                    })
                    .collect();
                let seen = 1.0 - 40.0 * person.noise * self.chance.within((0.0, 1.0));
                Some(ObjectSample { pose, joints, seen })
            })
            .collect();
        Frame { time, hands, objects, facts: None }
    }
}

/// Whether a body is seen in this frame.
fn seen(track: &mut Track, lost: bool, time: f64, person: &Person, chance: &mut Chance) -> bool {
    if track.lost > 0 {
        track.lost -= 1;
        return false;
    }
    if lost && time > CALM {
        track.lost = (chance.within((0.1, person.lost_for.max(0.1))) * RATE) as u32;
        return false;
    }
    true
}

/// A pose as it is tracked: white noise, and a part that changes slowly.
fn noisy(
    pose: &Isometry3<f64>,
    track: &mut Track,
    person: &Person,
    chance: &mut Chance,
) -> Isometry3<f64> {
    let keep = (-1.0 / (DRIFT * RATE)).exp();
    let slow = 0.5 * person.noise * (1.0 - keep * keep).sqrt();
    track.drift = track.drift * keep + chance.normals() * slow;
    let shift = chance.normals() * person.noise + track.drift;
    let turn = UnitQuaternion::from_scaled_axis(chance.normals() * person.turn_noise);
    Isometry3::from_parts(Translation3::from(pose.translation.vector + shift), pose.rotation * turn)
}
