//! Text goes in; [`Token`]s come out, which together cover every byte of it.
//!
//! Nothing is reserved here: `at`, `and` and `problem` are words like any other, and the grammar decides by place.
//! A `?` starts a token of its own, so `(aircraft?a)` is a word and a variable.

use logos::Logos;

use crate::diagnostic::{Diagnostics, invalid_character};
use crate::source::{SourceId, Span};

/// What a [`Token`] is.
#[derive(Logos, Debug, Clone, Copy, PartialEq, Eq)]
pub enum TokenKind {
    /// `(`
    #[token("(")]
    Open,
    /// `)`
    #[token(")")]
    Close,
    /// A name, a number, a keyword with its `:`, a variable with its `?`, or a dash.
    #[regex(r"\?[^\s();?\u{feff}]*")]
    #[regex(r"[^\s();?\u{feff}]+")]
    Atom,
    /// Blanks and line ends, and a byte order mark.
    #[regex(r"[\s\u{feff}]+")]
    Space,
    /// `;` to the end of the line.
    #[regex(r";[^\r\n]*", allow_greedy = true)]
    Comment,
}

/// A piece of the text. It ends where the next one starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

/// Cuts `text` into tokens. Their ranges follow each other without a gap.
pub fn lex(text: &str) -> Vec<Token> {
    let mut tokens = Vec::with_capacity(text.len() / 3);
    for (kind, range) in TokenKind::lexer(text).spanned() {
        // Every byte belongs to one of the patterns, so there is no error in practice; what had none would be a word.
        let kind = kind.unwrap_or(TokenKind::Atom);
        tokens.push(Token { kind, start: range.start as u32, end: range.end as u32 });
    }
    tokens
}

/// How many lines end in a text: a carriage return alone ends one too, as it ends a comment.
pub(crate) fn line_ends(text: &str) -> usize {
    let bytes = text.as_bytes();
    let ends = |at: usize| match bytes[at] {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    };
    (0..bytes.len()).filter(|&at| ends(at)).count()
}

/// Whether `text` is the `-` of a typed list, or one of the dashes that word processors put in its place.
pub fn is_dash(text: &str) -> bool {
    matches!(
        text,
        "-" | "\u{2010}" | "\u{2011}" | "\u{2012}" | "\u{2013}" | "\u{2014}" | "\u{2212}"
    )
}

/// Whether a PDDL name or number may contain `byte`; liberal, because planners are.
fn is_plain(byte: u8) -> bool {
    byte.is_ascii_graphic()
        && !matches!(byte, b'"' | b'\'' | b'`' | b',' | b'{' | b'}' | b'[' | b']' | b'\\')
}

/// Whether a word has no character that would be reported.
pub fn is_plain_text(text: &str) -> bool {
    text.bytes().all(is_plain)
}

/// Reports each character that has no place in PDDL, at its first appearance outside comments.
pub fn check_characters(
    source: SourceId,
    text: &str,
    tokens: &[Token],
    diagnostics: &mut Diagnostics,
) {
    let mut seen: Vec<char> = Vec::new();
    let bytes = text.as_bytes();
    for token in tokens {
        let range = token.start as usize..token.end as usize;
        let plain = match token.kind {
            TokenKind::Open | TokenKind::Close | TokenKind::Comment => true,
            TokenKind::Atom => bytes[range.clone()].iter().all(|&byte| is_plain(byte)),
            TokenKind::Space => bytes[range.clone()].is_ascii(),
        };
        if plain {
            continue;
        }
        for (offset, character) in text[range].char_indices() {
            let allowed = match token.kind {
                TokenKind::Space => character.is_ascii() || character == '\u{feff}',
                _ => u8::try_from(character).is_ok_and(is_plain),
            };
            if allowed || seen.contains(&character) {
                continue;
            }
            seen.push(character);
            // The quotation mark that closes says nothing that the one that opens has not.
            seen.extend(QUOTES.iter().find(|pair| pair[0] == character).map(|pair| pair[1]));
            let start = token.start + offset as u32;
            let span = Span::new(source, start, start + character.len_utf8() as u32);
            diagnostics.push(invalid_character::invalid_character(character, span));
            if seen.len() >= LIMIT {
                return;
            }
        }
    }
}

/// Quotation marks that open, each with the one that closes.
const QUOTES: [[char; 2]; 4] = [['“', '”'], ['‘', '’'], ['«', '»'], ['„', '“']];

/// How many different characters are reported: beyond this the text is no PDDL at all.
const LIMIT: usize = 20;
