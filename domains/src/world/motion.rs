//! Where a hand is and where it shall be go in; the way between them comes out, smooth and bounded in speed and acceleration.
//!
//! A hand runs along a Bézier curve or an arc by the minimum-jerk profile `10τ³ − 15τ⁴ + 6τ⁵`
//! (Flash and Hogan 1985), whose greatest speed is 1.875 and whose greatest acceleration is 5.774 times that of the mean.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

/// No hand is faster than this, in m/s.
pub const GREATEST_SPEED: f64 = 1.2;
/// No hand gains more speed along its way than this, in m/s².
pub const GREATEST_ACCELERATION: f64 = 6.0;
/// No hand turns faster than this, in rad/s.
pub const GREATEST_TURN: f64 = 5.0;

/// How often a curve is sampled to know its length.
const SAMPLES: usize = 48;

/// The course of a way.
#[derive(Debug, Clone)]
enum Course {
    /// A cubic Bézier curve with the length from its start at each sample.
    Bezier { points: [Vector3<f64>; 4], lengths: Vec<f64> },
    /// A turn about an axis.
    Arc { centre: Vector3<f64>, axis: Unit<Vector3<f64>>, angle: f64, start: Isometry3<f64> },
}

/// A way of a hand in time.
#[derive(Debug, Clone)]
pub(crate) struct Way {
    course: Course,
    from: UnitQuaternion<f64>,
    to: UnitQuaternion<f64>,
    /// How long it takes, in seconds.
    pub(crate) duration: f64,
}

impl Way {
    /// From one pose to another.
    ///
    /// `leave` and `arrive` are added to the ends to get the middle points of the curve, so a way that leaves upwards and arrives downwards has both upwards.
    /// It takes as long as its greatest speed allows, and no shorter than `least` seconds.
    pub(crate) fn new(
        start: &Isometry3<f64>,
        end: &Isometry3<f64>,
        leave: Vector3<f64>,
        arrive: Vector3<f64>,
        speed: f64,
        least: f64,
    ) -> Self {
        let points = [
            start.translation.vector,
            start.translation.vector + leave,
            end.translation.vector + arrive,
            end.translation.vector,
        ];
        let mut lengths = vec![0.0; SAMPLES + 1];
        let mut before = points[0];
        for sample in 1..=SAMPLES {
            let here = bezier(&points, sample as f64 / SAMPLES as f64);
            lengths[sample] = lengths[sample - 1] + (here - before).norm();
            before = here;
        }
        let turn = start.rotation.angle_to(&end.rotation);
        let duration = duration(lengths[SAMPLES], turn, speed).max(least);
        let course = Course::Bezier { points, lengths };
        Self { course, from: start.rotation, to: end.rotation, duration }
    }

    /// A turn about an axis through a point, by an angle in radians.
    pub(crate) fn around(
        start: &Isometry3<f64>,
        centre: Vector3<f64>,
        axis: Unit<Vector3<f64>>,
        angle: f64,
        speed: f64,
    ) -> Self {
        let arm = start.translation.vector - centre;
        let radius = (arm - axis.scale(arm.dot(&axis))).norm();
        Self {
            course: Course::Arc { centre, axis, angle, start: *start },
            from: start.rotation,
            to: UnitQuaternion::from_axis_angle(&axis, angle) * start.rotation,
            duration: duration(radius * angle.abs(), angle.abs(), speed),
        }
    }

    /// Where the hand is after so many seconds.
    pub(crate) fn at(&self, time: f64) -> Isometry3<f64> {
        let share = minimum_jerk((time / self.duration).clamp(0.0, 1.0));
        match &self.course {
            Course::Bezier { points, lengths } => Isometry3::from_parts(
                Translation3::from(bezier(points, parameter(lengths, share))),
                self.from.try_slerp(&self.to, share, 1e-9).unwrap_or(self.to),
            ),
            Course::Arc { centre, axis, angle, start } => {
                let turn = UnitQuaternion::from_axis_angle(axis, angle * share);
                Isometry3::from_parts(
                    Translation3::from(centre + turn * (start.translation.vector - centre)),
                    turn * start.rotation,
                )
            }
        }
    }
}

/// How much of the way is done after a share of the time.
fn minimum_jerk(share: f64) -> f64 {
    share.powi(3) * (10.0 + share * (6.0 * share - 15.0))
}

/// How long a way of a length and a turn takes.
fn duration(length: f64, turn: f64, speed: f64) -> f64 {
    let speed = speed.clamp(0.02, GREATEST_SPEED);
    (1.875 * length / speed)
        .max((5.774 * length / GREATEST_ACCELERATION).sqrt())
        .max(1.875 * turn / GREATEST_TURN)
        .max(0.12)
}

/// A point of a cubic Bézier curve.
fn bezier(points: &[Vector3<f64>; 4], at: f64) -> Vector3<f64> {
    let rest = 1.0 - at;
    points[0] * rest.powi(3)
        + points[1] * (3.0 * rest * rest * at)
        + points[2] * (3.0 * rest * at * at)
        + points[3] * at.powi(3)
}

/// The parameter at which a share of the length is behind.
fn parameter(lengths: &[f64], share: f64) -> f64 {
    let wanted = share * lengths[SAMPLES];
    let after = lengths.partition_point(|&length| length < wanted).clamp(1, SAMPLES);
    let step = lengths[after] - lengths[after - 1];
    let part = if step > 0.0 { (wanted - lengths[after - 1]) / step } else { 1.0 };
    (after as f64 - 1.0 + part) / SAMPLES as f64
}

#[cfg(test)]
mod tests {
    use super::{GREATEST_ACCELERATION, GREATEST_SPEED, Way};
    use crate::world::space::{at, turned};
    use nalgebra::Vector3;

    #[test]
    fn a_way_starts_and_ends_where_it_shall_and_keeps_its_bounds() {
        for (asked, distance) in [(0.3, 0.5), (9.0, 1.5), (0.8, 0.05)] {
            let (start, end) = (at(0.0, 0.0, 0.8), turned(Vector3::new(distance, 0.1, 0.9), 1.0));
            let up = Vector3::z() * 0.2;
            let way = Way::new(&start, &end, up, up, asked, 0.0);
            assert!((way.at(0.0).translation.vector - start.translation.vector).norm() < 1e-9);
            assert!(
                (way.at(way.duration).translation.vector - end.translation.vector).norm() < 1e-9
            );
            assert!(way.at(way.duration).rotation.angle_to(&end.rotation) < 1e-6);
            let step = 1.0 / 180.0;
            let mut before = (0.0_f64, way.at(0.0));
            for tick in 1..=(way.duration / step) as u32 {
                let here = way.at(f64::from(tick) * step);
                let speed = (here.translation.vector - before.1.translation.vector).norm() / step;
                assert!(speed < asked.min(GREATEST_SPEED) * 1.02, "{speed} of {asked}");
                // Along the curve; what bends the way comes on top.
                assert!((speed - before.0).abs() / step < GREATEST_ACCELERATION * 1.3);
                before = (speed, here);
            }
        }
    }

    #[test]
    fn a_turn_keeps_its_distance() {
        let way = Way::around(&at(0.04, 0.0, 0.2), Vector3::zeros(), Vector3::z_axis(), 2.0, 0.2);
        for share in [0.0, 0.3, 0.7, 1.0] {
            let here = way.at(share * way.duration).translation.vector;
            assert!((here.xy().norm() - 0.04).abs() < 1e-9);
            assert!((here.z - 0.2).abs() < 1e-9);
        }
    }
}
