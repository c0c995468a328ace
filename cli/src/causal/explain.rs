//! `caveat causal explain`: a model and a failure go in; what was wrong comes out, in a sentence.

use ::causal::contrast::{Contrast, contrast};
use ::causal::file::contrast::draw;
use ::causal::words::Time;
use serde_json::json;

use super::ask::{Asked, situation};
use crate::args::causal::{Explain, Format};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Explain, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let ask = &arguments.ask;
    let asked = Asked::new(ask)?;
    let situation = situation(&asked, ask, arguments.row)?;
    let question = asked.question(ask, &situation);
    let mut found = contrast(&question)?;
    let expected = found.before.is_some_and(|before| before > ask.threshold);
    if expected {
        // Another situation that would have succeeded as well explains nothing.
        found.answers.clear();
    }
    if let (Some(path), Some(answer)) = (&arguments.picture, found.answers.first()) {
        files::write(path, draw(&question, answer, &asked.vocabulary).as_bytes())?;
    }
    match ask.output_format {
        Format::Json => {
            let mut told = json!({
                "goal": asked.success(),
                "before": found.before,
                "answers": found.answers.iter().map(|answer| asked.json(answer, Time::Past)).collect::<Vec<_>>(),
                "looked-at": found.looked,
                "too-few-trials": found.unsure,
                "complete": found.complete,
            });
            if arguments.trace {
                told["trace"] = trace(&asked, &found).into();
            }
            terminal.data(serde_json::to_string_pretty(&told).expect("it is JSON") + "\n");
        }
        Format::Full => tell(arguments, &asked, &found, expected, terminal),
    }
    Ok(if found.answers.is_empty() { Exit::Findings } else { Exit::Done })
}

fn tell(
    arguments: &Explain,
    asked: &Asked,
    found: &Contrast,
    expected: bool,
    terminal: &mut Terminal,
) {
    let known = |probability: Option<f64>| match probability {
        Some(probability) => format!("{probability:.3}"),
        None => "unknown".to_owned(),
    };
    if arguments.trace {
        for visit in trace(asked, found) {
            let words = visit["changes"].as_str().unwrap_or_default();
            let words = if words.is_empty() { "as it was" } else { words };
            terminal.line(format_args!(
                "{:>4}  {}  {words}",
                visit["cost"],
                known(visit["probability"].as_f64())
            ));
        }
    }
    if expected {
        terminal.line(format_args!(
            "The model expects {} here: nothing that it knows explains a failure.",
            asked.success()
        ));
    }
    if expected {
        return;
    }
    let values = if arguments.probabilities {
        format!(" ({} -> {{}})", known(found.before))
    } else {
        String::new()
    };
    for (at, answer) in found.answers.iter().enumerate() {
        let or = if at == 0 { "" } else { "Or: " };
        let values = values.replace("{}", &known(Some(answer.probability)));
        terminal.line(format_args!("{or}{}{values}", asked.sentence(answer, Time::Past)));
    }
    if found.answers.is_empty() {
        let names: Vec<String> =
            asked.free.iter().map(|&(id, _)| asked.network.variable(id).name.clone()).collect();
        let unsure = match found.unsure {
            0 => String::new(),
            all if all == found.looked => "; too few trials are known of any of them".to_owned(),
            some => format!("; too few trials are known of {some} of them"),
        };
        let all = if found.complete { "none" } else { "the search was given up: none" };
        terminal.line(format_args!(
            "No success is within reach: {all} of {} situations that differ in {} makes {} likely{unsure}.",
            found.looked,
            ::causal::words::joined(&names),
            asked.success()
        ));
    }
}

/// The situations in the order in which they were looked at.
fn trace(asked: &Asked, found: &Contrast) -> Vec<serde_json::Value> {
    let visits = found.trace.iter().map(|visit| {
        let words: Vec<String> = visit
            .changes
            .iter()
            .map(|change| {
                let variable = asked.network.variable(change.variable);
                format!("{} = {}", variable.name, variable.label(change.to))
            })
            .collect();
        json!({"cost": visit.cost, "probability": visit.probability, "changes": words.join(", ")})
    });
    visits.collect()
}
