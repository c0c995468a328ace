//! Tokens go in; the sections that they are divided into come out, and which of them have parentheses that cannot be right.
//!
//! A section starts with its keyword wherever that stands in a list of its own, since no section contains another.
//! So a mistake in one section says nothing about the next.

use crate::lexer::{Token, TokenKind};
use crate::near::nearest;

/// The keywords that start a section, and so can stand directly in the definition only.
const SECTIONS: [&str; 27] = [
    ":requirements",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":action",
    ":durative-action",
    ":derived",
    ":process",
    ":event",
    ":constraints",
    ":axiom",
    ":task",
    ":method",
    ":concurrency-constraint",
    ":positive-dependence",
    ":invariant",
    ":timeless",
    ":safety",
    ":domain",
    ":objects",
    ":situation",
    ":init",
    ":goal",
    ":metric",
    ":htn",
    ":length",
];

/// What starts in lists of its own elsewhere, although it looks like a misspelt section.
const NO_SECTIONS: [&str; 3] = [":private", ":serial", ":parallel"];

/// The keyword of a section that is meant by a word in lower case.
pub(super) fn intended(word: &str) -> Option<&'static str> {
    let exact = SECTIONS.iter().find(|&&section| section == word);
    if exact.is_some() || NO_SECTIONS.contains(&word) {
        return exact.copied();
    }
    nearest(word, SECTIONS).and_then(|near| SECTIONS.into_iter().find(|&section| section == near))
}

/// A part of the text that starts with the parenthesis of a section or of `(define`, or at the beginning.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// Its first token.
    pub(super) start: u32,
    /// The token of its keyword, if it has one.
    pub(super) keyword: Option<u32>,
    /// How many lists are open where it starts.
    pub(super) depth: u32,
    /// Whether its parentheses or the places of its keywords are not as they must be.
    pub(super) broken: bool,
}

/// Divides the tokens.
pub(super) fn outline(text: &str, tokens: &[Token]) -> Vec<Section> {
    let mut scan = Scan {
        text,
        tokens,
        sections: vec![Section { start: 0, keyword: None, depth: 0, broken: false }],
        depth: 0,
        base: None,
        indent: None,
        ended: false,
    };
    for at in 0..tokens.len() {
        scan.token(at);
    }
    scan.end(0);
    scan.sections
}

struct Scan<'t> {
    text: &'t str,
    tokens: &'t [Token],
    sections: Vec<Section>,
    /// How many lists are open, as far as the text goes.
    depth: u32,
    /// How many are open where a section starts, once it is known.
    base: Option<u32>,
    /// How far sections are indented that start a line.
    indent: Option<usize>,
    /// Whether the outermost list has ended.
    ended: bool,
}

impl<'t> Scan<'t> {
    fn token(&mut self, at: usize) {
        match self.tokens[at].kind {
            TokenKind::Open => {
                self.open(at);
                self.depth += 1;
            }
            TokenKind::Close => match self.depth.checked_sub(1) {
                Some(depth) => {
                    self.depth = depth;
                    self.ended = depth == 0;
                }
                None => self.last().broken = true,
            },
            TokenKind::Atom => {
                if self.depth == 0 {
                    self.last().broken = true;
                } else if self.slice(at).starts_with(':') {
                    let first = self.before(at).is_some_and(|kind| kind == TokenKind::Open);
                    let direct = self.depth == self.last().depth + 1;
                    self.last().broken |= !first && !direct;
                }
            }
            TokenKind::Space | TokenKind::Comment => {}
        }
    }

    fn open(&mut self, at: usize) {
        let Some(keyword) = self.after(at) else { return };
        let word = self.slice(keyword);
        let starts = if word.eq_ignore_ascii_case("define") {
            self.defines(keyword).then_some(0)
        } else if word.starts_with(':') && self.is_section(at, word) {
            let base = self.base.unwrap_or_else(|| self.first_base());
            self.base = Some(base);
            Some(base)
        } else {
            None
        };
        if let Some(depth) = starts {
            if depth == 0 && word.eq_ignore_ascii_case("define") {
                self.base = Some(1);
            }
            self.end(depth);
            self.depth = depth;
            self.ended = false;
            let (start, keyword) = (at as u32, Some(keyword as u32));
            self.sections.push(Section { start, keyword, depth, broken: false });
        } else if self.ended && self.depth == 0 {
            self.last().broken = true;
        }
    }

    /// How many lists are open where the first section starts, if there is no `(define` before it.
    fn first_base(&self) -> u32 {
        let first = (0..self.tokens.len()).find(|&at| self.tokens[at].kind == TokenKind::Atom);
        let defines = first.is_some_and(|first| self.slice(first).eq_ignore_ascii_case("define"));
        if defines { 1 } else { self.depth.min(1) }
    }

    /// Ends the section at hand, where so many lists should be open.
    fn end(&mut self, depth: u32) {
        let wrong = self.depth != depth;
        self.last().broken |= wrong;
    }

    fn last(&mut self) -> &mut Section {
        self.sections.last_mut().expect("there is a section from the beginning")
    }

    /// Whether `(define` starts a definition: it comes first, or nothing is open, or it goes on with `(domain` or `(problem`.
    fn defines(&self, keyword: usize) -> bool {
        if self.depth == 0 || self.base.is_none() {
            return true;
        }
        let open = self.after(keyword).filter(|&at| self.tokens[at].kind == TokenKind::Open);
        open.and_then(|open| self.after(open)).is_some_and(|title| {
            let title = self.slice(title);
            title.eq_ignore_ascii_case("domain") || title.eq_ignore_ascii_case("problem")
        })
    }

    /// Whether a section starts at the parenthesis `at`. A misspelt one must be at the start of a line, in line with the others.
    fn is_section(&mut self, at: usize, word: &str) -> bool {
        let known = SECTIONS.iter().any(|section| section.eq_ignore_ascii_case(word));
        let indent = indent(self.text, self.tokens[at].start as usize);
        if known {
            self.indent = indent.or(self.indent);
            return true;
        }
        indent.is_some()
            && self.indent.is_none_or(|usual| indent == Some(usual))
            && intended(&word.to_ascii_lowercase()).is_some()
    }

    fn slice(&self, at: usize) -> &'t str {
        let token = self.tokens[at];
        &self.text[token.start as usize..token.end as usize]
    }

    /// The parenthesis or word after a token.
    fn after(&self, at: usize) -> Option<usize> {
        (at + 1..self.tokens.len()).find(|&next| !is_trivia(self.tokens[next].kind))
    }

    /// What stands before a token.
    fn before(&self, at: usize) -> Option<TokenKind> {
        let before = self.tokens[..at].iter().rev().find(|token| !is_trivia(token.kind));
        before.map(|token| token.kind)
    }
}

/// Whether a token is a blank or a comment.
pub(super) fn is_trivia(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Space | TokenKind::Comment)
}

/// How far byte `at` is indented, if only blanks stand before it on its line. A tab goes on to the next multiple of eight.
pub(super) fn indent(text: &str, at: usize) -> Option<usize> {
    let before = &text.as_bytes()[..at];
    // A byte order mark stands at the beginning of the text.
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t' | 0x0c | 0xef | 0xbb | 0xbf);
    let count = before.iter().rev().take_while(|byte| blank(byte)).count();
    let (before, blanks) = before.split_at(at - count);
    let column = |column: usize, byte: &u8| match byte {
        b'\t' => (column / 8 + 1) * 8,
        b' ' | 0x0c => column + 1,
        _ => column,
    };
    let starts = before.last().is_none_or(|byte| matches!(byte, b'\n' | b'\r'));
    starts.then(|| blanks.iter().fold(0, column))
}
