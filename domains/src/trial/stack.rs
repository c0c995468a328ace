//! How far off and from how high cubes are let go over each other goes in; which of them stay comes out (thesis §2.1.1, example 1).
//!
//! A first cube stands on a table. Each further one is let go over the one below, off its middle and a little turned and tilted, when
//! the tower has come to rest. It is on top if the whole tower stands then. Once it does not, nothing more is put onto it.
//!
//! The engine steps only while cubes touch: a cube falls freely until just before the first contact, which is the same and costs nothing.
//! A trial ends when a cube has fallen below its place, or when the tower has been at rest for a tenth of a second.

use causal::variable::Role;
use rapier3d::prelude::{
    ColliderBuilder, PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle, Rotation, Vector,
};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Column, Values, World};
use crate::chance::Chance;

/// As many cubes as are put onto the first one at most.
pub const MOST: usize = 12;

/// The colours, which do nothing.
const COLOURS: [&str; 4] = ["blue", "green", "orange", "red"];

/// The measures of the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Parameters {
    /// The edge of a cube, in cm.
    pub edge: f64,
    /// How much of its speed a cube keeps when it bounces, from 0 to 1.
    pub restitution: f64,
    /// Coulomb's coefficient between cubes, and between cubes and the table.
    pub friction: f64,
    /// How far the gripper misses the offset, as a standard deviation in cm along each axis.
    pub offset_noise: f64,
    /// How far a cube is turned about the vertical, as a standard deviation in rad.
    pub turn_noise: f64,
    /// How far it is tilted about each horizontal axis, as a standard deviation in rad.
    pub tilt_noise: f64,
    /// The greatest offset that is drawn, in cm, to each side.
    pub offset: f64,
    /// The least and the greatest height that is drawn: from the top of the cube below to the cube that is let go, in cm.
    pub drop: (f64, f64),
    /// The fewest and the most steps of the engine in a second.
    pub rate: (f64, f64),
    /// How far the fastest cube may travel in a step, in cm, as far as the rate allows: blows are followed finely, and rest coarsely.
    pub travel: f64,
    /// Iterations of the engine's solver in a step.
    pub iterations: usize,
}

/// Why there is no such world.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StackError {
    /// Too few cubes, or too many.
    #[error("{0} cubes; 1 to {MOST} can be put onto the first one")]
    Cubes(usize),
    /// A measure that cannot be.
    #[error("`{0}` is {1}; it should be {2}")]
    Measure(&'static str, f64, &'static str),
}

impl Default for Parameters {
    /// The world of `domains/worlds/stack.json`.
    fn default() -> Self {
        serde_json::from_str(include_str!("../../worlds/stack.json"))
            .expect("the file that ships is right")
    }
}

impl Parameters {
    /// Says what cannot be.
    fn check(&self) -> Result<(), StackError> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let spread = |value: f64| value >= 0.0 && value.is_finite();
        let rules: [(&'static str, f64, bool, &'static str); 11] = [
            ("edge", self.edge, (0.5..=100.0).contains(&self.edge), "0.5 to 100 cm"),
            ("restitution", self.restitution, (0.0..=1.0).contains(&self.restitution), "0 to 1"),
            ("friction", self.friction, spread(self.friction), "0 or more"),
            ("offset-noise", self.offset_noise, spread(self.offset_noise), "0 or more"),
            ("turn-noise", self.turn_noise, spread(self.turn_noise), "0 or more"),
            ("tilt-noise", self.tilt_noise, spread(self.tilt_noise), "0 or more"),
            ("offset", self.offset, positive(self.offset), "more than 0"),
            (
                "drop",
                self.drop.0,
                spread(self.drop.0) && self.drop.0 < self.drop.1 && self.drop.1 < 1000.0,
                "a range from 0 or more to less than 1000 cm",
            ),
            (
                "rate",
                self.rate.0,
                self.rate.0 >= 30.0 && self.rate.0 <= self.rate.1 && self.rate.1 <= 10_000.0,
                "a range within 30 to 10000 steps a second",
            ),
            ("travel", self.travel, positive(self.travel), "more than 0"),
            (
                "iterations",
                self.iterations as f64,
                (1..=100).contains(&self.iterations),
                "1 to 100",
            ),
        ];
        match rules.into_iter().find(|(_, _, holds, _)| !holds) {
            Some((name, value, _, should)) => Err(StackError::Measure(name, value, should)),
            None => Ok(()),
        }
    }
}

/// A world in which so many cubes are put onto a first one.
#[derive(Debug, Clone)]
pub struct Stack {
    cubes: usize,
    parameters: Parameters,
}

/// Where a cube is let go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// To the right of the middle of the cube below, in cm.
    pub x: f64,
    /// The same, to the back.
    pub y: f64,
    /// From the top of the cube below, in cm.
    pub drop: f64,
}

/// What is set for each cube, and for the first one.
const SET: usize = 4;

impl Stack {
    /// A world of these measures.
    pub fn new(cubes: usize, parameters: Parameters) -> Result<Self, StackError> {
        if !(1..=MOST).contains(&cubes) {
            return Err(StackError::Cubes(cubes));
        }
        parameters.check()?;
        Ok(Self { cubes, parameters })
    }

    /// Its measures.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// How many cubes are put onto the first one.
    pub fn cubes(&self) -> usize {
        self.cubes
    }

    /// Where the cubes are let go, by what is set in a trial.
    pub fn places(&self, set: &[f64]) -> Vec<Place> {
        let one = |cube: usize| {
            let at = if self.cubes == 1 { 0 } else { 1 + SET * cube };
            Place { x: set[at], y: set[at + 1], drop: set[at + 2] }
        };
        (0..self.cubes).map(one).collect()
    }

    /// The tower with its first cube, to which others are added one by one.
    pub fn begin(&self, mut noise: Chance) -> Tower<'_> {
        let errors = (0..self.cubes).map(|_| Error::draw(&mut noise, &self.parameters)).collect();
        Tower::new(&self.parameters, errors)
    }
}

impl World for Stack {
    fn columns(&self) -> Vec<Column> {
        let Parameters { offset, drop, .. } = self.parameters;
        let column = |name: String, unit, values, role, what: String| Column {
            name,
            unit,
            values,
            role,
            what,
        };
        let number = |name: String, (low, high), what: String| {
            column(name, Some("cm"), Values::Between(low, high), Role::Treatment, what)
        };
        let colour = |name: String, what: String| {
            column(name, None, Values::Words(COLOURS.to_vec()), Role::Treatment, what)
        };
        let top = |name: String, what: String| {
            column(name, None, Values::Words(vec!["0", "1"]), Role::Outcome, what)
        };
        let sides = (-offset, offset);
        if self.cubes == 1 {
            let text = str::to_owned;
            return vec![
                number(
                    text("xOff"),
                    sides,
                    text(
                        "how far to the right of the lower cube's middle the upper cube is let go",
                    ),
                ),
                number(text("yOff"), sides, text("how far behind it")),
                number(text("dropOff"), drop, text("how high over the lower cube")),
                colour(text("colorDown"), text("the colour of the lower cube")),
                colour(text("colorUp"), text("the colour of the upper cube")),
                top(text("onTop"), text("whether the upper cube stays on the lower one")),
            ];
        }
        let mut columns =
            vec![colour("color_0".to_owned(), "the colour of the first cube".to_owned())];
        for cube in 1..=self.cubes {
            columns.push(number(
                format!("xOff_{cube}"),
                sides,
                format!(
                    "how far to the right of the middle of the cube below cube {cube} is let go"
                ),
            ));
            columns.push(number(format!("yOff_{cube}"), sides, "how far behind it".to_owned()));
            columns.push(number(format!("dropOff_{cube}"), drop, "how high over it".to_owned()));
            columns.push(colour(format!("color_{cube}"), format!("the colour of cube {cube}")));
        }
        for cube in 1..=self.cubes {
            columns.push(top(
                format!("onTop_{cube}"),
                format!("whether the tower stands with cube {cube} on top"),
            ));
        }
        columns
    }

    fn run(&self, set: &[f64], noise: Chance) -> Vec<f64> {
        let mut tower = self.begin(noise);
        self.places(set).into_iter().map(|place| f64::from(u8::from(tower.put(place)))).collect()
    }
}

/// What the gripper does wrong with one cube.
#[derive(Debug, Clone, Copy)]
struct Error {
    /// In cm.
    offset: (f64, f64),
    /// In rad.
    turn: f64,
    tilt: (f64, f64),
}

impl Error {
    fn draw(noise: &mut Chance, parameters: &Parameters) -> Self {
        let mut spread = |deviation: f64| deviation * noise.normal();
        let offset = (spread(parameters.offset_noise), spread(parameters.offset_noise));
        let turn = spread(parameters.turn_noise);
        let tilt = (spread(parameters.tilt_noise), spread(parameters.tilt_noise));
        Self { offset, turn, tilt }
    }
}

/// A tower that grows.
pub struct Tower<'a> {
    parameters: &'a Parameters,
    world: PhysicsWorld,
    cubes: Vec<RigidBodyHandle>,
    errors: Vec<Error>,
    stands: bool,
}

/// At rest is what is slower than so many metres and radians a second, for so many seconds.
const SLOW: (f32, f32, f64) = (0.01, 0.1, 0.1);

/// A tower that has not come to rest after so many seconds is taken as it is.
const LONGEST: f64 = 3.0;

/// How far over the cube below a cube that falls is when the engine takes over, in m.
const GAP: f32 = 0.0005;

const GRAVITY: f32 = 9.81;

impl<'a> Tower<'a> {
    fn new(parameters: &'a Parameters, errors: Vec<Error>) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -GRAVITY);
        world.integration_parameters.num_solver_iterations = parameters.iterations;
        // Contacts as fine as the cubes are small.
        world.integration_parameters.length_unit = (parameters.edge / 100.0) as f32;
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        let table = ColliderBuilder::cuboid(2.0, 2.0, 0.05)
            .translation(Vector::new(0.0, 0.0, -0.05))
            .friction(parameters.friction as f32)
            .restitution(parameters.restitution as f32);
        world.insert_collider(table, Some(ground));
        let mut this = Self { parameters, world, cubes: Vec::new(), errors, stands: true };
        let half = this.edge() / 2.0;
        this.insert(Pose::from_translation(Vector::new(0.0, 0.0, half)), 0.0);
        this
    }

    /// In m.
    fn edge(&self) -> f32 {
        (self.parameters.edge / 100.0) as f32
    }

    fn insert(&mut self, pose: Pose, speed: f32) {
        let body = RigidBodyBuilder::dynamic()
            .pose(pose)
            .linvel(Vector::new(0.0, 0.0, -speed))
            .can_sleep(false);
        let body = self.world.insert_body(body);
        let half = self.edge() / 2.0;
        let shape = ColliderBuilder::cuboid(half, half, half)
            .mass(0.1)
            .friction(self.parameters.friction as f32)
            .restitution(self.parameters.restitution as f32);
        self.world.insert_collider(shape, Some(body));
        self.cubes.push(body);
    }

    /// How many cubes have been put onto the first one.
    pub fn height(&self) -> usize {
        self.cubes.len() - 1
    }

    /// Puts a cube onto the tower, and says whether the tower stands then.
    ///
    /// # Panics
    /// If there are more cubes than the world has.
    pub fn put(&mut self, place: Place) -> bool {
        let error = self.errors[self.height().min(self.errors.len() - 1)];
        assert!(self.height() < self.errors.len() || !self.stands, "the world has another cube");
        if self.stands {
            self.release(place, error);
            self.settle();
        }
        self.stands
    }

    /// Where the middles of the cubes are, in cm, the first cube's first, with their rotations as quaternions (x, y, z, w).
    pub fn poses(&self) -> Vec<([f64; 3], [f64; 4])> {
        let one = |body: &RigidBodyHandle| {
            let pose = self.world.bodies[*body].position();
            let (at, turn) = (pose.translation, pose.rotation);
            let centimetres = |metres: f32| f64::from(metres) * 100.0;
            let at = [centimetres(at.x), centimetres(at.y), centimetres(at.z)];
            (at, [turn.x, turn.y, turn.z, turn.w].map(f64::from))
        };
        self.cubes.iter().map(one).collect()
    }

    /// Lets a cube go. It is put where its free fall ends, with the speed that it has there.
    fn release(&mut self, place: Place, error: Error) {
        let edge = self.edge();
        let below = self.world.bodies[self.cubes[self.cubes.len() - 1]].translation();
        let metres = |centimetres: f64| (centimetres / 100.0) as f32;
        let turned = Rotation::from_rotation_z(error.turn as f32)
            * Rotation::from_rotation_x(error.tilt.0 as f32)
            * Rotation::from_rotation_y(error.tilt.1 as f32);
        // The lowest corner of a tilted cube is lower than its face was.
        let up = turned.inverse() * Vector::new(0.0, 0.0, 1.0);
        let reach = edge / 2.0 * (up.x.abs() + up.y.abs() + up.z.abs());
        let top = below.z + edge / 2.0;
        let height = metres(place.drop).max(reach - edge / 2.0);
        let start = top + height + edge / 2.0;
        let end = (top + reach + GAP).min(start);
        let speed = (2.0 * GRAVITY * (start - end)).sqrt();
        let x = below.x + metres(place.x + error.offset.0);
        let y = below.y + metres(place.y + error.offset.1);
        self.insert(Pose::from_parts(Vector::new(x, y, end), turned), speed);
    }

    /// Lets time pass until the tower stands or does not.
    fn settle(&mut self) {
        let (fewest, most) = self.parameters.rate;
        let travel = (self.parameters.travel / 100.0) as f32;
        let (mut time, mut rest) = (0.0, 0.0);
        while time < LONGEST && rest < SLOW.2 {
            let (speed, turn) = self.fastest();
            let outer = speed + turn * self.edge();
            let step = (travel / outer).clamp((1.0 / most) as f32, (1.0 / fewest) as f32);
            self.world.integration_parameters.dt = step;
            self.world.step();
            time += f64::from(step);
            if self.fallen() {
                self.stands = false;
                return;
            }
            let (speed, turn) = self.fastest();
            // For a moment at rest is also what is at the top of a bounce.
            rest = if speed < SLOW.0 && turn < SLOW.1 { rest + f64::from(step) } else { 0.0 };
        }
        self.stands = !self.fallen();
    }

    /// The speed of the fastest cube in m/s, and in rad/s that of the one that turns fastest.
    fn fastest(&self) -> (f32, f32) {
        let bodies = self.cubes.iter().map(|&cube| &self.world.bodies[cube]);
        bodies.fold((0.0, 0.0), |(speed, turn), body| {
            (body.linvel().length().max(speed), body.angvel().length().max(turn))
        })
    }

    /// Whether some cube is lower than its place in the tower, by a quarter of an edge.
    fn fallen(&self) -> bool {
        let edge = self.edge();
        self.cubes
            .iter()
            .enumerate()
            .any(|(at, &cube)| self.world.bodies[cube].translation().z < edge * (at as f32 + 0.25))
    }
}

#[cfg(test)]
mod tests {
    use super::super::noise;
    use super::*;

    fn tower(cubes: usize) -> Stack {
        Stack::new(cubes, Parameters::default()).unwrap()
    }

    #[test]
    fn a_trial_run_again_is_the_same_to_the_last_bit() {
        let stack = tower(3);
        for trial in 0..20 {
            let set = stack.draw(7, trial);
            let run = || {
                let mut tower = stack.begin(noise(7, trial));
                let stands: Vec<bool> =
                    stack.places(&set).into_iter().map(|place| tower.put(place)).collect();
                (stands, tower.poses())
            };
            assert_eq!(run(), run());
        }
    }

    #[test]
    fn what_hangs_over_stays_until_the_next_cube_pulls_it_down() {
        let still = Parameters {
            offset_noise: 0.0,
            turn_noise: 0.0,
            tilt_noise: 0.0,
            ..Parameters::default()
        };
        let stack = Stack::new(2, still).unwrap();
        // 1.9 cm over is within the edge, and so are both together where the second leans back.
        let run = |second: f64| {
            let mut tower = stack.begin(noise(1, 1));
            let place = |x| Place { x, y: 0.0, drop: 0.5 };
            (tower.put(place(1.9)), tower.put(place(second)))
        };
        assert_eq!(run(-1.5), (true, true));
        assert_eq!(run(1.9), (true, false));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        assert_eq!(
            Stack::new(0, Parameters::default()).unwrap_err().to_string(),
            "0 cubes; 1 to 12 can be put onto the first one"
        );
        let none = Parameters { edge: -1.0, ..Parameters::default() };
        assert_eq!(
            Stack::new(1, none).unwrap_err().to_string(),
            "`edge` is -1; it should be 0.5 to 100 cm"
        );
    }
}
