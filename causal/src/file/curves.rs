//! Numbers in rows go in; a picture (SVG) of them as curves, panel beside panel, comes out.

use super::svg::{escaped, sheet};

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it is about.
    pub title: String,
    /// What stands below each panel.
    pub axis: String,
    /// The places along that axis, from left to right, at equal distances.
    pub places: Vec<String>,
    /// What the curves are called, with their looks, in the order in which they are drawn.
    pub curves: Vec<Curve>,
    /// The panels, row by row, two in a row.
    pub panels: Vec<Panel>,
}

/// A curve that is in every panel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Curve {
    /// What it is called.
    pub name: String,
    /// Its colour and mark, by number; the first is grey.
    pub colour: usize,
    /// How it is dashed, by number; the first is not.
    pub dash: usize,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// What is measured.
    pub title: String,
    /// For each curve its value at each place; none where there is none.
    pub values: Vec<Vec<Option<f64>>>,
}

/// Sizes in pixels.
const WIDTH: f64 = 380.0;
const HEIGHT: f64 = 250.0;
const LEFT: f64 = 46.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 40.0;
const TITLE: f64 = 30.0;
const ROW: f64 = 18.0;

const COLOURS: [&str; 5] = ["#888888", "#1b7837", "#2166ac", "#d6604d", "#762a83"];
const DASHES: [&str; 4] = ["", "7 3", "2 3", "9 3 2 3"];

/// Draws a chart.
pub fn draw(chart: &Chart) -> String {
    let rows = chart.panels.len().div_ceil(2);
    let columns = chart.panels.len().clamp(1, 2);
    let width = WIDTH * columns as f64;
    let legend = ROW * chart.curves.len().div_ceil(columns) as f64 + 12.0;
    let height = TITLE + HEIGHT * rows as f64 + legend;
    let mut svg = format!(
        "<text x=\"{:.1}\" y=\"20\" text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\">{}</text>\n",
        width / 2.0,
        escaped(&chart.title)
    );
    for (at, one) in chart.panels.iter().enumerate() {
        let (x, y) = ((at % 2) as f64 * WIDTH, TITLE + (at / 2) as f64 * HEIGHT);
        panel(&mut svg, chart, one, (x, y));
    }
    for (at, curve) in chart.curves.iter().enumerate() {
        let x = LEFT + (at % columns) as f64 * WIDTH;
        let y = TITLE + HEIGHT * rows as f64 + ROW * (at / columns) as f64 + 8.0;
        line(&mut svg, curve, &[(x, y), (x + 34.0, y)]);
        mark(&mut svg, curve, (x + 17.0, y));
        put!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
            x + 42.0,
            y + 4.0,
            escaped(&curve.name)
        );
    }
    sheet((width, height), 11, &svg)
}

/// Draws a panel whose upper left corner is here.
fn panel(svg: &mut String, chart: &Chart, panel: &Panel, (x, y): (f64, f64)) {
    let (left, right) = (x + LEFT, x + WIDTH - RIGHT);
    let (top, bottom) = (y + TOP, y + HEIGHT - BOTTOM);
    put!(
        *svg,
        "<text x=\"{left:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>\n",
        y + 18.0,
        escaped(&panel.title)
    );
    let ticks = ticks(panel.values.iter().flatten().flatten().copied());
    let (low, high) = (ticks[0], ticks[ticks.len() - 1]);
    let height_of = |value: f64| bottom - (value - low) / (high - low) * (bottom - top);
    for &tick in &ticks {
        let at = height_of(tick);
        put!(
            *svg,
            "<path d=\"M{left:.1} {at:.1}H{right:.1}\" stroke=\"#dddddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>\n",
            left - 5.0,
            at + 4.0,
            crate::words::rounded(tick)
        );
    }
    let step = (right - left - 24.0) / (chart.places.len().max(2) - 1) as f64;
    let across = |place: usize| left + 12.0 + step * place as f64;
    for (place, label) in chart.places.iter().enumerate() {
        put!(
            *svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n",
            across(place),
            bottom + 15.0,
            escaped(label)
        );
    }
    put!(
        *svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555555\">{}</text>\n",
        f64::midpoint(left, right),
        bottom + 30.0,
        escaped(&chart.axis)
    );
    for (curve, values) in chart.curves.iter().zip(&panel.values) {
        let points: Vec<(f64, f64)> = values
            .iter()
            .enumerate()
            .filter_map(|(place, value)| Some((across(place), height_of((*value)?))))
            .collect();
        line(svg, curve, &points);
        for point in points {
            mark(svg, curve, point);
        }
    }
}

fn line(svg: &mut String, curve: &Curve, points: &[(f64, f64)]) {
    let path: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
    put!(
        *svg,
        "<path d=\"M{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"/>\n",
        path.join("L"),
        COLOURS[curve.colour % COLOURS.len()],
        DASHES[curve.dash % DASHES.len()]
    );
}

/// A mark whose shape says what its colour says.
fn mark(svg: &mut String, curve: &Curve, (x, y): (f64, f64)) {
    let colour = COLOURS[curve.colour % COLOURS.len()];
    let shape = match curve.colour % COLOURS.len() {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\""),
        1 => format!("<path d=\"M{:.1} {:.1}h6v6h-6z\"", x - 3.0, y - 3.0),
        2 => format!("<path d=\"M{x:.1} {:.1}l4 7h-8z\"", y - 4.5),
        3 => format!("<path d=\"M{x:.1} {:.1}l4 4l-4 4l-4 -4z\"", y - 4.0),
        _ => format!("<path d=\"M{x:.1} {:.1}l4 -7h-8z\"", y + 4.5),
    };
    put!(*svg, "{shape} fill=\"{colour}\"/>\n");
}

/// Round numbers that hold all values between the first and the last.
fn ticks(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), one| (low.min(one), high.max(one)));
    if low > high {
        return vec![0.0, 1.0];
    }
    let span = (high - low).max(0.02);
    let step = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|step| span / step <= 5.0)
        .unwrap_or(span / 5.0);
    let (first, mut last) = ((low / step).floor(), (high / step).ceil());
    if first >= last {
        last = first + 1.0;
    }
    let count = (last - first) as usize;
    (0..=count).map(|at| (first + at as f64) * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_hold_all_values() {
        let around = |values: &[f64]| ticks(values.iter().copied());
        let same = |found: Vec<f64>, wanted: &[f64]| {
            assert_eq!(found.len(), wanted.len(), "{found:?}");
            assert!(found.iter().zip(wanted).all(|(one, other)| (one - other).abs() < 1e-9));
        };
        same(around(&[0.61, 0.83]), &[0.6, 0.65, 0.7, 0.75, 0.8, 0.85]);
        same(around(&[0.5]), &[0.5, 0.505]);
        same(around(&[0.0, 1.0]), &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        same(around(&[]), &[0.0, 1.0]);
    }
}
