//! What was recognised and what really happened go in; how often they agree comes out.

use std::fmt;

use super::{Config, Segment, Segmenter, Tree};
use crate::observe::Observation;
use crate::truth::{Activity, Truth};

/// How frames were classified: a matrix of what was true against what was recognised.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Score {
    /// `counts[truth][recognised]`, both in the order of [`Activity::ALL`].
    pub counts: [[u64; 5]; 5],
    /// How many frames of hands had each variable right: handMove, actedOn (the same object), inHand (the same object).
    pub variables: [u64; 3],
}

impl Score {
    /// All frames of hands.
    pub fn frames(&self) -> u64 {
        self.counts.iter().flatten().sum()
    }

    /// The part of frames that were recognised rightly; 1 where there are none.
    pub fn accuracy(&self) -> f64 {
        let right: u64 = (0..5).map(|class| self.counts[class][class]).sum();
        share(right, self.frames())
    }

    /// The harmonic mean of precision and recall of one activity; none where it neither was nor was recognised.
    pub fn f1(&self, activity: Activity) -> Option<f64> {
        let class = activity.index();
        let right = self.counts[class][class];
        let true_frames: u64 = self.counts[class].iter().sum();
        let recognised: u64 = self.counts.iter().map(|row| row[class]).sum();
        (true_frames + recognised > 0)
            .then(|| 2.0 * right as f64 / (true_frames + recognised) as f64)
    }

    /// Adds the frames of another log.
    pub fn add(&mut self, other: &Score) {
        for (row, more) in self.counts.iter_mut().zip(other.counts) {
            for (count, more) in row.iter_mut().zip(more) {
                *count += more;
            }
        }
        for (count, more) in self.variables.iter_mut().zip(other.variables) {
            *count += more;
        }
    }
}

/// A part of a whole; 1 of nothing.
fn share(part: u64, whole: u64) -> f64 {
    if whole == 0 { 1.0 } else { part as f64 / whole as f64 }
}

/// A table: one row for each activity that really happened, one column for each that was recognised, and F1 at the end.
impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:>10}", "truth")?;
        for activity in Activity::ALL {
            write!(f, " {activity:>9}")?;
        }
        writeln!(f, " {:>7}", "F1")?;
        for activity in Activity::ALL {
            write!(f, "{activity:>10}")?;
            for count in self.counts[activity.index()] {
                write!(f, " {count:>9}")?;
            }
            match self.f1(activity) {
                Some(value) => writeln!(f, " {value:>7.3}")?,
                None => writeln!(f, " {:>7}", "–")?,
            }
        }
        let all = self.frames();
        write!(f, "{:.2} % of {all} frames of hands", 100.0 * self.accuracy())?;
        let [moves, acted_on, in_hand] = self.variables.map(|count| 100.0 * share(count, all));
        writeln!(f, "; handMove {moves:.2} %, actedOn {acted_on:.2} %, inHand {in_hand:.2} %")
    }
}

/// Holds observations against the truth of the same log, frame by frame and hand by hand; frames are matched by their times, to a tenth of a millisecond.
/// What lasts too short to be a segment counts as the segment before it; what a hand does in a pause counts as what it is.
pub fn score(
    tree: &Tree,
    config: &Config,
    observations: &[Observation],
    truths: &[Truth],
) -> Score {
    let hands = observations.first().map_or(0, |first| first.hands.len());
    let steady = Config { pause: 0.0, ..*config };
    let mut segmenter = Segmenter::new(tree.clone(), steady, hands);
    let mut segments: Vec<Segment> =
        observations.iter().flat_map(|observation| segmenter.push(observation)).collect();
    segments.extend(segmenter.finish());
    let mut score = Score::default();
    let mut classes: Vec<Vec<Activity>> = vec![Vec::new(); hands];
    let first = observations.first().map_or(0, |first| first.frame);
    for segment in &segments {
        let row = &mut classes[segment.hand.index()];
        row.resize((segment.until - first) as usize, segment.activity);
    }
    let mut truths = truths.iter().peekable();
    for (index, observation) in observations.iter().enumerate() {
        while truths.next_if(|truth| truth.time < observation.time - 1e-4).is_some() {}
        let Some(truth) = truths.peek().filter(|truth| truth.time <= observation.time + 1e-4)
        else {
            continue;
        };
        for (hand, (state, activity)) in truth.hands.iter().enumerate() {
            let found = &observation.hands[hand];
            score.counts[activity.index()][classes[hand][index].index()] += 1;
            score.variables[0] += u64::from(state.moves == found.moves);
            score.variables[1] += u64::from(state.acted_on == found.acted_on);
            score.variables[2] += u64::from(state.in_hand == found.in_hand);
        }
    }
    score
}
