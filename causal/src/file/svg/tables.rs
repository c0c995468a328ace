//! A network goes in; the tables of its variables come out as rows of text, each probability on a shade as dark as it is great.

use super::{MARGIN, escaped, shortened};
use crate::network::Network;
use crate::variable::{State, VariableId};

/// Sizes in pixels.
const LETTER: f64 = 6.4;
const LINE: f64 = 17.0;
const PAD: f64 = 12.0;
const BETWEEN: f64 = 22.0;

/// As many rows as a table shows, and as many letters as a cell.
const MOST_ROWS: usize = 64;
const MOST_LETTERS: usize = 24;

/// Draws the tables of all variables one below the other from `top`. The width and the lower end come after the elements.
pub fn draw(network: &Network, top: f64) -> (String, f64, f64) {
    let (mut svg, mut widest, mut y) = (String::new(), 0.0_f64, top);
    for id in network.ids() {
        let (width, end) = table(network, id, y, &mut svg);
        widest = widest.max(width);
        y = end + BETWEEN;
    }
    (svg, widest, y)
}

/// Draws one table from `top`. Its width and its lower end come out.
fn table(network: &Network, id: VariableId, top: f64, svg: &mut String) -> (f64, f64) {
    let variable = network.variable(id);
    let parents = network.graph().parents(id);
    let rows = network.rows(id).expect("the rows of a network are numbered");
    let short = |text: &str| shortened(text, MOST_LETTERS);
    let mut head: Vec<String> =
        parents.iter().map(|&parent| short(&network.variable(parent).name)).collect();
    head.extend(variable.labels().iter().map(|label| short(label)));
    let counted = network.table(id).counts.is_some();
    if counted {
        head.push("trials".to_owned());
    }
    let causes = |row: usize| -> Vec<String> {
        let states = network.states_of(id, row);
        let labels = parents.iter().zip(states);
        labels.map(|(&parent, state)| short(&network.variable(parent).label(state))).collect()
    };
    let mut widths: Vec<f64> = head.iter().map(|cell| letters(cell).max(7.0)).collect();
    for row in 0..rows.min(MOST_ROWS) {
        for (width, cell) in widths.iter_mut().zip(causes(row)) {
            *width = width.max(letters(&cell));
        }
    }
    let mut lefts = vec![MARGIN];
    for width in &widths {
        lefts.push(lefts[lefts.len() - 1] + width * LETTER + PAD);
    }
    let mut y = top + LINE;
    let text = |svg: &mut String, at: usize, y: f64, weight: &str, cell: &str| {
        let x = lefts[at] + PAD / 2.0;
        put!(*svg, "<text x=\"{x:.1}\" y=\"{y:.1}\"{weight}>{}</text>", escaped(cell));
    };
    let bold = " font-weight=\"bold\"";
    text(svg, 0, y, bold, &title(network, id));
    y += LINE;
    for (at, cell) in head.iter().enumerate() {
        text(svg, at, y, " fill=\"#456\"", cell);
    }
    let right = lefts[lefts.len() - 1];
    put!(*svg, "<path d=\"M{MARGIN:.1} {0:.1}H{right:.1}\" stroke=\"#456\"/>\n", y + 5.0);
    for row in 0..rows.min(MOST_ROWS) {
        y += LINE;
        for (at, cell) in causes(row).iter().enumerate() {
            text(svg, at, y, "", cell);
        }
        for state in 0..variable.arity() {
            let at = parents.len() + state;
            let Some(probability) = network.row(id, row).map(|row| row[state]) else {
                text(svg, at, y, " fill=\"#a33\"", "unknown");
                continue;
            };
            put!(
                *svg,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{LINE}\" fill=\"#9bd\" fill-opacity=\"{probability:.3}\"/>",
                lefts[at],
                y - LINE + 5.0,
                lefts[at + 1] - lefts[at]
            );
            text(svg, at, y, "", &format!("{probability:.4}"));
        }
        if let Some(counts) = network.counts(id, row) {
            let trials: u64 = counts.iter().sum();
            text(svg, parents.len() + variable.arity(), y, " fill=\"#456\"", &trials.to_string());
        }
        svg.push('\n');
    }
    if rows > MOST_ROWS {
        y += LINE;
        text(svg, 0, y, "", &format!("and {} rows more", rows - MOST_ROWS));
    }
    (right + MARGIN, y)
}

/// The variable, and what its table is given.
fn title(network: &Network, id: VariableId) -> String {
    let name = |id: VariableId| network.variable(id).name.as_str();
    let parents = network.causes(id);
    let goal = network.goal.as_ref().filter(|goal| goal.variable == name(id));
    let success = goal.map_or_else(String::new, |goal| {
        let variable = network.variable(id);
        let sure = |row: usize| {
            let state = variable.state_of_word(&goal.state).unwrap_or(State::MAX);
            network.row(id, row).and_then(|row| row.get(usize::from(state)).copied())
        };
        let best = (0..network.rows(id).unwrap_or(0)).filter_map(sure).fold(0.0, f64::max);
        format!(" (success is {}, at best {best:.2})", goal.state)
    });
    match parents.as_slice() {
        [] => format!("{}{success}", name(id)),
        some => format!("{} given {}{success}", name(id), some.join(", ")),
    }
}

fn letters(text: &str) -> f64 {
    text.chars().count() as f64
}
