//! What a variable comes from goes in; where it lies in the columns of a source comes out, and its value in each row.

use super::{Block, Cells, Fault, MISSING, Source, is_missing, number};
use crate::derive::{Derivation, Value};

/// The columns of a source that some variables need, and how their values come from them.
#[derive(Debug, Clone)]
pub struct Fetch {
    columns: Vec<usize>,
    variables: Vec<Needed>,
}

/// Where the value of a variable lies.
#[derive(Debug, Clone)]
pub enum Needed {
    /// In one of the fetched columns.
    Column(usize),
    /// In several, moment by moment.
    Series(Vec<usize>),
    /// In what a derivation makes of these named columns and series.
    Derived(Derivation, Vec<(String, Needed)>),
}

/// The columns of a source as a person sees them: a series is one, though it has a column for each moment.
pub fn names(source: &dyn Source) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for column in source.columns() {
        let name = moment(column).map_or(column.as_str(), |(base, _)| base);
        if !names.iter().any(|one| one == name) {
            names.push(name.to_owned());
        }
    }
    names
}

/// The series and the moment of a column `dist[3]`.
pub fn moment(column: &str) -> Option<(&str, usize)> {
    let (base, rest) = column.strip_suffix(']')?.rsplit_once('[')?;
    Some((base, rest.parse().ok()?)).filter(|(base, _)| !base.is_empty())
}

impl Fetch {
    /// Finds what each variable comes from: its derivation, or the column or series of its own name.
    pub fn new<'a>(
        source: &dyn Source,
        variables: impl IntoIterator<Item = (&'a str, Option<&'a Derivation>)>,
    ) -> Result<Self, Fault> {
        let mut this = Self { columns: Vec::new(), variables: Vec::new() };
        for (name, from) in variables {
            let needed = match from {
                None => this.column(source, name, name)?,
                Some(Derivation::Column(column)) => this.column(source, column, name)?,
                Some(derivation) => {
                    let parts: Vec<(String, Needed)> = derivation
                        .columns()
                        .into_iter()
                        .map(|column| Ok((column.to_owned(), this.column(source, column, name)?)))
                        .collect::<Result<_, Fault>>()?;
                    Needed::Derived(derivation.clone(), parts)
                }
            };
            this.variables.push(needed);
        }
        Ok(this)
    }

    /// The columns to read, as numbers among those of the source.
    pub fn columns(&self) -> &[usize] {
        &self.columns
    }

    /// Where the values of the variables lie, in the order of the variables.
    pub fn variables(&self) -> &[Needed] {
        &self.variables
    }

    fn column(
        &mut self,
        source: &dyn Source,
        column: &str,
        variable: &str,
    ) -> Result<Needed, Fault> {
        let all = source.columns();
        if let Some(at) = all.iter().position(|one| one == column) {
            return Ok(Needed::Column(self.slot(at)));
        }
        let mut moments: Vec<(usize, usize)> = all
            .iter()
            .enumerate()
            .filter_map(|(at, one)| {
                moment(one).filter(|(base, _)| *base == column).map(|(_, moment)| (moment, at))
            })
            .collect();
        moments.sort_unstable();
        if moments.is_empty() {
            let names = names(source);
            let help = lang::did_you_mean(column, names.iter().map(String::as_str));
            let whose =
                if column == variable { String::new() } else { format!(" of `{variable}`") };
            return Err(Fault::new(
                "the trials",
                format!("there is no column `{column}`{whose}{help}"),
            ));
        }
        if let Some(gap) = moments.iter().enumerate().find(|(at, (moment, _))| at != moment) {
            return Err(Fault::new(
                "the trials",
                format!("there is no column `{column}[{}]`", gap.0),
            ));
        }
        Ok(Needed::Series(moments.into_iter().map(|(_, at)| self.slot(at)).collect()))
    }

    /// The place of a column among those that are read.
    fn slot(&mut self, column: usize) -> usize {
        self.columns.iter().position(|&one| one == column).unwrap_or_else(|| {
            self.columns.push(column);
            self.columns.len() - 1
        })
    }
}

impl Needed {
    /// The value in a row; a missing one is NaN. A text that is no number is an error: that text.
    pub fn value(&self, block: &Block, row: usize) -> Result<Value, String> {
        match self {
            Self::Column(column) => Ok(Value::Number(number_at(&block.columns[*column], row)?)),
            Self::Series(columns) => columns
                .iter()
                .map(|&column| number_at(&block.columns[column], row))
                .collect::<Result<_, _>>()
                .map(Value::Series),
            Self::Derived(derivation, parts) => {
                let mut values: Vec<(&str, Value)> = Vec::with_capacity(parts.len());
                for (name, part) in parts {
                    values.push((name, part.value(block, row)?));
                }
                derivation
                    .value(&mut |name| {
                        let value = values.iter().find(|(one, _)| *one == name);
                        value.expect("all columns of a derivation are fetched").1.clone()
                    })
                    .map_err(|error| error.to_string())
            }
        }
    }
}

/// The number in a row of a column; NaN where it is missing.
fn number_at(cells: &Cells, row: usize) -> Result<f64, String> {
    let text = match cells {
        Cells::Numbers(numbers) => return Ok(numbers[row]),
        Cells::Text(texts) => texts.get(row),
        Cells::Words(words, codes) => match codes[row] {
            MISSING => return Ok(f64::NAN),
            code => words[code as usize].as_bytes(),
        },
    };
    if is_missing(text) {
        return Ok(f64::NAN);
    }
    number(text).ok_or_else(|| format!("`{}` is no number", String::from_utf8_lossy(text)))
}
