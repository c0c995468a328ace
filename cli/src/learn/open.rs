//! The path of a log goes in; whatever its format is, its header and its frames come out.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use learner::log::{BadLine, Frame, Header, csv, json};

use super::Kind;
use crate::files::{self, Complaint};

/// A log that is being read.
pub trait Log: Iterator<Item = Result<Frame, BadLine>> {
    /// What is tracked.
    fn header(&self) -> &Header;

    /// How many bytes were read so far, where that is known.
    fn consumed(&self) -> u64 {
        0
    }
}

impl<R: BufRead> Log for json::Reader<R> {
    fn header(&self) -> &Header {
        self.header()
    }

    fn consumed(&self) -> u64 {
        self.consumed()
    }
}

impl<R: BufRead> Log for csv::Reader<R> {
    fn header(&self) -> &Header {
        self.header()
    }

    fn consumed(&self) -> u64 {
        self.consumed()
    }
}

#[cfg(feature = "mcap")]
impl<R: io::Read> Log for learner::log::mcap::Reader<R> {
    fn header(&self) -> &Header {
        self.header()
    }

    fn consumed(&self) -> u64 {
        self.consumed()
    }
}

#[cfg(feature = "lerobot")]
impl Log for learner::log::lerobot::Reader {
    fn header(&self) -> &Header {
        self.header()
    }
}

/// Opens a log; recordings and tables need a mapping.
pub fn open(path: &Path, kind: Kind, mapping: Option<&Path>) -> Result<Box<dyn Log>, Complaint> {
    let bad = |bad: BadLine| Complaint::new(format!("{}: {bad}", files::name(path)));
    match kind {
        Kind::Csv => Ok(Box::new(csv::Reader::new(input(path)?).map_err(bad)?)),
        Kind::Json | Kind::Trace => Ok(Box::new(json::Reader::new(input(path)?).map_err(bad)?)),
        Kind::Mcap => recording(path, mapping),
        Kind::Parquet => table(path, mapping),
    }
}

fn input(path: &Path) -> Result<Box<dyn BufRead>, Complaint> {
    if files::is_stdin(path) {
        return Ok(Box::new(BufReader::new(io::stdin())));
    }
    Ok(Box::new(BufReader::with_capacity(1 << 18, file(path)?)))
}

fn file(path: &Path) -> Result<File, Complaint> {
    File::open(path)
        .map_err(|error| Complaint::new(format!("`{}` cannot be read: {error}", files::name(path))))
}

#[cfg(any(feature = "mcap", feature = "lerobot"))]
fn mapped(path: &Path, mapping: Option<&Path>) -> Result<String, Complaint> {
    let Some(mapping) = mapping else {
        return Err(Complaint::with_help(
            format!("nothing says what is in `{}`", files::name(path)),
            "--mapping FILE does; see docs/logs.md",
        ));
    };
    Ok(files::read(mapping)?.text)
}

#[cfg(feature = "mcap")]
fn recording(path: &Path, mapping: Option<&Path>) -> Result<Box<dyn Log>, Complaint> {
    let mapping = mapped(path, mapping)?;
    let reader = learner::log::mcap::Reader::new(BufReader::new(file(path)?), mapping.as_bytes());
    let bad = |bad: BadLine| Complaint::new(format!("{}: {bad}", files::name(path)));
    Ok(Box::new(reader.map_err(bad)?))
}

#[cfg(feature = "lerobot")]
fn table(path: &Path, mapping: Option<&Path>) -> Result<Box<dyn Log>, Complaint> {
    let mapping = mapped(path, mapping)?;
    let reader = learner::log::lerobot::Reader::new(file(path)?, mapping.as_bytes());
    let bad = |bad: BadLine| Complaint::new(format!("{}: {bad}", files::name(path)));
    Ok(Box::new(reader.map_err(bad)?))
}

#[cfg(not(feature = "mcap"))]
fn recording(path: &Path, _: Option<&Path>) -> Result<Box<dyn Log>, Complaint> {
    Err(without(path, "mcap"))
}

#[cfg(not(feature = "lerobot"))]
fn table(path: &Path, _: Option<&Path>) -> Result<Box<dyn Log>, Complaint> {
    Err(without(path, "lerobot"))
}

/// What to say of a file that only other builds of this program read.
#[cfg(not(all(feature = "mcap", feature = "lerobot")))]
fn without(path: &Path, feature: &str) -> Complaint {
    Complaint::with_help(
        format!("`{}` cannot be read by this program", files::name(path)),
        format!("one that was built with `--features {feature}` reads it"),
    )
}
