//! Wide CSV goes in, one row for each frame, and frames come out one by one; and back. `docs/logs.md` has the columns.
//!
//! The header of the log is the JSON of [`json`](super::json) in a first line that begins with `#`, or comes from elsewhere.

use std::io::{self, BufRead, Write};

use csv::{ReaderBuilder, StringRecord, Terminator, WriterBuilder};

use super::fault::{BadLine, Fault};
use super::header::{self, Scale};
use super::line::Lines;
use super::{Fact, Frame, HandSample, HandState, Header, ObjectId, ObjectSample, sample};

/// What a column is, with the place of the hand or object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Time,
    Facts,
    Hand(usize, Part),
    Object(usize, Part),
    Remark,
}

/// What a column says of a hand or an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// One of the seven numbers of a pose.
    Pose(usize),
    Grip,
    Teach,
    Moves,
    ActedOn,
    InHand,
    Seen,
    Joint(usize),
}

/// The names of the seven numbers of a pose.
const POSE: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// Reads a log of wide CSV: an iterator over its frames, as [`json::Reader`](super::json::Reader) is.
pub struct Reader<R> {
    rows: csv::Reader<R>,
    row: StringRecord,
    header: Header,
    scale: Scale,
    columns: Vec<Column>,
    names: Vec<String>,
    /// The lines and bytes before the row of names.
    lines: u64,
    bytes: u64,
    before: Option<f64>,
    ended: bool,
}

impl<R: BufRead> Reader<R> {
    /// Reads the header from the first line, which begins with `#`, and then the row of names.
    pub fn new(input: R) -> Result<Self, BadLine> {
        let mut lines = Lines::new(input);
        let Some(line) = lines.next()? else { return Err(BadLine::new(1, Fault::Empty)) };
        let Some(text) = line.strip_prefix(b"#") else {
            return Err(BadLine::new(1, Fault::NoHeader));
        };
        let (header, scale) = header::read(text.trim_ascii_start(), 1)?;
        let (number, bytes) = (lines.number, lines.consumed);
        Self::start(lines.rest(), header, scale, number, bytes)
    }

    /// Reads a log whose header is the JSON text in another file, and whose first row has the names of the columns.
    pub fn beside(input: R, header: &[u8]) -> Result<Self, BadLine> {
        let (header, scale) = header::read(header.trim_ascii(), 1)?;
        Self::start(input, header, scale, 0, 0)
    }

    /// Reads the row of names.
    fn start(
        input: R,
        header: Header,
        scale: Scale,
        lines: u64,
        bytes: u64,
    ) -> Result<Self, BadLine> {
        let mut rows = ReaderBuilder::new().flexible(true).comment(Some(b'#')).from_reader(input);
        let bad = |error: &csv::Error| row_fault(error, lines);
        let names: Vec<String> = rows
            .headers()
            .map_err(|error| bad(&error))?
            .iter()
            .map(|name| name.trim().to_string())
            .collect();
        let place = |fault| BadLine::new(lines + 1, fault);
        if names.iter().all(String::is_empty) {
            return Err(place(Fault::Column(String::from(
                "there is no row with the names of the columns",
            ))));
        }
        let columns = columns(&names, &header).map_err(place)?;
        let row = StringRecord::new();
        Ok(Self {
            rows,
            row,
            header,
            scale,
            columns,
            names,
            lines,
            bytes,
            before: None,
            ended: false,
        })
    }

    /// What is tracked.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many bytes were read so far, to show progress by.
    pub fn consumed(&self) -> u64 {
        self.bytes + self.rows.position().byte()
    }
}

impl<R: BufRead> Iterator for Reader<R> {
    type Item = Result<Frame, BadLine>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        match self.rows.read_record(&mut self.row) {
            Ok(true) => {}
            Ok(false) => {
                self.ended = true;
                return None;
            }
            Err(error) => {
                let bad = row_fault(&error, self.lines);
                self.ended = bad.is_fatal();
                return Some(Err(bad));
            }
        }
        let line = self.lines + self.row.position().map_or(0, csv::Position::line);
        let frame = self.frame(line);
        if let Ok(frame) = &frame {
            self.before = Some(frame.time);
        }
        Some(frame)
    }
}

/// What is wrong with a row as such.
fn row_fault(error: &csv::Error, lines: u64) -> BadLine {
    let line = lines + error.position().map_or(1, csv::Position::line);
    let fault = match error.kind() {
        csv::ErrorKind::Io(error) => Fault::Unreadable(error.to_string()),
        csv::ErrorKind::Utf8 { .. } => Fault::Form(String::from("it is not UTF-8")),
        _ => Fault::Form(error.to_string()),
    };
    BadLine::new(line, fault)
}

/// What each column is.
fn columns(names: &[String], header: &Header) -> Result<Vec<Column>, Fault> {
    let mut columns = Vec::new();
    for name in names {
        let column = column(name, header)?;
        if column != Column::Remark && columns.contains(&column) {
            return Err(Fault::Column(format!("there are two columns `{name}`")));
        }
        columns.push(column);
    }
    if !columns.contains(&Column::Time) {
        return Err(Fault::Column(String::from("there is no column `t`")));
    }
    // A pose is there whole or not at all.
    for column in columns.clone() {
        let whole =
            |of: &dyn Fn(usize) -> Column| (0..7).find(|&part| !columns.contains(&of(part)));
        let (missing, name) = match column {
            Column::Hand(hand, _) => {
                (whole(&|part| Column::Hand(hand, Part::Pose(part))), &header.hands[hand].name)
            }
            Column::Object(object, _) => (
                whole(&|part| Column::Object(object, Part::Pose(part))),
                &header.objects[object].name,
            ),
            _ => continue,
        };
        if let Some(part) = missing {
            return Err(Fault::Column(format!("there is no column `{name}.{}`", POSE[part])));
        }
    }
    Ok(columns)
}

/// What a column of this name is.
fn column(name: &str, header: &Header) -> Result<Column, Fault> {
    if name == "t" {
        return Ok(Column::Time);
    }
    if name == "facts" {
        return Ok(Column::Facts);
    }
    if name.starts_with('_') {
        return Ok(Column::Remark);
    }
    let unknown = || {
        let all = column_names(header);
        let hint = lang::did_you_mean(name, all.iter().map(String::as_str));
        Fault::Column(format!("unknown column `{name}`{hint}"))
    };
    let (thing, part) = name.rsplit_once('.').ok_or_else(unknown)?;
    let pose = POSE.iter().position(|other| *other == part).map(Part::Pose);
    if let Some(hand) = header.hand(thing) {
        let part = pose.or(match part {
            "grip" => Some(Part::Grip),
            "teach" => Some(Part::Teach),
            "moves" => Some(Part::Moves),
            "acted-on" => Some(Part::ActedOn),
            "in-hand" => Some(Part::InHand),
            _ => None,
        });
        return part.map(|part| Column::Hand(hand.index(), part)).ok_or_else(unknown);
    }
    let object = header.object(thing).ok_or_else(unknown)?;
    let joints = &header.objects[object.index()].joints;
    let part = pose
        .or_else(|| joints.iter().position(|joint| joint.name == part).map(Part::Joint))
        .or((part == "seen").then_some(Part::Seen));
    part.map(|part| Column::Object(object.index(), part)).ok_or_else(unknown)
}

/// The names of all columns that a log with this header can have.
fn column_names(header: &Header) -> Vec<String> {
    let mut names = vec![String::from("t")];
    for hand in &header.hands {
        let parts = POSE.into_iter().chain(["grip", "teach", "moves", "acted-on", "in-hand"]);
        names.extend(parts.map(|part| format!("{}.{part}", hand.name)));
    }
    for object in &header.objects {
        let joints = object.joints.iter().map(|joint| joint.name.as_str());
        let parts = POSE.into_iter().chain(joints).chain(["seen"]);
        names.extend(parts.map(|part| format!("{}.{part}", object.name)));
    }
    names.push(String::from("facts"));
    names
}

/// What a row says of one hand or object.
#[derive(Default, Clone)]
struct Said {
    pose: [f64; 7],
    /// How many of the seven numbers are there.
    count: usize,
    grip: Option<f64>,
    teach: bool,
    moves: Option<bool>,
    acted_on: Option<ObjectId>,
    in_hand: Option<ObjectId>,
    seen: Option<f64>,
    joints: Vec<f64>,
}

impl<R> Reader<R> {
    /// The frame that the row is.
    fn frame(&self, line: u64) -> Result<Frame, BadLine> {
        if self.row.len() != self.columns.len() {
            let message = format!(
                "has {} columns, but the first row has {}",
                self.row.len(),
                self.columns.len()
            );
            return Err(BadLine::new(line, Fault::Form(message)));
        }
        let mut hands = vec![Said::default(); self.header.hands.len()];
        let mut objects = vec![Said::default(); self.header.objects.len()];
        let (mut time, mut facts) = (None, None);
        for ((column, cell), name) in self.columns.iter().zip(&self.row).zip(&self.names) {
            let cell = cell.trim();
            if cell.is_empty() {
                continue;
            }
            let read = match *column {
                Column::Remark => Ok(()),
                Column::Time => real(cell)
                    .and_then(|value| sample::time(value, self.scale, self.before))
                    .map(|value| time = Some(value)),
                Column::Facts => {
                    facts = Some(read_facts(cell));
                    Ok(())
                }
                Column::Hand(place, part) => self.cell(cell, part, &mut hands[place]),
                Column::Object(place, part) => self.cell(cell, part, &mut objects[place]),
            };
            read.map_err(|fault| BadLine::of_field(line, name, fault))?;
        }
        let Some(time) = time else {
            return Err(BadLine::of_field(
                line,
                "t",
                Fault::Form(String::from("there is no time")),
            ));
        };
        let at = |name: &str, fault| BadLine::of_field(line, name, fault);
        let pose = |said: &Said| match said.count {
            0 => Ok(None),
            7 => sample::pose(said.pose, self.scale).map(Some),
            count => Err(Fault::Pose(count)),
        };
        let mut frame = Frame { time, hands: Vec::new(), objects: Vec::new(), facts };
        for (said, hand) in hands.into_iter().zip(&self.header.hands) {
            let pose = pose(&said).map_err(|fault| at(&hand.name, fault))?;
            let given = said.moves.map(|moves| HandState {
                moves,
                acted_on: said.acted_on,
                in_hand: said.in_hand,
            });
            frame.hands.push(pose.map(|pose| HandSample {
                pose,
                grip: said.grip,
                teach: said.teach,
                given,
            }));
        }
        for (mut said, object) in objects.into_iter().zip(&self.header.objects) {
            let pose = pose(&said).map_err(|fault| at(&object.name, fault))?;
            if !said.joints.is_empty() {
                sample::joints(&mut said.joints, object, self.scale)
                    .map_err(|fault| at(&object.name, fault))?;
            }
            frame.objects.push(pose.map(|pose| ObjectSample {
                pose,
                joints: said.joints,
                seen: said.seen.unwrap_or(1.0),
            }));
        }
        Ok(frame)
    }

    /// Takes what one cell says.
    fn cell(&self, cell: &str, part: Part, said: &mut Said) -> Result<(), Fault> {
        let object =
            |name: &str| self.header.object(name).ok_or_else(|| self.header.no_object(name));
        match part {
            Part::Pose(place) => {
                said.pose[place] = real(cell)?;
                said.count += 1;
            }
            Part::Grip => said.grip = Some(sample::share(real(cell)?)?),
            Part::Seen => said.seen = Some(sample::share(real(cell)?)?),
            Part::Teach => said.teach = truth(cell)?,
            Part::Moves => said.moves = Some(truth(cell)?),
            Part::ActedOn => said.acted_on = Some(object(cell)?),
            Part::InHand => said.in_hand = Some(object(cell)?),
            // Joints come in the order of their columns; those that do not are put right by their place.
            Part::Joint(place) => {
                if said.joints.len() <= place {
                    said.joints.resize(place + 1, f64::NAN);
                }
                said.joints[place] = real(cell)?;
            }
        }
        Ok(())
    }
}

/// A finite number.
fn real(cell: &str) -> Result<f64, Fault> {
    match cell.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(Fault::NotFinite),
        Err(_) => Err(Fault::Form(format!("`{cell}` is not a number"))),
    }
}

/// Yes or no.
fn truth(cell: &str) -> Result<bool, Fault> {
    match cell {
        "1" | "true" => Ok(true),
        "0" | "false" => Ok(false),
        _ => Err(Fault::Form(format!("`{cell}` is neither true nor false"))),
    }
}

/// Facts such as `on-top a b; clear a`; a lone `;` says that none holds.
fn read_facts(cell: &str) -> Vec<Fact> {
    let facts = cell.split(';').filter(|fact| !fact.trim().is_empty()).map(|fact| {
        let mut words = fact.split_whitespace().map(String::from);
        let predicate = words.next().unwrap_or_default();
        Fact { predicate, arguments: words.collect() }
    });
    facts.collect()
}

/// Writes a log of wide CSV.
pub struct Writer<'h, W: Write> {
    out: csv::Writer<W>,
    header: &'h Header,
}

impl<'h, W: Write> Writer<'h, W> {
    /// Writes the header as a remark, and the row of names.
    pub fn new(mut out: W, header: &'h Header) -> io::Result<Self> {
        writeln!(out, "# {}", header::write(header))?;
        let mut out = WriterBuilder::new().terminator(Terminator::Any(b'\n')).from_writer(out);
        out.write_record(column_names(header))?;
        Ok(Self { out, header })
    }

    /// Writes a frame, which must have the hands and objects of the header. Where something is lost, its cells are empty.
    pub fn write(&mut self, frame: &Frame) -> io::Result<()> {
        let mut row = vec![text(frame.time)];
        let pose = |row: &mut Vec<String>, pose: Option<&nalgebra::Isometry3<f64>>| match pose {
            Some(pose) => {
                let (place, turn) = (pose.translation.vector, pose.rotation.coords);
                row.extend([place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w].map(text));
            }
            None => row.extend(std::iter::repeat_n(String::new(), 7)),
        };
        let name = |object: Option<ObjectId>| {
            object.map_or(String::new(), |object| self.header.objects[object.index()].name.clone())
        };
        for hand in &frame.hands {
            pose(&mut row, hand.as_ref().map(|hand| &hand.pose));
            let given = hand.as_ref().and_then(|hand| hand.given);
            row.push(hand.as_ref().and_then(|hand| hand.grip).map_or(String::new(), text));
            row.push(hand.as_ref().map_or(String::new(), |hand| u8::from(hand.teach).to_string()));
            row.push(given.map_or(String::new(), |given| u8::from(given.moves).to_string()));
            row.push(name(given.and_then(|given| given.acted_on)));
            row.push(name(given.and_then(|given| given.in_hand)));
        }
        for (object, what) in frame.objects.iter().zip(&self.header.objects) {
            pose(&mut row, object.as_ref().map(|object| &object.pose));
            let joints = object.as_ref().map_or(&[][..], |object| &object.joints);
            row.extend(
                (0..what.joints.len())
                    .map(|joint| joints.get(joint).map_or(String::new(), |value| text(*value))),
            );
            row.push(object.as_ref().map_or(String::new(), |object| text(object.seen)));
        }
        row.push(frame.facts.as_ref().map_or(String::new(), |facts| {
            let facts: Vec<String> =
                facts.iter().map(|fact| super::json::words(fact).join(" ")).collect();
            if facts.is_empty() { String::from(";") } else { facts.join("; ") }
        }));
        self.out.write_record(row)?;
        Ok(())
    }

    /// Hands over what is still in a buffer, and gives the output back.
    pub fn finish(self) -> io::Result<W> {
        self.out.into_inner().map_err(csv::IntoInnerError::into_error)
    }
}

/// A number as JSON logs have it.
fn text(value: f64) -> String {
    let mut text = Vec::new();
    super::json::number(&mut text, value);
    String::from_utf8(text).expect("digits are ASCII")
}
