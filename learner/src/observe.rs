//! Frames with noisy poses go in; for each of them come out the variables of each hand, and the facts that begin and end, each with the hands that may have brought it about.
//!
//! The variables are those of table 3.1 of the thesis; thresholds are in [`Config`].
//! An [`Observer`] takes frames one by one and gives them back a little later, once it has seen what came of them; it needs the same memory however long a log is.
//!
//! Where it is more than the published program, it is so for these reasons:
//! - Velocity is the slope of a line through as many frames as the noise of the tracker demands, since the difference of two frames is mostly noise.
//! - What a hand approaches is told by what it comes to within [`Config::ahead`] seconds, so that passing by is no approach.
//! - What a hand holds is told by its grip and by what moves along with it, and by the latter alone where no grip is measured.
//! - What is lost from sight stays as it was.

mod config;
mod credit;
mod grasp;
mod moment;
mod motion;
mod relation;
mod shape;
mod state;
mod target;
mod track;
mod vocabulary;

use std::collections::VecDeque;

use nalgebra::Vector3;

pub use config::{BadConfig, Band, Config, Measure};
pub use vocabulary::{BadPattern, Ground, Pattern, Relation, Thing, Vocabulary};

use crate::log::{Fact, Frame, HandId, HandState, Header, ObjectId};
use grasp::{Grasp, Seen, Since};
use moment::{HandMoment, Moment};
use motion::{Moving, STILL, Still};
use relation::{Body, Geometry};
use shape::Shape;
use state::State;
use track::{Sample, Track};

/// What is so in one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// The number of the frame in its log, from 0.
    pub frame: u64,
    /// The time of the frame in seconds.
    pub time: f64,
    /// What each hand does, in the order of [`Header::hands`].
    pub hands: Vec<HandState>,
    /// Which hands are in teach mode.
    pub teach: Vec<bool>,
    /// Which hands are lost from sight; their states are what they were before.
    pub lost: Vec<bool>,
    /// What holds since this frame and did not before, and what no longer holds: first what ended, then what began, each in the order of the facts.
    /// In the first frame that is everything that holds at all.
    pub changes: Vec<Change>,
}

/// A fact that began or ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The fact in the words of the vocabulary.
    pub fact: Fact,
    /// The relation that it stands for.
    pub ground: Ground,
    /// Whether it holds from now on.
    pub holds: bool,
    /// It may have been so for long: its objects were not seen before.
    pub fresh: bool,
    /// The objects that the change is about: those of the relation, and for what is clear or unblocked those that were or are in the way.
    pub objects: Vec<ObjectId>,
    /// All hands that were seen, from the most to the least likely one to have done it.
    pub credits: Vec<Credit>,
}

/// Where a hand was when a fact changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Credit {
    /// The hand.
    pub hand: HandId,
    /// The object of the change that is nearest to it.
    pub object: ObjectId,
    /// How near it, or what it holds, came to that object within [`Config::credit`] of the change, in metres; 0 in contact.
    pub distance: f64,
    /// It held one of the objects within that time.
    pub holds: bool,
    /// It touched one of them, itself or with what it held.
    pub touches: bool,
    /// It acted on one of them.
    pub acts: bool,
}

/// Takes the frames of one log in their order; gives each back as an [`Observation`].
#[derive(Debug)]
pub struct Observer<'a> {
    header: &'a Header,
    config: Config,
    /// The frames around the one that passes the front: their times, and the samples of all hands and objects.
    times: VecDeque<f64>,
    raw: VecDeque<Raw>,
    hands: Vec<Track>,
    objects: Vec<Track>,
    /// How many of `times` have passed the front, and the number of the first of them in the log.
    passed: usize,
    first: u64,
    moving: Vec<Moving>,
    /// How closed each hand was when it was last seen.
    grips: Vec<Option<f64>>,
    grasps: Vec<Grasp>,
    bodies: Vec<Body>,
    /// Which objects hands can take: those that are neither places nor furniture.
    loose: Vec<bool>,
    still: Vec<Still>,
    geometry: Geometry,
    /// The moments between front and back, with some that were given out already.
    moments: VecDeque<Moment>,
    /// The number of the oldest moment in the log, and of the next to give out.
    oldest: u64,
    next: u64,
    state: State,
    given: Vec<Fact>,
    before: Vec<HandState>,
}

/// What passes through unchanged.
#[derive(Debug)]
struct Raw {
    hands: Vec<(Option<f64>, bool, Option<HandState>)>,
    facts: Option<Vec<Fact>>,
}

/// Observes a whole log that is in memory.
pub fn observe<'f>(
    header: &Header,
    config: &Config,
    frames: impl IntoIterator<Item = &'f Frame>,
) -> Vec<Observation> {
    let mut observer = Observer::new(header, config.clone());
    let mut observations: Vec<Observation> =
        frames.into_iter().flat_map(|frame| observer.push(frame)).collect();
    observations.extend(observer.finish());
    observations
}

impl<'a> Observer<'a> {
    /// An observer of a log with this header.
    pub fn new(header: &'a Header, config: Config) -> Self {
        let hands = header.hands.len();
        let objects = header.objects.len();
        Self {
            header,
            config,
            times: VecDeque::new(),
            raw: VecDeque::new(),
            hands: (0..hands).map(|_| Track::default()).collect(),
            objects: (0..objects).map(|_| Track::default()).collect(),
            passed: 0,
            first: 0,
            moving: (0..hands).map(|_| Moving::default()).collect(),
            grips: vec![None; hands],
            grasps: (0..hands).map(|_| Grasp::default()).collect(),
            bodies: vec![Body::default(); objects],
            loose: header
                .objects
                .iter()
                .map(|what| !(what.region || what.fixed && what.joints.is_empty()))
                .collect(),
            still: (0..objects).map(|_| Still::default()).collect(),
            geometry: Geometry::new(header),
            moments: VecDeque::new(),
            oldest: 0,
            next: 0,
            state: State::default(),
            given: Vec::new(),
            before: vec![HandState::default(); hands],
        }
    }

    /// Takes the next frame, which must have the hands and objects of the header; gives back what is certain by now.
    /// A frame that is not later than the one before it is left out, and gets no observation.
    pub fn push(&mut self, frame: &Frame) -> Vec<Observation> {
        if self.times.back().is_some_and(|&last| frame.time <= last) {
            return Vec::new();
        }
        self.times.push_back(frame.time);
        let bridge = self.config.bridge;
        for (track, hand) in self.hands.iter_mut().zip(&frame.hands) {
            let sample = hand.as_ref().map(|hand| Sample {
                place: hand.pose.translation.vector,
                turn: hand.pose.rotation,
                open: f64::NAN,
                filled: false,
            });
            track.measure(sample.as_ref());
            track.push(sample, &self.times, bridge);
        }
        for (number, object) in frame.objects.iter().enumerate() {
            let seen = object.as_ref().filter(|object| object.seen >= self.config.seen);
            let what = &self.header.objects[number];
            if what.fixed && what.joints.is_empty() {
                if let Some(object) = seen {
                    self.still[number].add(&object.pose);
                }
                continue;
            }
            let sample = seen.map(|object| Sample {
                place: object.pose.translation.vector,
                turn: object.pose.rotation,
                open: what
                    .joints
                    .iter()
                    .zip(&object.joints)
                    .map(|(joint, value)| (value - joint.lower) / (joint.upper - joint.lower))
                    .fold(f64::NAN, f64::max),
                filled: false,
            });
            // Nothing is said of an object while it is lost, so its gaps stay.
            self.objects[number].push(sample, &self.times, 0.0);
        }
        let hands = frame.hands.iter().zip(&mut self.grips).map(|(hand, grip)| match hand {
            Some(hand) => {
                *grip = hand.grip;
                (hand.grip, hand.teach, hand.given)
            }
            None => (*grip, false, None),
        });
        self.raw.push_back(Raw { hands: hands.collect(), facts: frame.facts.clone() });
        let lag = bridge.max(self.config.window).max(self.config.smooth);
        while self.passed < self.times.len() && frame.time - self.times[self.passed] >= lag {
            self.front();
        }
        let ahead = self.config.ahead.max(2.0 * self.config.minimum).max(self.config.credit);
        self.back(ahead)
    }

    /// There are no more frames; gives back all that are left.
    pub fn finish(mut self) -> Vec<Observation> {
        while self.passed < self.times.len() {
            self.front();
        }
        self.back(f64::NEG_INFINITY)
    }

    /// All facts that hold in the last observation.
    pub fn facts(&self) -> impl Iterator<Item = &Fact> {
        self.state.facts()
    }

    /// Turns the next frame into a moment.
    fn front(&mut self) {
        let index = self.passed;
        let time = self.times[index];
        let number = self.first + index as u64;
        self.passed += 1;
        let around = track::window(index, &self.times, self.config.smooth);
        let close = track::window(index, &self.times, self.config.smooth.min(0.025));
        let mut met = Vec::new();
        for (object, what) in self.header.objects.iter().enumerate() {
            let body = &mut self.bodies[object];
            let known = body.shape.is_some();
            if what.fixed && what.joints.is_empty() {
                let still = &self.still[object];
                if still.count > 0 && (still.count < STILL || body.shape.is_none()) {
                    *body = Body {
                        shape: Some(Shape::new(still.pose(), &what.size)),
                        open: f64::NAN,
                        ..*body
                    };
                }
            } else if let Some((pose, open)) = self.objects[object].pose(index, around) {
                *body =
                    Body { shape: Some(Shape::new(pose, &what.size)), open, lost: false, ..*body };
            } else {
                body.lost = true;
            }
            if body.shape.is_some() && !known {
                met.push(ObjectId(object as u32));
            }
        }
        let raw = std::mem::replace(&mut self.raw[index], Raw { hands: Vec::new(), facts: None });
        let mut moment =
            Moment { time, hands: Vec::new(), flips: Vec::new(), met, facts: raw.facts };
        let mut places = Vec::new();
        let mut rewrites: Vec<(usize, Rewrite)> = Vec::new();
        for (hand, (grip, teach, given)) in raw.hands.into_iter().enumerate() {
            let pose = self.hands[hand].pose(index, close).map(|pose| pose.0);
            let speed = self.hands[hand].speed(index, &self.times, self.config.window);
            let moving = &mut self.moving[hand];
            let turned = moving.step((number, time), speed, &self.config);
            rewrites.extend(turned.map(|frame| (hand, Rewrite::Moves(frame, moving.moves))));
            let (moves, turned_at) = (moving.moves, moving.turned);
            let place = pose.map(|pose| pose.translation.vector);
            places.push(place);
            let bare = self.distances(place, self.config.measure);
            let held = self.grasps[hand].held();
            let gaps = held.map(|held| self.gaps(held)).unwrap_or_default();
            let by_surface = match self.config.measure {
                Measure::Surface => &bare,
                Measure::Centre => &self.distances(place, Measure::Surface),
            };
            let hold = self.config.hold.high as f32;
            let near: Vec<(ObjectId, f64)> = by_surface
                .iter()
                .enumerate()
                .filter(|(object, far)| **far <= hold && self.loose[*object])
                .map(|(object, far)| (ObjectId(object as u32), f64::from(*far)))
                .collect();
            // What a hand holds does not change while it is lost.
            if let Some(pose) = pose.filter(|_| self.hands[hand].seen(index)) {
                let seen = Seen {
                    frame: number,
                    time,
                    pose,
                    grip,
                    moves,
                    turned: turned_at,
                    near: &near,
                    bodies: &self.bodies,
                };
                let changes = self.grasps[hand].step(&seen, &self.config);
                rewrites.extend(changes.into_iter().map(|since| (hand, Rewrite::Holds(since))));
            }
            let in_hand = self.grasps[hand].held();
            moment.hands.push(HandMoment {
                place,
                moves,
                in_hand,
                acted_on: None,
                given,
                teach,
                bare,
                holding: held,
                gaps,
            });
        }
        for object in 0..self.bodies.len() {
            let id = ObjectId(object as u32);
            self.bodies[object].held = self.grasps.iter().any(|grasp| grasp.held() == Some(id));
        }
        self.moments.push_back(moment);
        for (hand, rewrite) in rewrites {
            self.rewrite(hand, rewrite);
        }
        let (oldest, next) = (self.oldest, self.next);
        let moments = &mut self.moments;
        self.geometry.step(
            (number, time),
            &self.bodies,
            &places,
            self.header,
            &self.config,
            |frame, flip| {
                let index = (frame.max(next) - oldest) as usize;
                moments[index].flips.push(flip);
            },
        );
        self.forget();
    }

    /// Changes moments that were not given out yet.
    fn rewrite(&mut self, hand: usize, rewrite: Rewrite) {
        let frame = match rewrite {
            Rewrite::Moves(frame, _) => frame,
            Rewrite::Holds(since) => since.frame,
        };
        let from = (frame.max(self.next) - self.oldest) as usize;
        for moment in self.moments.iter_mut().skip(from) {
            match rewrite {
                Rewrite::Moves(_, moves) => moment.hands[hand].moves = moves,
                Rewrite::Holds(since) => moment.hands[hand].in_hand = since.object,
            }
        }
    }

    /// Lets go of frames that no window at the front reaches any more.
    fn forget(&mut self) {
        let keep = self.config.window.max(self.config.smooth).max(self.config.bridge);
        while self.passed > 1 && self.times[self.passed - 1] - self.times[0] > keep + 0.1 {
            self.times.pop_front();
            self.raw.pop_front();
            for track in &mut self.hands {
                track.pop();
            }
            for (track, what) in self.objects.iter_mut().zip(&self.header.objects) {
                if !(what.fixed && what.joints.is_empty()) {
                    track.pop();
                }
            }
            self.passed -= 1;
            self.first += 1;
        }
    }

    /// Gives out the moments that lie so far back.
    fn back(&mut self, ahead: f64) -> Vec<Observation> {
        let mut out = Vec::new();
        let Some(last) = self.moments.back().map(|moment| moment.time) else { return out };
        while let Some(moment) = self.moments.get((self.next - self.oldest) as usize)
            && last - moment.time >= ahead
        {
            out.push(self.give());
        }
        out
    }

    /// Gives out the next moment.
    fn give(&mut self) -> Observation {
        let now = (self.next - self.oldest) as usize;
        let time = self.moments[now].time;
        let mut hands = Vec::new();
        for hand in 0..self.header.hands.len() {
            let before = self.before[hand];
            let here = &self.moments[now].hands[hand];
            let state = here.given.unwrap_or_else(|| {
                let id = HandId(hand as u32);
                let acted_on = target::acted_on(
                    &self.moments,
                    now,
                    id,
                    before.acted_on,
                    self.header,
                    &self.config,
                );
                HandState { moves: here.moves, acted_on, in_hand: here.in_hand }
            });
            self.moments[now].hands[hand].acted_on = state.acted_on;
            self.moments[now].hands[hand].in_hand = state.in_hand;
            hands.push(state);
        }
        let flips = std::mem::take(&mut self.moments[now].flips);
        let mut news = self.next == 0 || hands != self.before;
        for flip in &flips {
            self.state.flip(flip);
            news = true;
        }
        let met = std::mem::take(&mut self.moments[now].met);
        for &object in &met {
            self.state.meet(object);
            news = true;
        }
        if let Some(facts) = self.moments[now].facts.take() {
            news |= facts != self.given;
            self.given = facts;
        }
        let mut changes = Vec::new();
        if news {
            let facts = self.state.update(&hands, &self.given, self.header, &self.config);
            for (fact, ground, holds) in facts {
                let objects = self.about(&ground, &flips);
                let fresh = self.next == 0
                    || objects.iter().any(|object| met.contains(object))
                    || flips.iter().any(|flip| {
                        flip.fresh
                            && ground.things.contains(&flip.first)
                            && ground.things.contains(&flip.second)
                    });
                let credits = self.credits(now, &objects);
                changes.push(Change { fact, ground, holds, fresh, objects, credits });
            }
        }
        let teach = self.moments[now].hands.iter().map(|hand| hand.teach).collect();
        let lost = self.moments[now].hands.iter().map(|hand| hand.place.is_none()).collect();
        self.before.clone_from(&hands);
        let observation = Observation { frame: self.next, time, hands, teach, lost, changes };
        self.next += 1;
        while let Some(old) = self.moments.front()
            && self.oldest + 1 < self.next
            && time - old.time > self.config.credit.max(self.config.smooth)
        {
            self.moments.pop_front();
            self.oldest += 1;
        }
        observation
    }

    /// The distances of a place to all objects.
    fn distances(&self, place: Option<Vector3<f64>>, measure: Measure) -> Vec<f32> {
        let one = |body: &Body| {
            let (shape, place) = (body.shape?, place?);
            Some(match measure {
                Measure::Surface => shape.distance(&place),
                Measure::Centre => (shape.middle() - place).norm(),
            })
        };
        self.bodies.iter().map(|body| one(body).map_or(f32::NAN, |far| far as f32)).collect()
    }

    /// The distances of a held object to all others that hands act on; not numbers for the rest.
    fn gaps(&self, held: ObjectId) -> Vec<f32> {
        let one = |(body, loose): (&Body, &bool)| {
            let (held, other) = (self.bodies[held.index()].shape?, body.shape.filter(|_| *loose)?);
            let far = (held.middle() - other.middle()).norm();
            Some(match self.config.measure {
                Measure::Centre => far,
                // Far from touching, the distance of the balls around both says enough.
                Measure::Surface
                    if far - held.radius - other.radius > 2.0 * self.config.touch.high =>
                {
                    far - held.radius - other.radius
                }
                Measure::Surface => held.separation(&other),
            })
        };
        let bodies = self.bodies.iter().zip(&self.loose);
        bodies.map(|pair| one(pair).map_or(f32::NAN, |far| far as f32)).collect()
    }
}

/// A change of moments that were filled in before.
#[derive(Debug, Clone, Copy)]
enum Rewrite {
    /// From this frame on the hand moves, or not.
    Moves(u64, bool),
    /// From then on it holds this.
    Holds(Since),
}
