//! Samples of one hand or object, with noise and gaps, go in; poses and velocities that can be relied on come out.

use std::collections::VecDeque;

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};

/// What was tracked of one hand or object at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Where it was.
    pub place: Vector3<f64>,
    /// How it was turned.
    pub turn: UnitQuaternion<f64>,
    /// How far its joints are open, from 0 to 1; not a number where there are none.
    pub open: f64,
}

/// How fast velocity may seem to be because of noise alone, in metres per second and axis.
const NOISE_OF_SPEED: f64 = 0.007;

/// The narrowest half of a window, in seconds.
const NARROWEST: f64 = 0.035;

/// The samples of one hand or object around now: one for each frame that is kept.
#[derive(Debug, Default)]
pub(super) struct Track {
    samples: VecDeque<Option<Sample>>,
    /// How many frames at the end have no sample.
    missing: usize,
    /// The last four places in a row, to measure noise by.
    row: Vec<Vector3<f64>>,
    /// The mean square of third differences, and of how many.
    roughness: f64,
    count: f64,
}

impl Track {
    /// Takes the sample of the next frame; `times` are those of all kept frames with this one.
    /// A gap of at most `bridge` seconds is filled by moving straight across it.
    pub fn push(&mut self, sample: Option<Sample>, times: &VecDeque<f64>, bridge: f64) {
        self.samples.push_back(sample);
        let Some(found) = sample else {
            self.missing += 1;
            self.row.clear();
            return;
        };
        self.measure(found.place);
        let now = self.samples.len() - 1;
        let gap = std::mem::take(&mut self.missing);
        if gap == 0 || gap >= now {
            return;
        }
        let before = now - gap - 1;
        let Some(lost) = self.samples[before] else { return };
        let span = times[now] - times[before];
        if span > bridge {
            return;
        }
        for index in before + 1..now {
            let part = (times[index] - times[before]) / span;
            let turn = lost.turn.try_slerp(&found.turn, part, 1e-9).unwrap_or(found.turn);
            let open = lost.open + (found.open - lost.open) * part;
            let place = lost.place.lerp(&found.place, part);
            self.samples[index] = Some(Sample { place, turn, open });
        }
    }

    /// Forgets the oldest frame.
    pub fn pop(&mut self) {
        self.samples.pop_front();
    }

    /// The variance of tracking along one axis, in square metres.
    ///
    /// Third differences of a smooth motion vanish against those of noise, whose variance they have twentyfold.
    fn noise(&self) -> f64 {
        self.roughness / 20.0
    }

    fn measure(&mut self, place: Vector3<f64>) {
        self.row.push(place);
        if self.row.len() < 4 {
            return;
        }
        let row = &self.row;
        let third = row[3] - row[2] * 3.0 + row[1] * 3.0 - row[0];
        let square = third.norm_squared() / 3.0;
        // A jump of the tracker is no noise, and would be remembered for long.
        let square =
            if self.count > 50.0 { square.min(self.roughness * 20.0 + 1e-12) } else { square };
        self.count = (self.count + 1.0).min(500.0);
        self.roughness += (square - self.roughness) / self.count;
        self.row.remove(0);
    }

    /// The pose at a frame, averaged over so many seconds before and after; none where it is lost.
    pub fn pose(
        &self,
        index: usize,
        times: &VecDeque<f64>,
        half: f64,
    ) -> Option<(Isometry3<f64>, f64)> {
        self.samples[index]?;
        let mut place = Vector3::zeros();
        let mut turn = Quaternion::new(0.0, 0.0, 0.0, 0.0);
        let mut open = 0.0;
        let mut count = 0.0;
        let first = self.samples[index].map(|sample| sample.turn.into_inner())?;
        // The window is as wide before as after, so that a steady motion is not pulled to one side.
        let (from, to) = window(index, times, half);
        for sample in self.samples.range(from..=to).flatten() {
            place += sample.place;
            let other = sample.turn.into_inner();
            turn += if other.dot(&first) < 0.0 { -other } else { other };
            open += sample.open;
            count += 1.0;
        }
        let turn = UnitQuaternion::new_normalize(turn);
        Some((Isometry3::from_parts((place / count).into(), turn), open / count))
    }

    /// The speed at a frame in metres per second, freed of what noise adds to it; none where it is lost.
    ///
    /// It is the slope of the best straight line through a window that is as wide as the noise demands, but not wider than `widest` before and after.
    pub fn speed(&self, index: usize, times: &VecDeque<f64>, widest: f64) -> Option<f64> {
        self.samples[index]?;
        let span = (times[times.len() - 1] - times[0]) / (times.len() - 1).max(1) as f64;
        let frames = (12.0 * self.noise() / (NOISE_OF_SPEED * span).powi(2)).cbrt();
        let half = (frames * span / 2.0).clamp(NARROWEST.min(widest), widest);
        let (mut from, mut to) = window(index, times, half);
        if to == from {
            // At a low rate two frames are all there is.
            from = index.saturating_sub(1);
            to = (index + 1).min(self.samples.len() - 1);
        }
        let mut count = 0.0;
        let mut mean = Vector3::zeros();
        let mut middle = 0.0;
        for frame in from..=to {
            if let Some(sample) = self.samples[frame] {
                mean += sample.place;
                middle += times[frame] - times[index];
                count += 1.0;
            }
        }
        mean /= count;
        middle /= count;
        let mut slope = Vector3::zeros();
        let mut spread = 0.0;
        for frame in from..=to {
            if let Some(sample) = self.samples[frame] {
                let time = times[frame] - times[index] - middle;
                slope += (sample.place - mean) * time;
                spread += time * time;
            }
        }
        if spread <= 0.0 {
            return Some(0.0);
        }
        let square = (slope / spread).norm_squared() - 3.0 * self.noise() / spread;
        Some(square.max(0.0).sqrt())
    }
}

/// The frames around one that are at most so many seconds away, as many before as after.
fn window(index: usize, times: &VecDeque<f64>, half: f64) -> (usize, usize) {
    let now = times[index];
    let room = index.min(times.len() - 1 - index);
    let mut wide = 0;
    while wide < room
        && now - times[index - wide - 1] <= half + 1e-9
        && times[index + wide + 1] - now <= half + 1e-9
    {
        wide += 1;
    }
    if wide == 0 && room == 0 {
        // At either end of a log there is only one side.
        let mut from = index;
        let mut to = index;
        while from > 0 && now - times[from - 1] <= half + 1e-9 {
            from -= 1;
        }
        while to + 1 < times.len() && times[to + 1] - now <= half + 1e-9 {
            to += 1;
        }
        return (from, to);
    }
    (index - wide, index + wide)
}
