//! Continuous trials go in; a weighted linear graph comes out: NOTEARS (Zheng et al. 2018, "DAGs with NO TEARS: continuous optimization
//! for structure learning"), for data that nobody wants to cut into states.
//!
//! The weights `W` minimise half the mean squared error of predicting each variable from the others, with an L1 penalty, where
//! `h(W) = tr exp(W ∘ W) - d` is zero: exactly then the graph has no cycle. The constraint is met by an augmented Lagrangian (equation 13
//! there); the penalty by writing `W` as a difference of two matrices that are not negative; each problem in between is solved by projected
//! steps whose length Barzilai and Borwein (1988) choose.

use nalgebra::DMatrix;
use thiserror::Error;

use crate::graph::Dag;
use crate::variable::VariableId;

/// How to learn.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// What each unit of weight costs.
    pub penalty: f64,
    /// Weights smaller than this are no arcs.
    pub threshold: f64,
    /// How near to a graph without cycles is near enough.
    pub tolerance: f64,
}

impl Default for Config {
    fn default() -> Self {
        Self { penalty: 0.1, threshold: 0.3, tolerance: 1e-8 }
    }
}

/// What was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear {
    /// The graph.
    pub graph: Dag,
    /// The weight of each arc: row the cause, column the effect. Zero where there is none.
    pub weights: DMatrix<f64>,
}

/// Why nothing was learned.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LinearError {
    /// Columns without rows, or of different lengths, or fewer than two.
    #[error("two columns or more of one length are needed, with two rows or more")]
    Shape,
    /// A value that is no finite number.
    #[error("column {0} holds a value that is no finite number")]
    Value(usize),
    /// The iteration came to no graph.
    #[error("no graph without a cycle was reached; a larger penalty or threshold may help")]
    NoGraph,
}

/// Rounds of the augmented Lagrangian, and steps in each.
const ROUNDS: usize = 100;
const STEPS: usize = 2000;
/// The multiplier of the squared constraint grows to this at most.
const MOST_RHO: f64 = 1e16;

/// Learns a linear graph over columns, which are centred first; their scale is theirs, and matters.
pub fn learn(columns: &[Vec<f64>], config: &Config) -> Result<Linear, LinearError> {
    let (many, rows) = (columns.len(), columns.first().map_or(0, Vec::len));
    if many < 2 || rows < 2 || columns.iter().any(|column| column.len() != rows) {
        return Err(LinearError::Shape);
    }
    if let Some(bad) =
        columns.iter().position(|column| column.iter().any(|value| !value.is_finite()))
    {
        return Err(LinearError::Value(bad));
    }
    let data = DMatrix::from_fn(rows, many, |row, column| columns[column][row]);
    let means = data.row_mean();
    let centred = DMatrix::from_fn(rows, many, |row, column| data[(row, column)] - means[column]);
    // All that the loss needs of the data.
    let covariance = centred.transpose() * &centred / rows as f64;
    let mut problem = Problem { covariance, penalty: config.penalty, alpha: 0.0, rho: 1.0 };
    let mut halves = [DMatrix::zeros(many, many), DMatrix::zeros(many, many)];
    let mut before = f64::INFINITY;
    for _ in 0..ROUNDS {
        let tried = problem.minimise(halves.clone());
        let (constraint, _) = acyclicity(&(&tried[0] - &tried[1]));
        if constraint > 0.25 * before && problem.rho < MOST_RHO {
            problem.rho *= 10.0;
            continue;
        }
        halves = tried;
        before = constraint;
        problem.alpha += problem.rho * constraint;
        if constraint <= config.tolerance {
            break;
        }
    }
    let weights = (&halves[0] - &halves[1])
        .map(|weight| if weight.abs() < config.threshold { 0.0 } else { weight });
    let mut arcs = Vec::new();
    for from in 0..many {
        for to in 0..many {
            if weights[(from, to)] != 0.0 {
                arcs.push((VariableId(from as u16), VariableId(to as u16)));
            }
        }
    }
    let graph = Dag::of_arcs(many, arcs).map_err(|_| LinearError::NoGraph)?;
    Ok(Linear { graph, weights })
}

/// How far weights are from a graph without cycles, and the gradient of that.
fn acyclicity(weights: &DMatrix<f64>) -> (f64, DMatrix<f64>) {
    let exponential = weights.component_mul(weights).exp();
    let gradient = exponential.transpose().component_mul(weights) * 2.0;
    (exponential.trace() - weights.nrows() as f64, gradient)
}

/// What is minimised between two changes of the multipliers.
struct Problem {
    covariance: DMatrix<f64>,
    penalty: f64,
    alpha: f64,
    rho: f64,
}

impl Problem {
    /// The value at two halves, and the gradient in each.
    fn value(&self, halves: &[DMatrix<f64>; 2]) -> (f64, [DMatrix<f64>; 2]) {
        let many = self.covariance.nrows();
        let weights = &halves[0] - &halves[1];
        let rest = DMatrix::identity(many, many) - &weights;
        let pushed = &self.covariance * &rest;
        let loss = 0.5 * (rest.transpose() * &pushed).trace();
        let (constraint, slope) = acyclicity(&weights);
        let l1: f64 = halves.iter().map(DMatrix::sum).sum();
        let value = loss
            + self.alpha * constraint
            + 0.5 * self.rho * constraint * constraint
            + self.penalty * l1;
        let smooth = -pushed + slope * (self.alpha + self.rho * constraint);
        let gradients =
            [smooth.map(|one| one + self.penalty), smooth.map(|one| self.penalty - one)];
        (value, gradients)
    }

    /// Steps along the gradient, back to what is not negative, as long as that helps.
    fn minimise(&self, mut halves: [DMatrix<f64>; 2]) -> [DMatrix<f64>; 2] {
        let (mut value, mut gradients) = self.value(&halves);
        let mut length = 1e-2;
        for _ in 0..STEPS {
            let mut step: f64 = length;
            let next = loop {
                let moved = [0, 1].map(|half| stepped(&halves[half], &gradients[half], step));
                let (reached, slopes) = self.value(&moved);
                let change: f64 =
                    (0..2).map(|half| (&moved[half] - &halves[half]).norm_squared()).sum();
                // Armijo's rule for projected steps.
                if reached <= value - 1e-4 * change / step {
                    break Some((moved, reached, slopes, change));
                }
                step /= 2.0;
                if step < 1e-18 {
                    break None;
                }
            };
            let Some((moved, reached, slopes, change)) = next else { break };
            let turned: f64 = (0..2)
                .map(|half| (&moved[half] - &halves[half]).dot(&(&slopes[half] - &gradients[half])))
                .sum();
            length = if turned > 0.0 { (change / turned).clamp(1e-12, 1e6) } else { step * 2.0 };
            let gained = value - reached;
            (halves, value, gradients) = (moved, reached, slopes);
            if gained <= 1e-12 * (1.0 + value.abs()) {
                break;
            }
        }
        halves
    }
}

/// A step against a gradient; weights stay above zero, and nothing causes itself.
fn stepped(half: &DMatrix<f64>, gradient: &DMatrix<f64>, length: f64) -> DMatrix<f64> {
    DMatrix::from_fn(half.nrows(), half.ncols(), |row, column| {
        if row == column {
            0.0
        } else {
            (half[(row, column)] - length * gradient[(row, column)]).max(0.0)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of a linear graph a -> c <- b, c -> d with noise of one size, as the method assumes.
    fn columns() -> Vec<Vec<f64>> {
        let mut random = fastrand::Rng::with_seed(4);
        let mut normal = || (0..12).map(|_| random.f64()).sum::<f64>() - 6.0;
        let mut columns = vec![Vec::new(); 4];
        for _ in 0..1500 {
            let (a, b) = (normal(), normal());
            let c = 1.5 * a - 1.2 * b + normal();
            let d = 0.9 * c + normal();
            for (column, value) in columns.iter_mut().zip([a, b, c, d]) {
                column.push(value + 7.0);
            }
        }
        columns
    }

    #[test]
    fn a_linear_graph_is_found_with_its_weights() {
        let found = learn(&columns(), &Config::default()).unwrap();
        let arcs: Vec<(u16, u16)> = found.graph.arcs().map(|(from, to)| (from.0, to.0)).collect();
        assert_eq!(arcs, [(0, 2), (1, 2), (2, 3)]);
        assert!(
            (found.weights[(0, 2)] - 1.5).abs() < 0.2 && (found.weights[(1, 2)] + 1.2).abs() < 0.2
        );
        let mut turned = columns();
        turned.reverse();
        let turned = learn(&turned, &Config::default()).unwrap();
        let arcs: Vec<(u16, u16)> =
            turned.graph.arcs().map(|(from, to)| (3 - from.0, 3 - to.0)).collect();
        assert_eq!(arcs, [(2, 3), (1, 2), (0, 2)], "the order of columns does not matter");
    }

    #[test]
    fn the_constraint_is_zero_exactly_without_cycles() {
        let forward = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 0.0, 0.0]);
        let both = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 0.5, 0.0]);
        assert!(acyclicity(&forward).0.abs() < 1e-12);
        assert!(acyclicity(&both).0 > 0.1);
    }

    #[test]
    fn what_is_no_table_is_refused() {
        assert_eq!(learn(&[vec![1.0, 2.0]], &Config::default()), Err(LinearError::Shape));
        assert_eq!(
            learn(&[vec![1.0, 2.0], vec![1.0, f64::NAN]], &Config::default()),
            Err(LinearError::Value(1))
        );
    }
}
