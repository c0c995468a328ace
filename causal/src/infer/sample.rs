//! A network goes in; trials drawn from it come out, and how probable trials are.

use rayon::prelude::*;

use super::InferError;
use crate::chance::chance;
use crate::network::Network;
use crate::table::Table;
use crate::variable::{State, VariableId};

/// As many trials as are drawn from one seed, so that many threads draw what one would.
const AT_ONCE: usize = 1 << 14;

/// Draws trials: each variable after its parents (forward sampling). The same seed gives the same trials, however many threads draw.
pub fn forward(network: &Network, rows: usize, seed: u64) -> Result<Table, InferError> {
    super::refuse_unknown(network, network.ids(), &[])?;
    let sampler = Sampler::new(network);
    let many = network.variables().len();
    let blocks: Vec<Vec<Vec<State>>> = (0..rows.div_ceil(AT_ONCE))
        .into_par_iter()
        .map(|block| {
            let length = AT_ONCE.min(rows - block * AT_ONCE);
            let mut columns = vec![vec![0; length]; many];
            sampler.fill(seed, block as u64, &mut columns);
            columns
        })
        .collect();
    let mut columns: Vec<Vec<State>> = vec![Vec::with_capacity(rows); many];
    for block in blocks {
        for (column, more) in columns.iter_mut().zip(block) {
            column.extend(more);
        }
    }
    Ok(Table::new(network.variables().to_vec(), columns).expect("samples are states"))
}

/// Draws blocks of trials.
#[derive(Debug)]
pub struct Sampler<'a> {
    network: &'a Network,
    order: Vec<VariableId>,
    /// For each variable its parents with the distance of their states in the table.
    strides: Vec<Vec<(VariableId, usize)>>,
    /// For each variable the sums of the probabilities up to each state.
    sums: Vec<Vec<f64>>,
}

impl<'a> Sampler<'a> {
    /// Prepares the tables of a network all of whose rows are known.
    pub fn new(network: &'a Network) -> Self {
        let strides = network
            .ids()
            .map(|id| {
                let mut stride = network.variable(id).arity();
                let mut strides: Vec<(VariableId, usize)> = Vec::new();
                for &parent in network.graph().parents(id).iter().rev() {
                    strides.push((parent, stride));
                    stride *= network.variable(parent).arity();
                }
                strides
            })
            .collect();
        let sums = network
            .ids()
            .map(|id| {
                let arity = network.variable(id).arity();
                let rows = network.table(id).probabilities.chunks_exact(arity);
                rows.flat_map(|row| {
                    let mut sum = 0.0;
                    row.iter().map(move |&probability| {
                        sum += probability;
                        sum
                    })
                })
                .collect()
            })
            .collect();
        Self { network, order: network.graph().order(), strides, sums }
    }

    /// Fills columns, one for each variable, with the trials of a block.
    pub fn fill(&self, seed: u64, block: u64, columns: &mut [Vec<State>]) {
        let mut random = chance(seed, block);
        for &id in &self.order {
            let mut column = std::mem::take(&mut columns[id.index()]);
            let arity = self.network.variable(id).arity();
            for (row, state) in column.iter_mut().enumerate() {
                let start: usize = self.strides[id.index()]
                    .iter()
                    .map(|&(parent, stride)| usize::from(columns[parent.index()][row]) * stride)
                    .sum();
                let sums = &self.sums[id.index()][start..start + arity];
                let chance = random.f64() * sums[arity - 1];
                *state = sums.iter().position(|&sum| chance < sum).unwrap_or(arity - 1) as State;
            }
            columns[id.index()] = column;
        }
    }
}

/// The logarithm of the probability of the trials of a table whose columns are the variables of the network, in its order. Minus
/// infinity where the network holds one impossible.
pub fn log_likelihood(network: &Network, table: &Table) -> Result<f64, InferError> {
    assert!(
        network
            .variables()
            .iter()
            .zip(table.variables())
            .all(|(one, other)| one.name == other.name),
        "the table has the variables of the network"
    );
    let mut total = 0.0;
    let mut states = Vec::new();
    for row in 0..table.len() {
        for id in network.ids() {
            states.clear();
            states.extend(
                network.graph().parents(id).iter().map(|&parent| table.column(parent)[row]),
            );
            let at = network.row_of(id, &states);
            let Some(probabilities) = network.row(id, at) else {
                let variable = network.variable(id).name.clone();
                return Err(InferError::Unknown { variable, row: network.row_name(id, at) });
            };
            total += probabilities[usize::from(table.column(id)[row])].ln();
        }
    }
    Ok(total)
}
