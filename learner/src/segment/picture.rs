//! Segments, or a decision tree, go in; a picture comes out, as SVG text.

use std::fmt::Write as _;

use petgraph::Direction;
use petgraph::graph::{DiGraph, NodeIndex};

use super::timeline::about;
use super::{Segment, Tree};
use crate::log::{HandId, Header};
use crate::truth::Activity;

/// The space for the names of hands, and around the rest, in pixels.
const LEFT: f64 = 110.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 46.0;
const ROW: f64 = 54.0;

/// The time line of all hands: a row for each hand and a box for each segment, with a scale in seconds.
pub fn picture(header: &Header, segments: &[Segment]) -> String {
    let start = segments.iter().map(|segment| segment.start).fold(f64::INFINITY, f64::min);
    let end = segments.iter().map(|segment| segment.end).fold(f64::NEG_INFINITY, f64::max);
    let span = if end > start { end - start } else { 1.0 };
    let start = if start.is_finite() { start } else { 0.0 };
    let scale = (1100.0 / span).clamp(20.0, 160.0);
    let width = LEFT + span * scale + RIGHT;
    let rows = header.hands.len() as f64;
    let height = TOP + rows * ROW + 34.0;
    let mut svg = open(width.max(620.0), height);
    for (place, activity) in Activity::ALL.into_iter().enumerate() {
        let x = LEFT + place as f64 * 100.0;
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.0}\" y=\"12\" width=\"14\" height=\"14\" rx=\"2\" fill=\"{}\"/>\
             <text x=\"{:.0}\" y=\"24\">{activity}</text>",
            colour(activity),
            x + 20.0
        );
    }
    for (number, hand) in header.hands.iter().enumerate() {
        let y = TOP + number as f64 * ROW;
        let _ = writeln!(
            svg,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"end\">{}</text>",
            LEFT - 10.0,
            y + 26.0,
            escape(&hand.name)
        );
        for segment in segments.iter().filter(|segment| segment.hand == HandId(number as u32)) {
            bar(&mut svg, header, segment, start, scale, y);
        }
    }
    let bottom = TOP + rows * ROW;
    let every = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 300.0, 600.0]
        .into_iter()
        .find(|every| every * scale >= 50.0)
        .unwrap_or(1800.0);
    let mut tick = (start / every).ceil() * every;
    while tick <= start + span + 1e-9 {
        let x = LEFT + (tick - start) * scale;
        let label = if every < 1.0 { format!("{tick:.1}") } else { format!("{tick:.0}") };
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{TOP}\" x2=\"{x:.1}\" y2=\"{bottom}\" stroke=\"#999\" stroke-width=\"0.5\" stroke-dasharray=\"2 3\"/>\
             <text x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#444\">{label} s</text>",
            bottom + 18.0
        );
        tick += every;
    }
    svg + "</svg>\n"
}

/// One segment as a box, with what fits into it, and all of it as a title that a viewer shows.
fn bar(svg: &mut String, header: &Header, segment: &Segment, start: f64, scale: f64, y: f64) {
    let x = LEFT + (segment.start - start) * scale;
    let width = (segment.length() * scale).max(0.5);
    let about = about(header, segment);
    let _ = writeln!(
        svg,
        "<g><title>{} {} {:.2}–{:.2} s</title>\
         <rect x=\"{x:.1}\" y=\"{y:.0}\" width=\"{width:.1}\" height=\"42\" rx=\"2\" fill=\"{}\" stroke=\"#fff\" stroke-width=\"0.6\"/>",
        segment.activity,
        escape(&about),
        segment.start,
        segment.end,
        colour(segment.activity)
    );
    for (from, to) in &segment.pauses {
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.0}\" width=\"{:.1}\" height=\"5\" fill=\"{}\"/>",
            LEFT + (from - start) * scale,
            y + 37.0,
            (to - from) * scale,
            colour(Activity::Take)
        );
    }
    let ink = if segment.activity == Activity::Idle { "#333" } else { "#fff" };
    // The two lines of a box: the activity, and the objects below it, each cut where the box ends.
    for (line, text) in [segment.activity.name(), about.as_str()].into_iter().enumerate() {
        let room = ((width - 6.0) / 6.2).max(0.0) as usize;
        if text.is_empty() || room < 2 {
            continue;
        }
        let short: String = if text.chars().count() > room {
            text.chars().take(room - 1).chain(['…']).collect()
        } else {
            text.to_string()
        };
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.0}\" fill=\"{ink}\" font-size=\"11\">{}</text>",
            x + 3.0,
            y + 16.0 + line as f64 * 15.0,
            escape(&short)
        );
    }
    svg.push_str("</g>\n");
}

/// A decision tree from top to bottom: questions in ellipses, activities in boxes, answers at the lines.
pub fn tree_picture(tree: &Tree) -> String {
    let graph = tree.graph();
    let mut places = vec![(0.0, 0.0); graph.node_count()];
    let mut leaves = 0.0;
    if graph.node_count() > 0 {
        place(&graph, NodeIndex::new(0), 0.0, &mut leaves, &mut places);
    }
    let at = |node: NodeIndex| {
        (20.0 + 60.0 + places[node.index()].0 * 140.0, 34.0 + places[node.index()].1 * 100.0)
    };
    let deepest = places.iter().map(|place| place.1).fold(0.0, f64::max);
    let mut svg = open(40.0 + leaves * 140.0, 68.0 + deepest * 100.0);
    for edge in graph.edge_indices() {
        let (from, to) = graph.edge_endpoints(edge).expect("the edge is in the graph");
        let ((x1, y1), (x2, y2)) = (at(from), at(to));
        let _ = writeln!(
            svg,
            "<line x1=\"{x1:.0}\" y1=\"{y1:.0}\" x2=\"{x2:.0}\" y2=\"{y2:.0}\" stroke=\"#555\"/>\
             <text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" stroke=\"#fff\" stroke-width=\"5\" paint-order=\"stroke\">{}</text>",
            f64::midpoint(x1, x2),
            f64::midpoint(y1, y2) + 4.0,
            graph[edge]
        );
    }
    for node in graph.node_indices() {
        let (x, y) = at(node);
        let inner = graph.neighbors_directed(node, Direction::Outgoing).next().is_some();
        let mut lines = graph[node].lines();
        let first = lines.next().unwrap_or_default();
        if inner {
            let _ = writeln!(
                svg,
                "<ellipse cx=\"{x:.0}\" cy=\"{y:.0}\" rx=\"56\" ry=\"22\" fill=\"#fff\" stroke=\"#333\"/>"
            );
        } else {
            let fill = Activity::ALL
                .into_iter()
                .find(|activity| activity.name() == first)
                .map_or("#ddd", colour);
            let _ = writeln!(
                svg,
                "<rect x=\"{:.0}\" y=\"{:.0}\" width=\"112\" height=\"40\" rx=\"4\" fill=\"{fill}\"/>",
                x - 56.0,
                y - 20.0
            );
        }
        let ink = if inner || first == "Idle" { "#222" } else { "#fff" };
        let below = lines.next();
        let _ = writeln!(
            svg,
            "<text x=\"{x:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"{ink}\">{first}</text>",
            y + if below.is_some() { -2.0 } else { 4.0 }
        );
        if let Some(below) = below {
            let _ = writeln!(
                svg,
                "<text x=\"{x:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"{ink}\" font-size=\"10\">{below}</text>",
                y + 13.0
            );
        }
    }
    svg + "</svg>\n"
}

/// Gives each node its column and its row: a leaf the next free column, a question the middle of its answers.
fn place(
    graph: &DiGraph<String, &'static str>,
    node: NodeIndex,
    depth: f64,
    leaves: &mut f64,
    places: &mut [(f64, f64)],
) {
    let mut children: Vec<NodeIndex> =
        graph.neighbors_directed(node, Direction::Outgoing).collect();
    // The graph gives its youngest edges first.
    children.reverse();
    for &child in &children {
        place(graph, child, depth + 1.0, leaves, places);
    }
    let column = if let (Some(first), Some(last)) = (children.first(), children.last()) {
        f64::midpoint(places[first.index()].0, places[last.index()].0)
    } else {
        *leaves += 1.0;
        *leaves - 1.0
    };
    places[node.index()] = (column, depth);
}

/// The start of a picture of this size in pixels.
fn open(width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"DejaVu Sans, Helvetica, sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    )
}

/// Colours that differ in lightness too, so that they can be told apart in print and by most eyes.
fn colour(activity: Activity) -> &'static str {
    match activity {
        Activity::Idle => "#dddddd",
        Activity::Reach => "#4477aa",
        Activity::Take => "#aa3377",
        Activity::Put => "#228833",
        Activity::Granular => "#b8590b",
    }
}

/// A text as it may stand in XML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
