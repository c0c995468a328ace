//! Trials go in; what kind of values each variable has comes out, after one reading.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use crate::derive::Value;
use crate::recipe::Declared;
use crate::source::fetch::{Fetch, Needed};
use crate::source::{Block, Cells, Fault, MISSING, Source, is_missing, number};
use crate::variable::MOST_STATES;

/// What is known of trials after one reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// How many rows there are.
    pub rows: u64,
    /// What is known of each variable, in their order.
    pub variables: Vec<Surveyed>,
}

/// What is known of a variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Surveyed {
    /// In how many rows its value is missing.
    pub missing: u64,
    /// Where it is missing first.
    pub first_missing: Option<(usize, u64)>,
    /// Its values.
    pub kind: Kind,
}

/// The values of a variable.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// No row has one.
    Nothing,
    /// Words, each with how many rows have it, in the order that categories have: numbers by size, then words by letter.
    Words(Vec<(String, u64)>),
    /// Numbers: the least and the greatest, and the different ones where they are few.
    Numbers {
        /// The least.
        least: f64,
        /// The greatest.
        greatest: f64,
        /// The different values, as they are written, where they could be categories.
        few: Option<Vec<(String, u64)>>,
    },
    /// Series of this many moments.
    Series(usize),
    /// More different words than a variable has states; some of them.
    TooManyWords(Vec<String>),
}

/// Reads all trials once.
pub fn survey(source: &dyn Source, declared: &[Declared]) -> Result<Survey, Fault> {
    let fetch =
        Fetch::new(source, declared.iter().map(|one| (one.name.as_str(), one.from.as_ref())))?;
    let gathered: Vec<Gathered> = (0..source.shards())
        .into_par_iter()
        .map(|shard| gather(source, shard, declared, &fetch))
        .collect::<Result<_, _>>()?;
    let mut all = Gathered::new(fetch.variables().len());
    for one in gathered {
        all.merge(one);
    }
    let variables = all.variables.into_iter().map(Values::surveyed).collect();
    Ok(Survey { rows: all.rows, variables })
}

/// What one shard says.
struct Gathered {
    rows: u64,
    variables: Vec<Values>,
}

/// The values of one variable so far.
#[derive(Default)]
struct Values {
    missing: u64,
    first_missing: Option<(usize, u64)>,
    /// The different words or numbers as they are written, while they are few.
    words: FxHashMap<Vec<u8>, u64>,
    many: bool,
    /// Whether some value is no number.
    wordy: bool,
    range: Option<(f64, f64)>,
    /// The moments of its series.
    length: Option<usize>,
}

fn gather(
    source: &dyn Source,
    shard: usize,
    declared: &[Declared],
    fetch: &Fetch,
) -> Result<Gathered, Fault> {
    let mut gathered = Gathered::new(fetch.variables().len());
    source.read(shard, fetch.columns(), &mut |block| {
        gathered.rows += block.rows.len() as u64;
        for ((values, needed), one) in
            gathered.variables.iter_mut().zip(fetch.variables()).zip(declared)
        {
            match needed {
                Needed::Column(column) => values.see(&block.columns[*column], block, shard),
                Needed::Series(_) | Needed::Derived(..) => {
                    for (row, &line) in block.rows.iter().enumerate() {
                        let value = needed.value(block, row).map_err(|what| {
                            Fault::new(source.place(shard, line), format!("`{}`: {what}", one.name))
                        })?;
                        values.take(&value, (shard, line));
                    }
                }
            }
        }
        Ok(())
    })?;
    Ok(gathered)
}

impl Values {
    /// Takes the cells of a column.
    fn see(&mut self, cells: &Cells, block: &Block, shard: usize) {
        match cells {
            Cells::Numbers(numbers) => {
                for (&number, &line) in numbers.iter().zip(&block.rows) {
                    self.take(&Value::Number(number), (shard, line));
                }
            }
            Cells::Text(texts) => {
                for (row, &line) in block.rows.iter().enumerate() {
                    let text = texts.get(row);
                    if is_missing(text) {
                        self.miss((shard, line));
                    } else {
                        self.word(text, 1);
                    }
                }
            }
            Cells::Words(words, codes) => {
                let mut counts = vec![0; words.len()];
                for (&code, &line) in codes.iter().zip(&block.rows) {
                    if code == MISSING {
                        self.miss((shard, line));
                    } else {
                        counts[code as usize] += 1;
                    }
                }
                for (word, &count) in words.iter().zip(&counts).filter(|&(_, &count)| count > 0) {
                    self.word(word.as_bytes(), count);
                }
            }
        }
    }

    fn take(&mut self, value: &Value, place: (usize, u64)) {
        match value {
            Value::Number(number) if number.is_nan() => self.miss(place),
            Value::Number(number) => {
                self.stretch(*number);
                if !self.many {
                    self.word(number.to_string().as_bytes(), 1);
                }
            }
            Value::Series(series) if series.iter().any(|value| value.is_nan()) => self.miss(place),
            Value::Series(series) => self.length = Some(series.len()),
        }
    }

    fn miss(&mut self, place: (usize, u64)) {
        self.missing += 1;
        self.first_missing = self.first_missing.map_or(Some(place), |first| Some(first.min(place)));
    }

    fn stretch(&mut self, value: f64) {
        let (least, greatest) = self.range.unwrap_or((value, value));
        self.range = Some((least.min(value), greatest.max(value)));
    }

    fn word(&mut self, text: &[u8], count: u64) {
        match number(text) {
            Some(value) => self.stretch(value),
            None => self.wordy = true,
        }
        if let Some(seen) = self.words.get_mut(text) {
            *seen += count;
        } else if self.words.len() < MOST_STATES {
            self.words.insert(text.to_vec(), count);
        } else {
            self.many = true;
        }
    }

    fn merge(&mut self, other: Self) {
        self.missing += other.missing;
        if let Some(place) = other.first_missing {
            self.first_missing =
                self.first_missing.map_or(Some(place), |first| Some(first.min(place)));
        }
        if let Some((least, greatest)) = other.range {
            self.stretch(least);
            self.stretch(greatest);
        }
        self.length = self.length.or(other.length);
        self.wordy |= other.wordy;
        self.many |= other.many;
        for (word, count) in other.words {
            self.word(&word, count);
        }
    }

    fn surveyed(self) -> Surveyed {
        let Self { missing, first_missing, words, many, wordy, range, length } = self;
        // `1` and `1.0` are one number, and would be two words.
        let mut counts: FxHashMap<String, u64> = FxHashMap::default();
        for (word, count) in words {
            let name = match number(&word) {
                Some(value) if !wordy => value.to_string(),
                _ => String::from_utf8_lossy(&word).into_owned(),
            };
            *counts.entry(name).or_default() += count;
        }
        let mut words: Vec<(String, u64)> = counts.into_iter().collect();
        words.sort_by(|(one, _), (other, _)| order(one, other));
        let kind = match (length, range) {
            (Some(length), _) => Kind::Series(length),
            _ if words.is_empty() => Kind::Nothing,
            (_, Some((least, greatest))) if !wordy => {
                Kind::Numbers { least, greatest, few: (!many).then_some(words) }
            }
            _ if many => {
                Kind::TooManyWords(words.into_iter().take(3).map(|(word, _)| word).collect())
            }
            _ => Kind::Words(words),
        };
        Surveyed { missing, first_missing, kind }
    }
}

/// The order of categories: numbers by size, then words by letter.
fn order(one: &str, other: &str) -> std::cmp::Ordering {
    let key = |word: &str| number(word.as_bytes()).unwrap_or(f64::INFINITY);
    key(one).total_cmp(&key(other)).then_with(|| one.cmp(other))
}

impl Gathered {
    fn new(variables: usize) -> Self {
        Self { rows: 0, variables: (0..variables).map(|_| Values::default()).collect() }
    }

    fn merge(&mut self, other: Self) {
        self.rows += other.rows;
        for (mine, theirs) in self.variables.iter_mut().zip(other.variables) {
            mine.merge(theirs);
        }
    }
}
