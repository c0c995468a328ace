//! Trials and a way to learn go in; how well the outcome of other trials is predicted comes out (thesis §2.3, table 2.4).

pub mod forest;

use thiserror::Error;

use crate::estimate::{EstimateError, Estimator, estimate};
use crate::graph::Dag;
use crate::network::Network;
use crate::table::Table;
use crate::variable::{State, VariableId};

/// What is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outcome {
    /// The variable.
    pub variable: VariableId,
    /// The state in which a trial succeeded.
    pub success: State,
}

/// How trials are parted into folds, each of which is predicted from the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Folds<'a> {
    /// So many folds of trials drawn at random under a seed.
    Random(usize, u64),
    /// One fold for each group; the group of each row.
    Groups(&'a [u32]),
}

/// Why nothing can be evaluated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EvaluateError {
    /// No outcome that varies.
    #[error("`{name}` {what}, so that there is nothing to predict")]
    Outcome {
        /// The variable.
        name: String,
        /// What it is always.
        what: String,
    },
    /// Less than two folds, or more than trials.
    #[error("{folds} folds of {rows} trials; there should be 2 folds or more, and a trial in each")]
    Folds {
        /// How many folds.
        folds: usize,
        /// How many trials.
        rows: usize,
    },
    /// Learning failed in a fold.
    #[error("fold {fold}: {what}")]
    Learn {
        /// The fold, from 1.
        fold: usize,
        /// What failed.
        what: String,
    },
}

/// What is predicted of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// The fold of the trial.
    pub fold: usize,
    /// The probability of success; none where the model knows nothing of such a trial.
    pub probability: Option<f64>,
    /// Whether success is predicted.
    pub predicted: bool,
    /// Whether it came.
    pub succeeded: bool,
}

/// How good predictions are.
#[derive(Debug, Clone, PartialEq)]
pub struct Scores {
    /// How many there are.
    pub trials: usize,
    /// The share that is right.
    pub accuracy: f64,
    /// Of those predicted to succeed, the share that does; 0 where none is.
    pub precision: f64,
    /// Of those that succeed, the share so predicted; 0 where none does.
    pub recall: f64,
    /// The harmonic mean of both.
    pub f1: f64,
    /// The mean squared difference of probability and outcome, where there are probabilities.
    pub brier: Option<f64>,
    /// The mean natural logarithm of what was given to what came, less than 0, where there are probabilities.
    pub likelihood: Option<f64>,
    /// The mean distance of probabilities and shares of success over ten bins, weighted by their trials.
    pub calibration_error: Option<f64>,
    /// Trials of which the model knew nothing: they count as predicted to fail.
    pub unknown: usize,
}

/// Trials with about one probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// How many there are.
    pub trials: usize,
    /// Their mean probability of success.
    pub predicted: f64,
    /// The share that succeeded.
    pub succeeded: f64,
}

/// The fold of each row.
pub fn folds(table: &Table, parted: Folds) -> Result<Vec<usize>, EvaluateError> {
    let rows = table.len();
    match parted {
        Folds::Random(folds, seed) => {
            if folds < 2 || folds > rows {
                return Err(EvaluateError::Folds { folds, rows });
            }
            let mut order: Vec<usize> = (0..rows).collect();
            fastrand::Rng::with_seed(seed).shuffle(&mut order);
            let mut fold = vec![0; rows];
            for (place, row) in order.into_iter().enumerate() {
                fold[row] = place % folds;
            }
            Ok(fold)
        }
        Folds::Groups(groups) => {
            assert_eq!(groups.len(), rows, "each row has its group");
            let mut names = groups.to_vec();
            names.sort_unstable();
            names.dedup();
            if names.len() < 2 {
                return Err(EvaluateError::Folds { folds: names.len(), rows });
            }
            let place = |group: &u32| names.binary_search(group).expect("it is one of them");
            Ok(groups.iter().map(place).collect())
        }
    }
}

/// Predicts each trial by a network learned from the other folds. `learn` gives the graph, from the trials that may be seen; the
/// outcome is predicted from everything else that is measured.
pub fn network(
    table: &Table,
    outcome: Outcome,
    fold_of: &[usize],
    learn: &dyn Fn(&Table) -> Result<Dag, String>,
    estimator: Estimator,
) -> Result<Vec<Prediction>, EvaluateError> {
    check(table, outcome)?;
    each_fold(table, outcome, fold_of, &|seen, hidden| {
        let graph = learn(seen)?;
        let network =
            estimate(seen, &graph, estimator).map_err(|error: EstimateError| error.to_string())?;
        (0..hidden.len()).map(|row| Ok(success(&network, hidden, row, outcome))).collect()
    })
}

/// Predicts each trial to be what most trials of the other folds are.
pub fn majority(
    table: &Table,
    outcome: Outcome,
    fold_of: &[usize],
) -> Result<Vec<Prediction>, EvaluateError> {
    check(table, outcome)?;
    each_fold(table, outcome, fold_of, &|seen, hidden| {
        let column = seen.column(outcome.variable);
        let share = successes(seen, outcome) as f64 / column.len() as f64;
        Ok(vec![Some(share); hidden.len()])
    })
}

/// The probability of success given everything else: by Bayes's rule from the tables of the outcome and of its children. None where a
/// row that matters is unknown, or where the model holds the trial impossible.
fn success(network: &Network, table: &Table, row: usize, outcome: Outcome) -> Option<f64> {
    let target = outcome.variable;
    let children = network.ids().filter(|&id| network.graph().parents(id).contains(&target));
    let relevant: Vec<VariableId> = std::iter::once(target).chain(children).collect();
    let mut weights = Vec::with_capacity(network.variable(target).arity());
    for state in 0..network.variable(target).arity() as u16 {
        let state_of =
            |id: VariableId| if id == target { state as State } else { table.column(id)[row] };
        let mut weight = 1.0;
        for &id in &relevant {
            let parents: Vec<State> =
                network.graph().parents(id).iter().map(|&parent| state_of(parent)).collect();
            weight *= network.row(id, network.row_of(id, &parents))?[usize::from(state_of(id))];
        }
        weights.push(weight);
    }
    let sum: f64 = weights.iter().sum();
    (sum > 0.0).then(|| weights[usize::from(outcome.success)] / sum)
}

/// How many trials succeeded.
fn successes(table: &Table, outcome: Outcome) -> usize {
    table.column(outcome.variable).iter().map(|&state| usize::from(state == outcome.success)).sum()
}

/// Whether there is something to predict.
fn check(table: &Table, outcome: Outcome) -> Result<(), EvaluateError> {
    let column = table.column(outcome.variable);
    let successes = successes(table, outcome);
    let wrong = |what: &str| {
        let name = table.variable(outcome.variable).name.clone();
        Err(EvaluateError::Outcome { name, what: what.to_owned() })
    };
    match successes {
        0 => wrong("never succeeds in these trials"),
        all if all == column.len() => wrong("always succeeds in these trials"),
        _ => Ok(()),
    }
}

/// What is predicted of the trials of a fold from those of the others.
type Predictor<'a> = dyn Fn(&Table, &Table) -> Result<Vec<Option<f64>>, String> + 'a;

fn each_fold(
    table: &Table,
    outcome: Outcome,
    fold_of: &[usize],
    predict: &Predictor,
) -> Result<Vec<Prediction>, EvaluateError> {
    let folds = fold_of.iter().max().map_or(0, |last| last + 1);
    let mut predictions: Vec<Option<Prediction>> = vec![None; table.len()];
    for fold in 0..folds {
        let rows = |inside: bool| -> Vec<u32> {
            (0..table.len() as u32)
                .filter(|&row| (fold_of[row as usize] == fold) == inside)
                .collect()
        };
        let hidden = rows(true);
        let probabilities = predict(&table.select(&rows(false)), &table.select(&hidden))
            .map_err(|what| EvaluateError::Learn { fold: fold + 1, what })?;
        for (&row, probability) in hidden.iter().zip(probabilities) {
            predictions[row as usize] = Some(Prediction {
                fold,
                probability,
                predicted: probability.is_some_and(|probability| probability >= 0.5),
                succeeded: table.column(outcome.variable)[row as usize] == outcome.success,
            });
        }
    }
    Ok(predictions.into_iter().map(|one| one.expect("each row is in a fold")).collect())
}

impl Scores {
    /// Scores predictions.
    pub fn of(predictions: &[Prediction]) -> Self {
        let count = |predicted: bool, succeeded: bool| {
            predictions
                .iter()
                .filter(|one| one.predicted == predicted && one.succeeded == succeeded)
                .count() as f64
        };
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let (hits, misses, alarms) = (count(true, true), count(false, true), count(true, false));
        let (precision, recall) = (share(hits, hits + alarms), share(hits, hits + misses));
        let known: Vec<(f64, f64)> = predictions
            .iter()
            .filter_map(|one| Some((one.probability?, f64::from(u8::from(one.succeeded)))))
            .collect();
        let mean = |value: &dyn Fn(f64, f64) -> f64| {
            (!known.is_empty()).then(|| {
                known.iter().map(|&(p, came)| value(p, came)).sum::<f64>() / known.len() as f64
            })
        };
        let bins = calibration(predictions);
        let error = |bin: &Bin| bin.trials as f64 * (bin.predicted - bin.succeeded).abs();
        Self {
            trials: predictions.len(),
            accuracy: share(hits + count(false, false), predictions.len() as f64),
            precision,
            recall,
            f1: share(2.0 * precision * recall, precision + recall),
            brier: mean(&|p, came| (p - came) * (p - came)),
            likelihood: mean(&|p, came| if came > 0.5 { p.ln() } else { (1.0 - p).ln() }),
            calibration_error: (!known.is_empty())
                .then(|| bins.iter().map(error).sum::<f64>() / known.len() as f64),
            unknown: predictions.len() - known.len(),
        }
    }
}

/// Ten bins of probability, as far as there are trials in them.
pub fn calibration(predictions: &[Prediction]) -> Vec<Bin> {
    let bin_of = |probability: f64| ((probability * 10.0) as usize).min(9);
    (0..10)
        .filter_map(|bin| {
            let inside: Vec<(f64, bool)> = predictions
                .iter()
                .filter_map(|one| Some((one.probability?, one.succeeded)))
                .filter(|&(probability, _)| bin_of(probability) == bin)
                .collect();
            let trials = inside.len();
            (trials > 0).then(|| Bin {
                trials,
                predicted: inside.iter().map(|(probability, _)| probability).sum::<f64>()
                    / trials as f64,
                succeeded: inside.iter().filter(|(_, came)| *came).count() as f64 / trials as f64,
            })
        })
        .collect()
}

/// The interval that holds the probability of success with this chance, of which `successes` of `trials` are known and nothing before
/// (the central interval of a beta distribution with a uniform prior).
pub fn credible(successes: u64, trials: u64, chance: f64) -> (f64, f64) {
    let (a, b) = (successes as f64 + 1.0, (trials - successes) as f64 + 1.0);
    let tail = (1.0 - chance) / 2.0;
    (puruspe::invbetai(tail, a, b), puruspe::invbetai(1.0 - tail, a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variable::Variable;

    fn prediction(probability: f64, succeeded: bool) -> Prediction {
        Prediction {
            fold: 0,
            probability: Some(probability),
            predicted: probability >= 0.5,
            succeeded,
        }
    }

    #[test]
    fn scores_are_those_of_the_textbook() {
        let predictions = [(0.9, true), (0.8, true), (0.7, false), (0.2, true), (0.1, false)]
            .map(|(p, came)| prediction(p, came));
        let scores = Scores::of(&predictions);
        assert!((scores.accuracy - 0.6).abs() < 1e-12);
        assert!(
            (scores.precision - 2.0 / 3.0).abs() < 1e-12
                && (scores.recall - 2.0 / 3.0).abs() < 1e-12
        );
        assert!((scores.f1 - 2.0 / 3.0).abs() < 1e-12);
        let brier = (0.01 + 0.04 + 0.49 + 0.64 + 0.01) / 5.0;
        assert!((scores.brier.unwrap() - brier).abs() < 1e-12);
        assert_eq!(calibration(&predictions).len(), 5);
    }

    #[test]
    fn the_interval_of_a_share_is_that_of_a_beta_distribution() {
        // Quantiles of Beta(3, 2) and Beta(1, 4), as tables have them.
        let (low, high) = credible(2, 3, 0.95);
        assert!((low - 0.194_120).abs() < 1e-5 && (high - 0.932_414).abs() < 1e-5, "{low} {high}");
        let (low, high) = credible(0, 3, 0.95);
        assert!((low - 0.006_309).abs() < 1e-5 && (high - 0.602_365).abs() < 1e-5, "{low} {high}");
    }

    /// Success where `cause` is 1, in nine of ten trials.
    fn trials() -> Table {
        let rows = 400;
        let mut random = fastrand::Rng::with_seed(1);
        let cause: Vec<u8> = (0..rows).map(|_| random.u8(..2)).collect();
        let noise: Vec<u8> = (0..rows).map(|_| random.u8(..3)).collect();
        let outcome =
            cause.iter().map(|&one| if random.f64() < 0.9 { one } else { 1 - one }).collect();
        let variables = vec![
            Variable::of_words("cause", ["0", "1"]),
            Variable::of_words("noise", ["a", "b", "c"]),
            Variable::of_words("outcome", ["0", "1"]),
        ];
        Table::new(variables, vec![cause, noise, outcome]).unwrap()
    }

    #[test]
    fn a_network_and_a_forest_predict_and_the_majority_does_not() {
        let table = trials();
        let outcome = Outcome { variable: VariableId(2), success: 1 };
        let fold_of = folds(&table, Folds::Random(5, 7)).unwrap();
        let graph = Dag::of_arcs(3, [(VariableId(0), VariableId(2))]).unwrap();
        let learn = |_: &Table| Ok(graph.clone());
        let ours = network(&table, outcome, &fold_of, &learn, Estimator::Bdeu(1.0)).unwrap();
        assert!(Scores::of(&ours).accuracy > 0.85);
        assert!(Scores::of(&ours).calibration_error.unwrap() < 0.05);
        assert_eq!(ours, network(&table, outcome, &fold_of, &learn, Estimator::Bdeu(1.0)).unwrap());
        let forest = forest::forest(&table, outcome, &fold_of, 3).unwrap();
        assert!(Scores::of(&forest.predictions).accuracy > 0.85);
        assert!(Scores::of(&majority(&table, outcome, &fold_of).unwrap()).accuracy < 0.7);
        // From effect to cause: by Bayes's rule.
        let turned = Dag::of_arcs(3, [(VariableId(2), VariableId(0))]).unwrap();
        let back =
            network(&table, outcome, &fold_of, &|_| Ok(turned.clone()), Estimator::Bdeu(1.0))
                .unwrap();
        assert!(Scores::of(&back).accuracy > 0.85);
    }

    #[test]
    fn what_cannot_be_evaluated_is_said() {
        let table = trials();
        let fold_of = folds(&table, Folds::Random(5, 7)).unwrap();
        let rows: Vec<u32> =
            (0..400).filter(|&row| table.column(VariableId(2))[row as usize] == 0).collect();
        let outcome = Outcome { variable: VariableId(2), success: 1 };
        let error = majority(&table.select(&rows), outcome, &fold_of[..rows.len()]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "`outcome` never succeeds in these trials, so that there is nothing to predict"
        );
        let error = folds(&table, Folds::Random(1, 0)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "1 folds of 400 trials; there should be 2 folds or more, and a trial in each"
        );
        assert!(folds(&table, Folds::Groups(&vec![4; 400])).is_err());
    }
}
