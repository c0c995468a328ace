//! A random forest beside the network, as the thesis has one (table 2.4): the same features and the same folds. The forest itself is
//! smartcore's.

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
    /// How it was tuned, for each fold: the number of trees and the depth.
    pub tuned: Vec<(u16, Option<u16>)>,
}

/// What is tried in each fold, on a fourth of what may be seen.
const TREES: [u16; 2] = [50, 150];
const DEPTHS: [Option<u16>; 3] = [Some(4), Some(8), None];

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
    let mut predictions: Vec<Option<Prediction>> = vec![None; table.len()];
    let mut tuned = Vec::with_capacity(folds);
    for fold in 0..folds {
        let failed = |what: String| EvaluateError::Learn { fold: fold + 1, what };
        let seen: Vec<usize> = (0..table.len()).filter(|&row| fold_of[row] != fold).collect();
        let hidden: Vec<usize> = (0..table.len()).filter(|&row| fold_of[row] == fold).collect();
        let (tried, held): (Vec<usize>, Vec<usize>) = seen.iter().partition(|row| *row % 4 != 0);
        let mut best: Option<(f64, (u16, Option<u16>))> = None;
        for trees in TREES {
            for depth in DEPTHS {
                let found = predict(&features, &came, &tried, &held, (trees, depth), seed)
                    .map_err(failed)?;
                let f1 = Scores::of(&judged(&held, &found, &came, fold)).f1;
                if best.is_none_or(|(highest, _)| f1 > highest) {
                    best = Some((f1, (trees, depth)));
                }
            }
        }
        let (_, chosen) = best.expect("some were tried");
        tuned.push(chosen);
        let found = predict(&features, &came, &seen, &hidden, chosen, seed).map_err(failed)?;
        for (&row, prediction) in hidden.iter().zip(judged(&hidden, &found, &came, fold)) {
            predictions[row] = Some(prediction);
        }
    }
    let predictions =
        predictions.into_iter().map(|one| one.expect("each row is in a fold")).collect();
    Ok(Forest { predictions, tuned })
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
    (trees, depth): (u16, Option<u16>),
    seed: u64,
) -> Result<Vec<u32>, String> {
    let matrix = |rows: &[usize]| {
        let rows: Vec<Vec<f64>> = rows.iter().map(|&row| features[row].clone()).collect();
        DenseMatrix::from_2d_vec(&rows).map_err(|error| error.to_string())
    };
    let mut parameters =
        RandomForestClassifierParameters::default().with_n_trees(trees).with_seed(seed);
    parameters.max_depth = depth;
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
