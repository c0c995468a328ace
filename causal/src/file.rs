//! Networks go in and text comes out, and back: our own JSON, BIF, XMLBIF, and pictures.

/// Writes at the end of a string.
macro_rules! put {
    ($text:expr, $($piece:tt)*) => {
        std::fmt::Write::write_fmt(&mut $text, format_args!($($piece)*)).expect("a string takes any text")
    };
}

pub mod json;
pub mod bif;
pub mod xmlbif;
pub mod dot;
pub mod svg;
pub mod curves;
pub mod contrast;
mod assemble;
mod names;

use thiserror::Error;

/// Why a text is no network.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {line}, column {column}: {what}")]
pub struct Fault {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What is wrong there.
    pub what: String,
}

impl Fault {
    /// A fault at a byte of a text.
    pub fn at(text: &str, byte: usize, what: impl Into<String>) -> Self {
        let mut byte = byte.min(text.len());
        while !text.is_char_boundary(byte) {
            byte -= 1;
        }
        let before = &text[..byte];
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        Self { line, column: before[start..].chars().count() + 1, what: what.into() }
    }
}
