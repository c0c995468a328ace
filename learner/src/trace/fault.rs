//! What is wrong with the text of a trace, and where.

use std::fmt;

/// Something in the text of a trace that could not be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1, in characters.
    pub column: u32,
    /// What is wrong, as a sentence without a full stop.
    pub message: String,
}

impl Fault {
    /// A fault at a byte of a text.
    pub(super) fn at(text: &str, place: usize, message: impl Into<String>) -> Self {
        let before = &text[..place.min(text.len())];
        let begin = before.rfind('\n').map_or(0, |at| at + 1);
        Self {
            line: 1 + before.bytes().filter(|byte| *byte == b'\n').count() as u32,
            column: 1 + before[begin..].chars().count() as u32,
            message: message.into(),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}:{}: {}", self.line, self.column, self.message)
    }
}
