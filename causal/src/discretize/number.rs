//! Trials, and variables whose number of intervals is open, go in; the numbers that predict an outcome best come out (thesis §2.1.2).
//!
//! The predictor is a table of the outcome for each combination of states of a few other variables, with one imagined trial in each
//! cell. It is judged by the mean logarithm of what it gave the true outcome, over five folds of a sample. Variables join it one by
//! one while that helps, and then the numbers of intervals move one by one while that helps: fewer intervals blur what matters, and
//! more leave cells that no trial fell into.

use rustc_hash::FxHashMap;

use super::quantile;
use crate::place::{Placer, Policy, Unfit};
use crate::recipe::Declared;
use crate::sample::{MOST, Share};
use crate::source::{Fault, Source};
use crate::variable::{State, States, Variable, VariableId, named, unknown};

/// The numbers of intervals that are tried.
pub const TRIED: std::ops::RangeInclusive<usize> = 2..=9;

const FOLDS: usize = 5;

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// The variables, the searched ones with their new states.
    pub variables: Vec<Variable>,
    /// The names of those that predict the outcome.
    pub predictors: Vec<String>,
    /// What was tried last for each predictor that was searched, the others as they are in `variables`.
    pub trials: Vec<Trial>,
}

/// A number of intervals, and how well it predicts.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The variable.
    pub name: String,
    /// Its number of intervals.
    pub states: usize,
    /// How well the outcome is predicted.
    pub skill: Skill,
}

/// How well an outcome is predicted in trials that were not learned from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Skill {
    /// The mean natural logarithm of the probability that the true outcome was given.
    pub likelihood: f64,
    /// How often the most probable outcome was the true one.
    pub accuracy: f64,
    /// How often the combination of states had not been seen.
    pub unseen: f64,
}

/// The values of a sample: what is open as numbers, the rest as states.
struct Data {
    /// For each variable the numbers, where its intervals are open.
    numbers: Vec<Option<Vec<f64>>>,
    /// For each variable and number of states the columns of states.
    columns: FxHashMap<(usize, usize), Vec<State>>,
    ranges: Vec<Option<(f64, f64)>>,
    outcome: Vec<State>,
    outcomes: usize,
}

/// Finds the numbers of intervals of the variables that are `open`.
pub fn search(
    source: &dyn Source,
    variables: &[Variable],
    open: &[bool],
    ranges: &[Option<(f64, f64)>],
    rows: u64,
    outcome: &str,
) -> Result<Search, Fault> {
    let wrong = |what: String| Fault::new("the variables", what);
    let Some(target) = named(variables, outcome).map(VariableId::index) else {
        return Err(wrong(unknown(outcome, variables)));
    };
    if open[target] {
        return Err(wrong(format!(
            "`{outcome}` is the outcome: its own states cannot be searched"
        )));
    }
    if variables[target].arity() < 2 {
        return Err(wrong(format!("`{outcome}` is the same in every trial: nothing predicts it")));
    }
    let mut data = read(source, variables, open, ranges, rows, target)?;
    let mut counts: Vec<usize> = variables.iter().map(Variable::arity).collect();
    let mut predictors: Vec<usize> = Vec::new();
    let mut best = data.skill(&predictors, &counts);
    loop {
        let before = best.likelihood;
        while let Some((next, skill)) = (0..variables.len())
            .filter(|&at| at != target && !predictors.contains(&at) && counts[at] > 1)
            .map(|at| (at, data.skill(&with(&predictors, at), &counts)))
            .reduce(|one, other| if other.1.likelihood > one.1.likelihood { other } else { one })
            .filter(|(_, skill)| skill.likelihood > best.likelihood)
        {
            predictors.push(next);
            best = skill;
        }
        for &at in predictors.iter().filter(|&&at| open[at]) {
            for states in TRIED {
                let other = replaced(&counts, at, states);
                let skill = data.skill(&predictors, &other);
                if skill.likelihood > best.likelihood {
                    (counts, best) = (other, skill);
                }
            }
        }
        if best.likelihood <= before {
            break;
        }
    }
    let mut trials = Vec::new();
    for &at in predictors.iter().filter(|&&at| open[at]) {
        for states in TRIED {
            let skill = data.skill(&predictors, &replaced(&counts, at, states));
            trials.push(Trial { name: variables[at].name.clone(), states, skill });
        }
    }
    let mut found = variables.to_vec();
    for (at, variable) in found.iter_mut().enumerate() {
        if let Some(numbers) = &data.numbers[at] {
            let range = data.ranges[at].expect("what is open is a quantity");
            variable.states = States::Intervals(quantile(numbers, range, counts[at]));
        }
    }
    let predictors = predictors.iter().map(|&at| variables[at].name.clone()).collect();
    Ok(Search { variables: found, predictors, trials })
}

fn with(predictors: &[usize], next: usize) -> Vec<usize> {
    let mut more = predictors.to_vec();
    more.push(next);
    more
}

fn replaced(counts: &[usize], at: usize, states: usize) -> Vec<usize> {
    let mut other = counts.to_vec();
    other[at] = states;
    other
}

/// Reads a sample: the same trials twice, once for numbers and once for states.
fn read(
    source: &dyn Source,
    variables: &[Variable],
    open: &[bool],
    ranges: &[Option<(f64, f64)>],
    rows: u64,
    target: usize,
) -> Result<Data, Fault> {
    let declared: Vec<Declared> = variables
        .iter()
        .map(|one| Declared { from: one.from.clone(), ..Declared::named(&one.name) })
        .collect();
    let policy = Policy { missing: Unfit::Drop, outside: Unfit::Drop };
    let placer = Placer::new(source, variables, policy)?;
    let fetch = crate::source::fetch::Fetch::new(
        source,
        declared.iter().map(|one| (one.name.as_str(), one.from.as_ref())),
    )?;
    let mut columns: Vec<Vec<State>> = vec![Vec::new(); variables.len()];
    let mut numbers: Vec<Option<Vec<f64>>> = open.iter().map(|&open| open.then(Vec::new)).collect();
    let share = Share::of(rows, MOST);
    for shard in 0..source.shards() {
        source.read(shard, placer.columns(), &mut |block| {
            let placed = placer.place(shard, block)?;
            let kept: Vec<u32> =
                placed.kept.unwrap_or_else(|| (0..block.rows.len() as u32).collect());
            for (at, &row) in kept.iter().enumerate() {
                if !share.holds(shard, block.rows[row as usize]) {
                    continue;
                }
                for (column, states) in columns.iter_mut().zip(&placed.columns) {
                    column.push(states[at]);
                }
                for (numbers, needed) in numbers.iter_mut().zip(fetch.variables()) {
                    if let Some(numbers) = numbers {
                        let value = needed.value(block, row as usize);
                        let Ok(crate::derive::Value::Number(value)) = value else {
                            unreachable!("it was placed in an interval")
                        };
                        numbers.push(value);
                    }
                }
            }
            Ok(())
        })?;
    }
    let outcome = columns[target].clone();
    if outcome.len() < FOLDS {
        return Err(Fault::new("the trials", "there are too few for a search of intervals"));
    }
    let columns = columns
        .into_iter()
        .enumerate()
        .filter(|(at, _)| !open[*at])
        .map(|(at, column)| ((at, variables[at].arity()), column))
        .collect();
    Ok(Data {
        numbers,
        columns,
        ranges: ranges.to_vec(),
        outcome,
        outcomes: variables[target].arity(),
    })
}

impl Data {
    /// The states of a variable that has so many.
    fn column(&mut self, variable: usize, states: usize) -> &[State] {
        self.columns.entry((variable, states)).or_insert_with(|| {
            let numbers =
                self.numbers[variable].as_ref().expect("only what is open has other numbers");
            let range = self.ranges[variable].expect("what is open is a quantity");
            let variable = Variable::of_intervals("", quantile(numbers, range, states));
            numbers
                .iter()
                .map(|&value| {
                    variable.state_of_number(value).expect("the edges reach over all values")
                })
                .collect()
        })
    }

    /// How well some variables, with so many states each, predict the outcome.
    fn skill(&mut self, predictors: &[usize], counts: &[usize]) -> Skill {
        let rows = self.outcome.len();
        let mut cells = vec![0_u64; rows];
        for &at in predictors {
            let states = counts[at];
            for (cell, &state) in cells.iter_mut().zip(self.column(at, states)) {
                *cell = *cell * states as u64 + u64::from(state);
            }
        }
        let outcomes = self.outcomes;
        let (mut likelihood, mut right, mut unseen) = (0.0, 0_usize, 0_usize);
        for fold in 0..FOLDS {
            let mut seen: FxHashMap<u64, Vec<u32>> = FxHashMap::default();
            for row in (0..rows).filter(|row| row % FOLDS != fold) {
                seen.entry(cells[row]).or_insert_with(|| vec![0; outcomes])
                    [usize::from(self.outcome[row])] += 1;
            }
            let none = vec![0; outcomes];
            for row in (fold..rows).step_by(FOLDS) {
                let counts = seen.get(&cells[row]).unwrap_or_else(|| {
                    unseen += 1;
                    &none
                });
                let total: u32 = counts.iter().sum();
                let outcome = usize::from(self.outcome[row]);
                let probability =
                    f64::from(counts[outcome] + 1) / (f64::from(total) + outcomes as f64);
                likelihood += probability.ln();
                let first = (0..outcomes).max_by_key(|&at| (counts[at], std::cmp::Reverse(at)));
                right += usize::from(first == Some(outcome));
            }
        }
        let share = |count: usize| count as f64 / rows as f64;
        Skill {
            likelihood: likelihood / rows as f64,
            accuracy: share(right),
            unseen: share(unseen),
        }
    }
}
