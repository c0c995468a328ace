//! Sets of variables go in; the SQL that counts their states comes out: counting is a GROUP BY, wherever the trials lie.
//!
//! Each query gives two columns, the number of a cell as in [`Counts`](crate::count::Counts) and how many trials are in it. Trials that
//! have no state for some variable of the model are in no cell: they come with a NULL, if at all.

use crate::derive::{Derivation, Operation};
use crate::variable::{States, Variable, VariableId};

/// The query for one set, over a relation of this name.
pub fn count(relation: &str, variables: &[Variable], set: &[VariableId]) -> Result<String, String> {
    let mut cell = "0".to_owned();
    for id in set {
        let variable = &variables[id.index()];
        cell = format!("({cell} * {} + {})", variable.arity(), state(variable)?);
    }
    // A trial counts where it has a state for every variable, as for whoever reads files.
    let fits = variables
        .iter()
        .map(|variable| Ok(format!("{} IS NOT NULL", state(variable)?)))
        .collect::<Result<Vec<_>, String>>()?
        .join(" AND ");
    Ok(format!(
        "SELECT cell, COUNT(*) AS trials FROM (SELECT CASE WHEN {fits} THEN CAST({cell} AS BIGINT) END AS cell FROM {}) GROUP BY cell",
        identifier(relation)
    ))
}

/// The number of the state of a variable; NULL where there is none.
fn state(variable: &Variable) -> Result<String, String> {
    let value = match &variable.from {
        None => identifier(&variable.name),
        Some(derivation) => value(derivation, &variable.name)?,
    };
    let cases: Vec<String> = match &variable.states {
        States::Categories(words) => {
            let numeric = words.iter().all(|word| word.parse::<f64>().is_ok_and(f64::is_finite));
            let case = |(state, word): (usize, &String)| {
                if numeric {
                    format!("WHEN CAST({value} AS DOUBLE) = {word} THEN {state}")
                } else {
                    format!("WHEN CAST({value} AS VARCHAR) = {} THEN {state}", text(word))
                }
            };
            words.iter().enumerate().map(case).collect()
        }
        States::Intervals(edges) => {
            let last = edges.len().saturating_sub(2);
            (0..=last)
                .map(|state| {
                    let below = if state == last { "<=" } else { "<" };
                    let (low, high) = (edges[state], edges[state + 1]);
                    format!("WHEN {value} >= {low:?} AND {value} {below} {high:?} THEN {state}")
                })
                .collect()
        }
        States::Series(_) => return Err(no_series(&variable.name)),
    };
    Ok(format!("CASE {} END", cases.join(" ")))
}

/// A quantity that is made of columns.
fn value(derivation: &Derivation, name: &str) -> Result<String, String> {
    let operation = match derivation {
        Derivation::Column(column) => return Ok(identifier(column)),
        Derivation::Of(operation) => &**operation,
    };
    match operation {
        Operation::Norm(parts) => {
            let squares: Vec<String> = parts
                .iter()
                .map(|part| value(part, name).map(|part| format!("{part} * {part}")))
                .collect::<Result<_, _>>()?;
            Ok(format!("SQRT({})", squares.join(" + ")))
        }
        Operation::Sum(parts) => {
            let parts: Vec<String> = parts
                .iter()
                .map(|(part, times)| value(part, name).map(|part| format!("{times:?} * {part}")))
                .collect::<Result<_, _>>()?;
            Ok(format!("({})", parts.join(" + ")))
        }
        Operation::GreatestMagnitude(parts) => {
            let parts: Vec<String> =
                parts.iter().map(|part| value(part, name)).collect::<Result<_, _>>()?;
            let known: Vec<String> =
                parts.iter().map(|part| format!("{part} IS NOT NULL")).collect();
            let magnitudes: Vec<String> = parts.iter().map(|part| format!("ABS({part})")).collect();
            Ok(format!(
                "CASE WHEN {} THEN GREATEST({}) END",
                known.join(" AND "),
                magnitudes.join(", ")
            ))
        }
        Operation::Threshold { of, at_least } => {
            let of = value(of, name)?;
            Ok(format!("CASE WHEN {of} >= {at_least:?} THEN 1 WHEN {of} < {at_least:?} THEN 0 END"))
        }
        Operation::Relative(_)
        | Operation::TotalVariation(_)
        | Operation::SumOfMagnitudes(_)
        | Operation::First(_) => Err(no_series(name)),
    }
}

fn no_series(name: &str) -> String {
    format!("`{name}` comes from a series, which cannot be counted in SQL")
}

fn identifier(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn text(word: &str) -> String {
    format!("'{}'", word.replace('\'', "''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_one_query() {
        let variables = [
            Variable::of_intervals("xOff", vec![-1.0, 0.0, 2.5]),
            Variable::of_words("colour", ["it's", "blue"]),
            Variable::of_words("onTop", ["0", "1"]),
        ];
        let query = count("trials", &variables[..2], &[VariableId(1), VariableId(0)]).unwrap();
        assert_eq!(
            query,
            "SELECT cell, COUNT(*) AS trials FROM (SELECT CASE WHEN \
             CASE WHEN \"xOff\" >= -1.0 AND \"xOff\" < 0.0 THEN 0 WHEN \"xOff\" >= 0.0 AND \"xOff\" <= 2.5 THEN 1 END IS NOT NULL AND \
             CASE WHEN CAST(\"colour\" AS VARCHAR) = 'it''s' THEN 0 WHEN CAST(\"colour\" AS VARCHAR) = 'blue' THEN 1 END IS NOT NULL \
             THEN CAST(((0 * 2 + CASE WHEN CAST(\"colour\" AS VARCHAR) = 'it''s' THEN 0 WHEN CAST(\"colour\" AS VARCHAR) = 'blue' THEN 1 END) \
             * 2 + CASE WHEN \"xOff\" >= -1.0 AND \"xOff\" < 0.0 THEN 0 WHEN \"xOff\" >= 0.0 AND \"xOff\" <= 2.5 THEN 1 END) AS BIGINT) END \
             AS cell FROM \"trials\") GROUP BY cell"
        );
        let query = count("trials", &variables[2..], &[VariableId(0)]).unwrap();
        assert!(query.contains("CAST(\"onTop\" AS DOUBLE) = 1 THEN 1"), "{query}");
    }

    #[test]
    fn what_comes_from_a_series_is_refused() {
        let from = serde_json::from_str(r#"{"total-variation": "way"}"#).unwrap();
        let moved =
            Variable { from: Some(from), ..Variable::of_intervals("moved", vec![0.0, 1.0]) };
        assert_eq!(
            count("trials", &[moved], &[VariableId(0)]).unwrap_err(),
            "`moved` comes from a series, which cannot be counted in SQL"
        );
    }
}
