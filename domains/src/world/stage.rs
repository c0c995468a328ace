//! Things and hands go in; a physical world comes out that runs in small steps, in which hands hold things by springs of bounded force.
//!
//! Hands are kinematic: they go where they are told. What they hold follows by a joint whose springs have a greatest force,
//! and which breaks when the thing lags behind, so a hand that pulls at something stuck slips off it.

use super::screw::Screw;
use super::space::{self, to_isometry, to_vector};
use super::thing::{Form, Mount, Part, Thing};
use learner::log::{HandId, ObjectId};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::parry::query::intersection_test;
use rapier3d::parry::shape::Cuboid;
use rapier3d::prelude::{
    ColliderBuilder, GenericJointBuilder, ImpulseJointHandle, JointAxesMask, JointAxis,
    PhysicsWorld, PrismaticJointBuilder, RigidBodyBuilder, RigidBodyHandle, RigidBodyType, Vector,
};

/// The length of a step in seconds; two make a frame.
pub(crate) const STEP: f64 = 1.0 / 180.0;
/// How near the fingers must be to take something, in metres.
const GRIP_DISTANCE: f64 = 0.02;
/// How far what is held may lag behind before it slips out of the hand, in metres.
const SLIP_DISTANCE: f64 = 0.025;
/// How far it may turn in the hand, in radians.
const SLIP_ANGLE: f64 = 0.6;

/// What a hand holds.
#[derive(Debug, Clone)]
struct Hold {
    object: ObjectId,
    joint: ImpulseJointHandle,
    /// The pose of the thing in the frame of the hand when it was taken.
    relative: Isometry3<f64>,
}

/// A hand as a body.
#[derive(Debug)]
struct Palm {
    body: RigidBodyHandle,
    pose: Isometry3<f64>,
    velocity: Vector3<f64>,
    closed: bool,
    hold: Option<Hold>,
}

/// A physical world.
pub(crate) struct Stage {
    pub(super) world: PhysicsWorld,
    things: Vec<Thing>,
    bodies: Vec<RigidBodyHandle>,
    palms: Vec<Palm>,
    screw: Option<Screw>,
}

impl Stage {
    /// A world of things, of parts that no log knows, and of hands; the lid and the bottle of a screw may be named.
    pub(crate) fn new(
        things: Vec<Thing>,
        scenery: &[Part],
        hands: &[Isometry3<f64>],
        screw: Option<(ObjectId, ObjectId)>,
    ) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -9.81);
        world.integration_parameters.dt = STEP as f32;
        // Things are some ten centimetres large; contacts are as much finer.
        world.integration_parameters.length_unit = 0.2;
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        for part in scenery {
            world.insert_collider(collider(part, 0.6), Some(ground));
        }
        let bodies = things.iter().map(|thing| insert(&mut world, ground, thing)).collect();
        let palms = hands
            .iter()
            .map(|pose| Palm {
                body: world.insert_body(
                    RigidBodyBuilder::kinematic_position_based().pose(space::pose(pose)),
                ),
                pose: *pose,
                velocity: Vector3::zeros(),
                closed: false,
                hold: None,
            })
            .collect();
        let mut stage = Self { world, things, bodies, palms, screw: None };
        if let Some((lid, bottle)) = screw {
            let screw = Screw::new(&mut stage, lid, bottle);
            stage.screw = Some(screw);
        }
        stage
    }

    /// One step in which the hands come to these poses.
    pub(crate) fn step(&mut self, hands: &[Isometry3<f64>]) {
        for (palm, aim) in self.palms.iter_mut().zip(hands) {
            palm.velocity = (aim.translation.vector - palm.pose.translation.vector) / STEP;
            palm.pose = *aim;
            self.world.bodies[palm.body].set_next_kinematic_position(space::pose(aim));
        }
        self.world.step();
        if let Some(mut screw) = self.screw.take() {
            screw.follow(self);
            self.screw = Some(screw);
        }
        for hand in 0..self.palms.len() {
            let Some(hold) = &self.palms[hand].hold else { continue };
            let lag = (self.palms[hand].pose * hold.relative).inverse() * self.pose(hold.object);
            let articulated = !self.things[hold.object.index()].object.joints.is_empty();
            let drift = self.palms[hand].pose.inverse() * self.pose(hold.object);
            let distance = if articulated && self.is_slider(hold.object) {
                (drift.translation.vector - hold.relative.translation.vector).norm()
            } else {
                lag.translation.vector.norm()
            };
            if distance > SLIP_DISTANCE
                || (!self.is_slider(hold.object) && lag.rotation.angle() > SLIP_ANGLE)
            {
                self.release(HandId(hand as u32));
            }
        }
    }

    fn is_slider(&self, object: ObjectId) -> bool {
        matches!(self.things[object.index()].mount, Mount::Slides(_))
    }

    /// Closes a hand, around the nearest thing if its fingers are at one, or opens it.
    pub(crate) fn grip(&mut self, hand: HandId, closed: bool) {
        let palm = &mut self.palms[hand.index()];
        if palm.closed == closed {
            return;
        }
        palm.closed = closed;
        if !closed {
            self.release(hand);
            return;
        }
        let place = self.palms[hand.index()].pose.translation.vector;
        let nearest = (0..self.things.len() as u32)
            .map(ObjectId)
            .filter(|object| {
                matches!(self.things[object.index()].mount, Mount::Free | Mount::Slides(_))
            })
            .map(|object| (self.distance(object, place), object))
            .min_by(|first, second| first.0.total_cmp(&second.0))
            .filter(|(distance, _)| *distance <= GRIP_DISTANCE);
        if let Some((_, object)) = nearest {
            self.take(hand, object);
        }
    }

    fn take(&mut self, hand: HandId, object: ObjectId) {
        let thing = &self.things[object.index()];
        let relative = self.palms[hand.index()].pose.inverse() * self.pose(object);
        let slides = self.is_slider(object);
        // Springs in terms of acceleration: frequency² and twice the frequency are critically damped.
        // Arms give way to what is heavy, so that a small slant of the hand does not press it into the floor.
        let (straight, round) = match (slides, thing.mass > 1.0) {
            (true, _) => (30.0_f32, 0.0_f32),
            (false, true) => (30.0, 12.0),
            (false, false) => (80.0, 250.0),
        };
        let mut joint = GenericJointBuilder::new(JointAxesMask::empty())
            .contacts_enabled(true)
            .local_frame1(space::pose(&relative))
            .local_frame2(space::pose(&Isometry3::identity()));
        if slides {
            // A handle turns between the fingers, which hold it where they are.
            let point = self.pose(object).inverse() * self.palms[hand.index()].pose;
            joint = joint
                .local_frame1(space::pose(&Isometry3::from_parts(
                    Vector3::zeros().into(),
                    relative.rotation,
                )))
                .local_frame2(space::pose(&Isometry3::from_parts(
                    point.translation,
                    UnitQuaternion::identity(),
                )));
        }
        for axis in [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ] {
            joint = joint
                .set_motor(axis, 0.0, 0.0, straight * straight, 2.0 * straight)
                .motor_max_force(axis, thing.hold as f32);
        }
        if !slides {
            for axis in [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ] {
                joint = joint
                    .set_motor(axis, 0.0, 0.0, round * round, 2.0 * round)
                    .motor_max_force(axis, 0.1 * thing.hold as f32);
            }
        }
        let (palm, body) = (self.palms[hand.index()].body, self.bodies[object.index()]);
        let joint = self.world.insert_impulse_joint(palm, body, joint);
        self.palms[hand.index()].hold = Some(Hold { object, joint, relative });
    }

    fn release(&mut self, hand: HandId) {
        if let Some(hold) = self.palms[hand.index()].hold.take() {
            self.world.remove_impulse_joint(hold.joint);
        }
    }

    /// All hands.
    pub(crate) fn hands(&self) -> impl Iterator<Item = HandId> + use<> {
        (0..self.palms.len() as u32).map(HandId)
    }

    /// All things.
    pub(crate) fn objects(&self) -> impl Iterator<Item = ObjectId> + use<> {
        (0..self.things.len() as u32).map(ObjectId)
    }

    /// A thing as it was put in.
    pub(crate) fn thing(&self, object: ObjectId) -> &Thing {
        &self.things[object.index()]
    }

    /// The thing of a name.
    pub(crate) fn named(&self, name: &str) -> Option<ObjectId> {
        self.objects().find(|object| self.thing(*object).object.name == name)
    }

    /// Where a hand is.
    pub(crate) fn hand(&self, hand: HandId) -> Isometry3<f64> {
        self.palms[hand.index()].pose
    }

    /// How a hand moves, in m/s.
    pub(crate) fn velocity(&self, hand: HandId) -> Vector3<f64> {
        self.palms[hand.index()].velocity
    }

    /// Whether a hand is closed.
    pub(crate) fn closed(&self, hand: HandId) -> bool {
        self.palms[hand.index()].closed
    }

    /// What a hand holds.
    pub(crate) fn held(&self, hand: HandId) -> Option<ObjectId> {
        self.palms[hand.index()].hold.as_ref().map(|hold| hold.object)
    }

    /// Where a thing is: the middle of its box.
    pub(crate) fn pose(&self, object: ObjectId) -> Isometry3<f64> {
        to_isometry(self.world.bodies[self.bodies[object.index()]].position())
    }

    /// The body of a thing.
    pub(super) fn body(&self, object: ObjectId) -> RigidBodyHandle {
        self.bodies[object.index()]
    }

    /// The values of the joints of a thing, in metres or radians.
    pub(crate) fn joints(&self, object: ObjectId) -> Vec<f64> {
        let thing = self.thing(object);
        let Some(joint) = thing.object.joints.first() else { return Vec::new() };
        if let (Some(screw), Mount::Free) = (&self.screw, thing.mount) {
            return vec![screw.value()];
        }
        let moved = self.pose(object).translation.vector - thing.pose.translation.vector;
        vec![moved.dot(&(thing.pose.rotation * joint.axis))]
    }

    /// How far a thing is open, from 0 (its lower limit) to 1; none without a joint.
    pub(crate) fn opening(&self, object: ObjectId) -> Option<f64> {
        let joint = self.thing(object).object.joints.first()?;
        let value = self.joints(object)[0];
        Some((value - joint.lower) / (joint.upper - joint.lower))
    }

    /// Which bottle a lid is screwed to.
    pub(crate) fn screwed(&self, lid: ObjectId) -> Option<ObjectId> {
        self.screw.as_ref().filter(|screw| screw.lid == lid && screw.engaged()).map(|s| s.bottle)
    }

    /// How far a point is from the parts of a thing, in metres; 0 inside.
    pub(crate) fn distance(&self, object: ObjectId, point: Vector3<f64>) -> f64 {
        let body = &self.world.bodies[self.bodies[object.index()]];
        body.colliders()
            .iter()
            .map(|collider| {
                let collider = &self.world.colliders[*collider];
                f64::from(collider.shape().distance_to_point(
                    collider.position(),
                    space::vector(point),
                    true,
                ))
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Whether a part of a thing is in a box of half this extent.
    pub(crate) fn overlaps(
        &self,
        object: ObjectId,
        place: &Isometry3<f64>,
        half: Vector3<f64>,
    ) -> bool {
        let (place, space) = (space::pose(place), Cuboid::new(space::vector(half)));
        self.world.bodies[self.bodies[object.index()]].colliders().iter().any(|collider| {
            let collider = &self.world.colliders[*collider];
            intersection_test(&place, &space, collider.position(), collider.shape())
                .is_ok_and(|found| found.intersecting)
        })
    }

    /// What touches what: pairs of things with the direction from the first to the second in which they press.
    pub(crate) fn contacts(&self) -> Vec<(ObjectId, ObjectId, Vector3<f64>)> {
        let owner = |collider| {
            let body = self.world.colliders.get(collider)?.parent()?;
            self.bodies.iter().position(|other| *other == body).map(|at| ObjectId(at as u32))
        };
        self.world
            .contact_pairs()
            .filter(|pair| pair.has_any_active_contact())
            .filter_map(|pair| {
                let (first, second) = (owner(pair.collider1)?, owner(pair.collider2)?);
                let manifold =
                    pair.manifolds().iter().find(|manifold| !manifold.points.is_empty())?;
                Some((first, second, to_vector(manifold.data.normal)))
            })
            .collect()
    }

    /// The smallest distance between two hands, in metres.
    pub(crate) fn clearance(&self) -> f64 {
        let mut least = f64::INFINITY;
        for (at, first) in self.palms.iter().enumerate() {
            for second in &self.palms[at + 1..] {
                let between = first.pose.translation.vector - second.pose.translation.vector;
                least = least.min(between.norm());
            }
        }
        least
    }
}

fn collider(part: &Part, friction: f64) -> ColliderBuilder {
    let (shape, place) = match part.form {
        Form::Box(size) => (
            ColliderBuilder::cuboid(size.x as f32 / 2.0, size.y as f32 / 2.0, size.z as f32 / 2.0),
            part.place,
        ),
        // The engine's cylinders stand along y.
        Form::Cylinder { radius, height } => (
            ColliderBuilder::cylinder(height as f32 / 2.0, radius as f32),
            part.place
                * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2),
        ),
    };
    shape.position(space::pose(&place)).friction(friction as f32).restitution(0.0)
}

fn insert(world: &mut PhysicsWorld, ground: RigidBodyHandle, thing: &Thing) -> RigidBodyHandle {
    let kind = match thing.mount {
        Mount::Free | Mount::Slides(_) => RigidBodyType::Dynamic,
        Mount::Fixed | Mount::Nowhere => RigidBodyType::Fixed,
    };
    let joint = thing.object.joints.first();
    let pose = match (thing.mount, joint) {
        (Mount::Slides(_), Some(joint)) => {
            thing.pose * Isometry3::from(nalgebra::Translation3::from(joint.axis * thing.start))
        }
        _ => thing.pose,
    };
    let body = world.insert_body(
        RigidBodyBuilder::new(kind)
            .pose(space::pose(&pose))
            .can_sleep(false)
            .linear_damping(0.05)
            .angular_damping(0.2),
    );
    let volume: f64 = thing.parts.iter().map(|part| volume(part.form)).sum();
    for part in &thing.parts {
        let share = if volume > 0.0 { volume_share(part.form, volume) * thing.mass } else { 0.0 };
        world.insert_collider(collider(part, thing.friction).mass(share as f32), Some(body));
    }
    if let (Mount::Slides(friction), Some(joint)) = (thing.mount, joint) {
        world.insert_impulse_joint(
            ground,
            body,
            PrismaticJointBuilder::new(space::vector(joint.axis))
                .contacts_enabled(false)
                .local_anchor1(space::vector(thing.pose.translation.vector))
                .limits([joint.lower as f32, joint.upper as f32])
                .motor_velocity(0.0, 1000.0)
                .motor_max_force(friction as f32),
        );
    }
    body
}

fn volume(form: Form) -> f64 {
    match form {
        Form::Box(size) => size.x * size.y * size.z,
        Form::Cylinder { radius, height } => std::f64::consts::PI * radius * radius * height,
    }
}

fn volume_share(form: Form, whole: f64) -> f64 {
    volume(form) / whole
}
