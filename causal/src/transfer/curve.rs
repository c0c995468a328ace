//! A prior and trials go in; how well success is predicted with ever more trials comes out, beside the same without the prior.
//!
//! Without a prior a row that no trial shows counts as one half, as in the thesis's comparison; so does a row that neither a trial nor the
//! prior knows. Whoever acts on such a number goes ahead: only where success is less probable than failure is there a reason not to.

use thiserror::Error;

use super::{Ends, Prior, Strategy, TransferError, prior, relation::Relation};
use crate::estimate::weighted;
use crate::table::Table;
use crate::variable::{State, VariableId};

/// Rows with fewer trials of the test than this have no share that a probability could be compared with.
pub const LEAST: u64 = 10;

/// What is compared.
#[derive(Debug, Clone, Copy)]
pub struct Study<'a> {
    /// From where to where.
    pub ends: Ends<'a>,
    /// Which variable stands for which.
    pub relation: &'a Relation,
    /// The strategies.
    pub strategies: &'a [Strategy],
    /// What the prior is worth, in trials for each row.
    pub weights: &'a [f64],
    /// How many trials the target has.
    pub sizes: &'a [usize],
    /// The trials from which those are drawn, over the variables of [`columns`].
    pub trials: Option<&'a Table>,
    /// How often they are drawn anew; all numbers are means.
    pub repeats: usize,
    /// What chance does.
    pub seed: u64,
    /// The trials that are predicted, over the same variables.
    pub test: &'a Table,
}

/// How good the predictions of one model are.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The strategy; none for the target's own trials alone.
    pub strategy: Option<Strategy>,
    /// What the prior is worth.
    pub weight: f64,
    /// How many trials the target has.
    pub trials: usize,
    /// How good they are.
    pub measures: Measures,
}

/// How good predictions are.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measures {
    /// The share of the test that comes as predicted.
    pub accuracy: f64,
    /// The mean squared difference of probability and outcome.
    pub brier: f64,
    /// The mean distance of the probabilities of success from the shares of the test, over rows with [`LEAST`] trials or more; none where
    /// there is no such row.
    pub difference: Option<f64>,
    /// How many rows that are.
    pub compared: u32,
    /// Of the trials that fail the share that does not take place where one acts only if success is not the less probable; none where no
    /// trial fails.
    pub avoided: Option<f64>,
    /// Of the trials that succeed the share that does not take place either; none where none succeeds.
    pub given_up: Option<f64>,
    /// The share of the test of which nothing is known.
    pub unknown: f64,
}

/// Why nothing can be compared.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// Nothing to predict.
    #[error("there is no trial to predict")]
    Test,
    /// More trials than there are.
    #[error("a curve up to {asked} trials needs as many, and there are {found}")]
    Trials {
        /// How many are asked for.
        asked: usize,
        /// How many there are.
        found: usize,
    },
    /// No draw at all.
    #[error("the trials should be drawn once or more often")]
    Repeats,
    /// The prior failed.
    #[error(transparent)]
    Transfer(#[from] TransferError),
}

/// The variables of the target that matter: the causes of its goal, and the goal.
pub fn columns(ends: &Ends) -> Vec<VariableId> {
    let goal = ends.target_goal.0;
    ends.target.graph().parents(goal).iter().copied().chain([goal]).collect()
}

/// Compares priors with each other and with none, size by size, and for each the target's own trials first.
pub fn curve(study: &Study) -> Result<Vec<Point>, CurveError> {
    if study.test.is_empty() {
        return Err(CurveError::Test);
    }
    if study.repeats == 0 {
        return Err(CurveError::Repeats);
    }
    let found = study.trials.map_or(0, Table::len);
    if let Some(&asked) = study.sizes.iter().max().filter(|&&most| most > found) {
        return Err(CurveError::Trials { asked, found });
    }
    if let Some(&weight) = study.weights.iter().find(|one| !one.is_finite() || **one < 0.0) {
        return Err(TransferError::Weight(weight).into());
    }
    let priors = study
        .strategies
        .iter()
        .map(|&strategy| prior(&study.ends, study.relation, strategy))
        .collect::<Result<Vec<Prior>, _>>()?;
    let rows = study
        .ends
        .target
        .rows(study.ends.target_goal.0)
        .expect("the rows of a network are numbered");
    let success = study.ends.target_goal.1;
    let test = Test::of(study.test, rows, success);
    let own = study.trials.map(|table| (rows_of(table), succeeded(table, success)));
    let mut orders: Vec<Vec<usize>> = Vec::new();
    for repeat in 0..study.repeats as u64 {
        let mut order: Vec<usize> = (0..found).collect();
        fastrand::Rng::with_seed(study.seed.wrapping_add(repeat)).shuffle(&mut order);
        orders.push(order);
    }
    let mut points = Vec::new();
    for &size in study.sizes {
        let counts: Vec<Vec<(u64, u64)>> = orders
            .iter()
            .map(|order| {
                let mut counts = vec![(0, 0); rows];
                if let Some((places, outcomes)) = &own {
                    for &trial in &order[..size] {
                        let (successes, total) = &mut counts[places[trial]];
                        *successes += u64::from(outcomes[trial]);
                        *total += 1;
                    }
                }
                counts
            })
            .collect();
        let mut point = |strategy: Option<(Strategy, &Prior)>, weight: f64| {
            let measured: Vec<Measures> = counts
                .iter()
                .map(|counts| {
                    let row = |row: usize| {
                        let (successes, total) = counts[row];
                        let before = strategy.and_then(|(_, prior)| prior.rows[row].as_ref());
                        let weight = if before.is_some() { weight } else { 0.0 };
                        let before = before.map_or(0.5, |before| before[usize::from(success)]);
                        (weight > 0.0 || total > 0)
                            .then(|| weighted(weight, before, successes, total))
                    };
                    test.measure(&(0..rows).map(row).collect::<Vec<_>>())
                })
                .collect();
            points.push(Point {
                strategy: strategy.map(|(strategy, _)| strategy),
                weight,
                trials: size,
                measures: Measures::mean(&measured),
            });
        };
        point(None, 0.0);
        for (&strategy, prior) in study.strategies.iter().zip(&priors) {
            // A prior that is worth nothing is none: that point is the first one.
            for &weight in study.weights.iter().filter(|&&weight| weight > 0.0) {
                point(Some((strategy, prior)), weight);
            }
        }
    }
    Ok(points)
}

/// The row of each trial of a table whose last column is the goal.
fn rows_of(table: &Table) -> Vec<usize> {
    let causes: Vec<VariableId> = table.ids().take(table.variables().len() - 1).collect();
    (0..table.len())
        .map(|trial| {
            causes.iter().fold(0, |row, &id| {
                row * table.variable(id).arity() + usize::from(table.column(id)[trial])
            })
        })
        .collect()
}

/// Whether each trial succeeded.
fn succeeded(table: &Table, success: State) -> Vec<bool> {
    let goal = VariableId(table.variables().len() as u16 - 1);
    table.column(goal).iter().map(|&state| state == success).collect()
}

/// The test as counts: for each row how many trials succeed, and how many there are.
struct Test {
    counts: Vec<(u64, u64)>,
    trials: u64,
}

impl Test {
    fn of(table: &Table, rows: usize, success: State) -> Self {
        let mut counts = vec![(0, 0); rows];
        for (row, succeeded) in rows_of(table).into_iter().zip(succeeded(table, success)) {
            counts[row].0 += u64::from(succeeded);
            counts[row].1 += 1;
        }
        Self { counts, trials: table.len() as u64 }
    }

    /// Measures the probabilities of success of all rows.
    fn measure(&self, rows: &[Option<f64>]) -> Measures {
        let (mut right, mut unknown, mut brier) = (0, 0, 0.0);
        let (mut failures, mut avoided, mut successes, mut given_up) = (0, 0, 0, 0);
        let (mut compared, mut difference) = (0_u32, 0.0);
        for (&(good, all), &known) in self.counts.iter().zip(rows) {
            let bad = all - good;
            let probability = known.unwrap_or(0.5);
            unknown += if known.is_none() { all } else { 0 };
            brier += good as f64 * (1.0 - probability).powi(2) + bad as f64 * probability.powi(2);
            (successes, failures) = (successes + good, failures + bad);
            if probability < 0.5 {
                (right, avoided, given_up) = (right + bad, avoided + bad, given_up + good);
            } else {
                right += good;
            }
            if all >= LEAST {
                compared += 1;
                difference += (probability - good as f64 / all as f64).abs();
            }
        }
        let share = |part: u64, whole: u64| (whole > 0).then(|| part as f64 / whole as f64);
        let all = self.trials as f64;
        Measures {
            accuracy: right as f64 / all,
            brier: brier / all,
            difference: (compared > 0).then(|| difference / f64::from(compared)),
            compared,
            avoided: share(avoided, failures),
            given_up: share(given_up, successes),
            unknown: unknown as f64 / all,
        }
    }
}

impl Measures {
    /// Their means; what is known is known of all of them, since the test is one.
    fn mean(all: &[Self]) -> Self {
        let count = all.len() as f64;
        let mean = |value: &dyn Fn(&Self) -> f64| all.iter().map(value).sum::<f64>() / count;
        let known = |value: &dyn Fn(&Self) -> Option<f64>| -> Option<f64> {
            let values: Option<Vec<f64>> = all.iter().map(value).collect();
            Some(values?.iter().sum::<f64>() / count)
        };
        Self {
            accuracy: mean(&|one| one.accuracy),
            brier: mean(&|one| one.brier),
            difference: known(&|one| one.difference),
            compared: all.first().map_or(0, |one| one.compared),
            avoided: known(&|one| one.avoided),
            given_up: known(&|one| one.given_up),
            unknown: mean(&|one| one.unknown),
        }
    }
}
