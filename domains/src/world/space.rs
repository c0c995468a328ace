//! Poses and vectors of the program go in, those of the physics engine come out, and back.
//!
//! The program measures in `f64` and speaks nalgebra, the engine in `f32` and glam; nothing of the engine's types leaves the worlds.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier3d::math::{Pose, Rotation, Vector};

/// A vector for the engine.
pub(crate) fn vector(value: Vector3<f64>) -> Vector {
    Vector::new(value.x as f32, value.y as f32, value.z as f32)
}

/// A pose for the engine.
pub(crate) fn pose(value: &Isometry3<f64>) -> Pose {
    let turn = value.rotation.quaternion();
    Pose::from_parts(
        vector(value.translation.vector),
        Rotation::from_xyzw(turn.i as f32, turn.j as f32, turn.k as f32, turn.w as f32).normalize(),
    )
}

/// A vector from the engine.
pub(crate) fn to_vector(value: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(value.x), f64::from(value.y), f64::from(value.z))
}

/// A pose from the engine.
pub(crate) fn to_isometry(value: &Pose) -> Isometry3<f64> {
    let turn = value.rotation;
    Isometry3::from_parts(
        Translation3::from(to_vector(value.translation)),
        UnitQuaternion::from_quaternion(Quaternion::new(
            f64::from(turn.w),
            f64::from(turn.x),
            f64::from(turn.y),
            f64::from(turn.z),
        )),
    )
}

/// A pose at a place, without a turn.
pub(crate) fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}

/// A pose at a place, turned about the vertical by an angle in radians.
pub(crate) fn turned(place: Vector3<f64>, yaw: f64) -> Isometry3<f64> {
    Isometry3::from_parts(
        Translation3::from(place),
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw),
    )
}

/// The turn about the vertical of a pose, in radians, by where its x axis points.
pub(crate) fn yaw(pose: &Isometry3<f64>) -> f64 {
    let front = pose.rotation * Vector3::x();
    front.y.atan2(front.x)
}

/// An angle brought into −π to π.
pub(crate) fn wrapped(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}

#[cfg(test)]
mod tests {
    use super::{pose, to_isometry, turned, wrapped, yaw};
    use nalgebra::Vector3;

    #[test]
    fn a_pose_survives_the_way_into_the_engine_and_back() {
        let there = turned(Vector3::new(0.3, -1.2, 0.75), 2.1);
        let back = to_isometry(&pose(&there));
        assert!((there.translation.vector - back.translation.vector).norm() < 1e-6);
        assert!(there.rotation.angle_to(&back.rotation) < 1e-6);
        assert!((yaw(&back) - 2.1).abs() < 1e-6);
    }

    #[test]
    fn angles_are_brought_near_zero() {
        assert!((wrapped(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-12);
        assert!((wrapped(-4.0) - (std::f64::consts::TAU - 4.0)).abs() < 1e-12);
    }
}
