//! `caveat causal show`: a model goes in; what a person wants to know of it comes out.

use ::causal::evaluate::credible;
use ::causal::network::Network;
use ::causal::variable::{Role, VariableId};

use super::model;
use crate::args::causal::Show;
use crate::exit::Exit;
use crate::files::Complaint;
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Show, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let network = model::read(&arguments.model)?;
    match &arguments.table {
        Some(name) => table(&network, model::find(&network, name)?, terminal),
        None => overview(&network, terminal),
    }
    if let Some(path) = &arguments.output {
        model::write(&network, path)?;
    }
    if let Some(path) = &arguments.svg {
        model::draw(&network, arguments.tables, path)?;
    }
    Ok(Exit::Done)
}

fn overview(network: &Network, terminal: &mut Terminal) {
    let about = &network.about;
    terminal.line(format_args!(
        "{} variables, {} arcs, {} probabilities",
        network.variables().len(),
        network.graph().arcs().count(),
        network.parameters()
    ));
    if let Some(trials) = about.trials {
        let files = if about.files.is_empty() {
            String::new()
        } else {
            format!(" in {}", about.files.join(", "))
        };
        terminal.line(format_args!("learned from {trials} trials{files}"));
    }
    if let Some(transfer) = &about.transfer {
        terminal.line(format_args!(
            "`{}` has a prior from `{}` of {}, by {} replacement, worth {} trials in each row",
            transfer.variable,
            transfer.goal,
            transfer.source,
            transfer.strategy.name(),
            transfer.weight
        ));
    }
    if let Some(goal) = &network.goal {
        terminal.line(format_args!("success is {} = {}", goal.variable, goal.state));
    }
    for id in network.ids() {
        let variable = network.variable(id);
        let unit = variable.unit.as_ref().map_or_else(String::new, |unit| format!(" ({unit})"));
        let role = match variable.role {
            Some(Role::Treatment) => ", set before the trial",
            Some(Role::Outcome) => ", an outcome",
            None => "",
        };
        terminal.line(format_args!("\n{}{unit}{role}", variable.name));
        if let Some(from) = &variable.from {
            terminal.line(format_args!("  is {from}"));
        }
        terminal.line(format_args!("  states  {}", variable.labels().join("  ")));
        let causes = network.causes(id);
        if !causes.is_empty() {
            terminal.line(format_args!("  causes  {}", causes.join(", ")));
        }
    }
    for note in &about.notes {
        terminal.line(format_args!("\nnote: {note}"));
    }
}

/// The rows of a table, with what they are known from.
fn table(network: &Network, id: VariableId, terminal: &mut Terminal) {
    let variable = network.variable(id);
    let goal = network.goal.as_ref().filter(|goal| goal.variable == variable.name);
    let wanted = goal.and_then(|goal| variable.state_of_word(&goal.state));
    let parents = network.causes(id);
    let labels = variable.labels();
    let rows = network.rows(id).unwrap_or(0);
    let states_of = |row: usize| -> Vec<String> {
        let states = network.states_of(id, row);
        network
            .graph()
            .parents(id)
            .iter()
            .zip(states)
            .map(|(parent, state)| network.variable(*parent).label(state))
            .collect()
    };
    let mut widths: Vec<usize> = parents.iter().map(|name| name.chars().count()).collect();
    for row in 0..rows {
        for (width, label) in widths.iter_mut().zip(states_of(row)) {
            *width = (*width).max(label.chars().count());
        }
    }
    let mut head = String::new();
    for (name, width) in parents.iter().zip(&widths) {
        head.push_str(&pad(name, *width));
    }
    for label in &labels {
        head.push_str(&format_cell(
            &format!("{} = {label}", variable.name),
            labels_width(&labels, &variable.name),
        ));
    }
    head.push_str("  trials");
    terminal.line(head.trim_end());
    for row in 0..rows {
        let mut line = String::new();
        for (label, width) in states_of(row).iter().zip(&widths) {
            line.push_str(&pad(label, *width));
        }
        let width = labels_width(&labels, &variable.name);
        match network.row(id, row) {
            Some(probabilities) => {
                for probability in probabilities {
                    line.push_str(&format_cell(&format!("{probability:.4}"), width));
                }
            }
            None => line.push_str(&"unknown  ".repeat(labels.len())),
        }
        if let Some(counts) = network.counts(id, row) {
            let trials: u64 = counts.iter().sum();
            line += format!("  {trials:>6}").as_str();
            if let Some(state) = wanted {
                let (low, high) = credible(counts[usize::from(state)], trials, 0.95);
                line += format!("   95 %: {low:.2} to {high:.2}").as_str();
            }
        }
        terminal.line(line.trim_end());
    }
}

fn labels_width(labels: &[String], name: &str) -> usize {
    labels
        .iter()
        .map(|label| label.chars().count() + name.chars().count() + 3)
        .max()
        .unwrap_or(0)
        .max(7)
}

fn pad(text: &str, width: usize) -> String {
    format!("{text:<width$}  ")
}

fn format_cell(text: &str, width: usize) -> String {
    format!("{text:>width$}  ")
}
