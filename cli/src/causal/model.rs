//! A path and what a command line says of a model go in; the model comes out, and is written again.

use std::path::Path;

use ::causal::estimate::Estimator;
use ::causal::file::{bif, dot, json, svg, xmlbif};
use ::causal::graph::Dag;
use ::causal::infer::junction::JunctionTree;
use ::causal::network::Network;
use ::causal::variable::{State, Variable, VariableId, named};

use super::trials::{no_variable, pair};
use crate::files::{self, Complaint};

/// The formats of models, by what a file is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Json,
    Bif,
    XmlBif,
    Dot,
}

fn format(path: &Path) -> Result<Format, Complaint> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("json") | None => Ok(Format::Json),
        Some("bif") => Ok(Format::Bif),
        Some("xml" | "bifxml" | "xmlbif") => Ok(Format::XmlBif),
        Some("dot" | "gv") => Ok(Format::Dot),
        Some(other) => Err(Complaint::with_help(
            format!("{}: nobody knows what a model in a file .{other} is", files::name(path)),
            "a model is JSON (.json), BIF (.bif) or XMLBIF (.xml)",
        )),
    }
}

/// Reads a model.
pub fn read(path: &Path) -> Result<Network, Complaint> {
    let format = format(path)?;
    let text = files::read(path)?;
    if let Some(byte) = text.bad {
        return Err(Complaint::new(format!("{}: byte {byte} is not UTF-8", files::name(path))));
    }
    let network = match format {
        Format::Json => json::read(&text.text),
        Format::Bif => bif::read(&text.text),
        Format::XmlBif => xmlbif::read(&text.text),
        Format::Dot => {
            return Err(Complaint::new(format!(
                "{}: a picture of a graph is no model",
                files::name(path)
            )));
        }
    };
    network.map_err(|fault| Complaint::new(format!("{}: {fault}", files::name(path))))
}

/// Writes a model in the format that the file is called by.
pub fn write(network: &Network, path: &Path) -> Result<(), Complaint> {
    let wrong = |what| Complaint::new(format!("{}: {what}", files::name(path)));
    let text = match format(path)? {
        Format::Json => json::write(network),
        Format::Bif => bif::write(network).map_err(wrong)?,
        Format::XmlBif => xmlbif::write(network).map_err(wrong)?,
        Format::Dot => dot::write(network),
    };
    files::write(path, text.as_bytes())
}

/// Draws a model with the probabilities of all states where they are known, and below it the tables where they are asked for.
pub fn draw(network: &Network, tables: bool, path: &Path) -> Result<(), Complaint> {
    let marginals: Option<Vec<Vec<f64>>> = JunctionTree::new(network).ok().and_then(|tree| {
        let calibrated = tree.calibrate(&[]).ok()?;
        network.ids().map(|id| calibrated.posterior(id)).collect()
    });
    let details = svg::Details { marginals: marginals.as_deref(), tables };
    files::write(path, svg::draw(network, details).as_bytes())
}

/// The variable of a name.
pub fn find(network: &Network, name: &str) -> Result<VariableId, Complaint> {
    network
        .named(name)
        .ok_or_else(|| no_variable(name, network.variables().iter().map(|one| one.name.as_str())))
}

/// A variable and its state, as NAME=VALUE says them.
pub fn assignment(network: &Network, text: &str) -> Result<(VariableId, State), Complaint> {
    let (name, value) = pair(text, '=', "NAME=VALUE")?;
    let id = find(network, name)?;
    let variable = network.variable(id);
    let number = || value.parse().ok().and_then(|number| variable.state_of_number(number));
    if let Some(state) = variable.state_of_word(value).or_else(number) {
        return Ok((id, state));
    }
    let message = match value.parse::<f64>() {
        Ok(_) if variable.is_ordered() => {
            format!("`{name}` is {value}, outside every interval of the model")
        }
        _ => format!("`{name}` has no state `{value}`"),
    };
    Err(Complaint::with_help(message, format!("its states are {}", variable.labels().join(", "))))
}

/// The variable and its state that are success, as the command line says or else the model itself; `of` begins the complaint.
pub fn goal(
    network: &Network,
    said: Option<&str>,
    of: &str,
    option: &str,
) -> Result<(VariableId, State), Complaint> {
    match (said, &network.goal) {
        (Some(text), _) => assignment(network, text),
        (None, Some(goal)) => assignment(network, &format!("{}={}", goal.variable, goal.state)),
        (None, None) => Err(Complaint::with_help(
            format!("{of}nothing says what success is"),
            format!("for example `{option} onTop=1`"),
        )),
    }
}

/// The graph of arcs by hand.
pub fn graph(variables: &[Variable], arcs: &[String]) -> Result<Dag, Complaint> {
    let find = |name: &str| {
        named(variables, name)
            .ok_or_else(|| no_variable(name, variables.iter().map(|one| one.name.as_str())))
    };
    let mut pairs = Vec::with_capacity(arcs.len());
    for text in arcs {
        let (from, to) = pair(text, ':', "CAUSE:EFFECT")?;
        pairs.push((find(from)?, find(to)?));
    }
    Dag::of_arcs(variables.len(), pairs)
        .map_err(|cycle| Complaint::new(Network::cycle(variables, &cycle).to_string()))
}

/// How probabilities are estimated: `likelihood`, `bdeu:WEIGHT`, `dirichlet:WEIGHT`.
pub fn estimator(text: &str) -> Result<Estimator<'static>, Complaint> {
    let weight = |rest: &str| {
        rest.parse::<f64>()
            .ok()
            .filter(|weight| weight.is_finite() && *weight > 0.0)
            .ok_or_else(|| Complaint::new(format!("`{rest}` is no number of trials above 0")))
    };
    match text.split_once(':') {
        None if text == "likelihood" => Ok(Estimator::Likelihood),
        Some(("bdeu", rest)) => Ok(Estimator::Bdeu(weight(rest)?)),
        Some(("dirichlet", rest)) => Ok(Estimator::Dirichlet(weight(rest)?)),
        _ => Err(Complaint::with_help(
            format!("nobody knows the estimate `{text}`"),
            "there are likelihood, bdeu:WEIGHT and dirichlet:WEIGHT",
        )),
    }
}
