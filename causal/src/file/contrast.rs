//! A failure and the nearest success go in; a picture of both side by side comes out (SVG): the scene where the vocabulary describes one,
//! and for each variable its states, that of the failure in red and that of the success in green.

use super::svg::{escaped, sheet, shortened};
use crate::contrast::{Answer, Question, corrected};
use crate::situation::{Known, Situation, state};
use crate::words::{Scene, Vocabulary, said};

/// Sizes in pixels.
const WIDTH: f64 = 560.0;
const SCENE: f64 = 230.0;
const STRIP: f64 = 46.0;
const MARGIN: f64 = 20.0;
const LABEL: f64 = 110.0;

const RED: &str = "#c44";
const GREEN: &str = "#4a7";

/// Draws a situation and the one of an answer.
pub fn draw(question: &Question, answer: &Answer, vocabulary: &Vocabulary) -> String {
    let network = question.network;
    let after = corrected(network, question.situation, &answer.changes);
    let mut body = String::new();
    let mut top = MARGIN;
    if let Some(scene) = &vocabulary.scene {
        let half = (WIDTH - 3.0 * MARGIN) / 2.0;
        for (at, (title, colour, values)) in
            [("as it was", RED, question.situation), ("instead", GREEN, &after)]
                .into_iter()
                .enumerate()
        {
            let left = MARGIN + at as f64 * (half + MARGIN);
            panel(&mut body, scene, values, (title, colour), (left, top, half));
        }
        top += SCENE + MARGIN;
    }
    for &(id, _) in &question.free {
        let variable = network.variable(id);
        let Ok(Some(from)) = state(variable, question.situation) else { continue };
        let change = answer.changes.iter().find(|change| change.variable == id);
        let arity = variable.arity();
        let width = (WIDTH - 2.0 * MARGIN - LABEL) / arity as f64;
        put!(
            body,
            "<text x=\"{MARGIN}\" y=\"{:.1}\">{}</text>\n",
            top + 15.0,
            escaped(&shortened(&variable.name, 16))
        );
        for one in (0..arity).map(|one| one as u8) {
            let left = MARGIN + LABEL + f64::from(one) * width;
            let to = change.map(|change| change.to);
            let fill = match (one == from, Some(one) == to) {
                (true, _) if change.is_some() => RED,
                (_, true) => GREEN,
                (true, _) => "#9bd",
                _ => "#eef2f5",
            };
            put!(
                body,
                "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"20\" fill=\"{fill}\" stroke=\"#fff\"/>",
            );
        }
        let told = match change {
            Some(change) => {
                format!("{} instead of {}", said(variable, change.to), said(variable, change.from))
            }
            None => format!("{}, as it was", said(variable, from)),
        };
        put!(
            body,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#456\">{}</text>\n",
            MARGIN + LABEL,
            top + 33.0,
            escaped(&told)
        );
        top += STRIP;
    }
    sheet((WIDTH, top), 12, &body)
}

/// Cubes from the side: the first one on a table, each further one where it is let go over the one below.
fn panel(
    body: &mut String,
    scene: &Scene,
    values: &Situation,
    (title, colour): (&str, &str),
    (left, top, width): (f64, f64, f64),
) {
    let number = |name: &String| match values.get(name) {
        Some(Known::Number(value)) => *value,
        _ => 0.0,
    };
    // What is drawn, in the scene's unit: the middle of each cube from that of the first, and its lower face from the table.
    let mut cubes = vec![(0.0, 0.0)];
    for cube in &scene.cubes {
        let (x, bottom) = cubes[cubes.len() - 1];
        let last = cubes.len() == scene.cubes.len();
        let drop = if last { number(&cube.drop) } else { 0.0 };
        cubes.push((x + number(&cube.x), bottom + scene.edge + drop));
    }
    let high = cubes[cubes.len() - 1].1 + scene.edge;
    let wide = cubes.iter().map(|(x, _)| x.abs()).fold(0.0, f64::max) * 2.0 + scene.edge;
    let scale = ((SCENE - 50.0) / high).min((width - 20.0) / wide).min(40.0);
    let (middle, floor) = (left + width / 2.0, top + SCENE - 12.0);
    put!(
        *body,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{SCENE}\" rx=\"4\" fill=\"none\" stroke=\"{colour}\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" fill=\"{colour}\" font-weight=\"bold\">{title}</text>\
         <path d=\"M{:.1} {floor:.1}H{:.1}\" stroke=\"#789\"/>\n",
        left + 8.0,
        top + 18.0,
        left + 10.0,
        left + width - 10.0
    );
    for (at, (x, bottom)) in cubes.iter().enumerate() {
        let side = scene.edge * scale;
        let fill = if at == 0 { "#cdd6dd" } else { "#9bd" };
        put!(
            *body,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{side:.1}\" height=\"{side:.1}\" fill=\"{fill}\" stroke=\"#456\"/>\n",
            middle + x * scale - side / 2.0,
            floor - bottom * scale - side
        );
    }
}
