//! [`Token`]s go in with the repairs of their parentheses; the nodes of a [`Tree`] come out.

use std::iter::{Copied, Enumerate};
use std::slice::Iter;

use nom::branch::alt;
use nom::combinator::map;
use nom::{IResult, Input, Needed, Parser};

use super::outline::{self, Section};
use super::repair::{self, Edit, Repair};
use super::{Node, NodeKind, Tree};
use crate::diagnostic::{Diagnostics, unclosed_paren, unexpected_close_paren};
use crate::lexer::{self, Token, TokenKind};
use crate::source::{SourceId, Span};

/// The tokens that are still to be read, as input for nom.
#[derive(Debug, Clone, Copy)]
struct Tokens<'t>(&'t [Token]);

impl<'t> Input for Tokens<'t> {
    type Item = Token;
    type Iter = Copied<Iter<'t, Token>>;
    type IterIndices = Enumerate<Self::Iter>;

    fn input_len(&self) -> usize {
        self.0.len()
    }
    fn take(&self, index: usize) -> Self {
        Self(&self.0[..index])
    }
    fn take_from(&self, index: usize) -> Self {
        Self(&self.0[index..])
    }
    fn take_split(&self, index: usize) -> (Self, Self) {
        (Self(&self.0[index..]), Self(&self.0[..index]))
    }
    fn position<P: Fn(Token) -> bool>(&self, predicate: P) -> Option<usize> {
        self.0.iter().position(|&token| predicate(token))
    }
    fn iter_elements(&self) -> Self::Iter {
        self.0.iter().copied()
    }
    fn iter_indices(&self) -> Self::IterIndices {
        self.iter_elements().enumerate()
    }
    fn slice_index(&self, count: usize) -> Result<usize, Needed> {
        if count <= self.0.len() { Ok(count) } else { Err(Needed::new(count - self.0.len())) }
    }
}

/// One token in the role that it plays for the tree.
#[derive(Debug, Clone, Copy)]
enum Item {
    Open(Token),
    Close(Token),
    Leaf(NodeKind, Token),
}

/// Reads one token of the wanted kind.
fn token<'t>(kind: TokenKind) -> impl FnMut(Tokens<'t>) -> IResult<Tokens<'t>, Token, ()> {
    move |input: Tokens<'t>| match input.0.split_first() {
        Some((&first, rest)) if first.kind == kind => Ok((Tokens(rest), first)),
        _ => Err(nom::Err::Error(())),
    }
}

/// Reads one item.
fn item(input: Tokens<'_>) -> IResult<Tokens<'_>, Item, ()> {
    alt((
        map(token(TokenKind::Space), |token| Item::Leaf(NodeKind::Space, token)),
        map(token(TokenKind::Atom), |token| Item::Leaf(NodeKind::Atom, token)),
        map(token(TokenKind::Open), Item::Open),
        map(token(TokenKind::Close), Item::Close),
        map(token(TokenKind::Comment), |token| Item::Leaf(NodeKind::Comment, token)),
    ))
    .parse(input)
}

/// Reads `text` as a tree.
pub fn parse<'a>(source: SourceId, text: &'a str, diagnostics: &mut Diagnostics) -> Tree<'a> {
    let tokens = lexer::lex(text);
    lexer::check_characters(source, text, &tokens, diagnostics);
    let sections = outline::outline(text, &tokens);
    let mut builder = Builder {
        source,
        text,
        tokens: &tokens,
        nodes: Vec::with_capacity(tokens.len()),
        open: Vec::new(),
        floor: 0,
        start: 0,
        last: Span::new(source, 0, 0),
        dropped: None,
        unpaired: Vec::new(),
        diagnostics,
    };
    let mut steps = repair::STEPS;
    for (number, section) in sections.iter().enumerate() {
        let next = sections.get(number + 1);
        let end = next.map_or(tokens.len() as u32, |next| next.start);
        let depth = next.map_or(0, |next| next.depth);
        let repair = if section.broken {
            repair::repair(text, &tokens, section, end, depth, &mut steps)
        } else {
            Repair::default()
        };
        builder.start(section);
        (builder.floor, builder.start) = (depth as usize, section.start);
        builder.section(section.start..end, &repair);
    }
    builder.finish();
    Tree { source, input: text, nodes: builder.nodes }
}

/// The state of the loop that builds a tree.
struct Builder<'a, 't, 'd> {
    source: SourceId,
    text: &'a str,
    tokens: &'t [Token],
    nodes: Vec<Node>,
    /// The lists that are not closed yet, outermost first.
    open: Vec<u32>,
    /// How many lists stay open at the end of the section at hand.
    floor: usize,
    /// The token with which the section at hand starts.
    start: u32,
    /// The last parenthesis or word.
    last: Span,
    /// The last parenthesis that was dropped, with the position of the message about it.
    dropped: Option<(u32, usize)>,
    /// The `)` that were missing, and those that were too many, until one of the other kind turns up.
    unpaired: Vec<Unpaired>,
    diagnostics: &'d mut Diagnostics,
}

/// A `)` that was missing or too many. With one of the other kind it may be a single one that stands in the wrong place.
#[derive(Clone, Copy)]
struct Unpaired {
    missing: bool,
    /// The token with which its section starts.
    section: u32,
    /// Whether all that is wrong with it is that the definition ends too early.
    ends_definition: bool,
    /// The position of the message about it.
    message: usize,
}

impl Builder<'_, '_, '_> {
    /// Reads the tokens of a section.
    fn section(&mut self, tokens: std::ops::Range<u32>, repair: &Repair) {
        let mut edits = repair.edits.as_slice();
        let mut rest = Tokens(&self.tokens[tokens.start as usize..tokens.end as usize]);
        let mut at = tokens.start;
        while let Ok((after, item)) = item(rest) {
            let mut dropped = false;
            while let Some((&edit, others)) = edits.split_first()
                && edit.token() == at
                && !matches!(edit, Edit::Close(_))
            {
                edits = others;
                match edit {
                    Edit::Open(_) => self.insert_open(at),
                    _ => dropped = true,
                }
            }
            match item {
                Item::Open(_) | Item::Close(_) if dropped => self.drop(at, repair.misplaced),
                Item::Open(token) => self.open(token),
                Item::Close(token) => self.close(token, at),
                Item::Leaf(kind, token) => self.leaf(kind, token),
            }
            let count = edits.iter().take_while(|edit| edit.token() == at).count();
            edits = &edits[count..];
            let token = self.tokens[at as usize];
            if !outline::is_trivia(token.kind) {
                self.last = Span::new(self.source, token.start, token.end);
            }
            // What is missing at the end of a section is closed where the next one starts.
            let goes_on = || after.0.iter().any(|token| !outline::is_trivia(token.kind));
            if count > 0 && goes_on() {
                self.insert_close(at, count, repair.misplaced);
            }
            (rest, at) = (after, at + 1);
        }
    }

    fn span(&self, token: u32) -> Span {
        let Token { start, end, .. } = self.tokens[token as usize];
        Span::new(self.source, start, end)
    }

    fn slice(&self, span: Span) -> &str {
        &self.text[span.start as usize..span.end as usize]
    }

    fn leaf(&mut self, kind: NodeKind, token: Token) {
        let next = self.nodes.len() as u32 + 1;
        self.nodes.push(Node { kind, start: token.start, end: token.end, next });
    }

    fn open(&mut self, token: Token) {
        self.open.push(self.nodes.len() as u32);
        self.leaf(NodeKind::OpenList, token);
    }

    /// Opens a list whose `(` is missing before a token.
    fn insert_open(&mut self, before: u32) {
        let span = self.span(before);
        let word = self.slice(span).to_owned();
        self.diagnostics.push(unexpected_close_paren::missing_open(&word, span));
        let token = Token { kind: TokenKind::Open, start: span.start, end: span.start };
        self.open(token);
    }

    fn close(&mut self, token: Token, at: u32) {
        if self.open.is_empty() || self.open.len() == self.floor {
            return self.drop(at, None);
        }
        let list = self.open.pop().expect("a list is open: it was looked at above");
        let next = self.nodes.len() as u32;
        let whole = self.starts(list);
        let node = &mut self.nodes[list as usize];
        node.kind = if whole { NodeKind::List } else { NodeKind::OpenList };
        (node.end, node.next) = (token.end, next);
    }

    /// Leaves a parenthesis out.
    fn drop(&mut self, at: u32, misplaced: Option<u32>) {
        let token = self.tokens[at as usize];
        let span = self.span(at);
        self.leaf(NodeKind::Stray, token);
        let joined = self.dropped.filter(|&(last, _)| {
            let between = &self.tokens[last as usize + 1..at as usize];
            self.tokens[last as usize].kind == token.kind
                && between.iter().all(|token| token.kind == TokenKind::Space)
        });
        if let Some((_, message)) = joined {
            self.dropped = Some((at, message));
            for fix in &mut self.diagnostics.list[message].fixes {
                fix.title = format!(
                    "remove these `{}`",
                    &self.text[span.start as usize..span.end as usize]
                );
                fix.edits.push((span, String::new()));
            }
            return;
        }
        if token.kind == TokenKind::Close
            && let Some(message) = self.pair(true, self.open.is_empty())
        {
            let message = &mut self.diagnostics.list[message];
            unclosed_paren::instead(message, span);
            return;
        }
        let misplaced = misplaced.filter(|&word| word > at).map(|word| self.span(word));
        let misplaced = misplaced.map(|span| (span, self.slice(span)));
        let ends_definition = self.open.len() == self.floor && !self.open.is_empty();
        let diagnostic = match token.kind {
            TokenKind::Open => unclosed_paren::superfluous(span),
            _ if self.open.is_empty() => unexpected_close_paren::nothing_open(span),
            _ if ends_definition => unexpected_close_paren::closes_definition(span),
            _ => unexpected_close_paren::too_many(span, misplaced),
        };
        let message = self.diagnostics.list.len();
        self.dropped = Some((at, message));
        if token.kind == TokenKind::Close {
            self.unpaired.push(Unpaired {
                missing: false,
                section: self.start,
                ends_definition,
                message,
            });
        }
        self.diagnostics.push(diagnostic);
    }

    /// The message about a `)` that was missing, or one that was too many, and that pairs with one of the other kind at hand.
    ///
    /// They are one mistake if they are of one section, or if the definition ends too early or too late because of them.
    fn pair(&mut self, missing: bool, at_end: bool) -> Option<usize> {
        let found = self.unpaired.iter().rposition(|one| {
            let same_section = one.section == self.start;
            one.missing == missing && (same_section || at_end && (missing || one.ends_definition))
        })?;
        Some(self.unpaired.remove(found).message)
    }

    /// Remembers that so many `)` were missing, of which the last message tells.
    fn missing(&mut self, count: usize) {
        let message = self.diagnostics.list.len() - 1;
        let one = Unpaired { missing: true, section: self.start, ends_definition: false, message };
        self.unpaired.extend(std::iter::repeat_n(one, count));
    }

    /// Closes the innermost lists after a token, in the middle of a section.
    fn insert_close(&mut self, after: u32, count: usize, misplaced: Option<u32>) {
        let depth = self.open.len().saturating_sub(count);
        let Some(&innermost) = self.open.last() else { return };
        let after = self.span(after);
        let place = Span { start: after.end, ..after };
        if count == 1
            && let Some(message) = self.pair(false, false)
        {
            unexpected_close_paren::instead(&mut self.diagnostics.list[message], after);
            return self.close_open(depth, place.end);
        }
        let misplaced =
            misplaced.map(|word| self.span(word)).filter(|span| span.start >= after.end);
        let misplaced = misplaced.map(|span| (span, self.slice(span)));
        self.diagnostics.push(unclosed_paren::inside(
            self.paren(innermost),
            &self.heading(innermost),
            after,
            misplaced,
            (place, self.open.len() - depth),
        ));
        self.missing(self.open.len() - depth);
        self.close_open(depth, place.end);
    }

    /// Closes what is still open where a section starts that cannot stand there.
    fn start(&mut self, section: &Section) {
        let depth = section.depth as usize;
        let Some(keyword) = section.keyword.filter(|_| self.open.len() > depth) else { return };
        let keyword = self.span(keyword);
        let first = self.open[depth];
        let missing = self.open.len() - depth;
        self.diagnostics.push(unclosed_paren::before_section(
            self.paren(first),
            &self.heading(first),
            keyword,
            self.slice(keyword),
            (Span { start: self.last.end, ..self.last }, missing),
        ));
        self.missing(missing);
        self.close_open(depth, self.last.end);
    }

    fn finish(&mut self) {
        if self.open.is_empty() {
            return;
        }
        let end = self.last.end;
        if self.open.len() == 1
            && let Some(message) = self.pair(false, true)
        {
            unexpected_close_paren::instead(&mut self.diagnostics.list[message], self.last);
            return self.close_open(0, end);
        }
        // The innermost section says most; where there is none, the definition does.
        let anchor =
            usize::from(self.open.len() > 1 && self.heading(self.open[1]).starts_with(':'));
        let others: Vec<String> = (0..self.open.len().min(MENTIONED))
            .filter(|&level| level != anchor)
            .map(|level| self.heading(self.open[level]))
            .collect();
        self.diagnostics.push(unclosed_paren::at_end(
            self.paren(self.open[anchor]),
            &self.heading(self.open[anchor]),
            &others,
            (Span::new(self.source, end, end), self.open.len()),
        ));
        self.close_open(0, end);
    }

    /// Ends the open lists above `depth` at byte `end`, and hands what follows it to the list that stays open.
    fn close_open(&mut self, depth: usize, end: u32) {
        let mut next = self.nodes.len();
        while next > 0 && self.nodes[next - 1].start >= end {
            next -= 1;
        }
        for list in self.open.split_off(depth) {
            if self.starts(list) {
                let node = &mut self.nodes[list as usize];
                (node.end, node.next) = (end, next as u32);
            } else {
                // Without both of its parentheses it is no list at all.
                let node = &mut self.nodes[list as usize];
                (node.kind, node.end) = (NodeKind::Space, node.start);
            }
        }
    }

    /// Whether the list has its `(`.
    fn starts(&self, list: u32) -> bool {
        self.text.as_bytes().get(self.nodes[list as usize].start as usize) == Some(&b'(')
    }

    fn paren(&self, list: u32) -> Span {
        let start = self.nodes[list as usize].start;
        Span::new(self.source, start, start + u32::from(self.starts(list)))
    }

    /// The first word of a list, and for a section like `:action` the name that follows.
    fn heading(&self, list: u32) -> String {
        let mut words = self.nodes[list as usize + 1..]
            .iter()
            .filter(|node| !matches!(node.kind, NodeKind::Space | NodeKind::Comment))
            .take_while(|node| node.kind == NodeKind::Atom)
            .map(|node| &self.text[node.start as usize..node.end as usize]);
        let first = words.next().unwrap_or("");
        match words.next() {
            Some(name)
                if first.starts_with(':')
                    && !name.starts_with([':', '?', '-'])
                    && first.ends_with("action") =>
            {
                format!("{first} {name}")
            }
            _ => first.to_owned(),
        }
    }
}

/// How many of the lists left open at the end a message names.
const MENTIONED: usize = 4;
