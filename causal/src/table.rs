//! Columns of states go in; a table that learners count in comes out.

use thiserror::Error;

use crate::variable::{MOST_STATES, State, Variable, VariableId, named};

/// Trials as states: one column for each variable, one row for each trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    variables: Vec<Variable>,
    columns: Vec<Vec<State>>,
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
        Ok(Self { variables, columns })
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
        named(&self.variables, name)
    }

    /// The states of a variable, row by row.
    pub fn column(&self, id: VariableId) -> &[State] {
        &self.columns[id.index()]
    }

    /// How many trials there are.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Whether there is no trial.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The rows with these numbers, in this order.
    #[must_use]
    pub fn select(&self, rows: &[u32]) -> Self {
        let pick = |column: &Vec<State>| rows.iter().map(|&row| column[row as usize]).collect();
        let columns = self.columns.iter().map(pick).collect();
        Self { variables: self.variables.clone(), columns }
    }

    /// The columns of these variables, in this order.
    #[must_use]
    pub fn project(&self, ids: &[VariableId]) -> Self {
        Self {
            variables: ids.iter().map(|id| self.variable(*id).clone()).collect(),
            columns: ids.iter().map(|id| self.column(*id).to_vec()).collect(),
        }
    }
}
