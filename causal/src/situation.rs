//! The row of a file goes in, or values that a person names; a situation comes out, and the states that variables have in it.

use std::collections::BTreeMap;

use thiserror::Error;

use crate::derive::{Derivation, Value};
use crate::source::fetch::moment;
use crate::source::{Cells, Fault, MISSING, Source, is_missing, number};
use crate::variable::{State, States, Variable};

/// What is known of a situation: the values of columns, by their names.
pub type Situation = BTreeMap<String, Known>;

/// A value of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Known {
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
    /// A series of numbers.
    Series(Vec<f64>),
}

/// A value that is in no state of its variable.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{name}` is {value}, which is no state of the model; {help}")]
pub struct Outside {
    /// The variable.
    pub name: String,
    /// Its value.
    pub value: String,
    /// What its states are.
    pub help: String,
}

impl Known {
    /// What a person wrote: a number, or else a word.
    pub fn read(text: &str) -> Self {
        text.parse().map_or_else(|_| Self::Word(text.to_owned()), Self::Number)
    }
}

/// Reads the trials of a source, each as a situation. What is missing in a trial is not known in it.
pub fn situations(source: &dyn Source) -> Result<Vec<Situation>, Fault> {
    let all: Vec<usize> = (0..source.columns().len()).collect();
    let mut situations = Vec::new();
    for shard in 0..source.shards() {
        source.read(shard, &all, &mut |block| {
            for row in 0..block.rows.len() {
                let mut situation = Situation::new();
                for (name, cells) in source.columns().iter().zip(&block.columns) {
                    let Some(known) = cell(cells, row) else { continue };
                    match (moment(name), known) {
                        (Some((series, _)), Known::Number(value)) => {
                            let before = situation
                                .entry(series.to_owned())
                                .or_insert_with(|| Known::Series(Vec::new()));
                            if let Known::Series(values) = before {
                                values.push(value);
                            }
                        }
                        (_, known) => {
                            situation.insert(name.clone(), known);
                        }
                    }
                }
                situations.push(situation);
            }
            Ok(())
        })?;
    }
    Ok(situations)
}

fn cell(cells: &Cells, row: usize) -> Option<Known> {
    match cells {
        Cells::Numbers(numbers) => {
            Some(numbers[row]).filter(|value| !value.is_nan()).map(Known::Number)
        }
        Cells::Words(_, codes) if codes[row] == MISSING => None,
        Cells::Words(words, codes) => Some(Known::read(&words[codes[row] as usize])),
        Cells::Text(texts) => {
            let text = texts.get(row);
            if is_missing(text) {
                return None;
            }
            let word = || Known::Word(String::from_utf8_lossy(text).into_owned());
            Some(number(text).map_or_else(word, Known::Number))
        }
    }
}

/// The column that a variable comes from: that of its own name, unless another is declared.
pub fn column(variable: &Variable) -> &str {
    match &variable.from {
        Some(Derivation::Column(column)) => column,
        _ => &variable.name,
    }
}

/// The value that stands for a state.
pub fn typical(variable: &Variable, state: State) -> Known {
    match &variable.states {
        States::Categories(words) => Known::Word(words[usize::from(state)].clone()),
        States::Intervals(edges) => {
            let middle = variable.midpoint(state).expect("the state is one of the intervals");
            // As many digits as matter in an interval so wide, for whoever reads the number.
            let at = usize::from(state);
            let digits = (4.0 - (edges[at + 1] - edges[at]).log10().floor()).clamp(0.0, 15.0);
            Known::Number(format!("{middle:.*}", digits as usize).parse().unwrap_or(middle))
        }
        States::Series(centroids) => Known::Series(centroids[usize::from(state)].clone()),
    }
}

/// The state of a variable in a situation; none where nothing is known of it.
pub fn state(variable: &Variable, situation: &Situation) -> Result<Option<State>, Outside> {
    let outside = |value: String| {
        let help = match &variable.states {
            States::Intervals(edges) => {
                format!("its intervals reach from {} to {}", edges[0], edges[edges.len() - 1])
            }
            _ => format!("its states are {}", variable.labels().join(", ")),
        };
        Outside { name: variable.name.clone(), value, help }
    };
    let place = |known: &Known| match known {
        Known::Number(value) => {
            variable.state_of_number(*value).ok_or_else(|| outside(value.to_string()))
        }
        Known::Word(word) => variable.state_of_word(word).ok_or_else(|| outside(word.clone())),
        Known::Series(series) => variable
            .state_of_series(series)
            .ok_or_else(|| outside(format!("a series of {} moments", series.len()))),
    };
    match &variable.from {
        None | Some(Derivation::Column(_)) => {
            situation.get(column(variable)).map(place).transpose()
        }
        Some(derivation) => {
            if derivation.columns().iter().any(|column| !situation.contains_key(*column)) {
                return Ok(None);
            }
            let value = derivation.value(&mut |column| match &situation[column] {
                Known::Number(value) => Value::Number(*value),
                Known::Series(series) => Value::Series(series.clone()),
                Known::Word(_) => Value::Number(f64::NAN),
            });
            match value {
                Ok(Value::Number(value)) => place(&Known::Number(value)).map(Some),
                Ok(Value::Series(series)) => place(&Known::Series(series)).map(Some),
                Err(error) => Err(outside(error.to_string())),
            }
        }
    }
}
