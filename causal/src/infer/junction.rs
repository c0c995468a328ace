//! A junction tree: a network is joined into cliques once, and evidence spread over them answers for every variable at once
//! (Lauritzen and Spiegelhalter 1988; Jensen et al. 1990).

use super::factor::{Factor, cells};
use super::{Evidence, InferError, check, refuse_unknown};
use crate::network::Network;
use crate::variable::VariableId;

/// The cliques of a network, and how they hang together.
#[derive(Debug, Clone)]
pub struct JunctionTree<'a> {
    network: &'a Network,
    cliques: Vec<Vec<(VariableId, usize)>>,
    /// The clique that each hangs from, which comes before it; the first of each tree hangs from none.
    parents: Vec<Option<usize>>,
    /// The clique that takes the table of each variable.
    homes: Vec<usize>,
}

/// A junction tree after evidence.
#[derive(Debug, Clone)]
pub struct Calibrated<'a> {
    tree: &'a JunctionTree<'a>,
    beliefs: Vec<Factor>,
    /// The logarithm of the probability of the evidence.
    pub evidence: f64,
}

impl<'a> JunctionTree<'a> {
    /// Joins the parents of each variable, triangulates by min-fill, and hangs the cliques together where they share most.
    pub fn new(network: &'a Network) -> Result<Self, InferError> {
        let many = network.variables().len();
        let mut joined = vec![vec![false; many]; many];
        for id in network.ids() {
            let family: Vec<VariableId> =
                network.graph().parents(id).iter().copied().chain([id]).collect();
            join(&mut joined, &family);
        }
        let mut cliques: Vec<Vec<VariableId>> = Vec::new();
        let mut left: Vec<VariableId> = network.ids().collect();
        while let Some(next) = simplest(network, &joined, &left) {
            let mut clique: Vec<VariableId> = left
                .iter()
                .copied()
                .filter(|&id| id == next || joined[id.index()][next.index()])
                .collect();
            left.retain(|&id| id != next);
            join(&mut joined, &clique);
            clique.sort_unstable();
            if !cliques.iter().any(|larger| clique.iter().all(|id| larger.contains(id))) {
                cliques.push(clique);
            }
        }
        let (cliques, parents) = hang(cliques);
        let homes = network
            .ids()
            .map(|id| {
                let holds = |clique: &Vec<VariableId>| {
                    clique.contains(&id)
                        && network.graph().parents(id).iter().all(|one| clique.contains(one))
                };
                cliques.iter().position(holds).expect("a variable and its parents were joined")
            })
            .collect();
        let with_arity = |clique: &Vec<VariableId>| -> Vec<(VariableId, usize)> {
            clique.iter().map(|&id| (id, network.variable(id).arity())).collect()
        };
        let cliques: Vec<Vec<(VariableId, usize)>> = cliques.iter().map(with_arity).collect();
        for clique in &cliques {
            cells(clique)?;
        }
        Ok(Self { network, cliques, parents, homes })
    }

    /// Spreads evidence over all cliques: once towards the roots, and back.
    pub fn calibrate(&self, evidence: &Evidence) -> Result<Calibrated<'_>, InferError> {
        check(self.network, evidence)?;
        refuse_unknown(self.network, self.network.ids(), evidence)?;
        let seen = |id: VariableId| evidence.iter().any(|&(other, _)| other == id);
        let free = |clique: &Vec<(VariableId, usize)>| -> Vec<(VariableId, usize)> {
            clique.iter().copied().filter(|&(id, _)| !seen(id)).collect()
        };
        let tables: Vec<Factor> =
            self.network.ids().map(|id| Factor::of_table(self.network, id, evidence)).collect();
        let mut beliefs: Vec<Factor> = self
            .cliques
            .iter()
            .enumerate()
            .map(|(at, clique)| {
                let mine: Vec<&Factor> = self
                    .homes
                    .iter()
                    .zip(&tables)
                    .filter(|(home, _)| **home == at)
                    .map(|(_, table)| table)
                    .collect();
                Factor::product(&mine, &free(clique))
            })
            .collect::<Result<_, _>>()?;
        let mut logarithm = 0.0;
        let mut upward: Vec<Option<Factor>> = vec![None; self.cliques.len()];
        for at in (0..self.cliques.len()).rev() {
            let sum: f64 = beliefs[at].values.iter().sum();
            if sum <= 0.0 {
                return Err(InferError::Impossible);
            }
            // Scaled, so that products of many small numbers do not vanish.
            logarithm += sum.ln();
            beliefs[at].values.iter_mut().for_each(|value| *value /= sum);
            let Some(parent) = self.parents[at] else { continue };
            let message = beliefs[at].onto(&shared(&beliefs[at], &beliefs[parent]));
            beliefs[parent] =
                Factor::product(&[&beliefs[parent], &message], &beliefs[parent].scope)?;
            upward[at] = Some(message);
        }
        for at in 0..self.cliques.len() {
            let (Some(parent), Some(up)) = (self.parents[at], &upward[at]) else { continue };
            let mut message = beliefs[parent].onto(&up.scope);
            for (down, up) in message.values.iter_mut().zip(&up.values) {
                *down = if *up > 0.0 { *down / up } else { 0.0 };
            }
            beliefs[at] = Factor::product(&[&beliefs[at], &message], &beliefs[at].scope)?;
        }
        Ok(Calibrated { tree: self, beliefs, evidence: logarithm })
    }
}

impl Calibrated<'_> {
    /// The probabilities of the states of a variable, given the evidence; none for one that was seen.
    pub fn posterior(&self, id: VariableId) -> Option<Vec<f64>> {
        let belief = self
            .beliefs
            .iter()
            .filter(|belief| belief.has(id))
            .min_by_key(|one| one.values.len())?;
        let arity = self.tree.network.variable(id).arity();
        let posterior = belief.onto(&[(id, arity)]).values;
        let sum: f64 = posterior.iter().sum();
        Some(posterior.into_iter().map(|value| value / sum).collect())
    }
}

/// Joins all of some variables with each other.
fn join(joined: &mut [Vec<bool>], all: &[VariableId]) {
    for &one in all {
        for &other in all {
            if one != other {
                joined[one.index()][other.index()] = true;
            }
        }
    }
}

/// The variable that needs the fewest new joins when it goes; of several, the one with the smallest clique.
fn simplest(network: &Network, joined: &[Vec<bool>], left: &[VariableId]) -> Option<VariableId> {
    left.iter().copied().min_by_key(|&id| {
        let around: Vec<VariableId> = left
            .iter()
            .copied()
            .filter(|&other| other != id && joined[id.index()][other.index()])
            .collect();
        let mut fill = 0;
        for (at, one) in around.iter().enumerate() {
            fill += around[..at].iter().filter(|other| !joined[one.index()][other.index()]).count();
        }
        let size: f64 =
            around.iter().map(|&other| (network.variable(other).arity() as f64).ln()).sum();
        (fill, (size * 1e6) as u64, id)
    })
}

/// Hangs cliques together by a spanning tree of those that share most; each comes after the one that it hangs from.
fn hang(cliques: Vec<Vec<VariableId>>) -> (Vec<Vec<VariableId>>, Vec<Option<usize>>) {
    let share = |one: usize, other: usize| -> usize {
        cliques[one].iter().filter(|id| cliques[other].contains(id)).count()
    };
    // For each clique that waits, the one in the tree that it shares most with: Prim's algorithm.
    let mut nearest: Vec<(usize, Option<usize>)> = vec![(0, None); cliques.len()];
    let mut waiting: Vec<usize> = (0..cliques.len()).collect();
    let (mut order, mut parents): (Vec<usize>, Vec<Option<usize>>) = (Vec::new(), Vec::new());
    while let Some(place) = (0..waiting.len())
        .max_by_key(|&place| (nearest[waiting[place]].0, std::cmp::Reverse(waiting[place])))
    {
        let next = waiting.swap_remove(place);
        parents.push(nearest[next].1);
        order.push(next);
        for &other in &waiting {
            let common = share(next, other);
            if common > nearest[other].0 {
                nearest[other] = (common, Some(order.len() - 1));
            }
        }
    }
    let mut cliques: Vec<Option<Vec<VariableId>>> = cliques.into_iter().map(Some).collect();
    let ordered =
        order.into_iter().map(|at| cliques[at].take().expect("each comes once")).collect();
    (ordered, parents)
}

/// The variables that two factors share.
fn shared(one: &Factor, other: &Factor) -> Vec<(VariableId, usize)> {
    one.scope.iter().copied().filter(|&(id, _)| other.has(id)).collect()
}
