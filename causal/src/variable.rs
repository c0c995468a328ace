//! A value of a column goes in; the state of the variable that it stands for comes out, and back.
//!
//! A variable of a causal model is discrete (thesis §2.1.2): its states are the words of a category, the intervals of a measured
//! quantity, or the typical courses of a series.

use serde::{Deserialize, Serialize};

use crate::derive::Derivation;

/// The number of a variable in its table, model or network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct VariableId(pub u16);

impl VariableId {
    /// The same as an index.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// The number of a state among those of its variable.
pub type State = u8;

/// As many states as a variable can have: a [`State`] holds their numbers.
pub const MOST_STATES: usize = 256;

/// What is set or measured in a trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Variable {
    /// What people call it; no two of one table are called the same.
    pub name: String,
    /// The unit of its values, for quantities that have one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// What it is in a trial, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
    /// How its value comes from the columns of a trial; none where it is the column of its own name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Derivation>,
    /// The states that it can be in.
    pub states: States,
}

/// What a variable is in a trial (thesis §2.1.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// It is set before the trial, by chance or by choice: nothing in the trial causes it.
    Treatment,
    /// It is measured during the trial or at its end.
    Outcome,
}

/// The states that a variable can be in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum States {
    /// Words without an order.
    Categories(Vec<String>),
    /// Intervals between these edges, from the lowest to the highest: one more than there are states. An interval holds its lower
    /// edge and not its upper one; the last holds both.
    Intervals(Vec<f64>),
    /// The centroids of series, all of one length, each the course that its state stands for.
    Series(Vec<Vec<f64>>),
}

impl Variable {
    /// A variable with these states, of which no more is known.
    pub fn new(name: impl Into<String>, states: States) -> Self {
        Self { name: name.into(), unit: None, role: None, from: None, states }
    }

    /// A variable whose states are words.
    pub fn of_words(
        name: impl Into<String>,
        words: impl IntoIterator<Item = impl Into<String>>,
    ) -> Self {
        let words = words.into_iter().map(Into::into).collect();
        Self::new(name, States::Categories(words))
    }

    /// A variable whose states are the intervals between rising `edges`.
    pub fn of_intervals(name: impl Into<String>, edges: Vec<f64>) -> Self {
        Self::new(name, States::Intervals(edges))
    }

    /// How many states there are.
    pub fn arity(&self) -> usize {
        match &self.states {
            States::Categories(words) => words.len(),
            States::Intervals(edges) => edges.len().saturating_sub(1),
            States::Series(centroids) => centroids.len(),
        }
    }

    /// What a state is called: the word, the interval as `[-1.2, -0.6)`, the centroid as `course 1`.
    ///
    /// # Panics
    /// If there is no such state.
    pub fn label(&self, state: State) -> String {
        let at = usize::from(state);
        match &self.states {
            States::Categories(words) => words[at].clone(),
            States::Intervals(edges) => {
                let end = if at + 2 == edges.len() { ']' } else { ')' };
                format!("[{}, {}{end}", edges[at], edges[at + 1])
            }
            States::Series(centroids) => {
                assert!(at < centroids.len(), "the state is one of this variable's");
                format!("course {}", at + 1)
            }
        }
    }

    /// What all states are called, in their order.
    pub fn labels(&self) -> Vec<String> {
        (0..self.arity()).map(|at| self.label(at as State)).collect()
    }

    /// The state of a word: a category's own, or the state with this [label](Self::label).
    pub fn state_of_word(&self, word: &str) -> Option<State> {
        match &self.states {
            States::Categories(words) => {
                words.iter().position(|one| one == word).map(|at| at as State)
            }
            _ => (0..self.arity()).map(|at| at as State).find(|&state| self.label(state) == word),
        }
    }

    /// The state of a number: its interval, or the category that is written as this number. None where it lies outside every
    /// interval.
    pub fn state_of_number(&self, value: f64) -> Option<State> {
        match &self.states {
            States::Categories(words) => words
                .iter()
                .position(|word| word.parse::<f64>().is_ok_and(|one| one.total_cmp(&value).is_eq()))
                .map(|at| at as State),
            States::Intervals(edges) => interval(edges, value),
            States::Series(_) => None,
        }
    }

    /// The state of a series: that with the nearest centroid by Euclidean distance (equation 2.3), the first among equals. None
    /// where the length differs or a value is no number.
    pub fn state_of_series(&self, series: &[f64]) -> Option<State> {
        let States::Series(centroids) = &self.states else { return None };
        if series.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let mut nearest: Option<(f64, State)> = None;
        for (at, centroid) in centroids.iter().enumerate() {
            if centroid.len() != series.len() {
                return None;
            }
            let distance = squared_distance(centroid, series);
            if nearest.is_none_or(|(least, _)| distance < least) {
                nearest = Some((distance, at as State));
            }
        }
        nearest.map(|(_, state)| state)
    }

    /// Whether the states have an order, so that one can be beside another.
    pub fn is_ordered(&self) -> bool {
        matches!(self.states, States::Intervals(_))
    }

    /// The middle of an interval, in the variable's unit; none for other states.
    pub fn midpoint(&self, state: State) -> Option<f64> {
        let States::Intervals(edges) = &self.states else { return None };
        let at = usize::from(state);
        Some(f64::midpoint(*edges.get(at)?, *edges.get(at + 1)?))
    }
}

/// The variable of a name.
pub fn named(variables: &[Variable], name: &str) -> Option<VariableId> {
    variables.iter().position(|one| one.name == name).map(|at| VariableId(at as u16))
}

/// What to say of a name that none of the variables has.
pub fn unknown(name: &str, variables: &[Variable]) -> String {
    let help = lang::did_you_mean(name, variables.iter().map(|one| one.name.as_str()));
    format!("there is no variable `{name}`{help}")
}

/// The square of the Euclidean distance of two series of one length (equation 2.3, without the root).
pub fn squared_distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// The interval between rising `edges` that holds a value.
fn interval(edges: &[f64], value: f64) -> Option<State> {
    let (&lowest, &highest) = (edges.first()?, edges.last()?);
    if edges.len() < 2 || !(lowest..=highest).contains(&value) {
        return None;
    }
    let above = edges.partition_point(|&edge| edge <= value);
    Some((above.min(edges.len() - 1) - 1) as State)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_lies_in_one_interval_or_in_none() {
        let offset = Variable::of_intervals("xOff", vec![-1.8, -0.6, 0.6, 1.8]);
        let states: Vec<Option<State>> = [-1.9, -1.8, -0.7, -0.6, 0.0, 1.8, 1.9, f64::NAN]
            .into_iter()
            .map(|value| offset.state_of_number(value))
            .collect();
        assert_eq!(states, [None, Some(0), Some(0), Some(1), Some(1), Some(2), None, None]);
        assert_eq!(offset.labels(), ["[-1.8, -0.6)", "[-0.6, 0.6)", "[0.6, 1.8]"]);
        assert_eq!(offset.midpoint(1), Some(0.0));
    }

    #[test]
    fn a_series_belongs_to_the_nearest_centroid() {
        let states = States::Series(vec![vec![0.0, 0.0, 0.0], vec![0.0, 1.0, 2.0]]);
        let course = Variable::new("robot_pos_change", states);
        assert_eq!(course.state_of_series(&[0.0, 0.9, 1.5]), Some(1));
        assert_eq!(course.state_of_series(&[0.0, 0.1, -0.5]), Some(0));
        assert_eq!(course.state_of_series(&[0.0, 0.1]), None, "another length");
    }
}
