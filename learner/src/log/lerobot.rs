//! A table of a `LeRobot` data set (version 3, Parquet) goes in, with a [`Mapping`] from columns to hands and objects; the frames of one episode come out.
//!
//! Such data sets have no names and sizes of objects, and what the numbers of `observation.state` are each robot decides; the mapping says both.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::record::reader::RowIter;
use parquet::record::{Field, Row};
use parquet::schema::types::Type;
use serde::Deserialize;

use super::fault::{BadLine, Fault};
use super::header::{self, Scale};
use super::{Frame, HandSample, Header, ObjectSample, sample};

/// What the columns of a table are.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// The header of the log, as JSON Lines have it; its units are those of the columns.
    pub header: serde_json::Value,
    /// Which episode of the table is read; all of it without one, which only makes sense if it has one alone.
    #[serde(default)]
    pub episode: Option<i64>,
    /// The column with the times.
    #[serde(default = "timestamp")]
    pub time: String,
    /// Where the hands are, by their names.
    #[serde(default)]
    pub hands: BTreeMap<String, Columns>,
    /// Where the objects are, by their names.
    #[serde(default)]
    pub objects: BTreeMap<String, Columns>,
}

fn timestamp() -> String {
    String::from("timestamp")
}

/// Where the pose of a hand or object is, and what else there is of it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Columns {
    /// The first of three numbers: a column and, if it is a list, the place in it.
    pub place: Cell,
    /// The first number of the rotation; without one there is none.
    #[serde(default)]
    pub turn: Option<Cell>,
    /// How the rotation is written.
    #[serde(default)]
    pub form: Form,
    /// How far a hand is closed.
    #[serde(default)]
    pub grip: Option<Cell>,
    /// The values of the grip when the hand is open and when it is closed; 0 and 1 without them.
    #[serde(default)]
    pub grip_range: Option<(f64, f64)>,
    /// The joints of an object.
    #[serde(default)]
    pub joints: Vec<Cell>,
}

/// A column and a place in the list that it has; `["observation.state", 3]`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Cell(pub String, #[serde(default)] pub usize);

/// How a rotation is written as numbers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// A quaternion with the real part last.
    #[default]
    Xyzw,
    /// A quaternion with the real part first.
    Wxyz,
    /// The axis times the angle.
    AxisAngle,
    /// Roll, pitch and yaw about the fixed axes x, y and z.
    RollPitchYaw,
}

/// Reads a table: an iterator over its frames. The number of a [`BadLine`] is that of the row, from 1.
pub struct Reader {
    rows: RowIter<'static>,
    mapping: Mapping,
    header: Header,
    scale: Scale,
    row: u64,
    before: Option<f64>,
    ended: bool,
}

impl Reader {
    /// A reader of a table. The text of the mapping is JSON.
    pub fn new<R: ChunkReader + 'static>(input: R, mapping: &[u8]) -> Result<Self, BadLine> {
        let mapping: Mapping = serde_json::from_slice(mapping)
            .map_err(|error| header::syntax(error.line() as u64, &error))?;
        let (header, scale) = header::read(mapping.header.to_string().as_bytes(), 1)?;
        for name in mapping.hands.keys() {
            header.hand(name).ok_or_else(|| BadLine::of_field(1, "hands", header.no_hand(name)))?;
        }
        for name in mapping.objects.keys() {
            header
                .object(name)
                .ok_or_else(|| BadLine::of_field(1, "objects", header.no_object(name)))?;
        }
        let broken = |error: parquet::errors::ParquetError| {
            BadLine::new(0, Fault::Unreadable(error.to_string()))
        };
        let file = SerializedFileReader::new(input).map_err(broken)?;
        let schema = file.metadata().file_metadata().schema().clone();
        // Pictures and whatever else is not needed are never unpacked.
        let wanted = mapping.columns();
        for column in &wanted {
            if !schema.get_fields().iter().any(|field| field.name() == *column) {
                let hint = lang::did_you_mean(
                    column,
                    schema.get_fields().iter().map(|field| field.name()),
                );
                return Err(BadLine::new(
                    0,
                    Fault::Column(format!("there is no column `{column}`{hint}")),
                ));
            }
        }
        let fields: Vec<Arc<Type>> = schema
            .get_fields()
            .iter()
            .filter(|field| wanted.contains(&field.name()))
            .cloned()
            .collect();
        let part =
            Type::group_type_builder(schema.name()).with_fields(fields).build().map_err(broken)?;
        let rows = RowIter::from_file_into(Box::new(file)).project(Some(part)).map_err(broken)?;
        Ok(Self { rows, mapping, header, scale, row: 0, before: None, ended: false })
    }

    /// What is tracked.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The frame that a row is.
    fn frame(&self, row: &Row) -> Result<Frame, BadLine> {
        let bad = |name: &str, fault| BadLine::of_field(self.row, name, fault);
        let time = number(row, &Cell(self.mapping.time.clone(), 0))
            .and_then(|value| sample::time(value, self.scale, self.before))
            .map_err(|fault| bad(&self.mapping.time, fault))?;
        let mut hands = Vec::new();
        for hand in &self.header.hands {
            let sample = match self.mapping.hands.get(&hand.name) {
                Some(columns) => {
                    Some(self.hand(row, columns).map_err(|fault| bad(&hand.name, fault))?)
                }
                None => None,
            };
            hands.push(sample);
        }
        let mut objects = Vec::new();
        for object in &self.header.objects {
            let sample = match self.mapping.objects.get(&object.name) {
                Some(columns) => {
                    let read = || {
                        let pose = pose(row, columns, self.scale)?;
                        let mut joints = columns
                            .joints
                            .iter()
                            .map(|cell| number(row, cell))
                            .collect::<Result<Vec<_>, _>>()?;
                        if !joints.is_empty() {
                            sample::joints(&mut joints, object, self.scale)?;
                        }
                        Ok(ObjectSample { pose, joints, seen: 1.0 })
                    };
                    Some(read().map_err(|fault| bad(&object.name, fault))?)
                }
                None => None,
            };
            objects.push(sample);
        }
        Ok(Frame { time, hands, objects, facts: None })
    }

    /// What a row says of a hand.
    fn hand(&self, row: &Row, columns: &Columns) -> Result<HandSample, Fault> {
        let pose = pose(row, columns, self.scale)?;
        let (open, closed) = columns.grip_range.unwrap_or((0.0, 1.0));
        let grip = match &columns.grip {
            // Commands may go a little beyond the ends of the range.
            Some(cell) => Some(((number(row, cell)? - open) / (closed - open)).clamp(0.0, 1.0)),
            None => None,
        };
        Ok(HandSample { pose, grip, teach: false, given: None })
    }
}

impl Mapping {
    /// All columns that are needed.
    fn columns(&self) -> Vec<&str> {
        let mut columns = vec![self.time.as_str()];
        if self.episode.is_some() {
            columns.push(EPISODE);
        }
        for body in self.hands.values().chain(self.objects.values()) {
            let cells = [Some(&body.place), body.turn.as_ref(), body.grip.as_ref()];
            columns.extend(
                cells.into_iter().flatten().chain(&body.joints).map(|cell| cell.0.as_str()),
            );
        }
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

/// The column with the number of the episode.
const EPISODE: &str = "episode_index";

/// The number in a cell.
fn number(row: &Row, cell: &Cell) -> Result<f64, Fault> {
    let field = row.get_column_iter().find(|(name, _)| **name == cell.0).map(|(_, field)| field);
    let field = match field {
        Some(Field::ListInternal(list)) => list.elements().get(cell.1),
        other => other.filter(|_| cell.1 == 0),
    };
    let value = match field {
        Some(Field::Float(value)) => f64::from(*value),
        Some(Field::Double(value)) => *value,
        Some(Field::Int(value)) => f64::from(*value),
        Some(Field::Long(value)) => *value as f64,
        _ => return Err(Fault::Form(format!("there is no number {} in `{}`", cell.1, cell.0))),
    };
    if value.is_finite() { Ok(value) } else { Err(Fault::NotFinite) }
}

/// The pose that a row has.
fn pose(row: &Row, columns: &Columns, scale: Scale) -> Result<Isometry3<f64>, Fault> {
    let at = |cell: &Cell, next: usize| number(row, &Cell(cell.0.clone(), cell.1 + next));
    let three =
        |cell: &Cell| Ok::<_, Fault>(Vector3::new(at(cell, 0)?, at(cell, 1)?, at(cell, 2)?));
    let place = three(&columns.place)? * scale.length;
    let turn = match (&columns.turn, columns.form) {
        (None, _) => UnitQuaternion::identity(),
        (Some(cell), Form::AxisAngle) => UnitQuaternion::new(three(cell)? * scale.angle),
        (Some(cell), Form::RollPitchYaw) => {
            let angles = three(cell)? * scale.angle;
            UnitQuaternion::from_euler_angles(angles.x, angles.y, angles.z)
        }
        (Some(cell), form) => {
            let values = [at(cell, 0)?, at(cell, 1)?, at(cell, 2)?, at(cell, 3)?];
            let [first, second, third, fourth] = values;
            let turn = if form == Form::Xyzw {
                Quaternion::new(fourth, first, second, third)
            } else {
                Quaternion::new(first, second, third, fourth)
            };
            if (turn.norm() - 1.0).abs() > 0.02 {
                return Err(Fault::Quaternion(turn.norm()));
            }
            UnitQuaternion::new_normalize(turn)
        }
    };
    Ok(Isometry3::from_parts(place.into(), turn))
}

impl Iterator for Reader {
    type Item = Result<Frame, BadLine>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.ended {
            let row = match self.rows.next() {
                None => break,
                Some(Err(error)) => {
                    self.ended = true;
                    let fault = Fault::Unreadable(error.to_string());
                    return Some(Err(BadLine::new(self.row + 1, fault)));
                }
                Some(Ok(row)) => row,
            };
            self.row += 1;
            if let Some(wanted) = self.mapping.episode {
                match number(&row, &Cell(EPISODE.to_string(), 0)) {
                    Ok(episode) if episode.to_bits() != (wanted as f64).to_bits() => continue,
                    Ok(_) => {}
                    Err(fault) => return Some(Err(BadLine::of_field(self.row, EPISODE, fault))),
                }
            }
            let frame = self.frame(&row);
            if let Ok(frame) = &frame {
                self.before = Some(frame.time);
            }
            return Some(frame);
        }
        None
    }
}
