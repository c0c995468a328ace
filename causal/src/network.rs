//! A graph and a table of probabilities for each of its variables go in; a causal Bayesian network comes out (thesis §2.1, equations
//! 2.1 and 2.2).

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::graph::{Cycle, Dag};
use crate::knowledge::Knowledge;
use crate::variable::{State, Variable, VariableId, named, unknown};

/// How far a row of probabilities may be from one in sum: files round them.
pub const ROUNDING: f64 = 1e-5;

/// A causal Bayesian network.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    variables: Vec<Variable>,
    graph: Dag,
    tables: Vec<Conditional>,
    /// What success is, where the network is about it.
    pub goal: Option<Goal>,
    /// Where it comes from.
    pub about: About,
}

/// The probabilities of a variable's states in each combination of its parents' states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Conditional {
    /// Row after row: a row for each combination of the states of the parents, which are in rising order and the last of which runs
    /// fastest; in it a probability for each state. Rows that are unknown hold zeros.
    pub probabilities: Vec<f64>,
    /// How many trials have each state in each row, laid out like the probabilities, where that is known.
    pub counts: Option<Vec<u64>>,
    /// The rows of which nothing is known, in rising order.
    pub unknown: Vec<u32>,
}

/// A variable and the state in which a trial succeeded.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The name of the variable.
    pub variable: String,
    /// What the state is called.
    pub state: String,
}

/// Where a network comes from.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default, deny_unknown_fields)]
pub struct About {
    /// The files of trials.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// How many trials there were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trials: Option<u64>,
    /// How the graph was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// What the graph scores.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub score: Option<f64>,
    /// What was known before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub knowledge: Option<Knowledge>,
    /// How the probabilities were found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimate: Option<String>,
    /// Arcs of which neither data nor knowledge tell the direction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub undirected: Vec<(String, String)>,
    /// How often arcs were found in resampled trials.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub strengths: Vec<Strength>,
    /// What came from another network.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transfer: Option<crate::transfer::Provenance>,
    /// What a person should know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// How often an arc was found in resampled trials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Strength {
    /// The cause.
    pub from: String,
    /// The effect.
    pub to: String,
    /// In which share of the samples the two were joined.
    pub joined: f64,
    /// In which share they were joined in this direction; where a sample left it open, half.
    pub directed: f64,
}

/// Why tables make no network.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NetworkError {
    /// Two variables with one name.
    #[error("there are two variables `{0}`")]
    SameName(String),
    /// A variable without states or with too many.
    #[error("`{0}` has {1} states; it can have 1 to 256")]
    Arity(String, usize),
    /// Arcs that come round.
    #[error("the arcs make a cycle: {0}")]
    Cycle(String),
    /// A table of another size.
    #[error(
        "the table of `{variable}` has {found} probabilities; with its parents there are {expected}"
    )]
    Size {
        /// The variable.
        variable: String,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A row that is none of probabilities.
    #[error("row {row} of the table of `{variable}` {what}")]
    Row {
        /// The variable.
        variable: String,
        /// The row, from 1.
        row: usize,
        /// What is wrong.
        what: String,
    },
    /// A goal that there is not.
    #[error("{0}")]
    Goal(String),
}

impl Network {
    /// Checks tables, one for each variable, and keeps them.
    pub fn new(
        variables: Vec<Variable>,
        graph: Dag,
        tables: Vec<Conditional>,
    ) -> Result<Self, NetworkError> {
        assert!(
            variables.len() == graph.len() && variables.len() == tables.len(),
            "each variable has its parents and its table"
        );
        for (at, variable) in variables.iter().enumerate() {
            if variables[..at].iter().any(|one| one.name == variable.name) {
                return Err(NetworkError::SameName(variable.name.clone()));
            }
            if !(1..=crate::variable::MOST_STATES).contains(&variable.arity()) {
                return Err(NetworkError::Arity(variable.name.clone(), variable.arity()));
            }
        }
        let this = Self { variables, graph, tables, goal: None, about: About::default() };
        for id in this.ids() {
            this.check(id)?;
        }
        Ok(this)
    }

    /// The error of arcs that come round, with names.
    pub fn cycle(variables: &[Variable], cycle: &Cycle) -> NetworkError {
        let mut names: Vec<&str> =
            cycle.0.iter().map(|id| variables[id.index()].name.as_str()).collect();
        names.push(names[0]);
        NetworkError::Cycle(names.join(" -> "))
    }

    fn check(&self, id: VariableId) -> Result<(), NetworkError> {
        let arity = self.variable(id).arity();
        let table = &self.tables[id.index()];
        let name = || self.variable(id).name.clone();
        let found = table.probabilities.len();
        let rows = self.rows(id);
        let expected = rows.and_then(|rows| rows.checked_mul(arity)).unwrap_or(usize::MAX);
        if found != expected {
            return Err(NetworkError::Size { variable: name(), found, expected });
        }
        for (row, probabilities) in table.probabilities.chunks_exact(arity).enumerate() {
            if table.unknown.binary_search(&(row as u32)).is_ok() {
                continue;
            }
            let wrong = |what: String| NetworkError::Row { variable: name(), row: row + 1, what };
            if let Some(bad) =
                probabilities.iter().find(|&&one| !(0.0..=1.0 + ROUNDING).contains(&one))
            {
                return Err(wrong(format!("holds {bad}, which is no probability")));
            }
            let sum: f64 = probabilities.iter().sum();
            if (sum - 1.0).abs() > ROUNDING {
                return Err(wrong(format!("sums to {sum}")));
            }
        }
        Ok(())
    }

    /// Says what success is.
    pub fn with_goal(mut self, goal: Goal) -> Result<Self, NetworkError> {
        let Some(id) = self.named(&goal.variable) else {
            return Err(NetworkError::Goal(self.unknown(&goal.variable)));
        };
        if self.variable(id).state_of_word(&goal.state).is_none() {
            return Err(NetworkError::Goal(self.no_state(id, &goal.state)));
        }
        self.goal = Some(goal);
        Ok(self)
    }

    /// What to say of a name that no variable has.
    pub fn unknown(&self, name: &str) -> String {
        unknown(name, &self.variables)
    }

    /// What to say of a value that is no state of a variable.
    pub fn no_state(&self, id: VariableId, value: &str) -> String {
        let variable = self.variable(id);
        format!(
            "`{}` has no state `{value}`; there are {}",
            variable.name,
            variable.labels().join(", ")
        )
    }

    /// The variables.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// One of them.
    pub fn variable(&self, id: VariableId) -> &Variable {
        &self.variables[id.index()]
    }

    /// Their numbers.
    pub fn ids(&self) -> impl Iterator<Item = VariableId> + use<> {
        (0..self.variables.len() as u16).map(VariableId)
    }

    /// The variable of a name.
    pub fn named(&self, name: &str) -> Option<VariableId> {
        named(&self.variables, name)
    }

    /// Which variables cause which.
    pub fn graph(&self) -> &Dag {
        &self.graph
    }

    /// What the parents of a variable are called, in their order.
    pub fn causes(&self, id: VariableId) -> Vec<&str> {
        let parents = self.graph.parents(id).iter();
        parents.map(|&parent| self.variable(parent).name.as_str()).collect()
    }

    /// The table of a variable.
    pub fn table(&self, id: VariableId) -> &Conditional {
        &self.tables[id.index()]
    }

    /// How many combinations of states the parents of a variable have. None where they are more than can be numbered.
    pub fn rows(&self, id: VariableId) -> Option<usize> {
        self.graph
            .parents(id)
            .iter()
            .try_fold(1_usize, |rows, parent| rows.checked_mul(self.variable(*parent).arity()))
    }

    /// The number of the row in which the parents of a variable have these states, in their order.
    pub fn row_of(&self, id: VariableId, states: &[State]) -> usize {
        let parents = self.graph.parents(id);
        assert_eq!(parents.len(), states.len(), "each parent has a state");
        parents.iter().zip(states).fold(0, |row, (parent, &state)| {
            row * self.variable(*parent).arity() + usize::from(state)
        })
    }

    /// The states of the parents in a row.
    pub fn states_of(&self, id: VariableId, row: usize) -> Vec<State> {
        let mut rest = row;
        let mut states: Vec<State> = self
            .graph
            .parents(id)
            .iter()
            .rev()
            .map(|parent| {
                let arity = self.variable(*parent).arity();
                let state = (rest % arity) as State;
                rest /= arity;
                state
            })
            .collect();
        states.reverse();
        states
    }

    /// The probabilities of a variable's states in a row; none where nothing is known of it.
    pub fn row(&self, id: VariableId, row: usize) -> Option<&[f64]> {
        let table = self.table(id);
        if table.unknown.binary_search(&(row as u32)).is_ok() {
            return None;
        }
        let arity = self.variable(id).arity();
        Some(&table.probabilities[row * arity..(row + 1) * arity])
    }

    /// How many trials have each state in a row, where that is known.
    pub fn counts(&self, id: VariableId, row: usize) -> Option<&[u64]> {
        let arity = self.variable(id).arity();
        self.table(id).counts.as_deref().map(|counts| &counts[row * arity..(row + 1) * arity])
    }

    /// A row in words: `xOff = [0.6, 1.2), dropOff = [2, 3)`.
    pub fn row_name(&self, id: VariableId, row: usize) -> String {
        let parents = self.graph.parents(id).iter().zip(self.states_of(id, row));
        let words: Vec<String> = parents
            .map(|(parent, state)| {
                let parent = self.variable(*parent);
                format!("{} = {}", parent.name, parent.label(state))
            })
            .collect();
        words.join(", ")
    }

    /// The number of free probabilities.
    pub fn parameters(&self) -> usize {
        self.ids().map(|id| self.rows(id).unwrap_or(0) * (self.variable(id).arity() - 1)).sum()
    }
}
