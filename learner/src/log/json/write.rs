//! Frames go in; lines of JSON come out, rounded to micrometres, microradians and microseconds, which no tracker reaches.

use std::io::{self, Write};

use super::super::{Fact, Frame, HandSample, HandState, Header, ObjectSample, header};

/// Writes a log of JSON Lines.
#[derive(Debug)]
pub struct Writer<'h, W> {
    out: W,
    header: &'h Header,
    /// The names of hands and objects as JSON strings.
    hands: Vec<String>,
    objects: Vec<String>,
    line: Vec<u8>,
}

impl<'h, W: Write> Writer<'h, W> {
    /// Writes the header.
    pub fn new(mut out: W, header: &'h Header) -> io::Result<Self> {
        writeln!(out, "{}", header::write(header))?;
        let hands = header.hands.iter().map(|hand| quoted(&hand.name)).collect();
        let objects = header.objects.iter().map(|object| quoted(&object.name)).collect();
        Ok(Self { out, header, hands, objects, line: Vec::new() })
    }

    /// Writes a frame, which must have the hands and objects of the header. What is lost is left out.
    pub fn write(&mut self, frame: &Frame) -> io::Result<()> {
        let mut line = std::mem::take(&mut self.line);
        line.clear();
        line.extend(b"{\"t\":");
        number(&mut line, frame.time);
        line.extend(b",\"hands\":{");
        let mut first = true;
        for (name, hand) in self.hands.iter().zip(&frame.hands) {
            if let Some(hand) = hand {
                entry(&mut line, &mut first, name);
                self.hand(&mut line, hand);
            }
        }
        line.extend(b"},\"objects\":{");
        let mut first = true;
        for (name, object) in self.objects.iter().zip(&frame.objects) {
            if let Some(object) = object {
                entry(&mut line, &mut first, name);
                body(&mut line, object);
            }
        }
        line.push(b'}');
        if let Some(facts) = &frame.facts {
            line.extend(b",\"facts\":");
            write_facts(&mut line, facts);
        }
        line.extend(b"}\n");
        self.out.write_all(&line)?;
        self.line = line;
        Ok(())
    }

    /// Hands over what is still in a buffer, and gives the output back.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }

    fn hand(&self, line: &mut Vec<u8>, hand: &HandSample) {
        if hand.grip.is_none() && !hand.teach && hand.given.is_none() {
            return pose(line, &hand.pose);
        }
        line.extend(b"{\"pose\":");
        pose(line, &hand.pose);
        if let Some(grip) = hand.grip {
            line.extend(b",\"grip\":");
            number(line, grip);
        }
        if hand.teach {
            line.extend(b",\"teach\":true");
        }
        if let Some(state) = &hand.given {
            line.extend(b",\"given\":");
            write_state(line, state, self.header);
        }
        line.push(b'}');
    }
}

/// What a hand does, as JSON.
pub(crate) fn write_state(line: &mut Vec<u8>, state: &HandState, header: &Header) {
    let name = |object: Option<super::super::ObjectId>| {
        object.map_or(String::from("null"), |object| quoted(&header.objects[object.index()].name))
    };
    let text = format!(
        "{{\"moves\":{},\"acted-on\":{},\"in-hand\":{}}}",
        state.moves,
        name(state.acted_on),
        name(state.in_hand)
    );
    line.extend(text.as_bytes());
}

/// Facts as lists of words.
fn write_facts(line: &mut Vec<u8>, facts: &[Fact]) {
    let lists: Vec<Vec<&str>> = facts.iter().map(words).collect();
    line.extend(serde_json::to_string(&lists).expect("words are always JSON").as_bytes());
}

/// A fact as a list of words.
pub(crate) fn words(fact: &Fact) -> Vec<&str> {
    std::iter::once(&fact.predicate).chain(&fact.arguments).map(String::as_str).collect()
}

/// The start of an entry of a JSON object.
fn entry(line: &mut Vec<u8>, first: &mut bool, name: &str) {
    if !std::mem::take(first) {
        line.push(b',');
    }
    line.extend(name.as_bytes());
    line.push(b':');
}

/// An object: its pose alone where there is no more to say.
fn body(line: &mut Vec<u8>, object: &ObjectSample) {
    let sure = object.seen >= 1.0;
    if object.joints.is_empty() && sure {
        return pose(line, &object.pose);
    }
    line.extend(b"{\"pose\":");
    pose(line, &object.pose);
    if !object.joints.is_empty() {
        line.extend(b",\"joints\":");
        list(line, &object.joints);
    }
    if !sure {
        line.extend(b",\"seen\":");
        number(line, object.seen);
    }
    line.push(b'}');
}

/// A pose as seven numbers.
fn pose(line: &mut Vec<u8>, pose: &nalgebra::Isometry3<f64>) {
    let (place, turn) = (pose.translation.vector, pose.rotation.coords);
    list(line, &[place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]);
}

/// A list of numbers.
fn list(line: &mut Vec<u8>, values: &[f64]) {
    line.push(b'[');
    for (place, value) in values.iter().enumerate() {
        if place > 0 {
            line.push(b',');
        }
        number(line, *value);
    }
    line.push(b']');
}

/// A number with at most six digits after the point.
pub(crate) fn number(line: &mut Vec<u8>, value: f64) {
    let millionths = (value * 1e6).round();
    if millionths.abs() >= 9e15 || !millionths.is_finite() {
        // Beyond that six digits are no rounding any more.
        line.extend(format!("{value}").as_bytes());
        return;
    }
    let mut rest = millionths as i64;
    if rest < 0 {
        line.push(b'-');
        rest = -rest;
    }
    let mut digits = [b'0'; 24];
    let mut start = digits.len();
    let mut count = 0;
    while rest > 0 || count < 7 {
        start -= 1;
        digits[start] = b'0' + (rest % 10) as u8;
        rest /= 10;
        count += 1;
    }
    let point = digits.len() - 6;
    line.extend(&digits[start..point]);
    let fraction = digits[point..].trim_ascii_end();
    let used = fraction.iter().rposition(|&digit| digit != b'0').map_or(0, |last| last + 1);
    if used > 0 {
        line.push(b'.');
        line.extend(&fraction[..used]);
    }
}

/// A text as a JSON string.
pub(crate) fn quoted(text: &str) -> String {
    serde_json::to_string(text).expect("a text is always JSON")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-0.5, "-0.5"),
            (0.000_001, "0.000001"),
            (0.000_000_4, "0"),
            (-12.034_560_9, "-12.034561"),
            (1e20, "100000000000000000000"),
        ] {
            let mut line = Vec::new();
            number(&mut line, value);
            assert_eq!(String::from_utf8(line).unwrap(), text);
        }
    }
}
