//! The columns of a trial go in; the value of a variable that is not a column of its own comes out (thesis table 2.1).

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How a value comes from the columns of a trial. In JSON a column is its name, and an operation is `{"norm": ["dx", "dy"]}`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Derivation {
    /// A column: `dist`; or a series, whose columns are `dist[0]`, `dist[1]` and so on.
    Column(String),
    /// Something made of other values.
    Of(Box<Operation>),
}

/// What is made of other values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Operation {
    /// The Euclidean norm of several quantities; of series, at each moment.
    Norm(Vec<Derivation>),
    /// The sum of several quantities, each as often as the number beside it says: `{"sum": [["x", 1], ["y", 0.5]]}`.
    Sum(Vec<(Derivation, f64)>),
    /// The greatest of the absolute values of several quantities.
    GreatestMagnitude(Vec<Derivation>),
    /// A series less its first value, so that it begins at 0.
    Relative(Derivation),
    /// How far a series moves in all: the sum of the absolute differences of neighbours.
    TotalVariation(Derivation),
    /// The sum of the absolute values of a series: what table 2.1 prints for `total_robot_rotation`.
    SumOfMagnitudes(Derivation),
    /// The first value of a series.
    First(Derivation),
    /// 1 where a quantity is at least this, else 0.
    #[serde(rename_all = "kebab-case")]
    Threshold {
        /// The quantity.
        of: Derivation,
        /// What it must reach.
        at_least: f64,
    },
}

/// A value of a trial: a quantity, or a series of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// One number.
    Number(f64),
    /// Numbers at moments that are the same in each trial.
    Series(Vec<f64>),
}

/// Why a value cannot be derived.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum DeriveError {
    /// A norm of nothing, or of a quantity and a series, or of series of different lengths.
    #[error("the values under `norm` differ in length")]
    Lengths,
    /// Something that only a series has.
    #[error("`{0}` is of a series, and `{1}` is one number")]
    NoSeries(&'static str, String),
    /// Something that only a quantity has.
    #[error("`{0}` is of one number, and `{1}` is a series")]
    NoNumber(&'static str, String),
}

impl Derivation {
    /// The names of the columns and series that the value comes from, each once, as they occur.
    pub fn columns(&self) -> Vec<&str> {
        let mut names = Vec::new();
        self.collect(&mut names);
        names
    }

    fn collect<'a>(&'a self, names: &mut Vec<&'a str>) {
        match self {
            Self::Column(name) if names.contains(&name.as_str()) => {}
            Self::Column(name) => names.push(name),
            Self::Of(operation) => match &**operation {
                Operation::Norm(parts) | Operation::GreatestMagnitude(parts) => {
                    for part in parts {
                        part.collect(names);
                    }
                }
                Operation::Sum(parts) => {
                    for (part, _) in parts {
                        part.collect(names);
                    }
                }
                Operation::Relative(of)
                | Operation::TotalVariation(of)
                | Operation::SumOfMagnitudes(of)
                | Operation::First(of)
                | Operation::Threshold { of, .. } => of.collect(names),
            },
        }
    }

    /// The value, where `column` gives that of a column or a series.
    pub fn value(&self, column: &mut dyn FnMut(&str) -> Value) -> Result<Value, DeriveError> {
        let operation = match self {
            Self::Column(name) => return Ok(column(name)),
            Self::Of(operation) => &**operation,
        };
        Ok(match operation {
            Operation::Norm(parts) => {
                let parts: Vec<Value> =
                    parts.iter().map(|part| part.value(column)).collect::<Result<_, _>>()?;
                norm(&parts)?
            }
            Operation::Sum(parts) => {
                let mut sum = 0.0;
                for (part, times) in parts {
                    sum += times * part.number("sum", column)?;
                }
                Value::Number(sum)
            }
            Operation::GreatestMagnitude(parts) => {
                let mut greatest = 0.0_f64;
                for part in parts {
                    let magnitude = part.number("greatest-magnitude", column)?.abs();
                    // A value that is missing makes the whole missing, which `max` would not.
                    greatest = if magnitude.is_nan() { magnitude } else { greatest.max(magnitude) };
                    if greatest.is_nan() {
                        break;
                    }
                }
                Value::Number(greatest)
            }
            Operation::Relative(of) => {
                let series = of.series("relative", column)?;
                let first = series.first().copied().unwrap_or_default();
                Value::Series(series.iter().map(|value| value - first).collect())
            }
            Operation::TotalVariation(of) => {
                let series = of.series("total-variation", column)?;
                Value::Number(series.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum())
            }
            Operation::SumOfMagnitudes(of) => {
                let series = of.series("sum-of-magnitudes", column)?;
                Value::Number(series.iter().map(|value| value.abs()).sum())
            }
            Operation::First(of) => {
                let series = of.series("first", column)?;
                Value::Number(series.first().copied().unwrap_or(f64::NAN))
            }
            Operation::Threshold { of, at_least } => match of.number("threshold", column)? {
                value if value.is_nan() => Value::Number(value),
                value => Value::Number(f64::from(u8::from(value >= *at_least))),
            },
        })
    }

    /// A value that must be one number.
    fn number(
        &self,
        what: &'static str,
        column: &mut dyn FnMut(&str) -> Value,
    ) -> Result<f64, DeriveError> {
        match self.value(column)? {
            Value::Number(value) => Ok(value),
            Value::Series(_) => Err(DeriveError::NoNumber(what, self.to_string())),
        }
    }

    /// A value that must be a series.
    fn series(
        &self,
        what: &'static str,
        column: &mut dyn FnMut(&str) -> Value,
    ) -> Result<Vec<f64>, DeriveError> {
        match self.value(column)? {
            Value::Series(series) => Ok(series),
            Value::Number(_) => Err(DeriveError::NoSeries(what, self.to_string())),
        }
    }
}

/// The norm of quantities, or of series moment by moment.
fn norm(parts: &[Value]) -> Result<Value, DeriveError> {
    let numbers: Option<Vec<f64>> = parts
        .iter()
        .map(|part| if let Value::Number(value) = part { Some(*value) } else { None })
        .collect();
    if let Some(numbers) = numbers {
        return Ok(Value::Number(numbers.iter().map(|value| value * value).sum::<f64>().sqrt()));
    }
    let series: Vec<&Vec<f64>> =
        parts
            .iter()
            .map(|part| {
                if let Value::Series(series) = part {
                    Ok(series)
                } else {
                    Err(DeriveError::Lengths)
                }
            })
            .collect::<Result<_, _>>()?;
    let length = series.first().map_or(0, |first| first.len());
    if series.iter().any(|one| one.len() != length) {
        return Err(DeriveError::Lengths);
    }
    let at = |moment: usize| series.iter().map(|one| one[moment] * one[moment]).sum::<f64>().sqrt();
    Ok(Value::Series((0..length).map(at).collect()))
}

impl std::fmt::Display for Derivation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let operation = match self {
            Self::Column(name) => return f.write_str(name),
            Self::Of(operation) => &**operation,
        };
        match operation {
            Operation::Norm(parts) => {
                let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
                write!(f, "norm({})", parts.join(", "))
            }
            Operation::Sum(parts) => {
                let parts: Vec<String> = parts
                    .iter()
                    .map(|(part, times)| match times {
                        1.0 => part.to_string(),
                        times => format!("{times} {part}"),
                    })
                    .collect();
                f.write_str(&parts.join(" + "))
            }
            Operation::GreatestMagnitude(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| format!("|{part}|")).collect();
                match parts.as_slice() {
                    [one] => f.write_str(one),
                    several => write!(f, "the greatest of {}", several.join(", ")),
                }
            }
            Operation::Relative(of) => write!(f, "relative({of})"),
            Operation::TotalVariation(of) => write!(f, "total-variation({of})"),
            Operation::SumOfMagnitudes(of) => write!(f, "sum-of-magnitudes({of})"),
            Operation::First(of) => write!(f, "first({of})"),
            Operation::Threshold { of, at_least } => write!(f, "{of} >= {at_least}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(json: &str) -> Result<Value, DeriveError> {
        let derivation: Derivation = serde_json::from_str(json).unwrap();
        derivation.value(&mut |name| match name {
            "x" => Value::Series(vec![3.0, 0.0, -6.0]),
            "y" => Value::Series(vec![4.0, 1.0, 8.0]),
            "rating" => Value::Number(4.0),
            _ => Value::Number(2.0),
        })
    }

    #[test]
    fn table_2_1_can_be_declared() {
        let distance = r#"{"norm": ["x", "y"]}"#;
        assert_eq!(value(distance), Ok(Value::Series(vec![5.0, 1.0, 10.0])));
        let relative = format!(r#"{{"relative": {distance}}}"#);
        assert_eq!(value(&relative), Ok(Value::Series(vec![0.0, -4.0, 5.0])));
        assert_eq!(value(r#"{"total-variation": "x"}"#), Ok(Value::Number(9.0)));
        assert_eq!(value(r#"{"sum-of-magnitudes": "x"}"#), Ok(Value::Number(9.0)));
        assert_eq!(value(r#"{"first": "x"}"#), Ok(Value::Number(3.0)));
        let threshold = r#"{"threshold": {"of": "rating", "at-least": 4}}"#;
        assert_eq!(value(threshold), Ok(Value::Number(1.0)));
        assert_eq!(value(r#"{"norm": ["rating", "z"]}"#), Ok(Value::Number(20_f64.sqrt())));
    }

    #[test]
    fn quantities_are_summed_and_the_greatest_is_taken() {
        let sum = r#"{"sum": [["rating", -1], ["z", 0.5]]}"#;
        assert_eq!(value(sum), Ok(Value::Number(-3.0)));
        let greatest = format!(r#"{{"greatest-magnitude": ["z", {sum}]}}"#);
        assert_eq!(value(&greatest), Ok(Value::Number(3.0)));
        let derivation: Derivation = serde_json::from_str(&greatest).unwrap();
        assert_eq!(derivation.to_string(), "the greatest of |z|, |-1 rating + 0.5 z|");
    }

    #[test]
    fn what_a_number_has_not_is_said() {
        let error = value(r#"{"relative": "rating"}"#).unwrap_err();
        assert_eq!(error.to_string(), "`relative` is of a series, and `rating` is one number");
        assert_eq!(value(r#"{"norm": ["x", "rating"]}"#), Err(DeriveError::Lengths));
    }
}
