//! [`Token`]s go in; a lossless [`Tree`] of parentheses comes out, for any text whatever.
//!
//! nom reads one [`Item`] at a time; a loop with a stack of its own puts the items into a flat arena.
//! So nothing recurses, however deep the text nests.
//! Parentheses are repaired on the way: a list that is still open where a section starts, or at the end, is closed there;
//! a `)` that closes nothing, or that closes the whole definition before another section, is dropped.
//! Each repair is reported once.

use std::iter::{Copied, Enumerate};
use std::slice::Iter;

use nom::branch::alt;
use nom::combinator::map;
use nom::{IResult, Input, Needed, Parser};

use crate::diagnostic::{Diagnostics, unclosed_paren, unexpected_close_paren};
use crate::lexer::{self, Token, TokenKind};
use crate::source::{SourceId, Span};

/// What a [`Node`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeKind {
    /// `( … )`
    List,
    /// A list without its `)`, which was missing.
    OpenList,
    /// One word.
    Atom,
    /// A comment.
    Comment,
    /// Blanks.
    Space,
    /// A `)` that was dropped.
    Stray,
}

/// A node of the [`Tree`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// What it is.
    pub kind: NodeKind,
    /// The first byte.
    pub start: u32,
    /// The byte after the last, with the `)` of a list.
    pub end: u32,
    /// The node after this one and everything in it.
    pub next: u32,
}

/// Names a node of the [`Tree`] at hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// The parenthesis structure of one text: the nodes in the order of the text, each list before what it contains.
#[derive(Debug)]
pub struct Tree<'a> {
    /// Which text this is.
    pub source: SourceId,
    input: &'a str,
    nodes: Vec<Node>,
}

impl<'a> Tree<'a> {
    /// The node that `id` names.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    /// All nodes, in the order of the text.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Where the node stands.
    pub fn span(&self, id: NodeId) -> Span {
        let node = self.node(id);
        Span::new(self.source, node.start, node.end)
    }

    /// The text of the node as it stands in the input.
    pub fn slice(&self, id: NodeId) -> &'a str {
        let node = self.node(id);
        &self.input[node.start as usize..node.end as usize]
    }

    /// The whole text.
    pub fn input(&self) -> &'a str {
        self.input
    }

    /// Whether the node is a list.
    pub fn is_list(&self, id: NodeId) -> bool {
        matches!(self.node(id).kind, NodeKind::List | NodeKind::OpenList)
    }

    /// The lists and words outside all lists.
    pub fn roots(&self) -> Children<'_> {
        Children { nodes: &self.nodes, at: 0, end: self.nodes.len() as u32 }
    }

    /// The lists and words directly in the list `id`, without comments and blanks.
    pub fn children(&self, id: NodeId) -> Children<'_> {
        let node = self.node(id);
        Children { nodes: &self.nodes, at: id.0 + 1, end: node.next }
    }

    /// The text put together again from the leaves. It equals the input, whatever that was.
    pub fn text(&self) -> String {
        let mut text = String::with_capacity(self.input.len());
        let mut open: Vec<Node> = Vec::new();
        let close = |open: &mut Vec<Node>, text: &mut String, at: u32| {
            while let Some(list) = open.pop_if(|list| list.next == at) {
                if list.kind == NodeKind::List {
                    text.push_str(&self.input[list.end as usize - 1..list.end as usize]);
                }
            }
        };
        for (index, &node) in self.nodes.iter().enumerate() {
            close(&mut open, &mut text, index as u32);
            match node.kind {
                NodeKind::List | NodeKind::OpenList => {
                    text.push_str(&self.input[node.start as usize..=node.start as usize]);
                    open.push(node);
                }
                _ => text.push_str(&self.input[node.start as usize..node.end as usize]),
            }
        }
        close(&mut open, &mut text, self.nodes.len() as u32);
        text
    }
}

/// Walks over nodes that stand side by side, without comments, blanks and dropped parentheses.
#[derive(Debug, Clone)]
pub struct Children<'t> {
    nodes: &'t [Node],
    at: u32,
    end: u32,
}

impl Iterator for Children<'_> {
    type Item = NodeId;

    fn next(&mut self) -> Option<NodeId> {
        while self.at < self.end {
            let id = self.at;
            let node = self.nodes[id as usize];
            self.at = node.next;
            if matches!(node.kind, NodeKind::List | NodeKind::OpenList | NodeKind::Atom) {
                return Some(NodeId(id));
            }
        }
        None
    }
}

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

/// The keywords that start a section, and so can stand directly in the definition only.
const SECTIONS: [&str; 19] = [
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
    ":domain",
    ":objects",
    ":init",
    ":goal",
    ":metric",
    ":htn",
    ":task",
    ":method",
];

/// Reads `text` as a tree.
pub fn parse<'a>(source: SourceId, text: &'a str, diagnostics: &mut Diagnostics) -> Tree<'a> {
    let tokens = lexer::lex(text);
    lexer::check_characters(source, text, &tokens, diagnostics);
    let mut builder = Builder {
        source,
        text,
        nodes: Vec::with_capacity(tokens.len()),
        open: Vec::new(),
        position: 0,
        diagnostics,
    };
    let mut rest = Tokens(&tokens);
    while let Ok((after, item)) = item(rest) {
        match item {
            Item::Open(token) => builder.open(token, after),
            Item::Close(token) => builder.close(token, after),
            Item::Leaf(kind, token) => builder.leaf(kind, token),
        }
        rest = after;
    }
    builder.finish();
    Tree { source, input: text, nodes: builder.nodes }
}

/// The state of the loop that builds a tree.
struct Builder<'a, 'd> {
    source: SourceId,
    text: &'a str,
    nodes: Vec<Node>,
    /// The lists that are not closed yet, outermost first.
    open: Vec<u32>,
    /// The byte up to which the text has been read.
    position: u32,
    diagnostics: &'d mut Diagnostics,
}

impl Builder<'_, '_> {
    fn leaf(&mut self, kind: NodeKind, token: Token) {
        let next = self.nodes.len() as u32 + 1;
        self.nodes.push(Node { kind, start: token.start, end: token.end, next });
        self.position = token.end;
    }

    fn open(&mut self, token: Token, after: Tokens<'_>) {
        if self.open.len() > 1
            && let Some(keyword) = self.section(after)
        {
            self.close_section(keyword);
        }
        self.open.push(self.nodes.len() as u32);
        self.leaf(NodeKind::OpenList, token);
    }

    fn close(&mut self, token: Token, after: Tokens<'_>) {
        let closes_definition = self.open.len() == 1 && self.starts_section(after);
        if self.open.is_empty() || closes_definition {
            let joins = self.nodes.last().is_some_and(|last| last.kind == NodeKind::Stray);
            if !joins {
                let span = Span::new(self.source, token.start, token.end);
                self.diagnostics
                    .push(unexpected_close_paren::unexpected_close_paren(span, closes_definition));
            }
            return self.leaf(NodeKind::Stray, token);
        }
        let list = self.open.pop().expect("a list is open: it was looked at above");
        let next = self.nodes.len() as u32;
        let node = &mut self.nodes[list as usize];
        (node.kind, node.end, node.next) = (NodeKind::List, token.end, next);
        self.position = token.end;
    }

    /// Closes everything down to the definition, because a section starts at `keyword`.
    fn close_section(&mut self, keyword: Token) {
        let section = self.open[1];
        let missing = self.open.len() - 1;
        let end = self.content_end();
        self.diagnostics.push(unclosed_paren::before_section(
            self.paren(section),
            &self.heading(section),
            Span::new(self.source, keyword.start, keyword.end),
            &self.text[keyword.start as usize..keyword.end as usize],
            (Span::new(self.source, end, end), missing),
        ));
        self.close_open(1, end);
    }

    fn finish(&mut self) {
        if self.open.is_empty() {
            return;
        }
        let end = self.content_end();
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
        for list in self.open.drain(depth..) {
            let node = &mut self.nodes[list as usize];
            (node.end, node.next) = (end, next as u32);
        }
    }

    /// Where what has been read ends, without the blanks and comments at its end.
    fn content_end(&self) -> u32 {
        let mut end = self.position;
        for node in self.nodes.iter().rev() {
            if node.end != end || !matches!(node.kind, NodeKind::Space | NodeKind::Comment) {
                break;
            }
            end = node.start;
        }
        end
    }

    fn paren(&self, list: u32) -> Span {
        let start = self.nodes[list as usize].start;
        Span::new(self.source, start, start + 1)
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

    /// The keyword that follows an open parenthesis, if it is that of a section.
    fn section(&self, after: Tokens<'_>) -> Option<Token> {
        let keyword = after.0.iter().find(|token| !is_trivia(token.kind))?;
        let text = self.text.get(keyword.start as usize..keyword.end as usize)?;
        let known = keyword.kind == TokenKind::Atom
            && text.starts_with(':')
            && SECTIONS.iter().any(|section| section.eq_ignore_ascii_case(text));
        known.then_some(*keyword)
    }

    /// Whether the next thing is a section.
    fn starts_section(&self, after: Tokens<'_>) -> bool {
        match after.0.iter().position(|token| !is_trivia(token.kind)) {
            Some(index) if after.0[index].kind == TokenKind::Open => {
                self.section(after.take_from(index + 1)).is_some()
            }
            _ => false,
        }
    }
}

/// How many of the lists left open at the end a message names.
const MENTIONED: usize = 4;

fn is_trivia(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Space | TokenKind::Comment)
}
