//! The lines of the file of truths beside a log go in, and truths come out one by one; and back.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};

use serde::Deserialize;

use super::{Activity, Truth};
use crate::log::json::{number, quoted, words, write_state};
use crate::log::{BadLine, Fact, Fault, HandState, Header, Lines, syntax};

/// The first line of such a file.
const FIRST: &str = "{\"caveat-truth\":1}";

/// One frame as it stands in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    t: f64,
    hands: BTreeMap<String, HandLine>,
    #[serde(default)]
    facts: Vec<Vec<String>>,
}

/// One hand.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HandLine {
    moves: bool,
    #[serde(rename = "acted-on")]
    acted_on: Option<String>,
    #[serde(rename = "in-hand")]
    in_hand: Option<String>,
    activity: Activity,
}

/// Reads what lies beside a log with a header: an iterator over the truths of its frames.
#[derive(Debug)]
pub struct Reader<'h, R> {
    lines: Lines<R>,
    header: &'h Header,
    before: Option<f64>,
    ended: bool,
}

impl<'h, R: BufRead> Reader<'h, R> {
    /// Reads the first line.
    pub fn new(input: R, header: &'h Header) -> Result<Self, BadLine> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct First {
            #[serde(rename = "caveat-truth")]
            version: u64,
        }
        let mut lines = Lines::new(input);
        let message = format!("the first line must be `{FIRST}`");
        let bad = BadLine::new(1, Fault::Column(message));
        let Some(line) = lines.next()? else { return Err(bad) };
        match serde_json::from_slice::<First>(line) {
            Ok(First { version: 1 }) => Ok(Self { lines, header, before: None, ended: false }),
            Ok(First { version }) => Err(BadLine::new(1, Fault::Version(version))),
            Err(_) => Err(bad),
        }
    }
}

impl<R: BufRead> Iterator for Reader<'_, R> {
    type Item = Result<Truth, BadLine>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let line = match self.lines.next() {
            Ok(Some(line)) => line,
            Ok(None) => {
                self.ended = true;
                return None;
            }
            Err(error) => {
                self.ended = error.is_fatal();
                return Some(Err(error));
            }
        };
        let read = read(line, self.header, self.before);
        let number = self.lines.number;
        Some(
            read.map_err(|bad| BadLine { line: number, ..bad })
                .inspect(|truth| self.before = Some(truth.time)),
        )
    }
}

/// Reads one line; the number of the line in an error is 0.
fn read(line: &[u8], header: &Header, before: Option<f64>) -> Result<Truth, BadLine> {
    let mut line: Line = serde_json::from_slice(line).map_err(|error| syntax(0, &error))?;
    if let Some(before) = before.filter(|&before| line.t <= before) {
        return Err(BadLine::of_field(0, "t", Fault::Backwards { now: line.t, before }));
    }
    let mut hands = Vec::new();
    for hand in &header.hands {
        let field = || format!("hands.{}", hand.name);
        let Some(said) = line.hands.remove(&hand.name) else {
            let fault = Fault::Form(String::from("nothing is said of this hand"));
            return Err(BadLine::of_field(0, field(), fault));
        };
        let object = |name: Option<String>| {
            name.map(|name| {
                let found = header.object(&name);
                found.ok_or_else(|| BadLine::of_field(0, field(), header.no_object(&name)))
            })
            .transpose()
        };
        let state = HandState {
            moves: said.moves,
            acted_on: object(said.acted_on)?,
            in_hand: object(said.in_hand)?,
        };
        hands.push((state, said.activity));
    }
    if let Some(name) = line.hands.keys().next() {
        return Err(BadLine::of_field(0, "hands", header.no_hand(name)));
    }
    let facts = line.facts.into_iter().filter(|words| !words.is_empty()).map(|mut words| {
        let arguments = words.split_off(1);
        Fact { predicate: words.remove(0), arguments }
    });
    Ok(Truth { time: line.t, hands, facts: facts.collect() })
}

/// Writes what lies beside a log.
#[derive(Debug)]
pub struct Writer<'h, W> {
    out: W,
    header: &'h Header,
}

impl<'h, W: Write> Writer<'h, W> {
    /// Writes the first line.
    pub fn new(mut out: W, header: &'h Header) -> io::Result<Self> {
        writeln!(out, "{FIRST}")?;
        Ok(Self { out, header })
    }

    /// Writes the truth of a frame, which must have the hands of the header.
    pub fn write(&mut self, truth: &Truth) -> io::Result<()> {
        let mut line = b"{\"t\":".to_vec();
        number(&mut line, truth.time);
        line.extend(b",\"hands\":{");
        for (place, ((state, activity), hand)) in
            truth.hands.iter().zip(&self.header.hands).enumerate()
        {
            if place > 0 {
                line.push(b',');
            }
            line.extend(quoted(&hand.name).as_bytes());
            line.push(b':');
            write_state(&mut line, state, self.header);
            line.pop();
            line.extend(format!(",\"activity\":\"{activity}\"}}").as_bytes());
        }
        line.extend(b"},\"facts\":");
        let facts: Vec<Vec<&str>> = truth.facts.iter().map(words).collect();
        line.extend(serde_json::to_string(&facts).expect("words are always JSON").as_bytes());
        line.extend(b"}\n");
        self.out.write_all(&line)
    }

    /// Hands over what is still in a buffer, and gives the output back.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }
}
