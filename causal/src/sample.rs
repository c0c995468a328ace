//! Trials go in; the values of a few of them come out, the same ones however many threads read: those whose numbers hash lowest.

use std::ops::Range;

use rayon::prelude::*;

use crate::derive::Value;
use crate::recipe::Declared;
use crate::source::fetch::Fetch;
use crate::source::{Fault, Source};

/// As many trials as intervals are cut from.
pub const MOST: usize = 50_000;

/// The values of some trials, those of which no value is missing.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    places: Vec<Range<usize>>,
    rows: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq)]
struct Row {
    hash: u64,
    values: Vec<f64>,
}

impl Sample {
    /// Draws at most `most` trials: the values of these variables, each a number or a series.
    pub fn draw(source: &dyn Source, declared: &[&Declared], most: usize) -> Result<Self, Fault> {
        let fetch =
            Fetch::new(source, declared.iter().map(|one| (one.name.as_str(), one.from.as_ref())))?;
        let shards: Vec<(Vec<Range<usize>>, Vec<Row>)> = (0..source.shards())
            .into_par_iter()
            .map(|shard| draw(source, shard, declared, &fetch, most))
            .collect::<Result<_, _>>()?;
        let mut sample = Self { places: Vec::new(), rows: Vec::new() };
        for (places, rows) in shards {
            if !rows.is_empty() {
                sample.places = places;
            }
            sample.rows.extend(rows);
        }
        keep_lowest(&mut sample.rows, most);
        sample.rows.sort_by(|one, other| {
            one.hash.cmp(&other.hash).then_with(|| compare(&one.values, &other.values))
        });
        Ok(sample)
    }

    /// How many trials there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The values of a variable that is a number.
    pub fn numbers(&self, variable: usize) -> Vec<f64> {
        let Some(place) = self.places.get(variable) else { return Vec::new() };
        self.rows.iter().map(|row| row.values[place.start]).collect()
    }

    /// The values of a variable that is a series.
    pub fn series(&self, variable: usize) -> Vec<&[f64]> {
        let Some(place) = self.places.get(variable) else { return Vec::new() };
        self.rows.iter().map(|row| &row.values[place.clone()]).collect()
    }
}

/// A number for a row that looks drawn by chance.
fn hash(shard: usize, row: u64) -> u64 {
    fastrand::Rng::with_seed((shard as u64) << 40 ^ row).u64(..)
}

/// A share of the rows of a source.
#[derive(Debug, Clone, Copy)]
pub struct Share {
    highest: u64,
}

impl Share {
    /// The share that holds about `most` of `rows` rows.
    pub fn of(rows: u64, most: usize) -> Self {
        let part = most as f64 / rows.max(1) as f64;
        Self { highest: if part >= 1.0 { u64::MAX } else { (part * u64::MAX as f64) as u64 } }
    }

    /// Whether a row is in it.
    pub fn holds(self, shard: usize, row: u64) -> bool {
        hash(shard, row) <= self.highest
    }
}

/// The order of series of one length, value by value.
pub(crate) fn compare(one: &[f64], other: &[f64]) -> std::cmp::Ordering {
    let by_value = one.iter().zip(other).map(|(a, b)| a.total_cmp(b));
    by_value.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
}

fn draw(
    source: &dyn Source,
    shard: usize,
    declared: &[&Declared],
    fetch: &Fetch,
    most: usize,
) -> Result<(Vec<Range<usize>>, Vec<Row>), Fault> {
    let mut places: Vec<Range<usize>> = Vec::new();
    let mut rows: Vec<Row> = Vec::new();
    let mut highest = u64::MAX;
    source.read(shard, fetch.columns(), &mut |block| {
        for (at, &line) in block.rows.iter().enumerate() {
            let hash = hash(shard, line);
            if hash > highest {
                continue;
            }
            let mut values = Vec::new();
            let mut laid: Vec<Range<usize>> = Vec::with_capacity(declared.len());
            for (needed, one) in fetch.variables().iter().zip(declared) {
                let start = values.len();
                let value = needed.value(block, at).map_err(|what| {
                    Fault::new(source.place(shard, line), format!("`{}`: {what}", one.name))
                })?;
                match value {
                    Value::Number(number) => values.push(number),
                    Value::Series(series) => values.extend(series),
                }
                laid.push(start..values.len());
            }
            if values.iter().all(|value| !value.is_nan()) {
                places = laid;
                rows.push(Row { hash, values });
            }
        }
        if rows.len() > 2 * most {
            highest = keep_lowest(&mut rows, most);
        }
        Ok(())
    })?;
    keep_lowest(&mut rows, most);
    Ok((places, rows))
}

/// Keeps those with the lowest hashes, and says which is the highest of them.
fn keep_lowest(rows: &mut Vec<Row>, most: usize) -> u64 {
    if rows.len() <= most || most == 0 {
        return u64::MAX;
    }
    let (_, last, _) = rows.select_nth_unstable_by_key(most - 1, |row| row.hash);
    let highest = last.hash;
    rows.truncate(most);
    highest
}
