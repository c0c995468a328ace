//! DOT, for Graphviz: the graph, with the strengths of its arcs.

use crate::network::Network;
use crate::variable::VariableId;

/// Writes the graph of a network.
pub fn write(network: &Network) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""));
    let mut text = String::from(
        "digraph caveat {\n  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n",
    );
    for variable in network.variables() {
        let goal = network.goal.as_ref().is_some_and(|goal| goal.variable == variable.name);
        let heavy = if goal { ", penwidth=2" } else { "" };
        let label = variable
            .unit
            .as_ref()
            .map_or_else(|| variable.name.clone(), |unit| format!("{} ({unit})", variable.name));
        put!(text, "  {} [label={}{heavy}];\n", quoted(&variable.name), quoted(&label));
    }
    for (from, to) in network.graph().arcs() {
        let (one, other) = (&network.variable(from).name, &network.variable(to).name);
        let mut marks: Vec<String> = Vec::new();
        if is_undirected(network, from, to) {
            marks.push("dir=none".to_owned());
        }
        if let Some(strength) = strength(network, from, to) {
            marks.push(format!(
                "label=\"{:.0} %\", penwidth={:.2}",
                strength * 100.0,
                0.5 + 2.5 * strength
            ));
        }
        let marks =
            if marks.is_empty() { String::new() } else { format!(" [{}]", marks.join(", ")) };
        put!(text, "  {} -> {}{marks};\n", quoted(one), quoted(other));
    }
    text.push_str("}\n");
    text
}

/// Whether nothing tells the direction of an arc.
pub(super) fn is_undirected(network: &Network, from: VariableId, to: VariableId) -> bool {
    let (from, to) = (&network.variable(from).name, &network.variable(to).name);
    network
        .about
        .undirected
        .iter()
        .any(|(one, other)| (one == from && other == to) || (one == to && other == from))
}

/// In which share of resampled trials two variables were joined.
pub(super) fn strength(network: &Network, from: VariableId, to: VariableId) -> Option<f64> {
    let (from, to) = (&network.variable(from).name, &network.variable(to).name);
    let joins = |one: &&crate::network::Strength| {
        (one.from == *from && one.to == *to) || (one.from == *to && one.to == *from)
    };
    network.about.strengths.iter().find(joins).map(|one| one.joined)
}
