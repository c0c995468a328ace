//! A lid and its bottle go in; a thread comes out that holds them together until the lid is turned far enough, and takes hold of a lid that is set on and turned back.

use super::space::{self, wrapped, yaw};
use super::stage::Stage;
use learner::log::ObjectId;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::prelude::{GenericJointBuilder, ImpulseJointHandle, JointAxesMask, JointAxis};

/// What the thread resists, in N·m: more than a bottle that stands unheld on a table, and less than one in a hand.
const FRICTION: f32 = 0.15;
/// Additional rounds of the solver for lid and bottle.
const ROUNDS: usize = 20;
/// How far from its seat a lid may be for the thread to take hold, in metres.
const SEAT: f64 = 0.008;
/// How far a lid is turned before the thread takes hold, in radians.
const CATCH: f64 = 0.08;

/// The thread between a lid and a bottle.
#[derive(Debug)]
pub(crate) struct Screw {
    pub(crate) lid: ObjectId,
    pub(crate) bottle: ObjectId,
    joint: Option<ImpulseJointHandle>,
    /// The value of the lid's joint, in radians.
    value: f64,
    /// The angle between lid and bottle at the last step.
    angle: f64,
    /// How far a loose lid was turned towards closing since it was last turned the other way.
    closing: f64,
}

impl Screw {
    /// A thread, closed as far as the lid says.
    pub(super) fn new(stage: &mut Stage, lid: ObjectId, bottle: ObjectId) -> Self {
        let thing = stage.thing(lid);
        let (value, upper) = (thing.start, thing.object.joints[0].upper);
        let mut screw = Self { lid, bottle, joint: None, value, angle: 0.0, closing: 0.0 };
        screw.angle = screw.between(stage);
        // A light lid hands the torque of a hand on to a heavier bottle, which takes the solver some rounds.
        for object in [lid, bottle] {
            let body = stage.body(object);
            stage.world.bodies[body].set_additional_pgs_iterations(ROUNDS);
        }
        if value < upper - CATCH {
            screw.engage(stage);
        }
        screw
    }

    /// The value of the lid's joint, in radians.
    pub(super) fn value(&self) -> f64 {
        self.value
    }

    /// The thread holds.
    pub(super) fn engaged(&self) -> bool {
        self.joint.is_some()
    }

    fn between(&self, stage: &Stage) -> f64 {
        yaw(&(stage.pose(self.bottle).inverse() * stage.pose(self.lid)))
    }

    /// The seat of the lid in the frame of the bottle.
    fn seat(&self, stage: &Stage) -> Vector3<f64> {
        let height = |object| stage.thing(object).object.size.z / 2.0;
        Vector3::z() * (height(self.bottle) + height(self.lid))
    }

    fn engage(&mut self, stage: &mut Stage) {
        let joint = &stage.thing(self.lid).object.joints[0];
        let middle = f64::midpoint(joint.lower, joint.upper);
        // The free axis of the joint is x of its frames, which therefore points up.
        let upright =
            UnitQuaternion::from_axis_angle(&-Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
        let frame = Isometry3::from_parts(self.seat(stage).into(), upright);
        let turn = UnitQuaternion::from_axis_angle(
            &Vector3::z_axis(),
            middle - self.value + self.between(stage),
        );
        let limits = [(joint.lower - middle) as f32, (joint.upper - middle) as f32];
        let thread = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
            .contacts_enabled(false)
            .local_frame1(space::pose(&Isometry3::from_parts(frame.translation, turn * upright)))
            .local_frame2(space::pose(&Isometry3::from_parts(Vector3::zeros().into(), upright)))
            .limits(JointAxis::AngX, limits)
            .motor_velocity(JointAxis::AngX, 0.0, 1e6)
            .motor_max_force(JointAxis::AngX, FRICTION);
        let (bottle, lid) = (stage.body(self.bottle), stage.body(self.lid));
        self.joint = Some(stage.world.insert_impulse_joint(bottle, lid, thread));
    }

    /// Follows the lid after a step: it comes loose, or is caught.
    pub(super) fn follow(&mut self, stage: &mut Stage) {
        let (lower, upper) = {
            let joint = &stage.thing(self.lid).object.joints[0];
            (joint.lower, joint.upper)
        };
        let angle = self.between(stage);
        let turned = wrapped(angle - self.angle);
        self.angle = angle;
        if let Some(joint) = self.joint {
            self.value = (self.value + turned).clamp(lower, upper);
            if self.value > upper - CATCH / 2.0 {
                stage.world.remove_impulse_joint(joint);
                self.joint = None;
                self.value = upper;
                self.closing = 0.0;
            }
            return;
        }
        let relative = stage.pose(self.bottle).inverse() * stage.pose(self.lid);
        let off = relative.translation.vector - self.seat(stage);
        let upright = (relative.rotation * Vector3::z()).z > 0.985;
        if off.xy().norm() > SEAT || off.z.abs() > SEAT || !upright {
            self.closing = 0.0;
            return;
        }
        self.closing = (self.closing - turned).max(0.0);
        if self.closing > CATCH {
            self.value = upper - CATCH;
            self.engage(stage);
        }
    }
}
