//! Counts and a graph go in; the probabilities of a network come out (thesis §2.1.3.2 and §2.1.4).

use thiserror::Error;

use crate::count::{CountError, Counter};
use crate::graph::Dag;
use crate::network::{Conditional, Network, NetworkError};
use crate::variable::VariableId;

/// How probabilities come from counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Estimator<'a> {
    /// The shares of the trials (equation 2.5). A combination of parent states that no trial has stays unknown.
    Likelihood,
    /// As if each state had been seen so often in each row (equation 2.8).
    Dirichlet(f64),
    /// As if so many trials had been seen, spread evenly over each table (equation 2.8; `BDeu`).
    Bdeu(f64),
    /// As if each row had been seen in so many trials that agree with another network of the same graph (equation 2.9).
    Weighted {
        /// What the other network is worth, in trials for each row.
        weight: f64,
        /// The other network.
        prior: &'a Network,
    },
}

/// Why there are no probabilities.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EstimateError {
    /// A weight that is none.
    #[error("a prior is worth {0} trials; it must be more than 0")]
    Weight(f64),
    /// A prior that does not fit.
    #[error("the prior network {0}")]
    Prior(String),
    /// Counting failed.
    #[error(transparent)]
    Count(#[from] CountError),
    /// Tables that are no network.
    #[error(transparent)]
    Network(#[from] NetworkError),
}

/// Equation 2.9: a row with `count` of `total` trials in a state that the prior gives `probability`, where the prior is worth `weight`
/// trials. Not a number where there is neither a trial nor a weight.
pub fn weighted(weight: f64, probability: f64, count: u64, total: u64) -> f64 {
    (weight * probability + count as f64) / (weight + total as f64)
}

/// Estimates the probabilities of all tables, from one question to whoever counts.
pub fn estimate(
    counter: &dyn Counter,
    graph: &Dag,
    estimator: Estimator,
) -> Result<Network, EstimateError> {
    let variables = counter.variables();
    match estimator {
        Estimator::Dirichlet(weight)
        | Estimator::Bdeu(weight)
        | Estimator::Weighted { weight, .. }
            if weight.is_nan() || weight <= 0.0 || weight.is_infinite() =>
        {
            return Err(EstimateError::Weight(weight));
        }
        Estimator::Weighted { prior, .. } => fits(prior, counter, graph)?,
        _ => {}
    }
    let ids: Vec<VariableId> = (0..variables.len() as u16).map(VariableId).collect();
    let families: Vec<Vec<VariableId>> = ids
        .iter()
        .map(|&id| graph.parents(id).iter().copied().chain(std::iter::once(id)).collect())
        .collect();
    let counts = counter.count(&families)?;
    let tables = ids
        .iter()
        .zip(&counts)
        .map(|(&id, counts)| table(estimator, id, counts, variables[id.index()].arity()))
        .collect();
    let mut network = Network::new(variables.to_vec(), graph.clone(), tables)?;
    network.about.trials = Some(counter.rows());
    network.about.estimate = Some(estimator.name());
    Ok(network)
}

/// Says where a prior differs from what is estimated.
fn fits(prior: &Network, counter: &dyn Counter, graph: &Dag) -> Result<(), EstimateError> {
    let wrong = |what: String| Err(EstimateError::Prior(what));
    if prior.graph() != graph {
        return wrong("has another graph".to_owned());
    }
    for (mine, theirs) in counter.variables().iter().zip(prior.variables()) {
        if mine.name != theirs.name || mine.states != theirs.states {
            return wrong(format!("has other states of `{}`", mine.name));
        }
    }
    Ok(())
}

fn table(estimator: Estimator, id: VariableId, counts: &[u64], arity: usize) -> Conditional {
    let rows = counts.len() / arity;
    let uniform = vec![1.0 / arity as f64; arity];
    blended(rows, arity, Some(counts), |row| match estimator {
        Estimator::Likelihood => None,
        Estimator::Dirichlet(each) => Some((each * arity as f64, &uniform)),
        Estimator::Bdeu(all) => Some((all / rows as f64, &uniform)),
        // A row that the prior does not know either has only its own trials.
        Estimator::Weighted { prior, weight } => Some((weight, prior.row(id, row)?)),
    })
}

/// A table of which each row is a prior, worth so many trials, together with the trials of the row (equation 2.9). A row with neither is
/// unknown.
pub(crate) fn blended<'p>(
    rows: usize,
    arity: usize,
    counts: Option<&[u64]>,
    prior: impl Fn(usize) -> Option<(f64, &'p [f64])>,
) -> Conditional {
    let mut table = Conditional {
        probabilities: Vec::with_capacity(rows * arity),
        counts: counts.map(<[u64]>::to_vec),
        unknown: Vec::new(),
    };
    let none = vec![0; arity];
    for row in 0..rows {
        let counts = counts.map_or(&none[..], |counts| &counts[row * arity..(row + 1) * arity]);
        let total: u64 = counts.iter().sum();
        let prior = prior(row);
        let weight = prior.map_or(0.0, |(weight, _)| weight);
        if total == 0 && weight <= 0.0 {
            table.unknown.push(row as u32);
            table.probabilities.extend(std::iter::repeat_n(0.0, arity));
            continue;
        }
        table.probabilities.extend(counts.iter().enumerate().map(|(state, &count)| {
            let probability = prior.map_or(0.0, |(_, prior)| prior[state]);
            weighted(weight, probability, count, total)
        }));
    }
    table
}

impl Estimator<'_> {
    /// What it is called in a file.
    pub fn name(self) -> String {
        match self {
            Self::Likelihood => "maximum likelihood".to_owned(),
            Self::Dirichlet(each) => format!("Dirichlet, {each} for each state"),
            Self::Bdeu(all) => format!("BDeu, {all} in all"),
            Self::Weighted { weight, .. } => {
                format!("prior network, worth {weight} trials in each row")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Table;
    use crate::variable::Variable;

    #[test]
    fn the_worked_example_of_equation_2_9() {
        // 6 of 24 trials, a prior of one half that weighs as much as they do.
        let probability = weighted(24.0, 0.5, 6, 24);
        assert!((probability - 3.0 / 8.0).abs() < 1e-15);
    }

    fn trials() -> (Table, Dag) {
        let variables = vec![
            Variable::of_words("cause", ["a", "b", "c"]),
            Variable::of_words("effect", ["0", "1"]),
        ];
        let table = Table::new(variables, vec![vec![0, 0, 0, 0, 1], vec![0, 1, 1, 1, 0]]).unwrap();
        (table, Dag::of_arcs(2, [(VariableId(0), VariableId(1))]).unwrap())
    }

    #[test]
    fn what_no_trial_shows_is_unknown_without_a_prior_and_even_with_one() {
        let (table, graph) = trials();
        let likelihood = estimate(&table, &graph, Estimator::Likelihood).unwrap();
        let effect = VariableId(1);
        assert_eq!(likelihood.row(effect, 0), Some(&[0.25, 0.75][..]));
        assert_eq!(likelihood.row(effect, 1), Some(&[1.0, 0.0][..]));
        assert_eq!(likelihood.row(effect, 2), None);
        assert_eq!(likelihood.table(effect).counts, Some(vec![1, 3, 1, 0, 0, 0]));
        let bdeu = estimate(&table, &graph, Estimator::Bdeu(6.0)).unwrap();
        assert_eq!(bdeu.row(effect, 0), Some(&[2.0 / 6.0, 4.0 / 6.0][..]));
        assert_eq!(bdeu.row(effect, 2), Some(&[0.5, 0.5][..]));
        let weighted = Estimator::Weighted { weight: 4.0, prior: &bdeu };
        let weighted = estimate(&table, &graph, weighted).unwrap();
        assert!(
            (weighted.row(effect, 0).unwrap()[1] - (4.0 * 4.0 / 6.0 + 3.0) / 8.0).abs() < 1e-15
        );
        assert_eq!(
            estimate(&table, &graph, Estimator::Dirichlet(0.0)),
            Err(EstimateError::Weight(0.0))
        );
    }
}
