//! A random forest beside the network, as the thesis has one (table 2.4): the same features and the same folds. The forest itself is
//! smartcore's.

use rayon::prelude::*;
use smartcore::ensemble::random_forest_classifier::{
    RandomForestClassifier, RandomForestClassifierParameters,
};
use smartcore::linalg::basic::matrix::DenseMatrix;

use super::{EvaluateError, Outcome, Prediction, Scores, check};
use crate::table::Table;
use crate::variable::{States, VariableId};

/// What a forest predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct Forest {
    /// The predictions; a forest has no probabilities.
    pub predictions: Vec<Prediction>,
    /// How it was tuned, fold by fold.
    pub tuned: Vec<Tuning>,
}

/// How a forest is grown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tuning {
    /// How many trees.
    pub trees: u16,
    /// How deep they may be.
    pub depth: Option<u16>,
    /// Whether each split may look at all features, and not only at the square root of their number.
    pub all_features: bool,
}

/// What is tried in each fold, on a fourth of what may be seen.
const TREES: [u16; 2] = [50, 150];
const DEPTHS: [Option<u16>; 3] = [Some(4), Some(8), None];

fn tunings() -> impl Iterator<Item = Tuning> {
    let depths = |trees| DEPTHS.into_iter().map(move |depth| (trees, depth));
    TREES.into_iter().flat_map(depths).flat_map(|(trees, depth)| {
        [false, true].map(|all_features| Tuning { trees, depth, all_features })
    })
}

/// Predicts each trial by a forest learned from the other folds: ordered states by their numbers, categories by a column for each.
pub fn forest(
    table: &Table,
    outcome: Outcome,
    fold_of: &[usize],
    seed: u64,
) -> Result<Forest, EvaluateError> {
    check(table, outcome)?;
    let features = features(table, outcome.variable);
    let came: Vec<u32> = table
        .column(outcome.variable)
        .iter()
        .map(|&state| u32::from(state == outcome.success))
        .collect();
    let folds = fold_of.iter().max().map_or(0, |last| last + 1);
    let of_folds = (0..folds)
        .into_par_iter()
        .map(|fold| one_fold(&features, &came, fold_of, fold, seed))
        .collect::<Result<Vec<_>, _>>()?;
    let mut predictions: Vec<Option<Prediction>> = vec![None; table.len()];
    let mut tuned = Vec::with_capacity(folds);
    for (tuning, rows) in of_folds {
        tuned.push(tuning);
        for (row, prediction) in rows {
            predictions[row] = Some(prediction);
        }
    }
    let predictions =
        predictions.into_iter().map(|one| one.expect("each row is in a fold")).collect();
    Ok(Forest { predictions, tuned })
}

/// How the forest of a fold was tuned, and what it predicts of the fold's rows.
fn one_fold(
    features: &[Vec<f64>],
    came: &[u32],
    fold_of: &[usize],
    fold: usize,
    seed: u64,
) -> Result<(Tuning, Vec<(usize, Prediction)>), EvaluateError> {
    let failed = |what: String| EvaluateError::Learn { fold: fold + 1, what };
    let seen: Vec<usize> = (0..came.len()).filter(|&row| fold_of[row] != fold).collect();
    let hidden: Vec<usize> = (0..came.len()).filter(|&row| fold_of[row] == fold).collect();
    let (tried, held): (Vec<usize>, Vec<usize>) = seen.iter().partition(|row| *row % 4 != 0);
    let mut best: Option<(f64, Tuning)> = None;
    for tuning in tunings() {
        let found = predict(features, came, &tried, &held, tuning, seed).map_err(failed)?;
        let f1 = Scores::of(&judged(&held, &found, came, fold)).f1;
        if best.is_none_or(|(highest, _)| f1 > highest) {
            best = Some((f1, tuning));
        }
    }
    let (_, chosen) = best.expect("some were tried");
    let found = predict(features, came, &seen, &hidden, chosen, seed).map_err(failed)?;
    let predictions = judged(&hidden, &found, came, fold);
    Ok((chosen, hidden.into_iter().zip(predictions).collect()))
}

/// A row of numbers for each trial.
fn features(table: &Table, outcome: VariableId) -> Vec<Vec<f64>> {
    let mut rows = vec![Vec::new(); table.len()];
    for id in table.ids().filter(|&id| id != outcome) {
        let variable = table.variable(id);
        let ordered = matches!(variable.states, States::Intervals(_)) || variable.arity() == 2;
        for (row, &state) in rows.iter_mut().zip(table.column(id)) {
            if ordered {
                row.push(f64::from(state));
            } else {
                let indicator = |one| f64::from(u8::from(one == usize::from(state)));
                row.extend((0..variable.arity()).map(indicator));
            }
        }
    }
    rows
}

fn predict(
    features: &[Vec<f64>],
    came: &[u32],
    seen: &[usize],
    hidden: &[usize],
    tuning: Tuning,
    seed: u64,
) -> Result<Vec<u32>, String> {
    let matrix = |rows: &[usize]| {
        let rows: Vec<Vec<f64>> = rows.iter().map(|&row| features[row].clone()).collect();
        DenseMatrix::from_2d_vec(&rows).map_err(|error| error.to_string())
    };
    let mut parameters =
        RandomForestClassifierParameters::default().with_n_trees(tuning.trees).with_seed(seed);
    parameters.max_depth = tuning.depth;
    parameters.m = tuning.all_features.then(|| features.first().map_or(1, Vec::len));
    let labels: Vec<u32> = seen.iter().map(|&row| came[row]).collect();
    let forest = RandomForestClassifier::fit(&matrix(seen)?, &labels, parameters)
        .map_err(|error| error.to_string())?;
    forest.predict(&matrix(hidden)?).map_err(|error| error.to_string())
}

fn judged(rows: &[usize], found: &[u32], came: &[u32], fold: usize) -> Vec<Prediction> {
    let one = |(&row, &predicted): (&usize, &u32)| Prediction {
        fold,
        probability: None,
        predicted: predicted == 1,
        succeeded: came[row] == 1,
    };
    rows.iter().zip(found).map(one).collect()
}
