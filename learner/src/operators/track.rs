//! Frames go in; where hands and objects were at any time comes out, without most of the noise.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::log::{Frame, HandId, Header, ObjectId};

/// Where everything was. Hands are kept frame by frame; of objects only what moved.
#[derive(Debug, Clone, Default)]
pub struct Tracks {
    hands: Vec<Track>,
    objects: Vec<Track>,
    /// For each object the frames that are not yet looked at.
    recent: Vec<Track>,
}

/// Poses in the order of time.
type Track = Vec<(f64, Isometry3<f64>)>;

/// Poses of objects are averaged over so many frames.
const BLOCK: usize = 8;
/// An object that is so near to where it was did not move, in metres and radians.
const STILL: f64 = 0.004;
const TURNED: f64 = 0.05;
/// Poses of a hand are averaged over so much before and after, in seconds.
const WINDOW: f64 = 0.05;

impl Tracks {
    /// Nothing yet.
    pub fn new(header: &Header) -> Self {
        Self {
            hands: vec![Track::new(); header.hands.len()],
            objects: vec![Track::new(); header.objects.len()],
            recent: vec![Track::new(); header.objects.len()],
        }
    }

    /// Takes the next frame.
    pub fn push(&mut self, frame: &Frame) {
        for (track, hand) in self.hands.iter_mut().zip(&frame.hands) {
            track.extend(hand.as_ref().map(|hand| (frame.time, hand.pose)));
        }
        for ((kept, recent), object) in
            self.objects.iter_mut().zip(&mut self.recent).zip(&frame.objects)
        {
            recent.extend(object.as_ref().map(|object| (frame.time, object.pose)));
            if recent.len() < BLOCK {
                if kept.is_empty() {
                    kept.extend(recent.first().copied());
                }
                continue;
            }
            let pose = mean(recent);
            let before = around(kept, kept[kept.len() - 1].0);
            let still = before.is_some_and(|before| {
                (before.translation.vector - pose.translation.vector).norm() < STILL
                    && before.rotation.angle_to(&pose.rotation) < TURNED
            });
            if still {
                recent.clear();
            } else {
                kept.append(recent);
            }
        }
    }

    /// Where a hand was; none if it was not tracked around that time.
    pub fn hand(&self, hand: HandId, time: f64) -> Option<Isometry3<f64>> {
        let track = &self.hands[hand.index()];
        let from = track.partition_point(|(at, _)| *at < time - WINDOW);
        let to = track.partition_point(|(at, _)| *at <= time + WINDOW);
        if from < to {
            return Some(mean(&track[from..to]));
        }
        // It was lost: it is thought to have moved straight on.
        let (before, after) = (track.get(from.checked_sub(1)?)?, track.get(to)?);
        let share = (time - before.0) / (after.0 - before.0);
        Some(before.1.lerp_slerp(&after.1, share))
    }

    /// Where an object was; before it was first seen, where it was seen first.
    pub fn object(&self, object: ObjectId, time: f64) -> Option<Isometry3<f64>> {
        around(&self.objects[object.index()], time)
    }
}

/// Where something was that stayed where it was seen last.
fn around(track: &Track, time: f64) -> Option<Isometry3<f64>> {
    let place = track.partition_point(|(at, _)| *at <= time);
    let last = track.get(place.saturating_sub(1))?.0;
    let middle = if time > last + WINDOW { last } else { time.max(last) };
    let from = track.partition_point(|(at, _)| *at < middle - WINDOW);
    let to = track.partition_point(|(at, _)| *at <= middle + WINDOW);
    (from < to).then(|| mean(&track[from..to]))
}

/// The middle of poses that are near to one another.
fn mean(poses: &[(f64, Isometry3<f64>)]) -> Isometry3<f64> {
    let mut place = Vector3::zeros();
    let mut turn = Quaternion::identity() * 0.0;
    let first = poses[0].1.rotation;
    for (_, pose) in poses {
        place += pose.translation.vector;
        let sign = if pose.rotation.coords.dot(&first.coords) < 0.0 { -1.0 } else { 1.0 };
        turn += *pose.rotation.quaternion() * sign;
    }
    Isometry3::from_parts(
        Translation3::from(place / poses.len() as f64),
        UnitQuaternion::from_quaternion(turn),
    )
}
