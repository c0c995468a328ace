//! Bytes go in; decisions come out, the simplest behind the end.

use std::fmt;

/// Decides, byte by byte.
#[derive(Clone)]
pub struct Tape {
    bytes: Vec<u8>,
    at: usize,
}

/// On one line, however it is asked for.
impl fmt::Debug for Tape {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:?}", self.bytes)
    }
}

impl Tape {
    pub fn new(bytes: Vec<u8>) -> Self {
        Self { bytes, at: 0 }
    }

    /// A number below `limit`; 0 behind the end.
    pub fn below(&mut self, limit: usize) -> usize {
        self.at += 1;
        self.bytes.get(self.at - 1).map_or(0, |&byte| byte as usize % limit)
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == times - 1
    }
}
