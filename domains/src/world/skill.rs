//! What a hand shall do next goes in, such as to take a cube; the movements that do it in the world as it is now come out.

use super::motion::Way;
use super::person::Person;
use super::space::{self, turned, yaw};
use super::stage::Stage;
use super::thing::Mount;
use crate::chance::Chance;
use learner::log::{HandId, ObjectId};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// One thing that a hand can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Skill {
    /// Take something, and lift it if `lift` is more than 0, in metres.
    Take { thing: ObjectId, lift: f64 },
    /// Put what the hand holds on something: on its middle, or where `place` says.
    Put { thing: ObjectId, on: ObjectId, place: Option<Vector3<f64>> },
    /// Put what the hand holds into an open drawer.
    Insert { thing: ObjectId, into: ObjectId },
    /// Move a drawer until it is open so far, from 0 to 1, and let it go.
    Slide { drawer: ObjectId, opening: f64 },
    /// Take something heavy, move it along the floor by so much, and let it go.
    Drag { thing: ObjectId, by: Vector3<f64> },
    /// Turn the lid in the hand about its axis, by an angle in radians.
    Turn { lid: ObjectId, angle: f64 },
    /// Set what the hand holds on a bottle, without letting it go.
    Seat { lid: ObjectId, bottle: ObjectId },
    /// Let go and back off.
    Leave,
    /// Go to a place.
    Go(Isometry3<f64>),
    /// Start towards something and think better of it.
    Falter(ObjectId),
    /// Rest, in seconds.
    Pause(f64),
    /// Wait until another hand has done so many of its skills.
    Await { hand: HandId, skills: usize },
}

/// One movement of a hand.
#[derive(Debug, Clone)]
pub(crate) enum Act {
    /// Go a way; `about` is what the hand approaches or works on.
    Go { way: Box<Way>, about: Option<ObjectId> },
    /// Close or open the hand.
    Grip(bool),
    /// Rest, in seconds.
    Rest(f64),
}

/// How a skill is carried out: by whom, and with which hand.
pub(crate) struct Planner<'world> {
    pub(crate) stage: &'world Stage,
    pub(crate) person: &'world Person,
    pub(crate) chance: &'world mut Chance,
    pub(crate) hand: HandId,
    acts: Vec<Act>,
    /// Where the hand is after the movements so far.
    at: Isometry3<f64>,
}

/// The gap over what something is set on before it is let go, in metres.
const GAP: (f64, f64) = (0.001, 0.004);

impl<'world> Planner<'world> {
    /// For a hand as it is now.
    pub(crate) fn new(
        stage: &'world Stage,
        person: &'world Person,
        chance: &'world mut Chance,
        hand: HandId,
    ) -> Self {
        Self { stage, person, chance, hand, acts: Vec::new(), at: stage.hand(hand) }
    }

    /// The movements of a skill.
    pub(crate) fn acts(mut self, skill: &Skill) -> Vec<Act> {
        match *skill {
            Skill::Take { thing, lift } => self.take(thing, lift),
            Skill::Put { thing, on, place } => self.put(thing, on, place),
            Skill::Insert { thing, into } => self.insert(thing, into),
            Skill::Slide { drawer, opening } => self.slide(drawer, opening),
            Skill::Drag { thing, by } => {
                self.close_on(thing);
                let end = space::at(by.x, by.y, by.z) * self.at;
                self.go(end, Vector3::zeros(), Vector3::zeros(), 0.8, None);
                self.leave();
            }
            Skill::Turn { lid, angle } => {
                let centre = self.stage.pose(lid).translation.vector;
                let way = Way::around(&self.at, centre, Vector3::z_axis(), angle, 0.12);
                self.at = way.at(way.duration);
                self.acts.push(Act::Go { way: Box::new(way), about: None });
                self.acts.push(Act::Rest(self.person.delay));
            }
            Skill::Seat { lid, bottle } => {
                let seat = self.above(lid, bottle, Vector3::zeros(), 0.001);
                self.carry(lid, seat, Some(bottle));
                self.acts.push(Act::Rest(self.person.delay));
            }
            Skill::Leave => self.leave(),
            Skill::Go(pose) => {
                let rise = Vector3::z() * (self.person.height * 0.3);
                self.go(pose, self.back(), rise, 1.0, None);
            }
            Skill::Falter(thing) => {
                let aim = self.grasp(thing);
                let short = aim.translation.vector
                    + (self.at.translation.vector - aim.translation.vector)
                        .try_normalize(1e-9)
                        .unwrap_or_else(Vector3::z)
                        * self.chance.within((0.07, 0.12));
                let aim = Isometry3::from_parts(short.into(), aim.rotation);
                self.go(aim, self.back(), aim.rotation * Vector3::z() * 0.05, 0.8, Some(thing));
                self.acts.push(Act::Rest(self.chance.within((0.15, 0.4))));
            }
            Skill::Pause(time) => self.acts.push(Act::Rest(time)),
            Skill::Await { .. } => {}
        }
        self.acts
    }

    /// Backwards from where the palm is, or up with something in the hand.
    fn back(&self) -> Vector3<f64> {
        if self.stage.held(self.hand).is_some() {
            Vector3::z() * self.person.height
        } else {
            self.at.rotation * Vector3::z() * self.person.height
        }
    }

    fn go(
        &mut self,
        end: Isometry3<f64>,
        leave: Vector3<f64>,
        arrive: Vector3<f64>,
        pace: f64,
        about: Option<ObjectId>,
    ) {
        if self.chance.happens(self.person.hesitation) {
            let pause = self.chance.within((0.2, self.person.pause.max(0.21)));
            self.acts.push(Act::Rest(pause));
        }
        let way = Way::new(&self.at, &end, leave, arrive, self.person.speed * pace, 0.15);
        self.at = end;
        self.acts.push(Act::Go { way: Box::new(way), about });
    }

    /// Where to take a thing, given how it lies and where the hand comes from.
    fn grasp(&self, object: ObjectId) -> Isometry3<f64> {
        let (thing, pose) = (self.stage.thing(object), self.stage.pose(object));
        if thing.mount != Mount::Free || thing.object.kind == "chair" {
            return pose * thing.grasp;
        }
        // Cubes may lie on any face and round things turned by any angle; they are taken as if they stood upright.
        let turns = if thing.object.kind == "cube" { 4 } else { 24 };
        let face = upright_yaw(&pose);
        (0..turns)
            .map(|turn| {
                let angle = face + f64::from(turn) * std::f64::consts::TAU / f64::from(turns);
                turned(pose.translation.vector, angle) * thing.grasp
            })
            .min_by(|first, second| {
                let far = |aim: &Isometry3<f64>| {
                    let off = aim.translation.vector - self.at.translation.vector;
                    aim.rotation.angle_to(&self.at.rotation) + 4.0 * off.norm()
                };
                far(first).total_cmp(&far(second))
            })
            .expect("there is at least one turn")
    }

    /// Goes to a thing and closes around it.
    fn close_on(&mut self, thing: ObjectId) {
        if self.stage.closed(self.hand) {
            self.acts.push(Act::Grip(false));
        }
        let mut aim = self.grasp(thing);
        aim.translation.vector += self.chance.normals() * 0.0015;
        let arrive = aim.rotation * Vector3::z() * self.person.height;
        let (leave, arrive) = self.clear(aim, self.back(), arrive, None);
        self.go(aim, leave, arrive, 1.0, Some(thing));
        self.acts.push(Act::Rest(self.person.delay));
        self.acts.push(Act::Grip(true));
        self.acts.push(Act::Rest(self.person.delay));
    }

    fn take(&mut self, thing: ObjectId, lift: f64) {
        self.close_on(thing);
        if lift <= 0.0 {
            return;
        }
        let light = self.stage.thing(thing).mass < 0.3;
        let drops = light && self.chance.happens(self.person.drop);
        let height = if drops { self.chance.within((0.02, 0.04)) } else { lift };
        let end = space::at(0.0, 0.0, height) * self.at;
        self.go(end, Vector3::zeros(), Vector3::zeros(), 0.7, None);
        if drops {
            self.acts.push(Act::Grip(false));
            self.acts.push(Act::Rest(self.chance.within((0.25, 0.6))));
        }
    }

    /// Where a thing stands if it stands on another, off its middle by `off`, with a gap.
    fn above(&self, thing: ObjectId, on: ObjectId, off: Vector3<f64>, gap: f64) -> Isometry3<f64> {
        let (pose, below) = (self.stage.pose(thing), self.stage.pose(on));
        let half = |object: ObjectId| self.stage.thing(object).object.size.z / 2.0;
        let place = below.translation.vector + off + Vector3::z() * (half(on) + half(thing) + gap);
        // Turned to lie evenly on what is below, by as little as possible.
        let (mine, other) = (upright_yaw(&pose), upright_yaw(&below));
        let even = if self.stage.thing(on).mount == Mount::Fixed {
            0.0
        } else {
            let quarter = std::f64::consts::FRAC_PI_2;
            let apart = space::wrapped(other - mine);
            apart - (apart / quarter).round() * quarter
        };
        Isometry3::from_parts(
            place.into(),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), even) * upright(&pose),
        )
    }

    /// Carries what the hand holds to a pose.
    fn carry(&mut self, thing: ObjectId, to: Isometry3<f64>, about: Option<ObjectId>) {
        let relative = self.stage.hand(self.hand).inverse() * self.stage.pose(thing);
        let end = to * relative.inverse();
        let up = Vector3::z() * self.person.height;
        let (leave, arrive) = self.clear(end, up, up, Some(thing));
        self.go(end, leave, arrive, 0.9, about);
    }

    fn put(&mut self, thing: ObjectId, on: ObjectId, place: Option<Vector3<f64>>) {
        let gap = self.chance.within(GAP);
        let off = place.unwrap_or_else(Vector3::zeros);
        let to = self.above(thing, on, off, gap);
        let works = self.stage.thing(on).mount == Mount::Free;
        self.carry(thing, to, works.then_some(on));
        self.leave();
    }

    fn insert(&mut self, thing: ObjectId, into: ObjectId) {
        let (drawer, pose) = (self.stage.thing(into), self.stage.pose(into));
        let half = drawer.object.size / 2.0;
        let size = self.stage.thing(thing).object.size;
        // As near to the front as it fits, since the rear is under the counter.
        let front = -half.y + size.y / 2.0 + 0.035;
        let inside = pose * space::at(0.0, front, size.z / 2.0 + 0.012 + 0.006 - half.z);
        let to = Isometry3::from_parts(inside.translation, upright(&self.stage.pose(thing)));
        self.carry(thing, to, Some(into));
        self.leave();
    }

    fn slide(&mut self, drawer: ObjectId, opening: f64) {
        self.close_on(drawer);
        let joint = &self.stage.thing(drawer).object.joints[0];
        let axis = self.stage.pose(drawer).rotation * joint.axis;
        let now = self.stage.opening(drawer).unwrap_or(0.0);
        let by = axis * ((opening - now) * (joint.upper - joint.lower));
        let end = space::at(by.x, by.y, by.z) * self.at;
        self.go(end, Vector3::zeros(), Vector3::zeros(), 0.6, None);
        self.leave();
    }

    fn leave(&mut self) {
        self.acts.push(Act::Rest(self.person.delay));
        self.acts.push(Act::Grip(false));
        self.acts.push(Act::Rest(self.person.delay * 0.6));
        let away = self.at.rotation * Vector3::z() * (self.person.height * 0.7);
        let end = space::at(away.x, away.y, away.z) * self.at;
        self.go(end, Vector3::zeros(), Vector3::zeros(), 0.8, None);
    }

    /// Bends a way so that it passes over what stands between its ends.
    fn clear(
        &self,
        end: Isometry3<f64>,
        leave: Vector3<f64>,
        arrive: Vector3<f64>,
        carried: Option<ObjectId>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let (from, to) = (self.at.translation.vector, end.translation.vector);
        let along = to.xy() - from.xy();
        let hang = carried.map_or(0.0, |thing| self.stage.thing(thing).object.size.z);
        let reach = carried.map_or(0.0, |thing| self.stage.thing(thing).object.size.x / 2.0);
        let low = from.z.min(to.z);
        // What is carried a long way comes down steeply enough not to push over what it is set on:
        // at a height z over its end the curve is off by d·z²/(3·rise²), which is to be 5 cm at 10 cm.
        let mut needed: f64 = if carried.is_some() { 0.26 * along.norm().sqrt() } else { 0.0 };
        for object in self.stage.objects() {
            let thing = self.stage.thing(object);
            // An empty hand goes around a chair, and needs not rise over it.
            let around = carried.is_none() && thing.object.kind == "chair";
            if Some(object) == carried || thing.mount != Mount::Free || around {
                continue;
            }
            let place = self.stage.pose(object).translation.vector;
            let share = if along.norm_squared() > 1e-9 {
                ((place.xy() - from.xy()).dot(&along) / along.norm_squared()).clamp(0.0, 1.0)
            } else {
                0.0
            };
            // The ends themselves stand where hands arrive and leave.
            let between = (0.15..0.85).contains(&share);
            if between
                && (from.xy() + along * share - place.xy()).norm()
                    < 0.11 + thing.object.size.x / 2.0 + reach
            {
                let top = place.z + thing.object.size.z / 2.0;
                needed = needed.max((top + hang + 0.05 - low) / 0.75);
            }
        }
        let raise = |bend: Vector3<f64>| {
            if bend.z >= 0.0 { Vector3::new(bend.x, bend.y, bend.z.max(needed)) } else { bend }
        };
        (raise(leave), raise(arrive))
    }
}

/// Whether a skill has done what it is for.
pub(crate) fn done(skill: &Skill, stage: &Stage, hand: HandId) -> bool {
    let near = |thing: ObjectId, place: Vector3<f64>, distance: f64| {
        (stage.pose(thing).translation.vector - place).norm() < distance
    };
    match *skill {
        Skill::Take { thing, .. } => stage.held(hand) == Some(thing),
        Skill::Put { thing, on, place } => {
            let half = |object: ObjectId| stage.thing(object).object.size.z / 2.0;
            let off = place.unwrap_or_else(Vector3::zeros);
            let aim =
                stage.pose(on).translation.vector + off + Vector3::z() * (half(thing) + half(on));
            // Off by more than a third it is no longer on it.
            let slack = stage.thing(thing).object.size.x * 0.35;
            stage.held(hand) != Some(thing) && near(thing, aim, slack)
        }
        Skill::Insert { thing, into } => {
            let inside = stage.pose(into).inverse() * stage.pose(thing);
            let half = stage.thing(into).object.size / 2.0;
            let middle = inside.translation.vector;
            stage.held(hand) != Some(thing) && (0..3).all(|at| middle[at].abs() < half[at])
        }
        Skill::Slide { drawer, opening } => {
            stage.opening(drawer).is_some_and(|now| (now - opening).abs() < 0.2)
        }
        Skill::Turn { lid, angle } => (stage.screwed(lid).is_some()) == (angle < 0.0),
        Skill::Drag { .. }
        | Skill::Seat { .. }
        | Skill::Leave
        | Skill::Go(_)
        | Skill::Falter(_)
        | Skill::Pause(_)
        | Skill::Await { .. } => true,
    }
}

/// The turn about the vertical of a thing that may lie on any of its faces.
fn upright_yaw(pose: &Isometry3<f64>) -> f64 {
    // The axis of the frame that is most level and, of two such, the first.
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let level = axes
        .iter()
        .map(|axis| pose.rotation * axis)
        .min_by(|first, second| (first.z.abs() + 1e-3).total_cmp(&second.z.abs()))
        .expect("there are three axes");
    if (pose.rotation * Vector3::z()).z > 0.9 { yaw(pose) } else { level.y.atan2(level.x) }
}

/// The nearest turn in which a thing stands on one of its faces.
fn upright(pose: &Isometry3<f64>) -> UnitQuaternion<f64> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let highest = axes
        .iter()
        .flat_map(|axis| [pose.rotation * axis, -(pose.rotation * axis)])
        .max_by(|first, second| first.z.total_cmp(&second.z))
        .expect("there are six directions");
    let lift = UnitQuaternion::rotation_between(&highest, &Vector3::z())
        .unwrap_or_else(UnitQuaternion::identity);
    lift * pose.rotation
}
