//! `caveat causal prevent`: a model and what is going to be done go in; whether it will do comes out, and if not what to do instead.

use std::io::Write as _;
use std::path::Path;

use ::causal::contrast::ContrastError;
use ::causal::prevent::{Prevention, prevent};
use ::causal::situation::{Known, Situation, column};
use ::causal::source::write::quoted;
use ::causal::words::Time;
use rayon::prelude::*;
use serde_json::json;

use super::ask::{Asked, rows, situation, text, value};
use super::trials;
use crate::args::causal::{Format, Prevent};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Prevent, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let ask = &arguments.ask;
    let asked = Asked::new(ask)?;
    if enough(arguments) > ask.threshold {
        let message = "what is corrected must become likelier than what is left alone";
        return Err(Complaint::with_help(message, "`--act-below` is at most `--threshold`"));
    }
    match (&ask.trials, &arguments.output) {
        (Some(trials), Some(output)) => all(arguments, &asked, trials, output, terminal),
        _ => one(arguments, &asked, terminal),
    }
}

/// What is enough: the threshold, where nothing else is said.
fn enough(arguments: &Prevent) -> f64 {
    arguments.act_below.unwrap_or(arguments.ask.threshold)
}

fn one(arguments: &Prevent, asked: &Asked, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let ask = &arguments.ask;
    let situation = situation(asked, ask, arguments.row)?;
    let question = asked.question(ask, &situation);
    let found = prevent(&question, enough(arguments))?;
    if ask.output_format == Format::Json {
        let told = match &found {
            Prevention::Keep(probability) => json!({"do": "keep", "probability": probability}),
            Prevention::Correct { before, answer, .. } => {
                let mut told = asked.json(answer, Time::Ahead);
                told["do"] = "correct".into();
                told["before"] = json!(before);
                told
            }
            Prevention::Hopeless(found) => {
                json!({"do": "give up", "before": found.before, "looked-at": found.looked})
            }
        };
        terminal.data(serde_json::to_string_pretty(&told).expect("it is JSON") + "\n");
    } else {
        match &found {
            Prevention::Keep(_) => {
                terminal.line(format_args!("Go on: {} is likely as it is.", asked.success()));
            }
            Prevention::Correct { answer, situation: after, .. } => {
                terminal.line(format_args!("As it is, {} is not likely. {}", asked.success(), asked.sentence(answer, Time::Ahead)));
                for change in &answer.changes {
                    let variable = asked.network.variable(change.variable);
                    let (name, unit) = (&variable.name, variable.unit.as_deref().unwrap_or_default());
                    let (before, after) = (situation.get(column(variable)), &after[column(variable)]);
                    let before = before.map_or_else(|| "?".to_owned(), text);
                    terminal.line(format!("  {name}: {} instead of {before} {unit}", text(after)).trim_end());
                }
            }
            Prevention::Hopeless(found) => terminal.line(format_args!(
                "As it is, {} is not likely, and nothing that may still be changed makes it so ({} situations were looked at).",
                asked.success(),
                found.looked
            )),
        }
    }
    Ok(if matches!(found, Prevention::Hopeless(_)) { Exit::Findings } else { Exit::Done })
}

/// All trials of a file, each corrected where it needs to be.
fn all(
    arguments: &Prevent,
    asked: &Asked,
    trials: &Path,
    output: &Path,
    terminal: &mut Terminal,
) -> Result<Exit, Complaint> {
    let ask = &arguments.ask;
    if output.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet")) {
        return Err(Complaint::new("corrected trials are written as CSV"));
    }
    let situations = rows(trials)?;
    let columns = trials::open_files(&[trials.to_owned()])?.columns().to_vec();
    let enough = enough(arguments);
    let place = |at: usize, error: &ContrastError| {
        format!("{}, trial {}: {error}", files::name(trials), at + 1)
    };
    // A trial outside of what the model has seen is left as it is, and told.
    let found: Vec<Option<Prevention>> = situations
        .par_iter()
        .enumerate()
        .map(|(at, situation)| match prevent(&asked.question(ask, situation), enough) {
            Ok(found) => Ok(Some(found)),
            Err(ContrastError::Outside(_)) => Ok(None),
            Err(error) => Err(Complaint::new(place(at, &error))),
        })
        .collect::<Result<_, _>>()?;
    let outside = found.iter().filter(|one| one.is_none()).count();
    if let Some(at) = found.iter().position(Option::is_none)
        && let Err(error) = prevent(&asked.question(ask, &situations[at]), enough)
    {
        terminal.say(format_args!(
            "note: {outside} of {} trials lie outside of the model, the first of them: {}",
            found.len(),
            place(at, &error)
        ));
    }
    files::write_with(output, |out| {
        let mut out = std::io::BufWriter::new(out);
        let names: Vec<String> = columns.iter().map(|name| quoted(name)).collect();
        writeln!(out, "{},prevention", names.join(","))?;
        for (before, found) in situations.iter().zip(&found) {
            let (after, what) = match found {
                Some(Prevention::Keep(_)) => (before, "keep"),
                Some(Prevention::Correct { situation, .. }) => (situation, "correct"),
                Some(Prevention::Hopeless(_)) => (before, "give up"),
                None => (before, "outside"),
            };
            let cells: Vec<String> = columns.iter().map(|name| cell(after, name)).collect();
            writeln!(out, "{},{what}", cells.join(","))?;
        }
        out.flush()
    })?;
    let count =
        |what: fn(&Prevention) -> bool| found.iter().flatten().filter(|one| what(one)).count();
    let kept = count(|one| matches!(one, Prevention::Keep(_)));
    let given_up = count(|one| matches!(one, Prevention::Hopeless(_)));
    terminal.line(format_args!(
        "{} trials: {kept} kept, {} corrected, {given_up} beyond help",
        found.len(),
        found.len() - kept - given_up - outside
    ));
    Ok(if given_up + outside > 0 { Exit::Findings } else { Exit::Done })
}

/// The cell of a column.
fn cell(situation: &Situation, column: &str) -> String {
    if let Some(known) = situation.get(column) {
        return match value(known) {
            serde_json::Value::String(word) => quoted(&word),
            // A whole number is written as one, as it was read.
            _ => match known {
                Known::Number(number) => number.to_string(),
                _ => String::new(),
            },
        };
    }
    let moment = ::causal::source::fetch::moment(column);
    let series = moment.and_then(|(name, at)| Some((situation.get(name)?, at)));
    match series {
        Some((Known::Series(values), at)) => {
            values.get(at).map_or_else(String::new, ToString::to_string)
        }
        _ => String::new(),
    }
}
