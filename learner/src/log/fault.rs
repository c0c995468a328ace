//! What is wrong with a line of a log, as data and as a sentence with the number of the line.

use std::fmt;

/// A line that is not what it should be.
#[derive(Debug, Clone, PartialEq)]
pub struct BadLine {
    /// The number of the line, from 1; in a binary log the number of the message or row.
    pub line: u64,
    /// The column in bytes, from 1, where that says something.
    pub column: Option<u64>,
    /// The field, such as `hands.left-hand.pose`, where it is known.
    pub field: Option<String>,
    /// What is wrong.
    pub fault: Fault,
}

/// What can be wrong with a line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The input ends or fails while it is read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is longer than any sensible line.
    #[error("is longer than {} MiB", super::LONGEST >> 20)]
    Long,
    /// There is no line at all.
    #[error("the log is empty; its first line must be a header such as {}", super::header::EXAMPLE)]
    Empty,
    /// The first line is no header.
    #[error("there is no header; the first line must be one such as {}", super::header::EXAMPLE)]
    NoHeader,
    /// It is of a version that this program does not know.
    #[error("this is version {0} of the format; this program reads version 1")]
    Version(u64),
    /// It is not JSON, or not of the form that it must have.
    #[error("{0}")]
    Form(String),
    /// A field does not exist; the end of the message tells one like it.
    #[error("unknown field{0}")]
    UnknownField(String),
    /// The header has no such hand.
    #[error("the header has no hand `{name}`{hint}")]
    UnknownHand {
        /// The name.
        name: String,
        /// The end of the message: a name like it.
        hint: String,
    },
    /// The header has no such object.
    #[error("the header has no object `{name}`{hint}")]
    UnknownObject {
        /// The name.
        name: String,
        /// The end of the message: a name like it.
        hint: String,
    },
    /// Something is named twice.
    #[error("`{0}` is there twice")]
    Twice(String),
    /// A number is infinite or none at all.
    #[error("this is no finite number")]
    NotFinite,
    /// A pose has too few or too many numbers.
    #[error("a pose has 7 numbers (x, y, z, qx, qy, qz, qw), not {0}")]
    Pose(usize),
    /// The four numbers of a rotation are none.
    #[error("the quaternion has length {0:.3} instead of 1, so it is no rotation")]
    Quaternion(f64),
    /// Time does not go on.
    #[error("time runs backwards: {now:.6} s after {before:.6} s")]
    Backwards {
        /// The time of this frame in seconds.
        now: f64,
        /// The time of the frame before it in seconds.
        before: f64,
    },
    /// Two frames have one time.
    #[error("time stands still: there is a frame at {0:.6} s already")]
    Still(f64),
    /// The number of joint values is not that of the header.
    #[error("has {found} joint value{}, but {expected} joint{} in the header", plural(*.found), plural(*.expected))]
    Joints {
        /// The number in the header.
        expected: usize,
        /// The number in the line.
        found: usize,
    },
    /// A value is out of its range.
    #[error("is {value}, which is not from 0 to 1")]
    Range {
        /// The value.
        value: f64,
    },
    /// A column is missing, or there is one too many.
    #[error("{0}")]
    Column(String),
}

/// The end of a plural.
fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

impl BadLine {
    /// A fault of a whole line.
    pub(crate) fn new(line: u64, fault: Fault) -> Self {
        Self { line, column: None, field: None, fault }
    }

    /// A fault of a field of a line.
    pub(crate) fn of_field(line: u64, field: impl Into<String>, fault: Fault) -> Self {
        Self { line, column: None, field: Some(field.into()), fault }
    }

    /// Whether nothing after this line can be read, so that there is no skipping it.
    pub fn is_fatal(&self) -> bool {
        matches!(
            self.fault,
            Fault::Unreadable(_)
                | Fault::Empty
                | Fault::NoHeader
                | Fault::Version(_)
                | Fault::Column(_)
        )
    }
}

impl std::error::Error for BadLine {}

impl fmt::Display for BadLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.line)?;
        if let Some(column) = self.column {
            write!(f, ", column {column}")?;
        }
        write!(f, ": ")?;
        if let Some(field) = &self.field {
            write!(f, "`{field}`: ")?;
        }
        write!(f, "{}", self.fault)
    }
}
