//! A picture of a network (SVG): causes above their effects, each variable with the probabilities of its states as bars, arcs as wide as
//! they are strong.
//!
//! The layout is Sugiyama's: layers by the longest way from a root, places of arcs in the layers that they cross, and an order within
//! each layer by the middle of what a place is joined to.

mod tables;

use super::dot::{is_undirected, strength};
use crate::network::Network;
use crate::variable::VariableId;

/// Sizes in pixels.
const BOX: f64 = 230.0;
const TITLE: f64 = 24.0;
const ROW: f64 = 15.0;
const GAP: f64 = 28.0;
const BETWEEN: f64 = 64.0;
const MARGIN: f64 = 16.0;

/// As many states as a box shows.
const MOST_ROWS: usize = 8;

/// A place in a layer: a variable, or an arc that passes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Node(VariableId),
    Pass(VariableId, VariableId, usize),
}

/// What is drawn beside variables and arcs.
#[derive(Debug, Clone, Copy, Default)]
pub struct Details<'a> {
    /// The probabilities of each variable's states, in the order of the variables.
    pub marginals: Option<&'a [Vec<f64>]>,
    /// Below the graph, the table of each variable.
    pub tables: bool,
}

/// Draws a network.
pub fn draw(network: &Network, details: Details) -> String {
    let marginals = details.marginals;
    let layers = layers(network);
    let height = |id: VariableId| {
        let rows =
            if marginals.is_some() { network.variable(id).arity().min(MOST_ROWS + 1) } else { 0 };
        TITLE + rows as f64 * ROW + if rows > 0 { 6.0 } else { 0.0 }
    };
    let width_of = |place: &Place| if matches!(place, Place::Node(_)) { BOX } else { 12.0 };
    let layer_width = |layer: &Vec<Place>| {
        layer.iter().map(width_of).sum::<f64>() + GAP * (layer.len().max(1) - 1) as f64
    };
    let width = layers.iter().map(layer_width).fold(0.0, f64::max) + 2.0 * MARGIN;
    let mut places: Vec<(Place, f64, f64, f64)> = Vec::new();
    let mut top = MARGIN;
    for layer in &layers {
        let mut left = (width - layer_width(layer)) / 2.0;
        let tallest = layer.iter().map(|place| match place {
            Place::Node(id) => height(*id),
            Place::Pass(..) => TITLE,
        });
        let tallest = tallest.fold(0.0, f64::max);
        for place in layer {
            let own = if let Place::Node(id) = place { height(*id) } else { tallest };
            places.push((*place, left + width_of(place) / 2.0, top, own));
            left += width_of(place) + GAP;
        }
        top += tallest + BETWEEN;
    }
    let mut total = top - BETWEEN + MARGIN;
    let mut page = width;
    let mut below = String::new();
    if details.tables {
        let (drawn, widest, end) = tables::draw(network, total);
        (below, total, page) = (drawn, end, width.max(widest));
    }
    let mut svg = "<defs><marker id=\"tip\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"9\" markerHeight=\"9\" \
         markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0 0L10 5L0 10z\" fill=\"#456\"/></marker></defs>\n"
        .to_owned();
    for (from, to) in network.graph().arcs() {
        svg.push_str(&arc(network, &places, from, to));
    }
    for &(place, x, y, height) in &places {
        if let Place::Node(id) = place {
            svg.push_str(&node(
                network,
                id,
                (x, y, height),
                marginals.map(|all| all[id.index()].as_slice()),
            ));
        }
    }
    svg.push_str(&below);
    sheet((page, total), 11, &svg)
}

/// A white sheet of this width and height in pixels, with letters of this size.
pub(super) fn sheet((width, height): (f64, f64), letters: u32, body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"{letters}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{body}</svg>\n"
    )
}

/// The layer of each variable, with the arcs that pass through, in the order from left to right.
fn layers(network: &Network) -> Vec<Vec<Place>> {
    let graph = network.graph();
    let mut depth = vec![0_usize; network.variables().len()];
    for id in graph.order() {
        for parent in graph.parents(id) {
            depth[id.index()] = depth[id.index()].max(depth[parent.index()] + 1);
        }
    }
    let mut layers: Vec<Vec<Place>> =
        vec![Vec::new(); depth.iter().max().map_or(0, |most| most + 1)];
    for id in network.ids() {
        layers[depth[id.index()]].push(Place::Node(id));
    }
    let mut links: Vec<(Place, Place)> = Vec::new();
    for (from, to) in graph.arcs() {
        let mut before = Place::Node(from);
        for (between, layer) in
            layers.iter_mut().enumerate().take(depth[to.index()]).skip(depth[from.index()] + 1)
        {
            let pass = Place::Pass(from, to, between);
            layer.push(pass);
            links.push((before, pass));
            before = pass;
        }
        links.push((before, Place::Node(to)));
    }
    // Down and up, several times: each layer by the middle of what its places are joined to in the layer before.
    for round in 0..8 {
        let down = round % 2 == 0;
        for step in 1..layers.len() {
            let (fixed, moved) = if down {
                (step - 1, step)
            } else {
                (layers.len() - step, layers.len() - step - 1)
            };
            let other = layers[fixed].clone();
            let middle = |place: &Place| {
                let ends = links.iter().filter_map(|(above, below)| {
                    let (own, end) = if down { (below, above) } else { (above, below) };
                    (own == place).then(|| other.iter().position(|one| one == end)).flatten()
                });
                let ends: Vec<usize> = ends.collect();
                let sum: usize = ends.iter().sum();
                if ends.is_empty() { None } else { Some(sum as f64 / ends.len() as f64) }
            };
            let mut keyed: Vec<(f64, Place)> = layers[moved]
                .iter()
                .enumerate()
                .map(|(at, place)| (middle(place).unwrap_or(at as f64), *place))
                .collect();
            keyed.sort_by(|one, two| one.0.total_cmp(&two.0));
            layers[moved] = keyed.into_iter().map(|(_, place)| place).collect();
        }
    }
    layers
}

fn arc(
    network: &Network,
    places: &[(Place, f64, f64, f64)],
    from: VariableId,
    to: VariableId,
) -> String {
    let find = |wanted: Place| places.iter().find(|(place, ..)| *place == wanted);
    let (_, x, y, height) = find(Place::Node(from)).expect("each variable has a place");
    let mut points = vec![(*x, y + height)];
    let mut passes: Vec<(usize, f64, f64, f64)> = places
        .iter()
        .filter_map(|(place, x, y, height)| match place {
            Place::Pass(one, other, layer) if *one == from && *other == to => {
                Some((*layer, *x, *y, *height))
            }
            _ => None,
        })
        .collect();
    passes.sort_by_key(|&(layer, ..)| layer);
    for (_, x, y, height) in passes {
        points.extend([(x, y), (x, y + height)]);
    }
    let (_, x, y, _) = find(Place::Node(to)).expect("each variable has a place");
    points.push((*x, *y));
    let mut path = format!("M{:.1} {:.1}", points[0].0, points[0].1);
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let bend = (y1 - y0) / 2.0;
        put!(path, " C{x0:.1} {:.1} {x1:.1} {:.1} {x1:.1} {y1:.1}", y0 + bend, y1 - bend);
    }
    let known = strength(network, from, to);
    let width = known.map_or(1.4, |strength| 0.6 + 2.4 * strength);
    let (tip, dash) = if is_undirected(network, from, to) {
        ("", " stroke-dasharray=\"5 4\"")
    } else {
        (" marker-end=\"url(#tip)\"", "")
    };
    let names = (escaped(&network.variable(from).name), escaped(&network.variable(to).name));
    let title = known.map_or_else(String::new, |strength| {
        format!(": in {:.0} % of the resampled trials", strength * 100.0)
    });
    format!(
        "<path d=\"{path}\" fill=\"none\" stroke=\"#456\" stroke-width=\"{width:.2}\"{dash}{tip}>\
         <title>{} → {}{title}</title></path>\n",
        names.0, names.1
    )
}

fn node(
    network: &Network,
    id: VariableId,
    (x, y, height): (f64, f64, f64),
    marginal: Option<&[f64]>,
) -> String {
    let variable = network.variable(id);
    let left = x - BOX / 2.0;
    let goal = network.goal.as_ref().filter(|goal| goal.variable == variable.name);
    let (stroke, heavy) = if goal.is_some() { ("#a33", 2.0) } else { ("#456", 1.0) };
    let title = variable
        .unit
        .as_ref()
        .map_or_else(|| variable.name.clone(), |unit| format!("{} ({unit})", variable.name));
    let mut svg = format!(
        "<g><rect x=\"{left:.1}\" y=\"{y:.1}\" width=\"{BOX}\" height=\"{height:.1}\" rx=\"5\" fill=\"#f4f7fa\" \
         stroke=\"{stroke}\" stroke-width=\"{heavy}\"/>\
         <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
        y + 16.0,
        escaped(&shortened(&title, 28))
    );
    let states = variable.arity();
    for (state, &probability) in marginal.unwrap_or_default().iter().enumerate().take(MOST_ROWS) {
        let middle = y + TITLE + ROW * state as f64;
        let label = variable.label(state as u8);
        let wanted = goal.is_some_and(|goal| goal.state == label);
        let colour = if wanted { "#7b9" } else { "#9bd" };
        put!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>\
             <rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"9\" fill=\"{colour}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{:.1} %</text>\n",
            left + 8.0,
            middle + 10.0,
            escaped(&shortened(&label, 22)),
            left + 132.0,
            middle + 2.0,
            (probability * 50.0).max(0.5),
            left + BOX - 6.0,
            middle + 10.0,
            probability * 100.0
        );
    }
    if marginal.is_some() && states > MOST_ROWS {
        let middle = y + TITLE + ROW * MOST_ROWS as f64 + 10.0;
        put!(
            svg,
            "<text x=\"{:.1}\" y=\"{middle:.1}\">and {} more</text>\n",
            left + 8.0,
            states - MOST_ROWS
        );
    }
    svg.push_str("</g>\n");
    svg
}

/// A text of at most so many characters.
pub(super) fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most - 1).chain(['…']).collect()
}

pub(super) fn escaped(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}
