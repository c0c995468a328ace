//! A variable of the source and one of the target go in; which states of the one stand for each state of the other comes out.
//!
//! Two networks rarely cut a quantity at the same places. A cell of the target lies over several cells of the source, and values are
//! taken to be spread evenly within a cell: each cell of the source counts by the share of the target's cell that it covers.

use super::unit;
use crate::variable::{State, States, Variable, squared_distance};

/// States of the source, each with its share; the shares sum to one.
pub(super) type Mixture = Vec<(State, f64)>;

/// A cell of which less than this share lies in the range of the source has no counterpart.
pub(super) const COVERED: f64 = 0.5;

/// For each state of the target the states of the source that stand for it; none where it lies outside what the source knows. What is
/// wrong where no state has a counterpart at all, or the values cannot be compared.
pub(super) fn overlap(
    source: &Variable,
    target: &Variable,
) -> Result<Vec<Option<Mixture>>, String> {
    let unit_of = |variable: &Variable| variable.unit.clone();
    let (own, other) = (unit_of(source), unit_of(target));
    let Some(factor) = unit::factor(other.as_deref(), own.as_deref()) else {
        return Err(format!(
            "the one is in {}, the other in {}",
            own.unwrap_or_default(),
            other.unwrap_or_default()
        ));
    };
    let numbers = |words: &[String]| -> Option<Vec<f64>> {
        words.iter().map(|word| word.parse::<f64>().ok().filter(|one| one.is_finite())).collect()
    };
    let found: Vec<Option<Mixture>> = match (&source.states, &target.states) {
        (States::Intervals(from), States::Intervals(to)) => {
            to.windows(2).map(|cell| shares(from, cell[0] * factor, cell[1] * factor)).collect()
        }
        (States::Categories(from), States::Categories(to)) => {
            let place = |word: &String| from.iter().position(|one| alike(one, word));
            to.iter().map(|word| place(word).map(|at| vec![(at as State, 1.0)])).collect()
        }
        (States::Intervals(_), States::Categories(to)) => {
            let Some(values) = numbers(to) else { return Err(kinds(source, target)) };
            values
                .into_iter()
                .map(|value| source.state_of_number(value * factor).map(|at| vec![(at, 1.0)]))
                .collect()
        }
        (States::Categories(from), States::Intervals(_)) => {
            let Some(values) = numbers(from) else { return Err(kinds(source, target)) };
            (0..target.arity())
                .map(|cell| {
                    let inside: Vec<State> = (0..values.len())
                        .filter(|&at| {
                            target.state_of_number(values[at] / factor) == Some(cell as State)
                        })
                        .map(|at| at as State)
                        .collect();
                    let share = 1.0 / inside.len().max(1) as f64;
                    (!inside.is_empty()).then(|| inside.iter().map(|&at| (at, share)).collect())
                })
                .collect()
        }
        (States::Series(from), States::Series(to)) => {
            let (own, other) = (from.first().map_or(0, Vec::len), to.first().map_or(0, Vec::len));
            if own != other {
                return Err(format!("the one is a series of {own} values, the other of {other}"));
            }
            to.iter().map(|course| nearest(from, course, factor)).collect()
        }
        _ => return Err(kinds(source, target)),
    };
    if found.iter().all(Option::is_none) {
        let labels = |variable: &Variable| variable.labels().join(", ");
        return Err(format!(
            "they have no value in common: {} and {}",
            labels(source),
            labels(target)
        ));
    }
    Ok(found)
}

/// How much of the values of two variables they share, from 0 to 1: the common part of both ranges, or of both lists of words. None
/// where they cannot be compared.
pub(super) fn common(source: &Variable, target: &Variable) -> Option<f64> {
    let factor = unit::factor(target.unit.as_deref(), source.unit.as_deref())?;
    match (&source.states, &target.states) {
        (States::Intervals(from), States::Intervals(to)) => {
            let (low, high) = (from.first()?, from.last()?);
            let (other_low, other_high) = (to.first()? * factor, to.last()? * factor);
            let both = high.min(other_high) - low.max(other_low);
            let whole = high.max(other_high) - low.min(other_low);
            (whole > 0.0).then(|| (both / whole).max(0.0))
        }
        (States::Categories(from), States::Categories(to)) => {
            let both = from.iter().filter(|one| to.iter().any(|other| alike(one, other))).count();
            let whole = from.len() + to.len() - both;
            (whole > 0).then(|| both as f64 / whole as f64)
        }
        (States::Series(from), States::Series(to)) => {
            Some(f64::from(u8::from(from.first()?.len() == to.first()?.len())))
        }
        _ => None,
    }
}

/// Whether two words name one category.
pub(super) fn alike(one: &str, other: &str) -> bool {
    let number = |word: &str| word.parse::<f64>().ok();
    one.to_lowercase() == other.to_lowercase()
        || matches!((number(one), number(other)), (Some(one), Some(other)) if one.total_cmp(&other).is_eq())
}

fn kinds(source: &Variable, target: &Variable) -> String {
    let kind = |variable: &Variable| match &variable.states {
        States::Categories(_) => "words",
        States::Intervals(_) => "a quantity",
        States::Series(_) => "a series",
    };
    format!("the one is {}, the other {}", kind(source), kind(target))
}

/// The cells between rising edges that cover the range from `low` to `high`, each with its share.
fn shares(edges: &[f64], low: f64, high: f64) -> Option<Mixture> {
    let parts: Mixture = edges
        .windows(2)
        .enumerate()
        .map(|(at, cell)| (at as State, high.min(cell[1]) - low.max(cell[0])))
        .filter(|&(_, length)| length > 0.0)
        .collect();
    let covered: f64 = parts.iter().map(|&(_, length)| length).sum();
    if covered < COVERED * (high - low) || parts.is_empty() {
        return None;
    }
    // A sliver comes from how edges are rounded, not from what is meant.
    let kept: Mixture = parts.into_iter().filter(|&(_, length)| length > 1e-9 * covered).collect();
    let whole: f64 = kept.iter().map(|&(_, length)| length).sum();
    Some(kept.into_iter().map(|(at, length)| (at, length / whole)).collect())
}

/// The course of the source that is nearest to one of the target (equation 2.3).
fn nearest(courses: &[Vec<f64>], course: &[f64], factor: f64) -> Option<Mixture> {
    let scaled: Vec<f64> = course.iter().map(|value| value * factor).collect();
    let distances = courses.iter().map(|one| squared_distance(one, &scaled)).enumerate();
    let (at, _) = distances.min_by(|one, other| one.1.total_cmp(&other.1))?;
    Some(vec![(at as State, 1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(name: &str, edges: &[f64]) -> Variable {
        Variable::of_intervals(name, edges.to_vec())
    }

    #[test]
    fn cells_count_by_the_share_that_they_cover() {
        let source = cut("x", &[0.0, 1.0, 2.0, 4.0]);
        let target = cut("x", &[0.5, 1.5, 3.0, 4.5, 6.0]);
        let found = overlap(&source, &target).unwrap();
        assert_eq!(found[0], Some(vec![(0, 0.5), (1, 0.5)]));
        let second = found[1].clone().unwrap();
        assert!((second[0].1 - 1.0 / 3.0).abs() < 1e-12 && (second[1].1 - 2.0 / 3.0).abs() < 1e-12);
        // Two thirds of [3, 4.5) lie in the range of the source, nothing of [4.5, 6].
        assert_eq!(found[2], Some(vec![(2, 1.0)]));
        assert_eq!(found[3], None);
        assert!((common(&source, &target).unwrap() - 3.5 / 6.0).abs() < 1e-12);
    }

    #[test]
    fn units_and_words_and_numbers_are_brought_together() {
        let mut metres = cut("height", &[0.0, 0.01, 0.02]);
        metres.unit = Some("m".to_owned());
        let mut centimetres = cut("height", &[0.0, 1.0, 2.0]);
        centimetres.unit = Some("cm".to_owned());
        let found = overlap(&metres, &centimetres).unwrap();
        assert_eq!(found, [Some(vec![(0, 1.0)]), Some(vec![(1, 1.0)])]);
        let words = Variable::of_words("n", ["1", "2", "9"]);
        let cells = cut("n", &[0.0, 1.5, 3.0]);
        assert_eq!(
            overlap(&cells, &words).unwrap(),
            [Some(vec![(0, 1.0)]), Some(vec![(1, 1.0)]), None]
        );
        assert_eq!(overlap(&words, &cells).unwrap(), [Some(vec![(0, 1.0)]), Some(vec![(1, 1.0)])]);
        let kinds = Variable::of_words("kind", ["Plate", "bowl"]);
        let others = Variable::of_words("kind", ["glass", "plate"]);
        assert_eq!(overlap(&kinds, &others).unwrap(), [None, Some(vec![(0, 1.0)])]);
    }

    #[test]
    fn what_cannot_be_compared_is_said() {
        let plates = Variable::of_words("kind", ["plate"]);
        let bowls = Variable::of_words("kind", ["bowl", "glass"]);
        assert_eq!(
            overlap(&plates, &bowls).unwrap_err(),
            "they have no value in common: plate and bowl, glass"
        );
        assert_eq!(
            overlap(&plates, &cut("kind", &[0.0, 1.0])).unwrap_err(),
            "the one is words, the other a quantity"
        );
        let mut seconds = cut("t", &[0.0, 1.0]);
        seconds.unit = Some("s".to_owned());
        let mut metres = seconds.clone();
        metres.unit = Some("m".to_owned());
        assert_eq!(overlap(&seconds, &metres).unwrap_err(), "the one is in s, the other in m");
    }
}
