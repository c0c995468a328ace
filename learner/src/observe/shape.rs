//! Poses and sizes of boxes go in; distances, overlaps and what lies over what come out.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

/// A box at its place, with what is asked of it often.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    /// The pose of its middle.
    pub pose: Isometry3<f64>,
    /// Its axes in the world, as columns.
    axes: Matrix3<f64>,
    /// Half of its extents along its own axes.
    pub half: Vector3<f64>,
    /// The radius of the ball around it.
    pub radius: f64,
}

impl Shape {
    /// A box at its place.
    pub fn new(pose: Isometry3<f64>, size: &Vector3<f64>) -> Self {
        let half = size / 2.0;
        let axes = pose.rotation.to_rotation_matrix().into_inner();
        Self { pose, axes, half, radius: half.norm() }
    }

    /// Where its middle is.
    pub fn middle(&self) -> Vector3<f64> {
        self.pose.translation.vector
    }

    /// A point in the frame of the box.
    pub fn local(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.axes.tr_mul(&(point - self.middle()))
    }

    /// How far a point is from the surface; negative inside.
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        let outside = self.local(point).abs() - self.half;
        let deepest = outside.max();
        if deepest <= 0.0 { deepest } else { outside.map(|beyond| beyond.max(0.0)).norm() }
    }

    /// The axis of the box that is nearest to the vertical.
    pub fn upright(&self) -> usize {
        self.axes.row(2).transpose().iamax()
    }

    /// How far apart two boxes are, from the separating axes: never more than their true distance, and negative where they overlap.
    pub fn separation(&self, other: &Shape) -> f64 {
        let between = other.middle() - self.middle();
        let gap = |axis: Vector3<f64>| {
            let length = axis.norm();
            if length < 1e-9 {
                return f64::NEG_INFINITY;
            }
            (axis.dot(&between).abs() - self.extent(&axis) - other.extent(&axis)) / length
        };
        let mut best = f64::NEG_INFINITY;
        for first in 0..3 {
            best = best.max(gap(self.axes.column(first).into_owned()));
            best = best.max(gap(other.axes.column(first).into_owned()));
            for second in 0..3 {
                best = best.max(gap(self.axes.column(first).cross(&other.axes.column(second))));
            }
        }
        best
    }

    /// Half of the extent along a direction of the world, times the length of that direction.
    fn extent(&self, direction: &Vector3<f64>) -> f64 {
        self.axes.tr_mul(direction).abs().dot(&self.half)
    }

    /// How far the middle of another box is beyond the sides of this one, seen along the axis that is nearest to the vertical; negative within.
    pub fn beyond(&self, other: &Shape) -> f64 {
        let local = self.local(&other.middle());
        let upright = self.upright();
        (0..3)
            .filter(|&axis| axis != upright)
            .map(|axis| local[axis].abs() - self.half[axis])
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far the lowest side of another box is above the upper side of this one, along the axis of this one that is nearest to the vertical.
    pub fn above(&self, other: &Shape) -> f64 {
        let upright = self.upright();
        let axis = self.axes.column(upright).into_owned();
        let sign = if axis.z < 0.0 { -1.0 } else { 1.0 };
        sign * axis.dot(&(other.middle() - self.middle()))
            - self.half[upright]
            - other.extent(&axis)
    }

    /// The box that this one passes through when it moves along a direction of its own frame, from so far behind it to so far before it.
    pub fn swept(&self, axis: &Vector3<f64>, from: f64, to: f64) -> Shape {
        let middle = self.pose * Point3::from(axis * f64::midpoint(from, to));
        let mut pose = self.pose;
        pose.translation.vector = middle.coords;
        let half = self.half + axis.abs() * ((to - from).abs() / 2.0);
        Shape::new(pose, &(half * 2.0))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    use super::*;

    fn at(x: f64, y: f64, z: f64, size: [f64; 3]) -> Shape {
        Shape::new(Isometry3::translation(x, y, z), &Vector3::from(size))
    }

    #[test]
    fn distances_are_to_the_surface() {
        let cube = at(1.0, 0.0, 0.0, [0.2; 3]);
        assert!((cube.distance(&Vector3::zeros()) - 0.9).abs() < 1e-12);
        assert!((cube.distance(&Vector3::new(1.05, 0.0, 0.0)) + 0.05).abs() < 1e-12);
    }

    #[test]
    fn a_drawer_sweeps_the_space_before_it() {
        let drawer = at(0.0, 0.0, 0.5, [0.4, 0.4, 0.2]);
        let way = drawer.swept(&Vector3::x(), 0.0, 0.3);
        assert!((way.middle() - Vector3::new(0.15, 0.0, 0.5)).norm() < 1e-12);
        assert!((way.half.x - 0.35).abs() < 1e-12);
    }

    fn shapes() -> impl Strategy<Value = Shape> {
        let number = -1.0..1.0f64;
        let size = 0.05..0.6f64;
        (
            [number.clone(), number.clone(), number.clone()],
            [number.clone(), number.clone(), number],
            [size.clone(), size.clone(), size],
        )
            .prop_map(|(place, turn, size)| {
                let rotation = UnitQuaternion::new(Vector3::from(turn) * 3.0);
                let pose = Isometry3::from_parts(Vector3::from(place).into(), rotation);
                Shape::new(pose, &Vector3::from(size))
            })
    }

    proptest! {
        /// Against points in both boxes: none is nearer to the other box than the separation, and where boxes are said to overlap some point is in both or nearly.
        #[test]
        fn separation_is_a_lower_bound_of_the_distance(one in shapes(), other in shapes()) {
            let separation = one.separation(&other);
            let mut nearest = f64::INFINITY;
            // Alternating projections between two convex bodies converge to their distance.
            let mut point = other.middle();
            for _ in 0..2000 {
                let on_one = nearest_in(&one, &point);
                point = nearest_in(&other, &on_one);
                nearest = nearest.min((point - on_one).norm());
            }
            prop_assert!(separation.max(0.0) <= nearest + 1e-9);
            prop_assert!(separation > 0.0 || nearest < 0.01, "{separation} {nearest}");
        }
    }

    fn nearest_in(shape: &Shape, point: &Vector3<f64>) -> Vector3<f64> {
        let local = shape.local(point);
        let inside = local.zip_map(&shape.half, |value, half| value.clamp(-half, half));
        (shape.pose * Point3::from(inside)).coords
    }
}
