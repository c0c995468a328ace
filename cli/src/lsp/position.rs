//! Byte offsets of a text go in, lines and columns as the protocol counts them come out, and the other way round.

use gen_lsp_types::{Position, PositionEncodingKind, Range};
use lang::source::Span;

/// What a column counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// Halves of UTF-16, which every client knows.
    #[default]
    Utf16,
}

impl Encoding {
    /// The first one in a client's list that is known here.
    pub fn negotiate(offered: &[PositionEncodingKind]) -> Self {
        let known = offered.iter().find_map(|one| match one {
            PositionEncodingKind::UTF8 => Some(Self::Utf8),
            PositionEncodingKind::UTF16 => Some(Self::Utf16),
            _ => None,
        });
        known.unwrap_or_default()
    }

    /// How much a piece of a text counts.
    pub fn units(self, text: &str) -> u32 {
        match self {
            Self::Utf8 => text.len() as u32,
            Self::Utf16 => text.encode_utf16().count() as u32,
        }
    }

    /// As the protocol names it.
    pub fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
        }
    }
}

/// A character of several bytes, which are fewer units.
#[derive(Debug, Clone, Copy)]
struct Wide {
    /// Its first byte, and the byte after its last.
    start: u32,
    end: u32,
    /// How many more bytes than units there are up to its end.
    more: u32,
}

/// Where the lines of a text begin, and what its wide characters do to columns.
#[derive(Debug, Clone, Default)]
pub struct Lines {
    /// The first byte of each line.
    starts: Vec<u32>,
    /// The byte after each line, without its line end.
    ends: Vec<u32>,
    /// The characters that are not ASCII.
    wide: Vec<Wide>,
}

impl Lines {
    /// Looks through a text. Lines end with `\n`, `\r\n` or `\r`.
    pub fn new(text: &str, encoding: Encoding) -> Self {
        let mut lines = Self { starts: vec![0], ..Self::default() };
        let bytes = text.as_bytes();
        for (at, &byte) in bytes.iter().enumerate() {
            let ends = match byte {
                b'\n' => true,
                b'\r' => bytes.get(at + 1) != Some(&b'\n'),
                _ => false,
            };
            if ends {
                let behind = byte == b'\n' && at > 0 && bytes[at - 1] == b'\r';
                lines.ends.push(at as u32 - u32::from(behind));
                lines.starts.push(at as u32 + 1);
            }
        }
        lines.ends.push(text.len() as u32);
        if encoding == Encoding::Utf16 && !text.is_ascii() {
            let mut more = 0;
            for (at, character) in text.char_indices().filter(|(_, one)| !one.is_ascii()) {
                more += (character.len_utf8() - character.len_utf16()) as u32;
                let end = (at + character.len_utf8()) as u32;
                lines.wide.push(Wide { start: at as u32, end, more });
            }
        }
        lines
    }

    /// How many units there are up to a byte, over all lines.
    fn units(&self, offset: u32) -> u32 {
        let before = self.wide.partition_point(|wide| wide.end <= offset);
        offset - before.checked_sub(1).map_or(0, |last| self.wide[last].more)
    }

    /// The byte up to which there are so many units; of a character that is cut, its first byte.
    fn byte(&self, units: u32) -> u32 {
        let before = self.wide.partition_point(|wide| wide.end - wide.more <= units);
        let offset = units + before.checked_sub(1).map_or(0, |last| self.wide[last].more);
        // Up to here nothing is cut but in the character that comes next.
        match self.wide.get(before) {
            Some(wide) => offset.min(wide.start),
            None => offset,
        }
    }

    /// The line and the column of a byte.
    pub fn position(&self, offset: u32) -> Position {
        let line = self.starts.partition_point(|&start| start <= offset) - 1;
        let offset = offset.min(self.ends[line]);
        Position {
            line: line as u32,
            character: self.units(offset) - self.units(self.starts[line]),
        }
    }

    /// The byte at a line and a column; what lies behind a line or the text is taken as its end.
    pub fn offset(&self, position: Position) -> u32 {
        let line = position.line as usize;
        let (Some(&start), Some(&end)) = (self.starts.get(line), self.ends.get(line)) else {
            return self.ends.last().copied().unwrap_or(0);
        };
        let units = self.units(start).saturating_add(position.character);
        self.byte(units.min(self.units(end)))
    }

    /// The lines and columns of a span.
    pub fn range(&self, span: Span) -> Range {
        Range { start: self.position(span.start), end: self.position(span.end) }
    }
}

#[cfg(test)]
mod tests {
    use super::{Encoding, Lines};
    use gen_lsp_types::Position;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn every_place_is_found_again() {
        let text = "(a) ; é\r\n🍵𝄞 b ü\rx\n\nend";
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            let lines = Lines::new(text, encoding);
            for (offset, character) in text.char_indices() {
                let inside_line_end = character == '\n' && text[..offset].ends_with('\r');
                if !inside_line_end {
                    let position = lines.position(offset as u32);
                    assert_eq!(lines.offset(position), offset as u32, "{encoding:?} {offset}");
                }
            }
        }
    }

    #[test]
    fn columns_count_what_was_agreed_on() {
        let text = "é🍵b\nü";
        let (bytes, halves) = (Lines::new(text, Encoding::Utf8), Lines::new(text, Encoding::Utf16));
        let b = text.find('b').expect("it is there") as u32;
        assert_eq!((bytes.position(b), halves.position(b)), (at(0, 6), at(0, 3)));
        assert_eq!((bytes.position(10), halves.position(10)), (at(1, 2), at(1, 1)));
        // Half a character is its beginning.
        assert_eq!(halves.offset(at(0, 2)), 2);
    }

    #[test]
    fn what_lies_behind_the_end_is_the_end() {
        let lines = Lines::new("ab\r\nc", Encoding::Utf16);
        assert_eq!(lines.offset(at(0, 99)), 2);
        assert_eq!(lines.offset(at(9, 0)), 5);
        assert_eq!(lines.position(3), at(0, 2));
    }
}
