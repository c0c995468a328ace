//! Trials and what is declared of their variables go in; the states of each variable come out (thesis §2.1.2, algorithm 1).

pub mod courses;
pub mod number;

use crate::recipe::{Cuts, Declared};
use crate::sample::{MOST, Sample};
use crate::source::{Fault, Source, fetch};
use crate::survey::{Kind, Survey, Surveyed};
use crate::variable::{MOST_STATES, States, Variable};

/// The states that a quantity or a series gets where nothing is declared: the thesis's examples have five.
pub const STATES: usize = 5;

/// Whole numbers are taken for categories up to this many different ones.
pub const MOST_NUMBERED: usize = 12;

/// What came of cutting.
#[derive(Debug, Clone, PartialEq)]
pub struct Discretized {
    /// The variables, with their states.
    pub variables: Vec<Variable>,
    /// What a person should know: states that fell together.
    pub notes: Vec<String>,
    /// What was tried for the variables whose number of intervals was searched.
    pub searched: Option<number::Search>,
}

/// Declares every column and series of a source, each by its name only.
pub fn declare(source: &dyn Source) -> Vec<Declared> {
    fetch::names(source).into_iter().map(Declared::named).collect()
}

/// Finds the states of each variable: algorithm 1.
///
/// `outcome` is what the number of intervals should predict, for variables whose [cuts](Cuts::Search) are searched.
pub fn discretize(
    source: &dyn Source,
    declared: &[Declared],
    survey: &Survey,
    outcome: Option<&str>,
) -> Result<Discretized, Fault> {
    if survey.rows == 0 {
        return Err(Fault::new("the trials", "there is no trial"));
    }
    let cuts: Vec<Cuts> = declared
        .iter()
        .zip(&survey.variables)
        .map(|(one, surveyed)| choose(one, surveyed))
        .collect::<Result<_, _>>()?;
    let needs_values =
        |cuts: &Cuts| matches!(cuts, Cuts::Quantile(_) | Cuts::KMeans(_) | Cuts::Search);
    let sampled: Vec<usize> = (0..declared.len()).filter(|&at| needs_values(&cuts[at])).collect();
    let sample = if sampled.is_empty() {
        None
    } else {
        let declared: Vec<&Declared> = sampled.iter().map(|&at| &declared[at]).collect();
        let sample = Sample::draw(source, &declared, MOST)?;
        if sample.is_empty() {
            return Err(Fault::new("the trials", "in every trial some value is missing"));
        }
        Some(sample)
    };
    let mut notes = Vec::new();
    let mut variables = Vec::with_capacity(declared.len());
    for (at, one) in declared.iter().enumerate() {
        let surveyed = &survey.variables[at];
        let place = sampled.iter().position(|&other| other == at);
        let values = || sample.as_ref().zip(place).expect("whatever needs values is sampled");
        let states = match &cuts[at] {
            Cuts::Categories => States::Categories(categories(one, surveyed)?),
            Cuts::Edges(edges) => States::Intervals(edges.clone()),
            Cuts::Width(states) => States::Intervals(width(range(one, surveyed)?, *states)),
            // A search begins where nothing is known.
            Cuts::Quantile(_) | Cuts::Search => {
                let states = if let Cuts::Quantile(states) = cuts[at] { states } else { STATES };
                let (sample, place) = values();
                States::Intervals(quantile(&sample.numbers(place), range(one, surveyed)?, states))
            }
            Cuts::KMeans(states) => {
                let (sample, place) = values();
                let series = sample.series(place);
                // A quantity can be clustered, too: a series of one moment, whose clusters are intervals again.
                if matches!(surveyed.kind, Kind::Series(_)) {
                    States::Series(courses::cluster(&series, *states))
                } else {
                    let centres = courses::cluster(&series, *states);
                    States::Intervals(between(&centres, range(one, surveyed)?))
                }
            }
        };
        let variable = Variable {
            name: one.name.clone(),
            unit: one.unit.clone(),
            role: one.role,
            from: one.from.clone(),
            states,
        };
        let asked = match cuts[at] {
            Cuts::Quantile(states) | Cuts::Width(states) | Cuts::KMeans(states) => states,
            _ => variable.arity(),
        };
        if (2..asked).contains(&variable.arity()) {
            let arity = variable.arity();
            notes.push(format!(
                "`{}` has {arity} states instead of {asked}: many trials have one value",
                one.name
            ));
        }
        variables.push(variable);
    }
    let mut searched = None;
    if cuts.contains(&Cuts::Search) {
        let Some(outcome) = outcome else {
            let what = "an outcome must be named, since the number of intervals is searched that predicts it best";
            return Err(Fault::new("the variables", what));
        };
        let open: Vec<bool> = cuts.iter().map(|cuts| *cuts == Cuts::Search).collect();
        let ranges: Vec<Option<(f64, f64)>> = survey.variables.iter().map(numeric).collect();
        let search = number::search(source, &variables, &open, &ranges, survey.rows, outcome)?;
        for (variable, found) in variables.iter_mut().zip(&search.variables) {
            variable.states.clone_from(&found.states);
        }
        searched = Some(search);
    }
    Ok(Discretized { variables, notes, searched })
}

/// The range of a variable that is a number.
fn numeric(surveyed: &Surveyed) -> Option<(f64, f64)> {
    match surveyed.kind {
        Kind::Numbers { least, greatest, .. } => Some((least, greatest)),
        _ => None,
    }
}

/// How a variable is cut: as declared where that can be, else as its values suggest.
fn choose(declared: &Declared, surveyed: &Surveyed) -> Result<Cuts, Fault> {
    let name = &declared.name;
    let wrong = |what: String| Err(Fault::new("the variables", format!("`{name}` {what}")));
    let kind = match &surveyed.kind {
        Kind::Nothing => return wrong("has no value in any trial".to_owned()),
        Kind::TooManyWords(some) => {
            let some: Vec<String> = some.iter().map(|word| format!("`{word}`")).collect();
            return wrong(format!(
                "has more than {MOST_STATES} different words ({} …); leave it out, or declare what its states are",
                some.join(", ")
            ));
        }
        kind => kind,
    };
    match (&declared.cuts, kind) {
        (None, Kind::Words(_)) => Ok(Cuts::Categories),
        (None, Kind::Series(_)) => Ok(Cuts::KMeans(STATES)),
        (None, Kind::Numbers { few: Some(few), .. }) if numbered(few) => Ok(Cuts::Categories),
        (None, _) => Ok(Cuts::Quantile(STATES)),
        (Some(Cuts::KMeans(_)), Kind::Series(_) | Kind::Numbers { .. }) => {
            Ok(declared.cuts.clone().expect("it was just matched"))
        }
        (Some(_), Kind::Series(_)) => {
            wrong("is a series; its states are typical courses (`k-means`)".to_owned())
        }
        (Some(Cuts::Categories), Kind::Words(_) | Kind::Numbers { few: Some(_), .. }) => {
            Ok(Cuts::Categories)
        }
        (Some(Cuts::Categories), _) => {
            wrong(format!("has more than {MOST_STATES} different values, too many for categories"))
        }
        (Some(_), Kind::Words(words)) => {
            let word = words.iter().map(|(word, _)| word).find(|word| word.parse::<f64>().is_err());
            wrong(format!(
                "holds words (`{}`), which have no intervals",
                word.map_or("", String::as_str)
            ))
        }
        (Some(cuts), _) => Ok(cuts.clone()),
    }
}

/// Whether numbers look like categories: few, and whole.
fn numbered(few: &[(String, u64)]) -> bool {
    few.len() <= MOST_NUMBERED && few.iter().all(|(word, _)| word.parse::<i64>().is_ok())
}

fn categories(declared: &Declared, surveyed: &Surveyed) -> Result<Vec<String>, Fault> {
    match &surveyed.kind {
        Kind::Words(words) | Kind::Numbers { few: Some(words), .. } => {
            Ok(words.iter().map(|(word, _)| word.clone()).collect())
        }
        _ => Err(Fault::new("the variables", format!("`{}` has no categories", declared.name))),
    }
}

fn range(declared: &Declared, surveyed: &Surveyed) -> Result<(f64, f64), Fault> {
    let none = || Fault::new("the variables", format!("`{}` is no quantity", declared.name));
    numeric(surveyed).ok_or_else(none)
}

/// The edges of intervals of one width.
pub fn width((least, greatest): (f64, f64), states: usize) -> Vec<f64> {
    let step = (greatest - least) / states as f64;
    let mut edges: Vec<f64> = (0..states).map(|at| least + step * at as f64).collect();
    edges.push(greatest);
    merged(edges)
}

/// The edges of intervals with about as many of the values in each: the lower edge of each is the least value in it.
pub fn quantile(values: &[f64], (least, greatest): (f64, f64), states: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let mut edges = vec![least];
    edges.extend((1..states).map(|at| sorted[at * sorted.len() / states]));
    edges.push(greatest);
    merged(edges)
}

/// Rising edges: those that fell together once. One interval remains in any case.
fn merged(mut edges: Vec<f64>) -> Vec<f64> {
    let greatest = edges.pop().expect("there is a last edge");
    edges.dedup();
    // An interval from the greatest value to itself would be one that the last interval holds already, unless it is the only one.
    while edges.len() > 1 && edges.last().is_some_and(|&last| last >= greatest) {
        edges.pop();
    }
    edges.push(greatest);
    edges
}

/// The edges between sorted centres, half way.
fn between(centres: &[Vec<f64>], (least, greatest): (f64, f64)) -> Vec<f64> {
    let mut centres: Vec<f64> = centres.iter().map(|centre| centre[0]).collect();
    centres.sort_unstable_by(f64::total_cmp);
    let mut edges = vec![least];
    edges.extend(centres.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])));
    edges.push(greatest);
    merged(edges)
}
