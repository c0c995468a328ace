//! `caveat causal evaluate`: trials go in; how well success is predicted in trials that were not learned from comes out.

use ::causal::discover::discover;
use ::causal::evaluate::forest::forest;
use ::causal::evaluate::{
    Bin, Folds, Outcome, Prediction, Scores, calibration, folds, majority, network,
};
use ::causal::graph::Dag;
use ::causal::stream;
use ::causal::table::Table;
use ::causal::variable::VariableId;

use super::{discover as learning, model, trials};
use crate::args::causal::{Evaluate, Format};
use crate::exit::Exit;
use crate::files::Complaint;
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Evaluate, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let config = learning::config(&arguments.learner)?;
    let estimator = model::estimator(&arguments.estimate)?;
    let Some(goal) = trials::goal(&arguments.trials)? else {
        return Err(Complaint::with_help(
            "nothing says what success is",
            "for example `--goal onTop=1`",
        ));
    };
    let source = trials::open(&arguments.trials)?;
    let declared = trials::declared(&arguments.trials, Some(&arguments.known), &*source)?;
    let variables = trials::states(&arguments.trials, &declared, &*source, terminal)?;
    let (all, dropped) = stream::table(
        &*source,
        &variables,
        trials::policy(arguments.trials.missing, arguments.trials.outside),
    )?;
    trials::tell_dropped(dropped, terminal);
    let (table, groups) = part(all, arguments.group.as_deref())?;
    let knowledge = trials::knowledge(&arguments.known)?.with_roles(table.variables());
    let outcome = outcome(&table, &goal.variable, &goal.state)?;
    let parted = match &groups {
        Some(groups) => Folds::Groups(groups),
        None => Folds::Random(arguments.folds, arguments.seed),
    };
    let fold_of = folds(&table, parted)?;
    let by_hand: Option<Dag> = if arguments.arcs.is_empty() {
        None
    } else {
        Some(model::graph(table.variables(), &arguments.arcs)?)
    };
    let learn = |seen: &Table| match &by_hand {
        Some(graph) => Ok(graph.clone()),
        None => discover(seen, &knowledge, &config)
            .map(|found| found.graph)
            .map_err(|error| error.to_string()),
    };
    let ours = network(&table, outcome, &fold_of, &learn, estimator)?;
    let mut rows = vec![("model", ours.clone())];
    if arguments.forest {
        rows.push((
            "random forest",
            forest(&table, outcome, &fold_of, arguments.seed)?.predictions,
        ));
    }
    rows.push(("majority", majority(&table, outcome, &fold_of)?));
    let count = fold_of.iter().max().map_or(0, |last| last + 1);
    match arguments.output_format {
        Format::Full => tell(&rows, count, table.len(), terminal),
        Format::Json => {
            let rows: Vec<serde_json::Value> =
                rows.iter().map(|(name, predictions)| json(name, predictions)).collect();
            terminal.line(
                serde_json::json!({"trials": table.len(), "folds": count, "predictors": rows}),
            );
        }
    }
    Ok(Exit::Done)
}

/// Takes the column of the groups away.
fn part(table: Table, group: Option<&str>) -> Result<(Table, Option<Vec<u32>>), Complaint> {
    let Some(name) = group else { return Ok((table, None)) };
    let Some(id) = table.named(name) else {
        let message = format!("there is no column `{name}` to group by");
        let names = table.variables().iter().map(|one| one.name.as_str());
        return Err(Complaint::misspelt(message, name, names));
    };
    let groups = table.column(id).iter().map(|&state| u32::from(state)).collect();
    let others: Vec<VariableId> = table.ids().filter(|&other| other != id).collect();
    Ok((table.project(&others), Some(groups)))
}

fn outcome(table: &Table, name: &str, state: &str) -> Result<Outcome, Complaint> {
    let Some(variable) = table.named(name) else {
        let names = table.variables().iter().map(|one| one.name.as_str());
        return Err(trials::no_variable(name, names));
    };
    let Some(success) = table.variable(variable).state_of_word(state) else {
        let states = table.variable(variable).labels().join(", ");
        return Err(Complaint::with_help(
            format!("`{name}` is never {state} in these trials"),
            format!("its states are {states}"),
        ));
    };
    Ok(Outcome { variable, success })
}

fn tell(rows: &[(&str, Vec<Prediction>)], folds: usize, trials: usize, terminal: &mut Terminal) {
    terminal.line(format_args!("{trials} trials in {folds} folds"));
    terminal.line("predictor         F1  accuracy  precision  recall   Brier  log-likelihood  calibration error");
    let or_dash = |value: Option<f64>, digits: usize| {
        value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
    };
    for (name, predictions) in rows {
        let scores = Scores::of(predictions);
        terminal.line(format_args!(
            "{name:<14} {:>5.3}  {:>8.3}  {:>9.3}  {:>6.3}  {:>6}  {:>14}  {:>17}",
            scores.f1,
            scores.accuracy,
            scores.precision,
            scores.recall,
            or_dash(scores.brier, 4),
            or_dash(scores.likelihood, 4),
            or_dash(scores.calibration_error, 4)
        ));
        if scores.unknown > 0 && scores.unknown < scores.trials {
            terminal.line(format_args!(
                "  of {} trials the {name} knew nothing; they count as predicted to fail",
                scores.unknown
            ));
        }
    }
    terminal.line("\nwhere the model says   trials   it says   it comes");
    for Bin { trials, predicted, succeeded } in calibration(&rows[0].1) {
        let low = ((predicted * 10.0) as usize).min(9);
        terminal.line(format_args!(
            "  {:>3} to {:>3} %      {trials:>6}   {:>5.1} %    {:>5.1} %",
            low * 10,
            low * 10 + 10,
            predicted * 100.0,
            succeeded * 100.0
        ));
    }
}

fn json(name: &str, predictions: &[Prediction]) -> serde_json::Value {
    let scores = Scores::of(predictions);
    let bins: Vec<serde_json::Value> = calibration(predictions)
        .into_iter()
        .map(|bin| serde_json::json!({"trials": bin.trials, "predicted": bin.predicted, "succeeded": bin.succeeded}))
        .collect();
    serde_json::json!({
        "name": name,
        "f1": scores.f1,
        "accuracy": scores.accuracy,
        "precision": scores.precision,
        "recall": scores.recall,
        "brier": scores.brier,
        "log-likelihood": scores.likelihood,
        "calibration-error": scores.calibration_error,
        "unknown": scores.unknown,
        "calibration": bins,
    })
}
