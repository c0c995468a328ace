//! Segments go in; a time line that a person reads in a terminal comes out, not wider than 100 columns.

use std::fmt::Write as _;

use super::Segment;
use crate::log::{HandId, Header, ObjectId};
use crate::truth::Activity;

/// How wide the text is at most.
const WIDTH: usize = 100;

/// The time line of all hands as one strip for each hand, and then each hand's segments one by one with their seconds.
pub fn timeline(header: &Header, segments: &[Segment]) -> String {
    let mut text = String::new();
    let (Some(start), Some(end)) = (
        segments.iter().map(|segment| segment.start).min_by(f64::total_cmp),
        segments.iter().map(|segment| segment.end).max_by(f64::total_cmp),
    ) else {
        return String::from("no frames\n");
    };
    let names =
        header.hands.iter().map(|hand| hand.name.chars().count()).max().unwrap_or(0).min(30);
    let room = WIDTH - names - 2;
    let span = (end - start).max(1e-3);
    let step = step(span, room);
    // A round scale lets a reader count columns.
    let columns = ((span / step).ceil() as usize).clamp(1, room);
    let _ = writeln!(text, "{:names$}  {}", "", axis(start, step, columns));
    for (number, hand) in header.hands.iter().enumerate() {
        let own: Vec<&Segment> =
            segments.iter().filter(|segment| segment.hand == HandId(number as u32)).collect();
        let strip: String =
            (0..columns).map(|column| sign(&own, start + column as f64 * step, step)).collect();
        let name: String = hand.name.chars().take(names).collect();
        let _ = writeln!(text, "{name:names$}  {}", strip.trim_end());
    }
    let legend: Vec<String> = Activity::ALL
        .into_iter()
        .map(|activity| format!("{} {activity}", letter(activity)))
        .collect();
    let _ = writeln!(text, "{:names$}  {}", "", legend.join("   "));
    for (number, hand) in header.hands.iter().enumerate() {
        let _ = writeln!(text, "\n{}", hand.name);
        for segment in segments.iter().filter(|segment| segment.hand == HandId(number as u32)) {
            let _ = writeln!(text, "{}", line(header, segment));
        }
    }
    text
}

/// One segment: `  1.20 –   2.05 s  Granular  red-cube on blue-cube`.
fn line(header: &Header, segment: &Segment) -> String {
    let mut line = format!("{:8.2} – {:7.2} s  {:8}", segment.start, segment.end, segment.activity);
    line.push_str("  ");
    line.push_str(&about(header, segment));
    if !segment.pauses.is_empty() {
        let rest: f64 = segment.pauses.iter().map(|(start, end)| end - start).sum();
        let count = segment.pauses.len();
        let _ = write!(line, " ({count} pause{}, {rest:.2} s)", if count == 1 { "" } else { "s" });
    }
    line.trim_end().to_string()
}

/// The objects that a segment is about.
pub(super) fn about(header: &Header, segment: &Segment) -> String {
    let name = |object: ObjectId| header.objects[object.index()].name.as_str();
    match (segment.in_hand, segment.acted_on) {
        (Some(held), Some(other)) => format!("{} at {}", name(held), name(other)),
        (Some(one), None) | (None, Some(one)) => name(one).to_string(),
        (None, None) => String::new(),
    }
}

/// How long one column is, in seconds: the shortest round time with which all fits.
fn step(span: f64, room: usize) -> f64 {
    let least = span / room as f64;
    let mut unit = 10f64.powf(least.log10().floor());
    while [1.0, 2.0, 5.0].iter().all(|factor| factor * unit < least) {
        unit *= 10.0;
    }
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * unit >= least);
    factor.unwrap_or(10.0) * unit
}

/// Seconds at every tenth column.
fn axis(start: f64, step: f64, columns: usize) -> String {
    let mut axis = String::new();
    for column in (0..columns).step_by(10) {
        let time = start + column as f64 * step;
        let label = if column == 0 { format!("{time:.1} s") } else { format!("{time:.1}") };
        let _ = write!(
            axis,
            "{:width$}{label}",
            "",
            width = column.saturating_sub(axis.chars().count())
        );
    }
    axis
}

/// The letter of what takes most of a column.
fn sign(own: &[&Segment], from: f64, step: f64) -> char {
    let overlap = |segment: &Segment| segment.end.min(from + step) - segment.start.max(from);
    own.iter()
        .filter(|segment| overlap(segment) > 0.0)
        .max_by(|one, other| overlap(one).total_cmp(&overlap(other)))
        .map_or(' ', |segment| letter(segment.activity))
}

/// The letter of an activity in a strip.
fn letter(activity: Activity) -> char {
    match activity {
        Activity::Idle => '·',
        Activity::Reach => 'r',
        Activity::Take => 'T',
        Activity::Put => 'p',
        Activity::Granular => 'G',
    }
}
