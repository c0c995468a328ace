//! A header and frames of a log go in; a drawing of them from above and from the front comes out, as SVG.

use learner::log::{Frame, Header};
use nalgebra::{Isometry3, Point3, Vector3};
use std::fmt::Write;

/// Pixels for a metre.
const SCALE: f64 = 320.0;
/// Around the drawing, in metres.
const MARGIN: f64 = 0.1;
const COLOURS: [&str; 6] = ["#c0392b", "#27ae60", "#2980b9", "#d4a017", "#8e44ad", "#16a085"];

/// Draws what was there at the first and the last of some frames, and the ways of hands and things between them.
pub fn draw(header: &Header, frames: &[Frame]) -> String {
    let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return String::new() };
    // The level coordinate is x in both views; above it is y from above, and z from the front.
    let views: [(&str, usize); 2] = [("from above", 1), ("from the front", 2)];
    let mut least = Vector3::repeat(f64::INFINITY);
    let mut most = Vector3::repeat(f64::NEG_INFINITY);
    let mut widen = |place: Vector3<f64>| {
        least = least.inf(&place);
        most = most.sup(&place);
    };
    for frame in frames {
        for pose in frame.hands.iter().flatten().map(|hand| hand.pose) {
            widen(pose.translation.vector);
        }
        for (object, sample) in header.objects.iter().zip(&frame.objects) {
            for corner in sample.iter().flat_map(|sample| corners(&sample.pose, object.size)) {
                widen(corner.coords);
            }
        }
    }
    let span = most - least;
    let width = (span.x + 2.0 * MARGIN) * SCALE;
    let heights = views.map(|(_, axis)| (span[axis] + 2.0 * MARGIN) * SCALE);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{:.0}\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>",
        heights[0] + heights[1]
    );
    let mut top = 0.0;
    for ((name, axis), height) in views.into_iter().zip(heights) {
        let _ = writeln!(text, "<text x=\"6\" y=\"{:.0}\">{name}</text>", top + 14.0);
        let at = |place: Vector3<f64>| {
            let x = (place.x - least.x + MARGIN) * SCALE;
            let y = top + height - (place[axis] - least[axis] + MARGIN) * SCALE;
            format!("{x:.1},{y:.1}")
        };
        for (number, object) in header.objects.iter().enumerate() {
            let colour = if object.fixed { "#999" } else { COLOURS[number % COLOURS.len()] };
            for (frame, dash) in [(first, " stroke-dasharray=\"4 3\""), (last, "")] {
                let Some(sample) = &frame.objects[number] else { continue };
                let outline =
                    hull(corners(&sample.pose, object.size).map(|corner| (corner.x, corner[axis])));
                let points: Vec<String> = outline
                    .into_iter()
                    .map(|(x, y)| {
                        let mut place = Vector3::new(x, 0.0, 0.0);
                        place[axis] = y;
                        at(place)
                    })
                    .collect();
                let _ = writeln!(
                    text,
                    "<polygon points=\"{}\" fill=\"{colour}\" fill-opacity=\"0.12\" stroke=\"{colour}\"{dash}/>",
                    points.join(" ")
                );
                if dash.is_empty() {
                    let place = at(sample.pose.translation.vector);
                    let (x, y) = place.split_once(',').unwrap_or_default();
                    // Names of things that lie on each other stand below each other.
                    let lower = 12 * (number % 3);
                    let _ = writeln!(
                        text,
                        "<text x=\"{x}\" y=\"{y}\" dy=\"{lower}\" fill=\"{colour}\">{}</text>",
                        object.name
                    );
                }
            }
        }
        for hand in 0..header.hands.len() {
            let points: Vec<String> = frames
                .iter()
                .filter_map(|frame| frame.hands[hand].as_ref())
                .map(|sample| at(sample.pose.translation.vector))
                .collect();
            let _ = writeln!(
                text,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"/>",
                points.join(" "),
                ["#333", "#e67e22"][hand % 2]
            );
        }
        top += height;
    }
    text.push_str("</svg>\n");
    text
}

/// The corners of a box.
fn corners(pose: &Isometry3<f64>, size: Vector3<f64>) -> [Point3<f64>; 8] {
    let half = size / 2.0;
    std::array::from_fn(|corner| {
        let sign = |bit: usize| if corner & bit == 0 { -1.0 } else { 1.0 };
        let signs = Vector3::new(sign(1), sign(2), sign(4));
        pose * Point3::from(half.component_mul(&signs))
    })
}

/// The convex outline of some points in a plane (Andrew's monotone chain, 1979).
fn hull(points: [(f64, f64); 8]) -> Vec<(f64, f64)> {
    let mut points = points.to_vec();
    points.sort_by(|first, second| first.0.total_cmp(&second.0).then(first.1.total_cmp(&second.1)));
    let mut outline: Vec<(f64, f64)> = Vec::new();
    for pass in 0..2 {
        let start = outline.len();
        for &point in &points {
            while outline.len() >= start + 2 {
                let (before, last) = (outline[outline.len() - 2], outline[outline.len() - 1]);
                let turn = (last.0 - before.0) * (point.1 - before.1)
                    - (last.1 - before.1) * (point.0 - before.0);
                if turn > 0.0 {
                    break;
                }
                outline.pop();
            }
            outline.push(point);
        }
        outline.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    outline
}
