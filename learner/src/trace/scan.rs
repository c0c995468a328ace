//! The text of a trace goes in; its [`Item`]s come out: lists that open and close, and words.
//!
//! Both the texts of `AMLGym` and those of MA-SAM are read by this; a `;` begins a comment.

/// A parenthesis or a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item<'t> {
    Open,
    Close,
    Word(&'t str),
}

/// Where reading has got to.
#[derive(Debug, Clone)]
pub(super) struct Scanner<'t> {
    pub(super) text: &'t str,
    at: usize,
}

impl<'t> Scanner<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// The byte of the next item, or the end of the text.
    pub(super) fn place(&mut self) -> usize {
        let bytes = self.text.as_bytes();
        while let Some(byte) = bytes.get(self.at) {
            match byte {
                b';' => {
                    let rest = &bytes[self.at..];
                    let end = rest.iter().position(|byte| *byte == b'\n');
                    self.at += end.unwrap_or(rest.len());
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        self.at
    }

    /// The next item, which is gone then.
    pub(super) fn next(&mut self) -> Option<Item<'t>> {
        let start = self.place();
        let bytes = self.text.as_bytes();
        let item = match bytes.get(start)? {
            b'(' => Item::Open,
            b')' => Item::Close,
            _ => {
                let ends =
                    |byte: &u8| matches!(byte, b'(' | b')' | b';') || byte.is_ascii_whitespace();
                let length = bytes[start..].iter().position(ends).unwrap_or(bytes.len() - start);
                self.at = start + length;
                return Some(Item::Word(&self.text[start..self.at]));
            }
        };
        self.at += 1;
        Some(item)
    }

    /// The next item, which stays.
    pub(super) fn peek(&mut self) -> Option<Item<'t>> {
        self.clone().next()
    }

    /// What stands before the next `)`, if no parenthesis and no comment comes before that; then both are gone.
    pub(super) fn flat(&mut self) -> Option<&'t str> {
        let rest = &self.text[self.at..];
        let end = rest.bytes().position(|byte| matches!(byte, b'(' | b')' | b';'))?;
        let closes = rest.as_bytes()[end] == b')';
        closes.then(|| {
            self.at += end + 1;
            &rest[..end]
        })
    }

    /// Reads on until the list that is open is closed; false if the text ends before.
    pub(super) fn leave(&mut self) -> bool {
        let mut depth = 1u32;
        while depth > 0 {
            match self.next() {
                Some(Item::Open) => depth += 1,
                Some(Item::Close) => depth -= 1,
                Some(Item::Word(_)) => {}
                None => return false,
            }
        }
        true
    }
}
