//! JSON Lines go in, and frames come out one by one; and back. `docs/logs.md` has the format.
//!
//! A log is read line by line into memory that is used again, so that it may be of any length.

mod fast;
mod frame;
mod write;

use std::io::BufRead;

use super::fault::{BadLine, Fault};
use super::header::{self, Scale};
use super::line::Lines;
use super::{Frame, Header};
use frame::Index;
pub use write::Writer;
pub(crate) use write::{number, quoted, words, write_state};

/// Reads a log of JSON Lines: an iterator over its frames.
///
/// A bad line is an error that says which line it is; reading goes on after it unless it [is fatal](BadLine::is_fatal).
///
/// ```
/// let text = r#"{"caveat-log":1,"units":{"length":"cm"},"agents":[{"name":"person","hands":[{"name":"right-hand"}]}],"objects":[]}
/// {"t":0.00,"hands":{"right-hand":[10,0,0,0,0,0,1]}}
/// {"t":0.01,"hands":{"right-hnad":[10,0,0,0,0,0,1]}}
/// "#;
/// let mut reader = learner::log::json::Reader::new(text.as_bytes()).unwrap();
/// let frame = reader.next().unwrap().unwrap();
/// assert_eq!(frame.hands[0].as_ref().unwrap().pose.translation.x, 0.1);
/// assert_eq!(
///     reader.next().unwrap().unwrap_err().to_string(),
///     "line 3, column 31: `hands`: the header has no hand `right-hnad`; did you mean `right-hand`?"
/// );
/// assert!(reader.next().is_none());
/// ```
#[derive(Debug)]
pub struct Reader<R> {
    lines: Lines<R>,
    header: Header,
    scale: Scale,
    index: Index,
    /// The time of the last good frame in seconds.
    before: Option<f64>,
    ended: bool,
}

impl<R: BufRead> Reader<R> {
    /// Reads the header.
    pub fn new(input: R) -> Result<Self, BadLine> {
        let mut lines = Lines::new(input);
        let number = lines.number + 1;
        let Some(line) = lines.next()? else { return Err(BadLine::new(number, Fault::Empty)) };
        let (header, scale) = header::read(line, number)?;
        let index = Index::new(&header);
        Ok(Self { lines, header, scale, index, before: None, ended: false })
    }

    /// What is tracked.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many bytes were read so far, to show progress by.
    pub fn consumed(&self) -> u64 {
        self.lines.consumed
    }

    /// The number of the last line that was read, from 1.
    pub fn line(&self) -> u64 {
        self.lines.number
    }
}

impl<R: BufRead> Iterator for Reader<R> {
    type Item = Result<Frame, BadLine>;

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
        let read = match fast::read(line, &self.header, self.scale, self.before) {
            Some(frame) => Ok(frame),
            None => frame::read(line, &self.header, &mut self.index, self.scale, self.before),
        };
        Some(match read {
            Ok(frame) => {
                self.before = Some(frame.time);
                Ok(frame)
            }
            Err(error) => Err(BadLine { line: self.lines.number, ..error }),
        })
    }
}
