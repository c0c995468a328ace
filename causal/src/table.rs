//! Columns of states go in; a table that learners count in comes out.

use thiserror::Error;

use crate::variable::{MOST_STATES, State, Variable, VariableId};

/// Trials as states: one column for each variable, one row for each trial.
///
/// A row may stand for several equal trials; then it has a weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    variables: Vec<Variable>,
    columns: Vec<Vec<State>>,
    weights: Option<Vec<u32>>,
    rows: u64,
}

/// Why columns make no table.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TableError {
    /// Two variables with one name.
    #[error("there are two variables `{0}`")]
    SameName(String),
    /// A variable without a state, or with more than fit.
    #[error("`{name}` has {arity} states; it can have 1 to {MOST_STATES}")]
    Arity {
        /// The variable.
        name: String,
        /// How many states it has.
        arity: usize,
    },
    /// Columns of different lengths.
    #[error("`{name}` has {rows} rows, the first column has {first}")]
    Length {
        /// The variable.
        name: String,
        /// Its rows.
        rows: usize,
        /// The rows of the first column.
        first: usize,
    },
    /// A state that the variable does not have.
    #[error("row {row} of `{name}` is state {state}, and there are {arity}")]
    State {
        /// The variable.
        name: String,
        /// The row, from 0.
        row: usize,
        /// What it holds.
        state: State,
        /// How many states there are.
        arity: usize,
    },
}

impl Table {
    /// Checks columns of states, each with its variable, and keeps them in the given order.
    pub fn new(variables: Vec<Variable>, columns: Vec<Vec<State>>) -> Result<Self, TableError> {
        assert_eq!(variables.len(), columns.len(), "each variable has its column");
        let first = columns.first().map_or(0, Vec::len);
        for (at, (variable, column)) in variables.iter().zip(&columns).enumerate() {
            let name = || variable.name.clone();
            if variables[..at].iter().any(|before| before.name == variable.name) {
                return Err(TableError::SameName(name()));
            }
            let arity = variable.arity();
            if !(1..=MOST_STATES).contains(&arity) {
                return Err(TableError::Arity { name: name(), arity });
            }
            if column.len() != first {
                return Err(TableError::Length { name: name(), rows: column.len(), first });
            }
            if let Some(row) = column.iter().position(|&state| usize::from(state) >= arity) {
                return Err(TableError::State { name: name(), row, state: column[row], arity });
            }
        }
        Ok(Self { variables, columns, weights: None, rows: first as u64 })
    }

    /// The same, where each row stands for as many trials as its weight says.
    ///
    /// # Panics
    /// If there is not one weight for each row.
    pub fn weighted(
        variables: Vec<Variable>,
        columns: Vec<Vec<State>>,
        weights: Vec<u32>,
    ) -> Result<Self, TableError> {
        let mut table = Self::new(variables, columns)?;
        assert_eq!(table.len(), weights.len(), "each row has its weight");
        table.rows = weights.iter().map(|&weight| u64::from(weight)).sum();
        table.weights = Some(weights);
        Ok(table)
    }

    /// The variables, in the order of the columns.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// One of them.
    pub fn variable(&self, id: VariableId) -> &Variable {
        &self.variables[id.index()]
    }

    /// The numbers of all variables.
    pub fn ids(&self) -> impl Iterator<Item = VariableId> + use<> {
        (0..self.variables.len() as u16).map(VariableId)
    }

    /// The variable of a name.
    pub fn named(&self, name: &str) -> Option<VariableId> {
        self.variables.iter().position(|one| one.name == name).map(|at| VariableId(at as u16))
    }

    /// The states of a variable, row by row.
    pub fn column(&self, id: VariableId) -> &[State] {
        &self.columns[id.index()]
    }

    /// How many trials each row stands for; none where each stands for one.
    pub fn weights(&self) -> Option<&[u32]> {
        self.weights.as_deref()
    }

    /// How many rows there are, equal trials taken together where they have weights.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many trials there are.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The rows with these numbers, in this order.
    #[must_use]
    pub fn select(&self, rows: &[u32]) -> Self {
        let pick = |column: &Vec<State>| rows.iter().map(|&row| column[row as usize]).collect();
        let columns = self.columns.iter().map(pick).collect();
        let weights: Option<Vec<u32>> = self
            .weights
            .as_ref()
            .map(|weights| rows.iter().map(|&row| weights[row as usize]).collect());
        let total = weights.as_ref().map_or(rows.len() as u64, |weights| {
            weights.iter().map(|&weight| u64::from(weight)).sum()
        });
        Self { variables: self.variables.clone(), columns, weights, rows: total }
    }

    /// The columns of these variables, in this order.
    #[must_use]
    pub fn project(&self, ids: &[VariableId]) -> Self {
        Self {
            variables: ids.iter().map(|id| self.variable(*id).clone()).collect(),
            columns: ids.iter().map(|id| self.column(*id).to_vec()).collect(),
            weights: self.weights.clone(),
            rows: self.rows,
        }
    }
}
