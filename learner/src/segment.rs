//! Observations go in, frame by frame; for each hand come out the activities in which it spent its time, by the rules of table 3.1 of the thesis.
//!
//! - [`Tree`]: from what a hand does in a frame to its activity; [`induce()`] learns one from annotated frames.
//! - [`Segmenter`]: from the activities of frames to [`Segment`]s that last.
//! - [`timeline()`] and [`picture()`] show segments as text and as SVG, [`score()`] holds them against the truth.

mod induce;
mod picture;
mod score;
mod timeline;
mod tree;

use serde::{Deserialize, Serialize};

pub use induce::{Induction, Samples, induce};
pub use picture::{picture, tree_picture};
pub use score::{Score, score};
pub use timeline::timeline;
pub use tree::{Feature, Tree};

use crate::log::{HandId, HandState, ObjectId};
use crate::observe::Observation;
use crate::truth::Activity;

/// How long segments and pauses are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Config {
    /// What lasts shorter than so many seconds is no segment of its own and belongs to the one before it; published are 0.05.
    pub minimum: f64,
    /// A hand that stops for at most so many seconds and then goes on with the same thing paused in it. 0 splits at each stop, as the published program does.
    pub pause: f64,
}

impl Default for Config {
    fn default() -> Self {
        Self { minimum: 0.05, pause: 0.8 }
    }
}

/// A time in which a hand does one thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// The hand.
    pub hand: HandId,
    /// What it does.
    pub activity: Activity,
    /// The number of its first frame.
    pub first: u64,
    /// The number of the first frame after it.
    pub until: u64,
    /// The time of its first frame in seconds.
    pub start: f64,
    /// The time of the first frame after it in seconds; of its last frame at the end of a log.
    pub end: f64,
    /// What the hand acts on.
    pub acted_on: Option<ObjectId>,
    /// What it holds.
    pub in_hand: Option<ObjectId>,
    /// When it stood still meanwhile: start and end of each pause in seconds.
    pub pauses: Vec<(f64, f64)>,
}

impl Segment {
    /// What tells segments apart.
    fn key(&self) -> (Activity, Option<ObjectId>, Option<ObjectId>) {
        (self.activity, self.acted_on, self.in_hand)
    }

    /// How long it is in seconds.
    pub fn length(&self) -> f64 {
        self.end - self.start
    }
}

/// Takes observations in their order; gives out segments when they are certain.
#[derive(Debug)]
pub struct Segmenter {
    tree: Tree,
    config: Config,
    hands: Vec<Hand>,
}

/// What is not certain yet of one hand: at most a segment, a stop after it, and what may go on or is too short.
#[derive(Debug, Default)]
struct Hand {
    open: Vec<Segment>,
}

impl Segmenter {
    /// A segmenter for logs with so many hands.
    pub fn new(tree: Tree, config: Config, hands: usize) -> Self {
        Self { tree, config, hands: (0..hands).map(|_| Hand::default()).collect() }
    }

    /// Takes the next observation; gives out the segments that ended, of all hands.
    pub fn push(&mut self, observation: &Observation) -> Vec<Segment> {
        let mut done = Vec::new();
        for (number, state) in observation.hands.iter().enumerate() {
            let activity = self.tree.classify(state);
            let frame = Segment::of_frame(HandId(number as u32), activity, state, observation);
            self.hands[number].push(frame, &self.config, &mut done);
        }
        done
    }

    /// There are no more observations; gives out all segments that are left.
    pub fn finish(mut self) -> Vec<Segment> {
        let mut done = Vec::new();
        for hand in &mut self.hands {
            hand.settle(&self.config);
            done.append(&mut hand.open);
        }
        done
    }
}

/// The segments of all observations of a log, in the order of their starts, those of one time in the order of the hands.
pub fn segments<'o>(
    tree: &Tree,
    config: &Config,
    observations: impl IntoIterator<Item = &'o Observation>,
) -> Vec<Segment> {
    let mut observations = observations.into_iter().peekable();
    let hands = observations.peek().map_or(0, |first| first.hands.len());
    let mut segmenter = Segmenter::new(tree.clone(), *config, hands);
    let mut segments: Vec<Segment> =
        observations.flat_map(|observation| segmenter.push(observation)).collect();
    segments.extend(segmenter.finish());
    segments
        .sort_by(|one, other| one.start.total_cmp(&other.start).then(one.hand.cmp(&other.hand)));
    segments
}

impl Segment {
    /// A segment of one frame.
    fn of_frame(
        hand: HandId,
        activity: Activity,
        state: &HandState,
        observation: &Observation,
    ) -> Self {
        Self {
            hand,
            activity,
            first: observation.frame,
            until: observation.frame + 1,
            start: observation.time,
            end: observation.time,
            acted_on: state.acted_on,
            in_hand: state.in_hand,
            pauses: Vec::new(),
        }
    }

    /// Goes on until the end of another one.
    fn extend(&mut self, other: &Segment) {
        self.until = other.until;
        self.end = other.end;
    }
}

impl Hand {
    /// Takes the next frame.
    fn push(&mut self, frame: Segment, config: &Config, done: &mut Vec<Segment>) {
        if let Some(last) = self.open.last_mut() {
            // Whatever comes now, the last one lasted until here.
            last.end = frame.start;
            if last.key() == frame.key() {
                last.until = frame.until;
                return;
            }
        }
        self.settle(config);
        if let Some(last) = self.open.last_mut()
            && last.key() == frame.key()
        {
            last.extend(&frame);
            return;
        }
        self.open.push(frame);
        // A stop that may turn out to be a pause keeps what was before it open.
        while self.open.len() > 3 {
            done.push(self.open.remove(0));
        }
        if self.open.len() == 3 && !stops(&self.open[0], &self.open[1]) {
            done.push(self.open.remove(0));
        }
    }

    /// Now that the last open segment has ended: it joins the one before it if it is too short, or if only a pause was between them.
    fn settle(&mut self, config: &Config) {
        let Some(last) = self.open.last() else { return };
        let count = self.open.len();
        if count > 1 && last.length() < config.minimum - 1e-9 {
            let last = self.open.pop().expect("there are two");
            self.open[count - 2].extend(&last);
            return;
        }
        if count > 2
            && self.open[count - 1].key() == self.open[count - 3].key()
            && stops(&self.open[count - 3], &self.open[count - 2])
            && self.open[count - 2].length() <= config.pause
        {
            let last = self.open.pop().expect("there are three");
            let stop = self.open.pop().expect("there are two");
            let before = self.open.last_mut().expect("there is one");
            before.pauses.push((stop.start, stop.end));
            before.pauses.extend(last.pauses.iter().copied());
            before.extend(&last);
        }
    }
}

/// Whether the second segment may be a stop within the first: the hand holds the same and has no other aim.
fn stops(before: &Segment, stop: &Segment) -> bool {
    before.in_hand == stop.in_hand
        && stop.acted_on.is_none_or(|aim| before.acted_on == Some(aim))
        && matches!(
            (before.activity, stop.activity),
            (Activity::Put, Activity::Take)
                | (Activity::Granular, Activity::Take | Activity::Put)
                | (Activity::Reach, Activity::Idle)
        )
}
