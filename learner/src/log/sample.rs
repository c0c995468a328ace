//! Numbers as they stand in a log go in; poses, joints and times that can be relied on come out, or what is wrong with them.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::fault::Fault;
use super::header::Scale;
use super::{Motion, Object};

/// A quaternion that is at most so much shorter or longer than 1 was rounded, and is made right.
const ROUNDED: f64 = 0.02;

/// A pose of a place and a quaternion `[x, y, z, qx, qy, qz, qw]`.
pub(super) fn pose(values: [f64; 7], scale: Scale) -> Result<Isometry3<f64>, Fault> {
    if !values.iter().all(|value| value.is_finite()) {
        return Err(Fault::NotFinite);
    }
    let turn = Quaternion::new(values[6], values[3], values[4], values[5]);
    let length = turn.norm();
    if (length - 1.0).abs() > ROUNDED {
        return Err(Fault::Quaternion(length));
    }
    let place = Translation3::new(
        values[0] * scale.length,
        values[1] * scale.length,
        values[2] * scale.length,
    );
    Ok(Isometry3::from_parts(place, UnitQuaternion::new_normalize(turn)))
}

/// The values of the joints of an object; none at all where they are not measured.
pub(super) fn joints(values: &mut [f64], object: &Object, scale: Scale) -> Result<(), Fault> {
    if values.len() != object.joints.len() {
        return Err(Fault::Joints { expected: object.joints.len(), found: values.len() });
    }
    for (value, joint) in values.iter_mut().zip(&object.joints) {
        if !value.is_finite() {
            return Err(Fault::NotFinite);
        }
        *value *= match joint.motion {
            Motion::Slides => scale.length,
            Motion::Turns => scale.angle,
        };
    }
    Ok(())
}

/// A number from 0 to 1.
pub(super) fn share(value: f64) -> Result<f64, Fault> {
    if !value.is_finite() {
        Err(Fault::NotFinite)
    } else if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err(Fault::Range { value })
    }
}

/// The time of a frame, which must be later than that of the one before it.
pub(super) fn time(value: f64, scale: Scale, before: Option<f64>) -> Result<f64, Fault> {
    let now = value * scale.time;
    match before {
        _ if !now.is_finite() => Err(Fault::NotFinite),
        Some(before) if now < before => Err(Fault::Backwards { now, before }),
        Some(before) if now <= before => Err(Fault::Still(now)),
        _ => Ok(now),
    }
}
