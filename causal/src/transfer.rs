//! A network and another one like it go in; what the first knows, as a prior for the second, comes out (thesis §2.1.4, equations 2.10
//! to 2.15).
//!
//! The source has a goal X' with causes Pa(X'), the target a goal X with causes Pa(X). For each row u of the target's table a row u' of
//! the source's is asked:
//!
//! - *direct replacement* (2.13): u' takes the values of the variables that both have, as 2.10 takes those of the first cube;
//! - *cross replacement* (2.14): u' takes the values of variables that are [`related`] and not the same, as 2.11 takes those of the
//!   second cube. Where there are several such ways, their mean counts. Where nothing is related but what is the same, it is direct;
//! - *minimal replacement* (2.15): of all these the one in which success is least probable. Its whole row is taken: a minimum for each
//!   state by itself, as the equation is printed, would not sum to one.
//!
//! Causes of the source that nothing stands for are summed out, as the source has them distributed where the others are as they are.
//! The prior then counts as so many trials in each row (2.12).

pub mod relation;
pub mod related;
pub mod curve;
mod name;
mod overlap;
mod unit;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use self::overlap::{Mixture, overlap};
use self::relation::{Relation, View};
use crate::estimate::blended;
use crate::infer::{InferError, elimination::joint};
use crate::network::{Conditional, Network, NetworkError};
use crate::variable::{State, VariableId};

/// From where to where something is carried over.
#[derive(Debug, Clone, Copy)]
pub struct Ends<'a> {
    /// The network that knows something.
    pub source: &'a Network,
    /// Its goal and the state that is success.
    pub source_goal: (VariableId, State),
    /// The network that is to know it.
    pub target: &'a Network,
    /// Its goal and the state that is success.
    pub target_goal: (VariableId, State),
}

/// Which values of the target are put into the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// Those of the variables that both have (equation 2.13).
    Direct,
    /// Those of related ones (equation 2.14).
    Cross,
    /// Those of the two with which success is less probable (equation 2.15).
    Minimal,
}

impl Strategy {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Direct, Self::Cross, Self::Minimal];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Cross => "cross",
            Self::Minimal => "minimal",
        }
    }

    /// Whose values it puts into the source, in a few words.
    pub fn about(self) -> &'static str {
        match self {
            Self::Direct => "Those of the variables that both have (equation 2.13)",
            Self::Cross => "Those of related ones (equation 2.14)",
            Self::Minimal => "Those with which success is less probable (equation 2.15)",
        }
    }
}

/// What a source knows of the rows of a target's table.
#[derive(Debug, Clone, PartialEq)]
pub struct Prior {
    /// For each row the probabilities of the states of the target's goal, which sum to one; none where the row lies outside what the
    /// source knows.
    pub rows: Vec<Option<Vec<f64>>>,
    /// Causes of the source that nothing in the target stands for: their own distribution does.
    pub summed_out: Vec<String>,
}

/// Where a table of a network was carried over from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Provenance {
    /// The file of the source.
    pub source: String,
    /// The goal of the source.
    pub goal: String,
    /// The variable whose table has the prior.
    pub variable: String,
    /// How values were replaced.
    pub strategy: Strategy,
    /// What the prior is worth in each row, in trials.
    pub weight: f64,
    /// How many rows have a prior.
    pub rows: usize,
    /// How many rows have none.
    pub without: usize,
    /// Which variable stands for which.
    pub relation: Relation,
}

/// Why nothing is carried over.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TransferError {
    /// No variable of the one is one of the other.
    #[error(
        "none of the causes of `{source_goal}` in the source ({source_causes}) is related to a cause of `{target_goal}` in the target ({target_causes})"
    )]
    Unrelated {
        /// The goal of the source.
        source_goal: String,
        /// Its causes.
        source_causes: String,
        /// The goal of the target.
        target_goal: String,
        /// Its causes.
        target_causes: String,
    },
    /// Direct replacement without a variable that is the same.
    #[error(
        "no cause is the same in both, as direct replacement needs it; cross replacement can do with related ones"
    )]
    NothingSame,
    /// A relation that names a variable that there is not.
    #[error("the relation is wrong: {0}")]
    Unknown(String),
    /// A relation that names a variable that does not cause the goal.
    #[error("the relation is wrong: `{name}` does not cause `{goal}` in the {side}; {causes}")]
    NoCause {
        /// Of the source or of the target.
        side: &'static str,
        /// The variable.
        name: String,
        /// The goal.
        goal: String,
        /// What is said of its causes.
        causes: String,
    },
    /// A relation with two answers to one question.
    #[error(
        "the relation is wrong: `{0}` stands for two variables at once; put each of them into a list of its own in `cross`"
    )]
    Twice(String),
    /// Variables whose values have nothing to do with each other.
    #[error("`{from}` of the source cannot stand for `{to}` of the target: {what}")]
    Incompatible {
        /// The variable of the source.
        from: String,
        /// The variable of the target.
        to: String,
        /// Why not.
        what: String,
    },
    /// A weight that is none.
    #[error("a prior is worth {0} trials; it can be any finite number from 0")]
    Weight(f64),
    /// The source cannot be asked.
    #[error("the source cannot be asked: {0}")]
    Source(#[from] InferError),
    /// What came out is no network.
    #[error(transparent)]
    Network(#[from] NetworkError),
}

/// What the source knows of each row of the target's table.
pub fn prior(ends: &Ends, relation: &Relation, strategy: Strategy) -> Result<Prior, TransferError> {
    let (direct, mut cross) = relation.views(ends)?;
    if direct.is_empty() && cross.is_empty() {
        return Err(unrelated(ends));
    }
    if cross.is_empty() {
        cross.push(direct.clone());
    }
    let views: Vec<View> = match strategy {
        Strategy::Direct if direct.is_empty() => return Err(TransferError::NothingSame),
        Strategy::Direct => vec![direct],
        Strategy::Cross => cross,
        Strategy::Minimal => {
            let direct = (!direct.is_empty()).then_some(direct);
            direct.into_iter().chain(cross).collect()
        }
    };
    let states = goal_states(ends)?;
    let parents = ends.source.graph().parents(ends.source_goal.0);
    let named = |id: &VariableId| ends.source.variable(*id).name.clone();
    let summed_out = parents
        .iter()
        .filter(|id| views.iter().any(|view| view.iter().all(|(source, _)| source != *id)))
        .map(named)
        .collect();
    let asked = views
        .iter()
        .map(|view| ask(ends, view, &states))
        .collect::<Result<Vec<Vec<Option<Vec<f64>>>>, _>>()?;
    let success = usize::from(ends.target_goal.1);
    let count = ends.target.rows(ends.target_goal.0).expect("the rows of a network are numbered");
    let rows = (0..count)
        .map(|row| {
            let known = asked.iter().filter_map(|answers| answers[row].as_ref());
            match strategy {
                Strategy::Minimal => {
                    known.min_by(|one, other| one[success].total_cmp(&other[success])).cloned()
                }
                Strategy::Direct | Strategy::Cross => mean(known),
            }
        })
        .collect();
    Ok(Prior { rows, summed_out })
}

/// Equation 2.12: the table of the target's goal where the prior is worth `weight` trials in each row and `counts` are the trials of the
/// target, laid out as its probabilities; none where there are none. Rows without a prior have only their own trials.
pub fn estimated(
    prior: &Prior,
    weight: f64,
    counts: Option<&[u64]>,
    arity: usize,
) -> Result<Conditional, TransferError> {
    if !weight.is_finite() || weight < 0.0 {
        return Err(TransferError::Weight(weight));
    }
    Ok(blended(prior.rows.len(), arity, counts, |row| {
        prior.rows[row].as_deref().map(|known| (weight, known))
    }))
}

/// The target with another table of its goal.
pub fn with_table(
    target: &Network,
    goal: VariableId,
    table: Conditional,
) -> Result<Network, TransferError> {
    let mut tables: Vec<Conditional> = target.ids().map(|id| target.table(id).clone()).collect();
    tables[goal.index()] = table;
    let mut network = Network::new(target.variables().to_vec(), target.graph().clone(), tables)?;
    network.goal.clone_from(&target.goal);
    network.about = target.about.clone();
    Ok(network)
}

/// The error of two networks that have nothing to do with each other.
fn unrelated(ends: &Ends) -> TransferError {
    let causes = |network: &Network, goal: VariableId| {
        let names = network.causes(goal);
        if names.is_empty() { "it has none".to_owned() } else { names.join(", ") }
    };
    TransferError::Unrelated {
        source_goal: ends.source.variable(ends.source_goal.0).name.clone(),
        source_causes: causes(ends.source, ends.source_goal.0),
        target_goal: ends.target.variable(ends.target_goal.0).name.clone(),
        target_causes: causes(ends.target, ends.target_goal.0),
    }
}

/// For each state of the target's goal the one of the source's: success is success; others are paired by what they are called, or are
/// the only other ones.
fn goal_states(ends: &Ends) -> Result<Vec<usize>, TransferError> {
    let (source, target) =
        (ends.source.variable(ends.source_goal.0), ends.target.variable(ends.target_goal.0));
    let (own, other) = (source.labels(), target.labels());
    let wrong = |what: String| TransferError::Incompatible {
        from: source.name.clone(),
        to: target.name.clone(),
        what,
    };
    if own.len() != other.len() {
        return Err(wrong(format!(
            "the one ends in {} ways, the other in {}",
            own.len(),
            other.len()
        )));
    }
    let (from, to) = (usize::from(ends.source_goal.1), usize::from(ends.target_goal.1));
    (0..other.len())
        .map(|state| match state {
            _ if state == to => Ok(from),
            _ if own.len() == 2 => Ok(1 - from),
            _ => (0..own.len())
                .find(|&at| at != from && overlap::alike(&own[at], &other[state]))
                .ok_or_else(|| wrong(format!("the one never ends in {}", other[state]))),
        })
        .collect()
}

/// What the source says of each row of the target's table when the target's values are put in for this view.
fn ask(ends: &Ends, view: &View, states: &[usize]) -> Result<Vec<Option<Vec<f64>>>, TransferError> {
    let (source, target) = (ends.source, ends.target);
    let causes = target.graph().parents(ends.target_goal.0);
    let mixtures = view
        .iter()
        .map(|&(from, to)| {
            let (from, to) = (source.variable(from), target.variable(to));
            overlap(from, to).map_err(|what| TransferError::Incompatible {
                from: from.name.clone(),
                to: to.name.clone(),
                what,
            })
        })
        .collect::<Result<Vec<Vec<Option<Mixture>>>, _>>()?;
    let place = |id: VariableId| {
        causes.iter().position(|&cause| cause == id).expect("a view names causes of the goal")
    };
    let places: Vec<usize> = view.iter().map(|&(_, to)| place(to)).collect();
    let known = known(ends, view)?;
    let arities: Vec<usize> = view.iter().map(|&(from, _)| source.variable(from).arity()).collect();
    let rows = target.rows(ends.target_goal.0).expect("the rows of a network are numbered");
    Ok((0..rows)
        .map(|row| {
            let here = target.states_of(ends.target_goal.0, row);
            // The rows of the source that this one lies over, each with its share.
            let mut over: Vec<(usize, f64)> = vec![(0, 1.0)];
            for ((mixture, &at), &arity) in mixtures.iter().zip(&places).zip(&arities) {
                let mixture = mixture[usize::from(here[at])].as_ref()?;
                over = over
                    .iter()
                    .flat_map(|&(row, share)| {
                        mixture.iter().map(move |&(state, part)| {
                            (row * arity + usize::from(state), share * part)
                        })
                    })
                    .collect();
            }
            let mut sum = vec![0.0; states.len()];
            let mut whole = 0.0;
            for (row, share) in over {
                let Some(probabilities) = &known[row] else { continue };
                whole += share;
                for (sum, &state) in sum.iter_mut().zip(states) {
                    *sum += share * probabilities[state];
                }
            }
            // What the source does not know, it does not know from trials: the rest speaks for all where it is the greater part.
            (whole >= overlap::COVERED).then(|| normal(sum))
        })
        .collect())
}

/// The source's table over the causes of a view, in its order, the last running fastest; its other causes are summed out.
fn known(ends: &Ends, view: &View) -> Result<Vec<Option<Vec<f64>>>, TransferError> {
    let (source, goal) = (ends.source, ends.source_goal.0);
    let parents = source.graph().parents(goal);
    let rows = source.rows(goal).expect("the rows of a network are numbered");
    let arity = source.variable(goal).arity();
    let chances =
        if view.len() == parents.len() { vec![1.0; rows] } else { joint(source, parents, &[])? };
    let places: Vec<(usize, usize)> = view
        .iter()
        .map(|&(from, _)| {
            let at = parents.iter().position(|&parent| parent == from);
            (at.expect("a view names causes of the goal"), source.variable(from).arity())
        })
        .collect();
    let cells: usize = places.iter().map(|&(_, arity)| arity).product();
    let mut sums = vec![(0.0, vec![0.0; arity]); cells];
    for (row, &chance) in chances.iter().enumerate() {
        let Some(probabilities) = source.row(goal, row) else { continue };
        let states = source.states_of(goal, row);
        let cell =
            places.iter().fold(0, |cell, &(at, arity)| cell * arity + usize::from(states[at]));
        let (whole, sum) = &mut sums[cell];
        *whole += chance;
        for (sum, probability) in sum.iter_mut().zip(probabilities) {
            *sum += chance * probability;
        }
    }
    Ok(sums.into_iter().map(|(whole, sum)| (whole > 0.0).then(|| normal(sum))).collect())
}

/// The mean of rows; none of no row.
fn mean<'a>(rows: impl Iterator<Item = &'a Vec<f64>>) -> Option<Vec<f64>> {
    let sum = rows.fold(None, |sum: Option<Vec<f64>>, row| match sum {
        None => Some(row.clone()),
        Some(sum) => Some(sum.iter().zip(row).map(|(one, other)| one + other).collect()),
    });
    sum.map(normal)
}

/// Numbers in the same proportions that sum to one.
fn normal(mut row: Vec<f64>) -> Vec<f64> {
    let whole: f64 = row.iter().sum();
    for one in &mut row {
        *one /= whole;
    }
    row
}
