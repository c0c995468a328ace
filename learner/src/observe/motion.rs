//! The speed of a hand, or the poses of something fixed, go in frame by frame; whether the hand moves, or where the thing is, comes out.

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3, Vector4};

use super::config::Config;

/// Whether a hand moves, by two thresholds and a least duration.
#[derive(Debug, Default)]
pub(super) struct Moving {
    raw: bool,
    pub moves: bool,
    since: Option<(u64, f64)>,
    /// Since which frame it moves or rests, and since which it did the other before.
    pub turned: (u64, u64),
    /// When the hand was last seen.
    seen: Option<f64>,
}

impl Moving {
    /// Takes the speed at the next frame; says since which frame the hand moves, or rests, once that has lasted long enough.
    pub fn step(&mut self, now: (u64, f64), speed: Option<f64>, config: &Config) -> Option<u64> {
        let first = self.seen.is_none();
        match speed {
            Some(speed) => {
                self.raw = config.speed.rising(self.raw, speed);
                self.seen = Some(now.1);
            }
            // A hand that stays away is no longer thought to move.
            None if self.seen.is_some_and(|seen| now.1 - seen > config.bridge) => self.raw = false,
            None => {}
        }
        if self.raw == self.moves {
            self.since = None;
            return None;
        }
        let since = *self.since.get_or_insert(now);
        (first || now.1 - since.1 >= config.minimum).then(|| {
            self.moves = self.raw;
            self.since = None;
            self.turned = (since.0, self.turned.0);
            since.0
        })
    }
}

/// The pose of something that never moves, averaged over all frames so far.
#[derive(Debug, Default)]
pub(super) struct Still {
    pub count: u32,
    place: Vector3<f64>,
    turn: Vector4<f64>,
}

/// The pose of a fixed object is averaged over so many frames.
pub(super) const STILL: u32 = 500;

impl Still {
    /// Takes one more pose.
    pub fn add(&mut self, pose: &Isometry3<f64>) {
        if self.count >= STILL {
            return;
        }
        self.count += 1;
        self.place += pose.translation.vector;
        let turn = pose.rotation.coords;
        self.turn += if turn.dot(&self.turn) < 0.0 { -turn } else { turn };
    }

    /// The mean pose.
    pub fn pose(&self) -> Isometry3<f64> {
        let place = self.place / f64::from(self.count);
        let turn = UnitQuaternion::new_normalize(Quaternion::from(self.turn));
        Isometry3::from_parts(place.into(), turn)
    }
}
