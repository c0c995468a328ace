//! A relation and trials go in; how much a prior is worth with ever more trials comes out, as a table and as a picture.

use ::causal::file::curves::{Chart, Curve, Panel, draw};
use ::causal::table::Table;
use ::causal::transfer::curve::{LEAST, Measures, Point, Study, curve};
use ::causal::transfer::relation::Relation;
use ::causal::transfer::{Ends, Strategy};

use super::{explained, read};
use crate::args::causal::Format;
use crate::args::causal::transfer::Transfer;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Compares, and says and draws what came out.
pub fn run(
    arguments: &Transfer,
    ends: &Ends,
    relation: &Relation,
    own: Option<&Table>,
    terminal: &mut Terminal,
) -> Result<(), Complaint> {
    let test = read(arguments, &arguments.test, ends, terminal)?;
    let sizes = if arguments.learning_curve.is_empty() {
        vec![own.map_or(0, Table::len)]
    } else {
        arguments.learning_curve.clone()
    };
    let weights =
        if arguments.sweep.is_empty() { vec![arguments.weight] } else { arguments.sweep.clone() };
    let mut notes: Vec<String> = Vec::new();
    let strategies: Vec<Strategy> = match arguments.strategy {
        Some(strategy) => vec![strategy.0],
        None if relation.direct.is_empty() => {
            notes.push("no cause is the same in both: there is no direct replacement".to_owned());
            vec![Strategy::Cross]
        }
        None if relation.cross.iter().all(Vec::is_empty) => {
            notes.push(
                "nothing is related that is not the same: all three strategies are direct replacement"
                    .to_owned(),
            );
            vec![Strategy::Direct]
        }
        None => Strategy::ALL.to_vec(),
    };
    let study = Study {
        ends: *ends,
        relation,
        strategies: &strategies,
        weights: &weights,
        sizes: &sizes,
        trials: own,
        repeats: arguments.repeats,
        seed: arguments.seed,
        test: &test,
    };
    let points = curve(&study).map_err(|error| match error {
        ::causal::transfer::curve::CurveError::Transfer(error) => explained(error),
        other => other.into(),
    })?;
    match arguments.output_format {
        Format::Full => {
            for note in &notes {
                terminal.line(format_args!("note: {note}"));
            }
            tell(&points, test.len(), arguments.repeats, terminal);
        }
        Format::Json => {
            let points: Vec<serde_json::Value> = points.iter().map(json).collect();
            terminal.line(serde_json::json!({
                "test": test.len(), "repeats": arguments.repeats, "relation": relation, "notes": notes, "points": points,
            }));
        }
    }
    if let Some(path) = &arguments.plot {
        let title = format!(
            "{} from {}",
            ends.target.variable(ends.target_goal.0).name,
            files::name(&arguments.source)
        );
        files::write(path, draw(&chart(title, &points)).as_bytes())?;
    }
    Ok(())
}

/// What a point is a point of.
fn named(point: &Point) -> String {
    point.strategy.map_or_else(
        || "own trials alone".to_owned(),
        |strategy| format!("{}, worth {}", strategy.name(), point.weight),
    )
}

fn tell(points: &[Point], test: usize, repeats: usize, terminal: &mut Terminal) {
    let times = if points.iter().any(|point| point.trials > 0) && repeats > 1 {
        format!(", means of {repeats} draws")
    } else {
        String::new()
    };
    let compared = points.first().map_or(0, |point| point.measures.compared);
    terminal.line(format_args!(
        "{test} trials predicted{times}; the difference is that of {compared} rows, which have {LEAST} of them or more"
    ));
    let width = points.iter().map(|point| named(point).len()).max().unwrap_or(0);
    terminal.line(format_args!(
        "trials  {:<width$}  accuracy   Brier  difference  failures avoided  successes given up  unknown",
        "prior"
    ));
    let percent = |value: Option<f64>| {
        value.map_or_else(|| "-".to_owned(), |value| format!("{:.1} %", value * 100.0))
    };
    let mut before = None;
    for point in points {
        let Measures { accuracy, brier, difference, avoided, given_up, unknown, .. } =
            point.measures;
        let trials =
            if before == Some(point.trials) { String::new() } else { point.trials.to_string() };
        before = Some(point.trials);
        terminal.line(format_args!(
            "{trials:>6}  {:<width$}  {accuracy:>8.3}  {brier:>6.4}  {:>10}  {:>16}  {:>18}  {:>7}",
            named(point),
            difference.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}")),
            percent(avoided),
            percent(given_up),
            percent(Some(unknown))
        ));
    }
}

fn json(point: &Point) -> serde_json::Value {
    let measures = point.measures;
    serde_json::json!({
        "strategy": point.strategy,
        "weight": point.weight,
        "trials": point.trials,
        "accuracy": measures.accuracy,
        "brier": measures.brier,
        "difference": measures.difference,
        "rows-compared": measures.compared,
        "failures-avoided": measures.avoided,
        "successes-given-up": measures.given_up,
        "unknown": measures.unknown,
    })
}

/// The points as curves over the number of trials; with one number of trials only, over the weight.
fn chart(title: String, points: &[Point]) -> Chart {
    let distinct = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let sizes = distinct(points.iter().map(|point| point.trials as f64).collect());
    let weights = distinct(
        points.iter().filter(|one| one.strategy.is_some()).map(|one| one.weight).collect(),
    );
    let by_trials = sizes.len() > 1 || weights.len() < 2;
    let places = if by_trials { &sizes } else { &weights };
    let mut curves: Vec<(Curve, Option<Strategy>, f64)> = Vec::new();
    for point in points {
        let weight = if by_trials { point.weight } else { 0.0 };
        let known = |(_, strategy, other): &(Curve, Option<Strategy>, f64)| {
            *strategy == point.strategy && other.total_cmp(&weight).is_eq()
        };
        if curves.iter().any(known) {
            continue;
        }
        let name = match point.strategy {
            Some(strategy) if !by_trials => strategy.name().to_owned(),
            _ => named(point),
        };
        let colour = point.strategy.map_or(0, |one| 1 + one as usize);
        let dash = weights.iter().position(|one| one.total_cmp(&weight).is_eq()).unwrap_or(0);
        curves.push((Curve { name, colour, dash }, point.strategy, weight));
    }
    let panel = |title: &str, value: &dyn Fn(&Measures) -> Option<f64>| Panel {
        title: title.to_owned(),
        values: curves
            .iter()
            .map(|(_, strategy, weight)| {
                places
                    .iter()
                    .map(|place| {
                        let here = |point: &&Point| {
                            let at = if by_trials { point.trials as f64 } else { point.weight };
                            // What the target knows by itself is the same at each weight.
                            let place_fits = at.total_cmp(place).is_eq()
                                || (!by_trials && point.strategy.is_none());
                            let weight_fits = !by_trials || point.weight.total_cmp(weight).is_eq();
                            point.strategy == *strategy && place_fits && weight_fits
                        };
                        points.iter().find(here).and_then(|point| value(&point.measures))
                    })
                    .collect()
            })
            .collect(),
    };
    let panels = vec![
        panel("accuracy", &|one| Some(one.accuracy)),
        panel("Brier score (less is better)", &|one| Some(one.brier)),
        panel("mean difference of probabilities (less is better)", &|one| one.difference),
        panel("failures avoided", &|one| one.avoided),
    ];
    Chart {
        title,
        axis: if by_trials { "trials of the target" } else { "weight of the prior" }.to_owned(),
        places: places.iter().map(ToString::to_string).collect(),
        panels,
        curves: curves.into_iter().map(|(curve, ..)| curve).collect(),
    }
}
