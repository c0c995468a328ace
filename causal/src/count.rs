//! Sets of variables go in; how often their states go together comes out, whoever does the counting.
//!
//! Counting is all that learning asks of data (equation 2.5): a table in memory counts, and so does whatever reads trials that no
//! memory holds.

use rayon::prelude::*;
use thiserror::Error;

use crate::table::Table;
use crate::variable::{State, Variable, VariableId};

/// How many trials fall into each combination of the states of some variables. The last variable runs fastest: for `[a, b]` the cell
/// of states `i`, `j` is `i * arity(b) + j`.
pub type Counts = Vec<u64>;

/// As many cells as one table of counts may have.
pub const MOST_CELLS: usize = 1 << 26;

/// Why counting failed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CountError {
    /// More combinations of states than can be counted.
    #[error(
        "{variables} have {cells} combinations of states together, more than the {MOST_CELLS} that can be counted"
    )]
    TooManyCells {
        /// Their names.
        variables: String,
        /// How many combinations there are.
        cells: u128,
    },
    /// The trials could not be read.
    #[error("{0}")]
    Source(String),
}

/// Whoever counts trials.
pub trait Counter: Sync {
    /// The variables that there are.
    fn variables(&self) -> &[Variable];

    /// How many trials there are.
    fn rows(&self) -> u64;

    /// Counts the states of each of these sets of variables. Many are asked at once, since a source that reads files reads them once
    /// for all.
    fn count(&self, sets: &[Vec<VariableId>]) -> Result<Vec<Counts>, CountError>;
}

/// How many cells the counts of some variables have.
pub fn cells(variables: &[Variable], set: &[VariableId]) -> Result<usize, CountError> {
    let product = set
        .iter()
        .map(|id| variables[id.index()].arity() as u128)
        .fold(1_u128, u128::saturating_mul);
    if product <= MOST_CELLS as u128 {
        return Ok(product as usize);
    }
    let names: Vec<&str> = set.iter().map(|id| variables[id.index()].name.as_str()).collect();
    Err(CountError::TooManyCells { variables: names.join(", "), cells: product })
}

impl Counter for Table {
    fn variables(&self) -> &[Variable] {
        self.variables()
    }

    fn rows(&self) -> u64 {
        self.len() as u64
    }

    fn count(&self, sets: &[Vec<VariableId>]) -> Result<Vec<Counts>, CountError> {
        // A few are counted faster than threads are woken.
        if sets.len() < 16 || rayon::current_num_threads() == 1 {
            return sets.iter().map(|set| count(self, set)).collect();
        }
        sets.par_iter().map(|set| count(self, set)).collect()
    }
}

/// Counts one set of variables of a table.
fn count(table: &Table, set: &[VariableId]) -> Result<Counts, CountError> {
    let mut counts = vec![0; cells(table.variables(), set)?];
    let columns: Vec<(&[State], usize)> =
        set.iter().map(|&id| (table.column(id), table.variable(id).arity())).collect();
    tally(&columns, table.len(), &mut counts);
    Ok(counts)
}

/// As many cells as are counted side by side in the nearest cache.
const NEAR: usize = 1 << 10;

/// As many rows as are counted at a time, so that what is known of them stays in the nearest cache.
const FEW: usize = 1 << 10;

/// Adds `rows` rows of columns, each with the arity of its variable, to counts.
pub(crate) fn tally(columns: &[(&[State], usize)], rows: usize, counts: &mut [u64]) {
    if counts.len() <= NEAR {
        return tally_near(columns, rows, counts);
    }
    let mut cells = [0_u32; FEW];
    for start in (0..rows).step_by(FEW) {
        let cells = &mut cells[..FEW.min(rows - start)];
        cells.fill(0);
        for &(column, arity) in columns {
            for (cell, &state) in cells.iter_mut().zip(&column[start..]) {
                *cell = *cell * arity as u32 + u32::from(state);
            }
        }
        for &cell in cells.iter() {
            counts[cell as usize] += 1;
        }
    }
}

/// The same for few cells: four counts of each, so that a row need not wait for the one before it, which often has the same cell.
/// Sixteen bits are enough for the number of a cell, and twice as many of them are made at once.
fn tally_near(columns: &[(&[State], usize)], rows: usize, counts: &mut [u64]) {
    let size = counts.len();
    let mut tables = [[0_u32; NEAR]; 4];
    let mut cells = [0_u16; FEW];
    for start in (0..rows).step_by(FEW) {
        let cells = &mut cells[..FEW.min(rows - start)];
        cells.fill(0);
        for &(column, arity) in columns {
            let arity = arity as u16;
            for (cell, &state) in cells.iter_mut().zip(&column[start..]) {
                *cell = cell.wrapping_mul(arity).wrapping_add(u16::from(state));
            }
        }
        let mut fours = cells.chunks_exact(4);
        let [first, second, third, fourth] = &mut tables;
        for four in &mut fours {
            first[usize::from(four[0]) % NEAR] += 1;
            second[usize::from(four[1]) % NEAR] += 1;
            third[usize::from(four[2]) % NEAR] += 1;
            fourth[usize::from(four[3]) % NEAR] += 1;
        }
        for &cell in fours.remainder() {
            first[usize::from(cell) % NEAR] += 1;
        }
    }
    for table in &tables {
        for (count, &more) in counts.iter_mut().zip(&table[..size]) {
            *count += u64::from(more);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_variable_runs_fastest() {
        let variables =
            vec![Variable::of_words("a", ["x", "y"]), Variable::of_words("b", ["r", "s", "t"])];
        let table = Table::new(variables, vec![vec![0, 1, 1, 1], vec![2, 0, 0, 2]]).unwrap();
        let sets = [vec![VariableId(0), VariableId(1)], vec![VariableId(1)], vec![]];
        let counts = table.count(&sets).unwrap();
        assert_eq!(counts, [vec![0, 0, 1, 2, 0, 1], vec![2, 0, 2], vec![4]]);
    }
}
