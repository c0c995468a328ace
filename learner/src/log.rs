//! What a tracker saw, frame by frame: a [`Header`] that says what is tracked, and [`Frame`]s with poses of hands and objects.
//!
//! Lengths are metres, angles radians, times seconds; the world frame is right-handed with z up.
//! Whatever units a file has, what is read from it has these.
//!
//! - [`json`] reads and writes JSON Lines, the format of `docs/logs.md`; [`csv`] the same as a table.
//! - With the features of those names, `mcap` reads recordings of ROS 2 and `lerobot` data sets of `LeRobot`.
//! - [`BadLine`] is what is wrong with a line.

mod fault;
mod line;
mod header;
mod sample;
pub mod json;
pub mod csv;
#[cfg(feature = "mcap")]
mod cdr;
#[cfg(feature = "mcap")]
pub mod mcap;
#[cfg(feature = "lerobot")]
pub mod lerobot;

pub use fault::{BadLine, Fault};
pub(crate) use header::syntax;
pub(crate) use line::{LONGEST, Lines};

use nalgebra::{Isometry3, Vector3};

/// Which hand of a [`Header`], counted over all agents in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HandId(pub u32);

/// Which object of a [`Header`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectId(pub u32);

impl HandId {
    /// The place of the hand in [`Header::hands`] and [`Frame::hands`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl ObjectId {
    /// The place of the object in [`Header::objects`] and [`Frame::objects`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What stands before the frames of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// The name of the world frame, such as `world`.
    pub frame: String,
    /// Frames in a second.
    pub rate: f64,
    /// The types of objects, each with the one above it; a type that is not listed is a type of its own below `object`.
    pub types: Vec<Type>,
    /// Those who act, such as a person or a robot.
    pub agents: Vec<String>,
    /// All hands, of all agents.
    pub hands: Vec<Hand>,
    /// What is acted on.
    pub objects: Vec<Object>,
}

/// A type of objects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Type {
    /// Its name.
    pub name: String,
    /// The type above it.
    pub parent: Option<String>,
}

/// A hand, or the gripper of an arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Hand {
    /// Its name.
    pub name: String,
    /// The place of its agent in [`Header::agents`].
    pub agent: u32,
    /// How far it gets, where that is known.
    pub reach: Option<Reach>,
}

/// A ball that a hand cannot leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Its centre, such as the shoulder, in metres.
    pub centre: Vector3<f64>,
    /// Its radius in metres.
    pub radius: f64,
}

/// An object as a box around its pose, and what can move in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Its name.
    pub name: String,
    /// The name of its type.
    pub kind: String,
    /// Its extent along the axes of its own frame, in metres; the pose is the middle of that box.
    pub size: Vector3<f64>,
    /// It never moves as a whole, like a table.
    pub fixed: bool,
    /// Other objects can be inside it.
    pub hollow: bool,
    /// It is a place and no body, such as a spot on a tray: things pass through it.
    pub region: bool,
    /// What moves in it, such as a drawer in its frame. The pose of the object is that of the moving part.
    pub joints: Vec<Joint>,
}

/// A joint of an object. At its lower limit the object is closed, at its upper limit open.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Whether it slides or turns.
    pub motion: Motion,
    /// The axis in the frame of the object, of length 1.
    pub axis: Vector3<f64>,
    /// The value when closed, in metres or radians.
    pub lower: f64,
    /// The value when wide open, in metres or radians.
    pub upper: f64,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// It slides along its axis.
    Slides,
    /// It turns about its axis.
    Turns,
}

/// What was tracked at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The time in seconds.
    pub time: f64,
    /// The hands in the order of [`Header::hands`]; none where a hand was not tracked.
    pub hands: Vec<Option<HandSample>>,
    /// The objects in the order of [`Header::objects`]; none where an object was not tracked.
    pub objects: Vec<Option<ObjectSample>>,
    /// What else is known to hold, where the log says it.
    pub facts: Option<Vec<Fact>>,
}

/// A hand at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct HandSample {
    /// Where it is.
    pub pose: Isometry3<f64>,
    /// How far it is closed, from 0 (open) to 1 (closed), where that is measured.
    pub grip: Option<f64>,
    /// Its teach mode is on, as in kinesthetic teaching.
    pub teach: bool,
    /// What the hand does, where the log says it.
    pub given: Option<HandState>,
}

/// An object at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectSample {
    /// Where it is.
    pub pose: Isometry3<f64>,
    /// The values of [`Object::joints`], in metres or radians.
    pub joints: Vec<f64>,
    /// How sure the tracker is, from 0 to 1.
    pub seen: f64,
}

/// What a hand does: the features of table 3.1 of the thesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct HandState {
    /// `handMove`: the hand moves.
    pub moves: bool,
    /// `actedOn`: what the hand approaches or works on.
    pub acted_on: Option<ObjectId>,
    /// `inHand`: what the hand holds.
    pub in_hand: Option<ObjectId>,
}

/// A fact about objects, by names.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fact {
    /// Its predicate.
    pub predicate: String,
    /// Its arguments: names of objects, hands or agents.
    pub arguments: Vec<String>,
}
