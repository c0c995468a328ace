//! Samples of one hand or object, with noise and gaps, go in; poses and velocities that can be relied on come out.

use std::collections::VecDeque;

use nalgebra::{Const, DimMin, Isometry3, Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};

/// What was tracked of one hand or object at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Where it was.
    pub place: Vector3<f64>,
    /// How it was turned.
    pub turn: UnitQuaternion<f64>,
    /// How far its joints are open, from 0 to 1; not a number where there are none.
    pub open: f64,
    /// It was lost, and this is only where it must have been about.
    pub filled: bool,
}

/// The standard deviation that noise alone may give to velocity, in metres per second and axis.
///
/// A wider window has less of it and smears the moment in which a hand starts or stops.
/// With minimum-jerk movements at 90 Hz and noise of 0.5 to 3 mm this one misses that moment by the fewest frames, about one.
const NOISE_OF_SPEED: f64 = 0.0125;

/// The narrowest half of a window, in frames.
const NARROWEST: f64 = 3.0;

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
            return;
        };
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
            self.samples[index] = Some(Sample { place, turn, open, filled: true });
        }
    }

    /// Whether it was really seen at a frame.
    pub fn seen(&self, index: usize) -> bool {
        self.samples[index].is_some_and(|sample| !sample.filled)
    }

    /// Forgets the oldest frame.
    pub fn pop(&mut self) {
        self.samples.pop_front();
    }

    /// The variance of tracking along one axis, in square metres.
    ///
    /// Third differences of a smooth motion vanish beside those of noise, whose variance they have twentyfold.
    fn noise(&self) -> f64 {
        self.roughness / 20.0
    }

    /// Takes the next sample to measure noise by.
    pub fn measure(&mut self, sample: Option<&Sample>) {
        let Some(sample) = sample else {
            self.row.clear();
            return;
        };
        self.row.push(sample.place);
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

    /// The pose at a frame, averaged over a [`window`] around it; none where it is lost.
    pub fn pose(&self, index: usize, (from, to): (usize, usize)) -> Option<(Isometry3<f64>, f64)> {
        self.samples[index]?;
        let mut place = Vector3::zeros();
        let mut turn = Quaternion::new(0.0, 0.0, 0.0, 0.0);
        let mut open = 0.0;
        let mut count = 0.0;
        let first = self.samples[index].map(|sample| sample.turn.into_inner())?;
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
    /// It is the slope of the cubic that fits best in a window as wide as the noise demands, but not wider than `widest` before and after (Savitzky and Golay 1964).
    /// A straight line would take the start of a movement for much earlier than it is.
    pub fn speed(&self, index: usize, times: &VecDeque<f64>, widest: f64) -> Option<f64> {
        self.samples[index]?;
        let span = (times[times.len() - 1] - times[0]) / (times.len() - 1).max(1) as f64;
        if span <= 0.0 {
            return Some(0.0);
        }
        // The variance of the slope of a cubic through n frames is about 75 / n³ of that of a place, in frames.
        let frames = (75.0 * self.noise() / (NOISE_OF_SPEED * span).powi(2)).cbrt();
        let half = (frames * span / 2.0).max(NARROWEST * span).min(widest);
        let (mut from, mut to) = window(index, times, half);
        if to - from < 2 {
            // At a low rate the neighbours are all there is.
            from = index.saturating_sub(1);
            to = (index + 1).min(self.samples.len() - 1);
        }
        let scale = (times[to] - times[from]).max(1e-9) / 2.0;
        let mut powers = [0.0; 7];
        let mut sums = [Vector3::zeros(); 4];
        let mut count = 0;
        for frame in from..=to {
            let Some(sample) = self.samples[frame] else { continue };
            let time = (times[frame] - times[index]) / scale;
            let place = sample.place - self.samples[index]?.place;
            let mut power = 1.0;
            for (degree, sum) in powers.iter_mut().enumerate() {
                *sum += power;
                if degree < 4 {
                    sums[degree] += place * power;
                }
                power *= time;
            }
            count += 1;
        }
        let fit = match count {
            0 | 1 => return Some(0.0),
            2..=5 => slope::<2>(&powers, &sums),
            _ => slope::<4>(&powers, &sums),
        };
        let (slope, variance) = fit?;
        let square = slope.norm_squared() - 3.0 * self.noise() * variance;
        Some(square.max(0.0).sqrt() / scale)
    }
}

/// The slope at 0 of the polynomial with so many coefficients that fits best, and its variance in that of a place.
fn slope<const N: usize>(powers: &[f64; 7], sums: &[Vector3<f64>; 4]) -> Option<(Vector3<f64>, f64)>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let normal = SMatrix::<f64, N, N>::from_fn(|row, column| powers[row + column]);
    let mut unit = SVector::<f64, N>::zeros();
    unit[1] = 1.0;
    // The row of the inverse that belongs to the slope; the matrix is its own transpose.
    let row = normal.lu().solve(&unit)?;
    let slope = (0..N).map(|degree| sums[degree] * row[degree]).sum();
    Some((slope, row[1]))
}

/// The frames around one that are at most so many seconds away, as many before as after, so that a steady motion is not pulled to one side.
pub(super) fn window(index: usize, times: &VecDeque<f64>, half: f64) -> (usize, usize) {
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
