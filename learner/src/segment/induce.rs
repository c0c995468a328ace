//! Annotated frames go in; a decision tree comes out, learned as C4.5 learns it (Quinlan 1993, chapters 2 and 4).

use super::tree::{Feature, Tree};
use crate::log::HandState;
use crate::truth::Activity;

/// How a tree is learned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Induction {
    /// A question must leave at least so many frames on both sides.
    pub least: u64,
    /// The confidence with which errors are estimated when branches are pruned, between 0 and 1; the smaller, the smaller the tree. 1 prunes nothing but what is useless.
    pub confidence: f64,
}

impl Default for Induction {
    /// Those of C4.5 itself.
    fn default() -> Self {
        Self { least: 2, confidence: 0.25 }
    }
}

/// How many frames of each activity there are with each combination of features: `[handMove][actedOn][inHand][activity]`.
///
/// That is all that a tree can be learned from, so any number of frames needs the same memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Samples {
    counts: [[u64; 5]; 8],
}

impl Samples {
    /// One more frame of a hand, with what a person, or a world, says that it did.
    pub fn add(&mut self, state: &HandState, activity: Activity) {
        self.counts[cell(state)][activity.index()] += 1;
    }

    /// Whether there is no frame.
    pub fn is_empty(&self) -> bool {
        self.counts.iter().flatten().all(|&count| count == 0)
    }
}

/// The number of a combination of features.
fn cell(state: &HandState) -> usize {
    Feature::ALL.iter().fold(0, |cell, feature| cell * 2 + usize::from(feature.holds(state)))
}

/// Whether a combination has a feature.
fn has(cell: usize, feature: Feature) -> bool {
    let place = Feature::ALL.iter().position(|other| *other == feature).expect("all are listed");
    cell >> (Feature::ALL.len() - 1 - place) & 1 == 1
}

/// Learns a tree: the question of the highest gain ratio first, among those whose gain is at least the average; then branches that do no better than a leaf are cut.
/// Ties go to the feature that table 3.1 has first, and between activities to the one that it has first.
/// Without any frame there is none.
pub fn induce(samples: &Samples, settings: &Induction) -> Option<Tree> {
    if samples.is_empty() {
        return None;
    }
    let cells: Vec<usize> = (0..8).collect();
    Some(grow(samples, &cells, settings).0)
}

/// The tree for some combinations, and how many errors it is estimated to make.
fn grow(samples: &Samples, cells: &[usize], settings: &Induction) -> (Tree, f64) {
    let counts = sum(samples, cells);
    let all: u64 = counts.iter().sum();
    let (leaf, wrong) = leaf(counts);
    let as_leaf = pessimistic(all, wrong, settings.confidence);
    let options: Vec<(Feature, f64, f64)> = Feature::ALL
        .into_iter()
        .filter_map(|feature| {
            gain(samples, cells, feature, settings.least)
                .map(|(gain, ratio)| (feature, gain, ratio))
        })
        .collect();
    let average = options.iter().map(|option| option.1).sum::<f64>() / options.len().max(1) as f64;
    let mut best: Option<(Feature, f64)> = None;
    for &(feature, gain, ratio) in &options {
        if gain > 1e-12
            && gain >= average - 1e-12
            && best.is_none_or(|(_, other)| ratio > other + 1e-12)
        {
            best = Some((feature, ratio));
        }
    }
    let Some((feature, _)) = best else { return (leaf, as_leaf) };
    let (with, without): (Vec<usize>, Vec<usize>) =
        cells.iter().partition(|&&cell| has(cell, feature));
    let (yes, yes_errors) = grow(samples, &with, settings);
    let (no, no_errors) = grow(samples, &without, settings);
    let errors = yes_errors + no_errors;
    if as_leaf <= errors + 0.1 {
        return (leaf, as_leaf);
    }
    (Tree::Node { feature, yes: Box::new(yes), no: Box::new(no) }, errors)
}

/// How many frames of each activity there are among some combinations.
fn sum(samples: &Samples, cells: &[usize]) -> [u64; 5] {
    let mut counts = [0; 5];
    for &cell in cells {
        for (count, more) in counts.iter_mut().zip(samples.counts[cell]) {
            *count += more;
        }
    }
    counts
}

/// The most frequent activity, and how many frames are of another.
fn leaf(counts: [u64; 5]) -> (Tree, u64) {
    let mut activity = Activity::ALL[0];
    for other in Activity::ALL {
        if counts[other.index()] > counts[activity.index()] {
            activity = other;
        }
    }
    (Tree::Leaf { activity, counts }, counts.iter().sum::<u64>() - counts[activity.index()])
}

/// The information that a question gains, in bits, and its ratio to the information of the answers; none if one side has too few frames.
fn gain(samples: &Samples, cells: &[usize], feature: Feature, least: u64) -> Option<(f64, f64)> {
    let (with, without): (Vec<usize>, Vec<usize>) =
        cells.iter().partition(|&&cell| has(cell, feature));
    let (yes, no) = (sum(samples, &with), sum(samples, &without));
    let (many, few) = (yes.iter().sum::<u64>(), no.iter().sum::<u64>());
    if many.min(few) < least.max(1) {
        return None;
    }
    let all = (many + few) as f64;
    let before = entropy(&sum(samples, cells));
    let after = many as f64 / all * entropy(&yes) + few as f64 / all * entropy(&no);
    let split = entropy(&[many, few]);
    Some((before - after, (before - after) / split))
}

/// The entropy of a distribution in bits.
fn entropy(counts: &[u64]) -> f64 {
    let all: u64 = counts.iter().sum();
    counts
        .iter()
        .filter(|&&count| count > 0)
        .map(|&count| {
            let part = count as f64 / all as f64;
            -part * part.log2()
        })
        .sum()
}

/// The number of errors that a leaf is to be expected to make: the upper limit of a confidence interval, as C4.5 has it, by the normal approximation.
fn pessimistic(all: u64, wrong: u64, confidence: f64) -> f64 {
    if all == 0 {
        return 0.0;
    }
    if confidence >= 1.0 {
        return wrong as f64;
    }
    let count = all as f64;
    if wrong == 0 {
        return count * (1.0 - confidence.powf(1.0 / count));
    }
    let rate = (wrong as f64 + 0.5) / count;
    if rate >= 1.0 {
        return wrong as f64;
    }
    let z = quantile(1.0 - confidence);
    let square = z * z;
    let limit = (rate
        + square / (2.0 * count)
        + z * (rate / count - rate * rate / count + square / (4.0 * count * count)).sqrt())
        / (1.0 + square / count);
    count * limit.min(1.0)
}

/// The quantile of the standard normal distribution, found by bisection of its distribution function.
fn quantile(probability: f64) -> f64 {
    let (mut low, mut high) = (-8.0, 8.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if normal(middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The distribution function of the standard normal distribution, by Simpson's rule on its density.
fn normal(x: f64) -> f64 {
    let density = |t: f64| (-t * t / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let steps = 200;
    let step = x / f64::from(steps);
    let mut sum = density(0.0) + density(x);
    for index in 1..steps {
        sum += density(f64::from(index) * step) * if index % 2 == 1 { 4.0 } else { 2.0 };
    }
    0.5 + sum * step / 3.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::log::ObjectId;

    fn state(cell: usize) -> HandState {
        let some = |feature| has(cell, feature).then_some(ObjectId(0));
        HandState {
            moves: has(cell, Feature::HandMove),
            acted_on: some(Feature::ActedOn),
            in_hand: some(Feature::InHand),
        }
    }

    /// Frames as table 3.1 has them, so many of each combination, of which a few are annotated wrongly.
    fn annotated(counts: [u64; 8], wrong: u64) -> Samples {
        let mut samples = Samples::default();
        for (cell, count) in counts.into_iter().enumerate() {
            let right = Tree::published().classify(&state(cell));
            for number in 0..count {
                let activity =
                    if number < wrong && count > 4 * wrong { Activity::Idle } else { right };
                samples.add(&state(cell), activity);
            }
        }
        samples
    }

    #[test]
    fn the_published_table_is_learned_from_frames_annotated_by_it() {
        let tree =
            induce(&annotated([40, 30, 0, 0, 25, 60, 50, 20], 2), &Induction::default()).unwrap();
        for cell in 0..8 {
            assert_eq!(
                tree.classify(&state(cell)),
                Tree::published().classify(&state(cell)),
                "{cell}\n{tree}"
            );
        }
    }

    #[test]
    fn a_question_that_explains_only_noise_is_pruned() {
        let mut samples = annotated([0; 8], 0);
        for number in 0..1000 {
            let moving = HandState { moves: number % 2 == 0, ..HandState::default() };
            samples.add(&moving, if number % 100 == 0 { Activity::Reach } else { Activity::Idle });
        }
        let tree = induce(&samples, &Induction::default()).unwrap();
        assert_eq!(tree.to_string(), "always Idle\n");
    }

    #[test]
    fn nothing_is_learned_from_nothing() {
        assert_eq!(induce(&Samples::default(), &Induction::default()), None);
    }

    #[test]
    fn limits_of_confidence_are_those_of_the_book() {
        // Quinlan 1993, section 4.2: U(0, 6) = 0.206, U(0, 9) = 0.143 and U(0, 1) = 0.750 at 25 %.
        for (all, limit) in [(6, 0.206), (9, 0.143), (1, 0.750)] {
            let found = pessimistic(all, 0, 0.25) / all as f64;
            assert!((found - limit).abs() < 0.001, "{all}: {found}");
        }
        assert!((quantile(0.75) - 0.6745).abs() < 1e-3);
    }

    proptest! {
        /// Unpruned, a tree makes no more errors on its own frames than any function of the features must make.
        #[test]
        fn an_unpruned_tree_is_as_good_as_features_allow_where_single_questions_help(
            counts in prop::array::uniform8(1u64..30)
        ) {
            let samples = annotated(counts, 0);
            let tree = induce(&samples, &Induction { least: 1, confidence: 1.0 }).unwrap();
            for cell in 0..8 {
                prop_assert_eq!(tree.classify(&state(cell)), Tree::published().classify(&state(cell)));
            }
        }
    }
}
