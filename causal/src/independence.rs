//! Counts go in; whether two variables are independent given others comes out.

use std::cell::RefCell;

use rustc_hash::FxHashMap;

use crate::count::{CountError, Counter};
use crate::set::Set;
use crate::variable::VariableId;

/// A test of independence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Test {
    /// The likelihood ratio: twice the number of trials times the mutual information.
    G2,
    /// Pearson's.
    X2,
    /// The mutual information itself; its p-value is that of [`Test::G2`], its strength is in nats.
    MutualInformation,
}

impl Test {
    /// All of them, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::G2, Self::X2, Self::MutualInformation];

    /// What it is called on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::G2 => "g2",
            Self::X2 => "x2",
            Self::MutualInformation => "mutual-information",
        }
    }

    /// What it is, in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            Self::G2 => "The likelihood ratio",
            Self::X2 => "Pearson's chi-square",
            Self::MutualInformation => "Mutual information",
        }
    }
}

/// What a test says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// The probability of a dependence that looks as strong or stronger, were there none.
    pub p: f64,
    /// The statistic, or the mutual information.
    pub strength: f64,
    /// Degrees of freedom: over combinations of the other variables that occur, of the states that occur there.
    pub freedom: u64,
}

/// Tests pairs of variables, and keeps what was found.
pub struct Tester<'a> {
    counter: &'a dyn Counter,
    test: Test,
    known: RefCell<FxHashMap<(VariableId, VariableId, Set), Verdict>>,
    failed: RefCell<Option<CountError>>,
}

/// As many cells as there may be for each trial.
const CELLS_FOR_A_TRIAL: u64 = 8;

/// What is said where nothing can be: too many combinations of states, or no trials in them.
const UNKNOWN: Verdict = Verdict { p: 1.0, strength: 0.0, freedom: 0 };

impl<'a> Tester<'a> {
    /// Tests what `counter` counts.
    pub fn new(counter: &'a dyn Counter, test: Test) -> Self {
        Self { counter, test, known: RefCell::default(), failed: RefCell::default() }
    }

    /// How many tests were made.
    pub fn asked(&self) -> usize {
        self.known.borrow().len()
    }

    /// Why counting failed, if it did.
    pub fn failure(&self) -> Option<CountError> {
        self.failed.borrow().clone()
    }

    /// Tests two variables given others.
    pub fn test(&self, one: VariableId, other: VariableId, given: Set) -> Verdict {
        let key = (one.min(other), one.max(other), given);
        if let Some(&verdict) = self.known.borrow().get(&key) {
            return verdict;
        }
        self.prepare(&[key]);
        self.known.borrow()[&key]
    }

    /// Makes several tests in one reading of the data.
    pub fn prepare(&self, tests: &[(VariableId, VariableId, Set)]) {
        let variables = self.counter.variables();
        let mut fresh = Vec::new();
        let mut sets = Vec::new();
        for &(one, other, given) in tests {
            let key = (one.min(other), one.max(other), given);
            if self.known.borrow().contains_key(&key) {
                continue;
            }
            let mut set = given.list();
            set.extend([key.0, key.1]);
            // With far more cells than trials nothing can be told, and nothing is worth counting.
            let cells = crate::count::cells(variables, &set);
            if cells.is_ok_and(|cells| {
                cells as u64 <= self.counter.rows().saturating_mul(CELLS_FOR_A_TRIAL)
            }) {
                fresh.push(key);
                sets.push(set);
            } else {
                self.known.borrow_mut().insert(key, UNKNOWN);
            }
        }
        if fresh.is_empty() {
            return;
        }
        let counts = self.counter.count(&sets);
        let mut known = self.known.borrow_mut();
        match counts {
            Ok(counts) => {
                for (key, counts) in fresh.into_iter().zip(counts) {
                    let (rows, columns) =
                        (variables[key.0.index()].arity(), variables[key.1.index()].arity());
                    known.insert(key, judge(self.test, &counts, rows, columns));
                }
            }
            Err(error) => {
                self.failed.borrow_mut().get_or_insert(error);
                known.extend(fresh.into_iter().map(|key| (key, UNKNOWN)));
            }
        }
    }
}

/// Tests counts that are tables of `rows` times `columns`, one after another.
fn judge(test: Test, counts: &[u64], rows: usize, columns: usize) -> Verdict {
    let mut statistic = 0.0;
    let mut freedom = 0;
    let mut trials = 0;
    let (mut by_row, mut by_column) = (vec![0_u64; rows], vec![0_u64; columns]);
    for table in counts.chunks_exact(rows * columns) {
        by_row.fill(0);
        by_column.fill(0);
        for (row, cells) in table.chunks_exact(columns).enumerate() {
            for (column, &count) in cells.iter().enumerate() {
                by_row[row] += count;
                by_column[column] += count;
            }
        }
        let total: u64 = by_row.iter().sum();
        if total == 0 {
            continue;
        }
        trials += total;
        let occur = |totals: &[u64]| totals.iter().filter(|&&total| total > 0).count() as u64;
        freedom += (occur(&by_row) - 1) * (occur(&by_column) - 1);
        for (row, cells) in table.chunks_exact(columns).enumerate() {
            for (column, &count) in cells.iter().enumerate() {
                let expected = by_row[row] as f64 * by_column[column] as f64 / total as f64;
                if expected > 0.0 {
                    let count = count as f64;
                    statistic += match test {
                        Test::X2 => (count - expected) * (count - expected) / expected,
                        _ if count > 0.0 => 2.0 * count * (count / expected).ln(),
                        _ => 0.0,
                    };
                }
            }
        }
    }
    let statistic = statistic.max(0.0);
    let p = survival(statistic, freedom);
    let strength = match test {
        Test::MutualInformation => statistic / (2.0 * trials.max(1) as f64),
        _ => statistic,
    };
    Verdict { p, strength, freedom }
}

/// The probability that a chi-square variable with these degrees of freedom exceeds a value.
pub fn survival(value: f64, freedom: u64) -> f64 {
    if freedom == 0 || value <= 0.0 {
        return 1.0;
    }
    puruspe::gammq(freedom as f64 / 2.0, value / 2.0).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Table;
    use crate::variable::Variable;

    #[test]
    fn the_tail_of_chi_square_is_known() {
        // Values of tables: P(X > x) for 1, 2, 10 and 100 degrees of freedom.
        for (value, freedom, p) in [
            (3.841_458_820_694_124, 1, 0.05),
            (9.210_340_371_976_182, 2, 0.01),
            (18.307_038_053_275_146, 10, 0.05),
            (135.806_723_171_025_37, 100, 0.01),
            (1.0, 1, 0.317_310_507_862_914_15),
        ] {
            let found = survival(value, freedom);
            assert!((found - p).abs() < 1e-10, "{value} {freedom}: {found} is not {p}");
        }
        assert!(survival(2000.0, 3) < 1e-100);
    }

    #[test]
    fn a_test_counts_only_states_that_occur() {
        // Two states of the first variable occur, two of the second's three.
        let variables =
            vec![Variable::of_words("a", ["0", "1"]), Variable::of_words("b", ["0", "1", "2"])];
        let cells = [((0, 0), 30), ((0, 1), 10), ((1, 0), 20), ((1, 1), 40)];
        let mut columns = vec![Vec::new(), Vec::new()];
        for ((a, b), count) in cells {
            for _ in 0..count {
                columns[0].push(a);
                columns[1].push(b);
            }
        }
        let table = Table::new(variables, columns).unwrap();
        let tester = Tester::new(&table, Test::X2);
        let verdict = tester.test(VariableId(0), VariableId(1), Set::EMPTY);
        // 100 (30*40 - 10*20)^2 / (40*60*50*50)
        assert!((verdict.strength - 100.0 / 6.0).abs() < 1e-9, "{verdict:?}");
        assert_eq!(verdict.freedom, 1);
    }
}
