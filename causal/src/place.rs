//! Blocks of cells and variables go in; states come out, or what keeps a value from being one.

use crate::derive::Value;
use crate::source::fetch::{Fetch, Needed};
use crate::source::{Block, Cells, Fault, MISSING, Source, is_missing, number};
use crate::variable::{State, States, Variable};

/// What becomes of a trial that has no state for some variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unfit {
    /// It is an error.
    #[default]
    Refuse,
    /// The trial is left out, and counted.
    Drop,
}

/// What becomes of trials that do not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Policy {
    /// Where a value is missing.
    pub missing: Unfit,
    /// Where a value lies outside every interval, or is a word that is no state.
    pub outside: Unfit,
}

/// Puts values into the states of variables.
pub struct Placer<'a> {
    source: &'a dyn Source,
    variables: &'a [Variable],
    fetch: Fetch,
    policy: Policy,
}

/// The states of some rows, column by column.
#[derive(Debug, Default)]
pub struct Placed {
    /// The states of each variable.
    pub columns: Vec<Vec<State>>,
    /// The rows of the block that they belong to, where some were left out.
    pub kept: Option<Vec<u32>>,
    /// How many trials were left out.
    pub dropped: u64,
}

/// Why a value is no state.
enum Misfit {
    Missing,
    Outside(String),
}

impl<'a> Placer<'a> {
    /// Finds what each variable comes from in a source.
    pub fn new(
        source: &'a dyn Source,
        variables: &'a [Variable],
        policy: Policy,
    ) -> Result<Self, Fault> {
        let fetch =
            Fetch::new(source, variables.iter().map(|one| (one.name.as_str(), one.from.as_ref())))?;
        for (variable, needed) in variables.iter().zip(fetch.variables()) {
            let series = matches!(needed, Needed::Series(_));
            if series != matches!(variable.states, States::Series(_))
                && !matches!(needed, Needed::Derived(..))
            {
                let (is, has) =
                    if series { ("a series", "no series") } else { ("one value", "a series") };
                let what = format!("`{}` is {is} here, and {has} in the model", variable.name);
                return Err(Fault::new("the trials", what));
            }
        }
        Ok(Self { source, variables, fetch, policy })
    }

    /// The columns to read.
    pub fn columns(&self) -> &[usize] {
        self.fetch.columns()
    }

    /// The states of the rows of a block.
    pub fn place(&self, shard: usize, block: &Block) -> Result<Placed, Fault> {
        let rows = block.rows.len();
        let mut columns = Vec::with_capacity(self.variables.len());
        let mut left_out: Vec<bool> = Vec::new();
        // Of several rows that do not fit, the first is told.
        let mut refused: Option<(usize, Fault)> = None;
        for (variable, needed) in self.variables.iter().zip(self.fetch.variables()) {
            let mut column = Vec::with_capacity(rows);
            let mut states = StateFinder::new(variable, needed, block);
            for row in 0..rows {
                match states.find(row) {
                    Ok(state) => column.push(state),
                    Err(misfit) => {
                        if refused.as_ref().is_some_and(|&(first, _)| first <= row) {
                            break;
                        }
                        if let Err(fault) = self.judge(variable, &misfit, shard, block.rows[row]) {
                            refused = Some((row, fault));
                            break;
                        }
                        if left_out.is_empty() {
                            left_out = vec![false; rows];
                        }
                        left_out[row] = true;
                        column.push(0);
                    }
                }
            }
            columns.push(column);
        }
        if let Some((_, fault)) = refused {
            return Err(fault);
        }
        if left_out.is_empty() {
            return Ok(Placed { columns, kept: None, dropped: 0 });
        }
        let kept: Vec<u32> = (0..rows as u32).filter(|&row| !left_out[row as usize]).collect();
        for column in &mut columns {
            *column = kept.iter().map(|&row| column[row as usize]).collect();
        }
        Ok(Placed { columns, dropped: (rows - kept.len()) as u64, kept: Some(kept) })
    }

    /// Whether a trial without a state may be left out.
    fn judge(
        &self,
        variable: &Variable,
        misfit: &Misfit,
        shard: usize,
        row: u64,
    ) -> Result<(), Fault> {
        let name = &variable.name;
        let (unfit, what) = match misfit {
            Misfit::Missing => (self.policy.missing, format!("`{name}` is missing")),
            Misfit::Outside(value) => (self.policy.outside, outside(variable, value)),
        };
        match unfit {
            Unfit::Refuse => Err(Fault::new(self.source.place(shard, row), what)),
            Unfit::Drop => Ok(()),
        }
    }
}

/// What to say of a value that is no state.
fn outside(variable: &Variable, value: &str) -> String {
    let name = &variable.name;
    match &variable.states {
        States::Intervals(edges) if number(value.as_bytes()).is_some() => format!(
            "`{name}` is {value}, outside every interval of the model; they reach from {} to {}",
            edges[0],
            edges[edges.len() - 1]
        ),
        States::Intervals(_) => format!("`{name}` is `{value}`, which is no number"),
        States::Series(_) => format!("`{name}`: {value}"),
        States::Categories(words) => {
            let help = lang::did_you_mean(value, words.iter().map(String::as_str));
            format!("`{name}` is `{value}`, which is no state of it{help}")
        }
    }
}

/// Finds the states of one variable in a block.
enum StateFinder<'a> {
    /// A column of words: the state of each word.
    Words(&'a [u32], Vec<Result<State, &'a str>>),
    /// A column of numbers.
    Numbers(&'a Variable, &'a [f64]),
    /// Anything else.
    Other(&'a Variable, &'a Needed, &'a Block),
}

impl<'a> StateFinder<'a> {
    fn new(variable: &'a Variable, needed: &'a Needed, block: &'a Block) -> Self {
        if let Needed::Column(column) = needed {
            match &block.columns[*column] {
                Cells::Words(words, codes) => {
                    let state = |word: &'a String| {
                        state_of_text(variable, word.as_bytes()).ok_or(word.as_str())
                    };
                    return Self::Words(codes, words.iter().map(state).collect());
                }
                Cells::Numbers(numbers) => return Self::Numbers(variable, numbers),
                Cells::Text(_) => {}
            }
        }
        Self::Other(variable, needed, block)
    }

    fn find(&mut self, row: usize) -> Result<State, Misfit> {
        match self {
            Self::Words(codes, states) => match codes[row] {
                MISSING => Err(Misfit::Missing),
                code => states[code as usize].map_err(|word| Misfit::Outside(word.to_owned())),
            },
            Self::Numbers(variable, numbers) => state_of_number(variable, numbers[row]),
            Self::Other(variable, needed, block) => {
                if let (Needed::Column(column), States::Categories(_)) =
                    (&**needed, &variable.states)
                    && let Cells::Text(texts) = &block.columns[*column]
                {
                    let text = texts.get(row);
                    if is_missing(text) {
                        return Err(Misfit::Missing);
                    }
                    return state_of_text(variable, text).ok_or_else(|| {
                        Misfit::Outside(String::from_utf8_lossy(text).into_owned())
                    });
                }
                match needed.value(block, row).map_err(Misfit::Outside)? {
                    Value::Number(value) => state_of_number(variable, value),
                    Value::Series(series) if series.iter().any(|value| value.is_nan()) => {
                        Err(Misfit::Missing)
                    }
                    Value::Series(series) => variable.state_of_series(&series).ok_or_else(|| {
                        Misfit::Outside(format!(
                            "a series of {} moments, and the model has another length",
                            series.len()
                        ))
                    }),
                }
            }
        }
    }
}

fn state_of_number(variable: &Variable, value: f64) -> Result<State, Misfit> {
    if value.is_nan() {
        return Err(Misfit::Missing);
    }
    variable.state_of_number(value).ok_or_else(|| Misfit::Outside(value.to_string()))
}

/// The state of a text: a word, or a number.
fn state_of_text(variable: &Variable, text: &[u8]) -> Option<State> {
    match &variable.states {
        States::Categories(words) => words
            .iter()
            .position(|word| word.as_bytes() == text)
            .map(|at| at as State)
            .or_else(|| variable.state_of_number(number(text)?)),
        _ => variable.state_of_number(number(text)?),
    }
}
