//! Observations of one demonstration go in, frame by frame; what operators are made of comes out: when hands changed what they do, and when facts changed.

use std::collections::BTreeSet;

use crate::log::{Fact, HandId, HandState, Header, ObjectId};
use crate::observe::{Credit, Ground, Observation};

/// What holds, as a relation between things and as the fact that the observer made of it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Told {
    /// The relation.
    pub ground: Ground,
    /// The fact; for what the log itself says there is nothing else.
    pub fact: Fact,
}

/// A demonstration without its frames.
#[derive(Debug, Clone)]
pub struct Record {
    /// What it is called in messages, such as the name of its file.
    pub name: String,
    /// What was tracked.
    pub header: Header,
    /// What held in the beginning. What was seen only later, and may have been so for long, is thought to have held.
    pub initial: BTreeSet<Told>,
    /// What changed, in its order.
    pub changes: Vec<Turn>,
    /// For each hand, in the order of the header, what it did and when.
    pub hands: Vec<Vec<Run>>,
    /// The time of the last frame in seconds.
    pub end: f64,
    /// How many frames there were.
    pub frames: u64,
}

/// A change of what holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Turn {
    /// When, in seconds.
    pub time: f64,
    /// What changed.
    pub told: Told,
    /// Whether it holds from then on.
    pub holds: bool,
    /// What the change is about.
    pub objects: Vec<ObjectId>,
    /// The hands that may have done it, the likeliest first.
    pub credits: Vec<Credit>,
}

/// A time in which a hand does the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// What it does.
    pub state: HandState,
    /// It is in teach mode.
    pub teach: bool,
    /// The time of the first frame in seconds.
    pub from: f64,
    /// The time of the frame after the last one, or of the last frame of all.
    pub to: f64,
}

/// Takes observations in their order.
#[derive(Debug, Clone)]
pub struct Recorder {
    record: Record,
    /// What holds now.
    now: BTreeSet<Told>,
}

impl Recorder {
    /// Begins with a demonstration of this name.
    pub fn new(name: impl Into<String>, header: &Header) -> Self {
        let record = Record {
            name: name.into(),
            header: header.clone(),
            initial: BTreeSet::new(),
            changes: Vec::new(),
            hands: vec![Vec::new(); header.hands.len()],
            end: 0.0,
            frames: 0,
        };
        Self { record, now: BTreeSet::new() }
    }

    /// Takes the next observation.
    pub fn push(&mut self, observation: &Observation) {
        let record = &mut self.record;
        let time = observation.time;
        for (runs, (&state, &teach)) in
            record.hands.iter_mut().zip(observation.hands.iter().zip(&observation.teach))
        {
            match runs.last_mut() {
                Some(run) if run.state == state && run.teach == teach => run.to = time,
                last => {
                    if let Some(run) = last {
                        run.to = time;
                    }
                    runs.push(Run { state, teach, from: time, to: time });
                }
            }
        }
        for change in &observation.changes {
            let told = Told { ground: change.ground.clone(), fact: change.fact.clone() };
            // What is met first and has been spoken of already did change in between, unseen.
            let spoken = record.changes.iter().any(|turn| turn.told == told);
            if change.fresh && change.holds && !spoken {
                record.initial.insert(told.clone());
                self.now.insert(told);
                continue;
            }
            let news =
                if change.holds { self.now.insert(told.clone()) } else { self.now.remove(&told) };
            if news {
                record.changes.push(Turn {
                    time,
                    told,
                    holds: change.holds,
                    objects: change.objects.clone(),
                    credits: change.credits.clone(),
                });
            }
        }
        record.end = time;
        record.frames += 1;
    }

    /// There are no more observations.
    pub fn finish(self) -> Record {
        self.record
    }
}

/// A time in which a hand holds one object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The hand.
    pub hand: HandId,
    /// What it holds.
    pub object: ObjectId,
    /// When it takes it, in seconds.
    pub from: f64,
    /// When it lets go, in seconds.
    pub to: f64,
    /// It does not let go before the log ends.
    pub open: bool,
}

impl Record {
    /// What the hands held and when, for each hand in the order of time.
    pub fn grips(&self) -> Vec<Grip> {
        let mut grips: Vec<Grip> = Vec::new();
        for (hand, runs) in self.hands.iter().enumerate() {
            let hand = HandId(hand as u32);
            let mut last: Option<Grip> = None;
            for run in runs {
                match (&mut last, run.state.in_hand) {
                    (Some(grip), Some(object)) if grip.object == object => grip.to = run.to,
                    (_, held) => {
                        grips.extend(last.take().map(|grip| Grip { open: false, ..grip }));
                        last = held.map(|object| Grip {
                            hand,
                            object,
                            from: run.from,
                            to: run.to,
                            open: true,
                        });
                    }
                }
            }
            grips.extend(last);
        }
        grips
    }

    /// When a hand last began to do something before `time`, counted from where it was idle or let go of something.
    pub fn begin(&self, hand: HandId, time: f64) -> f64 {
        let runs = &self.hands[hand.index()];
        let mut begin = time;
        for run in runs.iter().rev().filter(|run| run.from < time) {
            if run.state.in_hand.is_some() || run.state.acted_on.is_none() {
                break;
            }
            begin = run.from;
        }
        begin
    }
}
