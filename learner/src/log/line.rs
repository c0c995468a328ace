//! Bytes go in; lines of bounded length come out, with their numbers and how many bytes were read.

use std::io::{BufRead, Read};

use super::fault::{BadLine, Fault};

/// The longest line in bytes; it bounds the memory that any input can claim.
pub(crate) const LONGEST: usize = 16 << 20;

/// Reads lines.
#[derive(Debug)]
pub(crate) struct Lines<R> {
    input: R,
    buffer: Vec<u8>,
    /// The number of the line in the buffer, from 1.
    pub number: u64,
    /// How many bytes were read so far.
    pub consumed: u64,
}

impl<R: BufRead> Lines<R> {
    /// The lines of an input.
    pub fn new(input: R) -> Self {
        Self { input, buffer: Vec::new(), number: 0, consumed: 0 }
    }

    /// The next line that is not blank, without its end; none at the end of the input.
    pub fn next(&mut self) -> Result<Option<&[u8]>, BadLine> {
        loop {
            self.buffer.clear();
            self.number += 1;
            let read = (&mut self.input)
                .take(LONGEST as u64 + 1)
                .read_until(b'\n', &mut self.buffer)
                .map_err(|error| BadLine::new(self.number, Fault::Unreadable(error.to_string())))?;
            self.consumed += read as u64;
            if read == 0 {
                return Ok(None);
            }
            if read > LONGEST {
                self.skip()?;
                return Err(BadLine::new(self.number, Fault::Long));
            }
            if !self.buffer.iter().all(u8::is_ascii_whitespace) {
                break;
            }
        }
        // A mark of the order of bytes is none of the text.
        let start =
            if self.number == 1 && self.buffer.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Ok(Some(self.buffer[start..].trim_ascii_end()))
    }

    /// Passes over the rest of a line that is too long.
    fn skip(&mut self) -> Result<(), BadLine> {
        loop {
            self.buffer.clear();
            let read = (&mut self.input)
                .take(LONGEST as u64)
                .read_until(b'\n', &mut self.buffer)
                .map_err(|error| {
                BadLine::new(self.number, Fault::Unreadable(error.to_string()))
            })?;
            self.consumed += read as u64;
            if read == 0 || self.buffer.ends_with(b"\n") {
                return Ok(());
            }
        }
    }

    /// The rest of the input, from the next line on.
    pub fn rest(self) -> R {
        self.input
    }
}
