//! Files of trials go in; blocks of their cells come out, shard by shard, however many there are.
//!
//! A shard is what one thread reads from its beginning to its end: a CSV file, or a row group of a Parquet file.

pub mod csv;
pub mod parquet;
pub mod fetch;
pub mod write;

use thiserror::Error;

/// Trials that are read in blocks.
pub trait Source: Sync {
    /// The names of the columns.
    fn columns(&self) -> &[String];

    /// How many shards there are.
    fn shards(&self) -> usize;

    /// Where a row of a shard lies, for a person: `trials.csv, line 7`.
    fn place(&self, shard: usize, row: u64) -> String;

    /// Reads the given columns of a shard, and hands block after block to `each`.
    fn read(
        &self,
        shard: usize,
        columns: &[usize],
        each: &mut dyn FnMut(&Block) -> Result<(), Fault>,
    ) -> Result<(), Fault>;
}

/// As many rows as a block holds at most.
pub const BLOCK: usize = 1 << 13;

/// Some rows of a shard.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// The number of each row, as [`Source::place`] takes it.
    pub rows: Vec<u64>,
    /// The cells of the columns that were asked for, in that order.
    pub columns: Vec<Cells>,
}

/// The cells of one column in a block.
#[derive(Debug, Clone)]
pub enum Cells {
    /// As they are written.
    Text(Texts),
    /// Numbers; NaN where one is missing.
    Numbers(Vec<f64>),
    /// Words, each once, and the number of the word in each row; [`MISSING`] where there is none.
    Words(Vec<String>, Vec<u32>),
}

/// The number of no word.
pub const MISSING: u32 = u32::MAX;

/// Texts one after another.
#[derive(Debug, Clone, Default)]
pub struct Texts {
    bytes: Vec<u8>,
    ends: Vec<u32>,
}

impl Texts {
    /// Adds one, without the white space around it.
    pub fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text.trim_ascii());
        self.ends.push(self.bytes.len() as u32);
    }

    /// One of them.
    pub fn get(&self, at: usize) -> &[u8] {
        let start = if at == 0 { 0 } else { self.ends[at - 1] as usize };
        &self.bytes[start..self.ends[at] as usize]
    }
}

/// Whether a text says that a value is missing: nothing, `NA`, `NaN`, `null` or `?`.
pub fn is_missing(text: &[u8]) -> bool {
    matches!(text, b"" | b"?" | b"NA" | b"N/A" | b"na" | b"NaN" | b"nan" | b"null" | b"NULL")
}

/// The finite number that a text is.
pub fn number(text: &[u8]) -> Option<f64> {
    let value: f64 = std::str::from_utf8(text).ok()?.parse().ok()?;
    value.is_finite().then_some(value)
}

/// Why trials cannot be read or used, and where.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{place}: {what}")]
pub struct Fault {
    /// The file, and the line or row where it matters.
    pub place: String,
    /// What is wrong there.
    pub what: String,
}

impl Fault {
    /// A fault at a place.
    pub fn new(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self { place: place.into(), what: what.into() }
    }
}
