//! A script of what two hands do goes in; a log as a noisy tracker would write it comes out, with the truth beside it.

use learner::log::{
    Frame, Hand, HandId, HandSample, HandState, Header, Object, ObjectId, ObjectSample,
};
use learner::truth::{Activity, Truth};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// Frames in a second.
pub const RATE: f64 = 90.0;

/// What is going on, with exact poses.
pub struct Scene {
    /// What is tracked.
    pub header: Header,
    /// What was written so far.
    pub frames: Vec<Frame>,
    /// What really happened.
    pub truths: Vec<Truth>,
    /// The standard deviation of noise along each axis in metres.
    pub noise: f64,
    /// Whether the grip is measured.
    pub grip: bool,
    hands: Vec<Vector3<f64>>,
    held: Vec<Option<(ObjectId, Vector3<f64>)>>,
    places: Vec<Vector3<f64>>,
    joints: Vec<Vec<f64>>,
    about: [Option<ObjectId>; 2],
    seed: u64,
}

/// The edge of all cubes in metres.
pub const EDGE: f64 = 0.05;

/// A cube of this name.
pub fn cube(name: &str) -> Object {
    Object {
        name: name.to_string(),
        kind: "cube".to_string(),
        size: Vector3::repeat(EDGE),
        fixed: false,
        hollow: false,
        region: false,
        joints: Vec::new(),
    }
}

/// The table, whose upper side is at height 0.
pub fn table() -> Object {
    Object {
        name: "table".into(),
        kind: "table".into(),
        size: Vector3::new(2.0, 2.0, 0.04),
        fixed: true,
        ..cube("")
    }
}

impl Scene {
    /// Two hands at rest, and objects with their places, on a table.
    pub fn new(objects: Vec<(Object, Vector3<f64>)>, noise: f64) -> Self {
        let hand = |name: &str| Hand { name: name.to_string(), agent: 0, reach: None };
        let (mut listed, mut places) = (vec![table()], vec![Vector3::new(0.0, 0.0, -0.02)]);
        for (object, place) in objects {
            listed.push(object);
            places.push(place);
        }
        let joints = listed
            .iter()
            .map(|object| object.joints.iter().map(|joint| joint.lower).collect())
            .collect();
        Self {
            header: Header {
                frame: "world".into(),
                rate: RATE,
                types: Vec::new(),
                agents: vec!["person".into()],
                hands: vec![hand("left-hand"), hand("right-hand")],
                objects: listed,
            },
            frames: Vec::new(),
            truths: Vec::new(),
            noise,
            grip: true,
            hands: vec![Vector3::new(0.0, 0.5, 0.3), Vector3::new(0.0, -0.5, 0.3)],
            held: vec![None, None],
            places,
            joints,
            about: [None, None],
            seed: 1,
        }
    }

    /// The object of a name.
    pub fn id(&self, name: &str) -> ObjectId {
        let place = self.header.objects.iter().position(|object| object.name == name);
        ObjectId(place.expect("the object is in the scene") as u32)
    }

    /// Where an object is.
    pub fn place(&self, object: ObjectId) -> Vector3<f64> {
        self.places[object.index()]
    }

    /// Nothing moves for so many seconds.
    pub fn rest(&mut self, seconds: f64) {
        for _ in 0..(seconds * RATE).round() as u32 {
            self.frame(&[0.0, 0.0]);
        }
    }

    /// A hand goes along a straight line with minimum jerk, and takes with it what it holds; `aim` is what it says that it acts on.
    pub fn go(&mut self, hand: HandId, to: Vector3<f64>, seconds: f64, aim: Option<ObjectId>) {
        let from = self.hands[hand.index()];
        self.about[hand.index()] = aim;
        let count = (seconds * RATE).round().max(1.0);
        for step in 1..=count as u32 {
            let part = f64::from(step) / count;
            let way = part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part);
            let rate = 30.0 * part * part * (1.0 - part).powi(2);
            self.hands[hand.index()] = from + (to - from) * way;
            if let Some((object, offset)) = self.held[hand.index()] {
                let before = self.places[object.index()];
                self.places[object.index()] = self.hands[hand.index()] + offset;
                let shift = self.places[object.index()] - before;
                if let Some(value) = self.joints[object.index()].first_mut() {
                    *value += shift.x;
                }
            }
            let mut speeds = [0.0; 2];
            speeds[hand.index()] = (to - from).norm() * rate / seconds;
            self.frame(&speeds);
        }
    }

    /// A hand reaches an object, takes it, and rests a moment with it.
    pub fn take(&mut self, hand: HandId, object: ObjectId) {
        let place = self.places[object.index()];
        self.go(hand, place, 0.9, Some(object));
        self.rest(0.15);
        self.held[hand.index()] = Some((object, Vector3::zeros()));
        self.about[hand.index()] = None;
        self.rest(0.25);
    }

    /// A hand lets go and leaves upwards.
    pub fn release(&mut self, hand: HandId) {
        self.rest(0.2);
        self.held[hand.index()] = None;
        self.about[hand.index()] = None;
        self.rest(0.15);
        let up = self.hands[hand.index()] + Vector3::new(0.0, 0.0, 0.25);
        self.go(hand, up, 0.6, None);
    }

    /// Writes a frame.
    fn frame(&mut self, speeds: &[f64; 2]) {
        let time = self.frames.len() as f64 / RATE;
        let mut states = Vec::new();
        for (hand, speed) in speeds.iter().enumerate() {
            let moves = *speed > 0.04;
            let in_hand = self.held[hand].map(|held| held.0);
            // A hand acts on what it is about while it is within 0.15 m of its surface; once there, until it takes or lets go.
            let near = |aim: &ObjectId| {
                let off = (self.places[aim.index()] - self.hands[hand]).abs()
                    - Vector3::repeat(EDGE / 2.0);
                off.map(|beyond| beyond.max(0.0)).norm() <= 0.15
            };
            let acted_on = self.about[hand].filter(near);
            let state = HandState { moves, acted_on, in_hand };
            let activity = match (moves, acted_on.is_some(), in_hand.is_some()) {
                (_, true, true) => Activity::Granular,
                (true, false, true) => Activity::Put,
                (false, false, true) => Activity::Take,
                (_, true, false) => Activity::Reach,
                (_, false, false) => Activity::Idle,
            };
            states.push((state, activity));
        }
        self.truths.push(Truth { time, hands: states, facts: Vec::new() });
        let hands = (0..2).map(|hand| {
            let grip = self.grip.then_some(if self.held[hand].is_some() { 0.8 } else { 0.0 });
            let pose = self.noisy(self.hands[hand]);
            Some(HandSample { pose, grip, teach: false, given: None })
        });
        let hands = hands.collect::<Vec<_>>();
        let objects = (0..self.places.len())
            .map(|object| {
                let joints = self.joints[object].clone();
                Some(ObjectSample { pose: self.noisy(self.places[object]), joints, seen: 1.0 })
            })
            .collect();
        self.frames.push(Frame { time, hands, objects, facts: None });
    }

    /// A pose as the tracker sees it.
    fn noisy(&mut self, place: Vector3<f64>) -> Isometry3<f64> {
        let noise = self.noise;
        let shift = Vector3::new(self.normal(), self.normal(), self.normal()) * noise;
        let turn = Vector3::new(self.normal(), self.normal(), self.normal()) * noise * 3.0;
        Isometry3::from_parts((place + shift).into(), UnitQuaternion::new(turn))
    }

    /// A random number of the standard normal distribution, as a sum of twelve even ones.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }

    /// A random number from 0 to 1 (splitmix64).
    fn even(&mut self) -> f64 {
        self.seed = self.seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.seed;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}
