//! A network and evidence go in; probabilities come out, exactly.

pub mod elimination;
pub mod factor;
pub mod junction;
pub mod sample;

use thiserror::Error;

use crate::network::Network;
use crate::variable::{State, VariableId};

/// What is seen: variables and the states that they are in.
pub type Evidence = [(VariableId, State)];

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InferError {
    /// Evidence that the network holds impossible.
    #[error("what is given cannot happen together in this model")]
    Impossible,
    /// A row of which nothing is known, and which matters.
    #[error("no trial shows `{variable}` where {row}; without a prior nothing can be said of it")]
    Unknown {
        /// The variable.
        variable: String,
        /// The states of its parents.
        row: String,
    },
    /// A variable that is seen in two states.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// Tables that no memory holds.
    #[error("an exact answer needs a table of {0} probabilities at once, too many")]
    TooLarge(u128),
}

/// As many probabilities as one table may have on the way.
pub const MOST_CELLS: usize = 1 << 27;

/// A network after interventions: what is set has no causes any more (Pearl 2009, the do-operator).
///
/// # Panics
/// If a state is none of its variable's.
pub fn intervene(network: &Network, set: &Evidence) -> Network {
    let point = |&(id, state): &(VariableId, State)| {
        let mut probabilities = vec![0.0; network.variable(id).arity()];
        probabilities[usize::from(state)] = 1.0;
        (id, probabilities)
    };
    without_causes(network, set.iter().map(point))
}

/// A network in which nothing causes some variables, and each of their states is as likely: what is asked given their states is then
/// what happens when they are set.
pub fn sever(network: &Network, ids: &[VariableId]) -> Network {
    let uniform = |&id: &VariableId| {
        let arity = network.variable(id).arity();
        (id, vec![1.0 / arity as f64; arity])
    };
    without_causes(network, ids.iter().map(uniform))
}

fn without_causes(network: &Network, set: impl Iterator<Item = (VariableId, Vec<f64>)>) -> Network {
    let mut parents: Vec<Vec<VariableId>> =
        network.ids().map(|id| network.graph().parents(id).to_vec()).collect();
    let mut tables: Vec<_> = network.ids().map(|id| network.table(id).clone()).collect();
    for (id, probabilities) in set {
        parents[id.index()].clear();
        tables[id.index()] = crate::network::Conditional { probabilities, ..Default::default() };
    }
    let graph = crate::graph::Dag::new(parents).expect("taking arcs away closes no cycle");
    let mut after = Network::new(network.variables().to_vec(), graph, tables)
        .expect("what is set is a distribution, and the other tables are as they were");
    after.goal.clone_from(&network.goal);
    after.about.clone_from(&network.about);
    after
}

/// Refuses evidence that names a variable twice with different states.
fn check(network: &Network, evidence: &Evidence) -> Result<(), InferError> {
    for (at, (id, state)) in evidence.iter().enumerate() {
        if evidence[..at].iter().any(|(other, before)| other == id && before != state) {
            return Err(InferError::Twice(network.variable(*id).name.clone()));
        }
    }
    Ok(())
}

/// The error of a row that is unknown and agrees with the evidence, if there is one among these variables.
fn refuse_unknown(
    network: &Network,
    relevant: impl Iterator<Item = VariableId>,
    evidence: &Evidence,
) -> Result<(), InferError> {
    for id in relevant {
        for &row in &network.table(id).unknown {
            let states = network.states_of(id, row as usize);
            let agrees = network.graph().parents(id).iter().zip(&states).all(|(parent, state)| {
                evidence.iter().all(|(other, seen)| other != parent || seen == state)
            });
            if agrees {
                let variable = network.variable(id).name.clone();
                return Err(InferError::Unknown {
                    variable,
                    row: network.row_name(id, row as usize),
                });
            }
        }
    }
    Ok(())
}
