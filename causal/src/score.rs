//! Counts go in; how well parents explain a variable comes out, each question asked of the data once.

use std::cell::RefCell;

use rayon::prelude::*;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

use crate::count::{CountError, Counter, Counts};
use crate::graph::Dag;
use crate::set::Set;
use crate::variable::VariableId;

/// What a graph is judged by: the sum over its variables of a local score, the higher the better. Logarithms are natural.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Score {
    /// The log-likelihood, less half the logarithm of the number of trials for each parameter (Schwarz 1978).
    Bic,
    /// The log-likelihood, less one for each parameter (Akaike 1974).
    Aic,
    /// The marginal likelihood under Dirichlet priors that together are worth this many trials (Buntine 1991; Heckerman et al. 1995).
    Bdeu(f64),
    /// The marginal likelihood where every table of probabilities is equally probable (Cooper and Herskovits 1992).
    K2,
}

/// As many cells as are counted in one reading of the data.
const CELLS_AT_ONCE: usize = 1 << 22;

/// Scores of a variable under its parents, kept once known.
pub struct Scorer<'a> {
    counter: &'a dyn Counter,
    score: Score,
    arities: Vec<usize>,
    /// `n ln n` for every number of trials that can occur, where these are few.
    logarithms: Vec<f64>,
    known: RefCell<FxHashMap<(VariableId, Set), f64>>,
    failed: RefCell<Option<CountError>>,
}

/// Numbers of trials up to this have their logarithms in a table.
const TABULATED: u64 = 1 << 20;

impl<'a> Scorer<'a> {
    /// Scores what `counter` counts.
    pub fn new(counter: &'a dyn Counter, score: Score) -> Self {
        let rows = counter.rows();
        let logarithms =
            if rows <= TABULATED { (0..=rows).map(n_log_n).collect() } else { Vec::new() };
        Self {
            counter,
            score,
            arities: counter.variables().iter().map(crate::variable::Variable::arity).collect(),
            logarithms,
            known: RefCell::default(),
            failed: RefCell::default(),
        }
    }

    /// How many variables there are.
    pub fn len(&self) -> usize {
        self.arities.len()
    }

    /// Whether there is no variable.
    pub fn is_empty(&self) -> bool {
        self.arities.is_empty()
    }

    /// How many scores are known.
    pub fn asked(&self) -> usize {
        self.known.borrow().len()
    }

    /// How well `parents` explain `child`. Minus infinity where they have too many combinations of states to be counted, or counting
    /// [failed](Self::failure).
    pub fn local(&self, child: VariableId, parents: Set) -> f64 {
        if let Some(&score) = self.known.borrow().get(&(child, parents)) {
            return score;
        }
        self.prepare(&[(child, parents)]);
        self.known.borrow()[&(child, parents)]
    }

    /// Scores several families at once, and so in as few readings of the data as can be.
    pub fn prepare(&self, families: &[(VariableId, Set)]) {
        let mut fresh: Vec<(VariableId, Set)> = {
            let known = self.known.borrow();
            families.iter().copied().filter(|family| !known.contains_key(family)).collect()
        };
        fresh.sort_unstable();
        fresh.dedup();
        let cells = |&(child, parents): &(VariableId, Set)| {
            crate::count::cells(self.counter.variables(), &list(child, parents)).ok()
        };
        let mut batch: Vec<(VariableId, Set)> = Vec::new();
        let mut size = 0;
        for family in fresh {
            let Some(cells) = cells(&family) else {
                self.known.borrow_mut().insert(family, f64::NEG_INFINITY);
                continue;
            };
            if size + cells > CELLS_AT_ONCE && !batch.is_empty() {
                self.count(&std::mem::take(&mut batch));
                size = 0;
            }
            size += cells;
            batch.push(family);
        }
        self.count(&batch);
    }

    /// The score of a whole graph.
    pub fn total(&self, graph: &Dag) -> f64 {
        (0..graph.len() as u16)
            .map(|id| {
                self.local(VariableId(id), graph.parents(VariableId(id)).iter().copied().collect())
            })
            .sum()
    }

    /// Why counting failed, if it did; what was scored since is worth nothing.
    pub fn failure(&self) -> Option<CountError> {
        self.failed.borrow().clone()
    }

    fn count(&self, families: &[(VariableId, Set)]) {
        if families.is_empty() {
            return;
        }
        let sets: Vec<Vec<VariableId>> =
            families.iter().map(|&(child, parents)| list(child, parents)).collect();
        let scores: Vec<f64> = match self.counter.count(&sets) {
            Ok(counts) => {
                let (score, rows) = (self.score, self.counter.rows());
                let (arities, logarithms) = (&self.arities, &self.logarithms);
                let judge = |(family, counts): (&(VariableId, Set), &Counts)| {
                    judge(score, logarithms, rows, counts, arities[family.0.index()])
                };
                // A few are scored faster than threads are woken.
                if families.len() < 64 {
                    families.iter().zip(&counts).map(judge).collect()
                } else {
                    families.par_iter().zip(&counts).map(judge).collect()
                }
            }
            Err(error) => {
                self.failed.borrow_mut().get_or_insert(error);
                vec![f64::NEG_INFINITY; families.len()]
            }
        };
        self.known.borrow_mut().extend(families.iter().copied().zip(scores));
    }
}

/// The parents, then the child: so that the child's states run fastest.
fn list(child: VariableId, parents: Set) -> Vec<VariableId> {
    let mut list = parents.list();
    list.push(child);
    list
}

fn n_log_n(count: u64) -> f64 {
    if count == 0 { 0.0 } else { count as f64 * (count as f64).ln() }
}

/// The local score of counts in which a variable of `arity` states runs fastest.
fn judge(score: Score, logarithms: &[f64], rows: u64, counts: &[u64], arity: usize) -> f64 {
    let configurations = counts.len() / arity;
    match score {
        Score::Bic | Score::Aic => {
            let n_log_n = |count: u64| {
                logarithms.get(count as usize).copied().unwrap_or_else(|| n_log_n(count))
            };
            let mut likelihood = 0.0;
            for row in counts.chunks_exact(arity) {
                let mut total = 0;
                for &count in row {
                    likelihood += n_log_n(count);
                    total += count;
                }
                likelihood -= n_log_n(total);
            }
            let parameters = (configurations * (arity - 1)) as f64;
            let price = if score == Score::Aic { 1.0 } else { (rows.max(1) as f64).ln() / 2.0 };
            likelihood - price * parameters
        }
        Score::Bdeu(weight) => {
            let (of_row, of_cell) = (weight / configurations as f64, weight / counts.len() as f64);
            marginal(counts, arity, of_row, of_cell)
        }
        Score::K2 => marginal(counts, arity, arity as f64, 1.0),
    }
}

/// The logarithm of the marginal likelihood under a Dirichlet prior.
fn marginal(counts: &[u64], arity: usize, of_row: f64, of_cell: f64) -> f64 {
    let (row_alone, cell_alone) = (libm::lgamma(of_row), libm::lgamma(of_cell));
    let mut score = 0.0;
    for row in counts.chunks_exact(arity) {
        let total: u64 = row.iter().sum();
        if total == 0 {
            continue;
        }
        score += row_alone - libm::lgamma(of_row + total as f64);
        for &count in row.iter().filter(|&&count| count > 0) {
            score += libm::lgamma(of_cell + count as f64) - cell_alone;
        }
    }
    score
}
