//! `caveat causal query`: a model and a question go in; probabilities come out.

use ::causal::chance::chance;
use ::causal::infer::elimination::{joint, most_probable, posterior};
use ::causal::infer::{intervene, sample};
use ::causal::network::Network;
use ::causal::source::write::quoted;
use ::causal::variable::{State, States, VariableId};

use super::model;
use crate::args::causal::{Format, Query};
use crate::exit::Exit;
use crate::files::Complaint;
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Query, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let network = model::read(&arguments.model)?;
    let read = |texts: &[String]| -> Result<Vec<(VariableId, State)>, Complaint> {
        texts.iter().map(|text| model::assignment(&network, text)).collect()
    };
    let (given, set) = (read(&arguments.given)?, read(&arguments.set)?);
    let network = if set.is_empty() { network } else { intervene(&network, &set) };
    if let Some(rows) = arguments.sample {
        return draw(&network, rows, arguments.seed, terminal);
    }
    if arguments.most_probable {
        return explain(&network, &given, arguments.output_format, terminal);
    }
    let targets: Vec<VariableId> = if arguments.targets.is_empty() {
        network.ids().filter(|id| given.iter().chain(&set).all(|(other, _)| other != id)).collect()
    } else {
        arguments
            .targets
            .iter()
            .map(|name| model::find(&network, name))
            .collect::<Result<_, _>>()?
    };
    if arguments.joint {
        together(&network, &targets, &given, arguments.output_format, terminal)?;
    } else {
        apart(&network, &targets, &given, arguments.output_format, terminal)?;
    }
    Ok(Exit::Done)
}

/// Each variable by itself.
fn apart(
    network: &Network,
    targets: &[VariableId],
    given: &[(VariableId, State)],
    format: Format,
    terminal: &mut Terminal,
) -> Result<(), Complaint> {
    let mut answers = serde_json::Map::new();
    let widest = targets
        .iter()
        .flat_map(|&id| network.variable(id).labels())
        .map(|label| label.chars().count())
        .max()
        .unwrap_or(0);
    for &target in targets {
        let probabilities = posterior(network, target, given)?;
        let variable = network.variable(target);
        if format == Format::Json {
            let states: Vec<serde_json::Value> = variable
                .labels()
                .into_iter()
                .zip(&probabilities)
                .map(|(state, probability)| serde_json::json!({"state": state, "probability": probability}))
                .collect();
            answers.insert(variable.name.clone(), states.into());
            continue;
        }
        terminal.line(&variable.name);
        for (label, probability) in variable.labels().iter().zip(&probabilities) {
            let bar = "#".repeat((probability * 40.0).round() as usize);
            terminal.line(format!("  {label:<widest$}  {probability:.6}  {bar}").trim_end());
        }
    }
    if format == Format::Json {
        terminal.line(serde_json::Value::Object(answers));
    }
    Ok(())
}

/// All variables together.
fn together(
    network: &Network,
    targets: &[VariableId],
    given: &[(VariableId, State)],
    format: Format,
    terminal: &mut Terminal,
) -> Result<(), Complaint> {
    let probabilities = joint(network, targets, given)?;
    let mut rows = Vec::new();
    for (cell, &probability) in probabilities.iter().enumerate() {
        let mut rest = cell;
        let mut states: Vec<(String, String)> = targets
            .iter()
            .rev()
            .map(|&id| {
                let variable = network.variable(id);
                let state = (rest % variable.arity()) as State;
                rest /= variable.arity();
                (variable.name.clone(), variable.label(state))
            })
            .collect();
        states.reverse();
        rows.push((states, probability));
    }
    if format == Format::Json {
        let rows: Vec<serde_json::Value> = rows
            .into_iter()
            .map(|(states, probability)| {
                let states: serde_json::Map<String, serde_json::Value> =
                    states.into_iter().map(|(name, state)| (name, state.into())).collect();
                serde_json::json!({"states": states, "probability": probability})
            })
            .collect();
        terminal.line(serde_json::Value::Array(rows));
        return Ok(());
    }
    for (states, probability) in rows {
        let words: Vec<String> =
            states.iter().map(|(name, state)| format!("{name} = {state}")).collect();
        terminal.line(format_args!("{probability:.6}  {}", words.join(", ")));
    }
    Ok(())
}

/// The most probable of all that can be.
fn explain(
    network: &Network,
    given: &[(VariableId, State)],
    format: Format,
    terminal: &mut Terminal,
) -> Result<Exit, Complaint> {
    let (states, logarithm) = most_probable(network, given)?;
    let named = network.ids().map(|id| {
        let variable = network.variable(id);
        (variable.name.clone(), variable.label(states[id.index()]))
    });
    if format == Format::Json {
        let states: serde_json::Map<String, serde_json::Value> =
            named.map(|(name, state)| (name, state.into())).collect();
        terminal.line(serde_json::json!({"states": states, "log-probability": logarithm}));
        return Ok(Exit::Done);
    }
    for (name, state) in named {
        terminal.line(format_args!("{name} = {state}"));
    }
    terminal.line(format_args!("probability {:.6}", logarithm.exp()));
    Ok(Exit::Done)
}

/// Trials drawn from the model: words as they are, quantities and series at a place within their state.
fn draw(
    network: &Network,
    rows: usize,
    seed: u64,
    terminal: &mut Terminal,
) -> Result<Exit, Complaint> {
    let table = sample::forward(network, rows, seed)?;
    // The places within the states are drawn after the trials, from a piece of chance of their own.
    let mut random = chance(seed, u64::MAX);
    let mut head: Vec<String> = Vec::new();
    for variable in network.variables() {
        match &variable.states {
            States::Series(centroids) => {
                head.extend(
                    (0..centroids[0].len())
                        .map(|moment| quoted(&format!("{}[{moment}]", variable.name))),
                );
            }
            _ => head.push(quoted(&variable.name)),
        }
    }
    terminal.line(head.join(","));
    for row in 0..rows {
        let mut cells: Vec<String> = Vec::new();
        for id in network.ids() {
            let state = table.column(id)[row];
            let variable = network.variable(id);
            match &variable.states {
                States::Categories(words) => cells.push(quoted(&words[usize::from(state)])),
                States::Intervals(edges) => {
                    let (low, high) = (edges[usize::from(state)], edges[usize::from(state) + 1]);
                    cells.push((low + (high - low) * random.f64()).to_string());
                }
                States::Series(centroids) => {
                    cells.extend(centroids[usize::from(state)].iter().map(ToString::to_string));
                }
            }
        }
        terminal.line(cells.join(","));
    }
    Ok(Exit::Done)
}
