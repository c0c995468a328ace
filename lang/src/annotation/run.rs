//! A [`Tree`] goes in; the [`Run`]s of its comments that begin with `;@` come out, and of each run its s-expressions.
//!
//! A run is one text: the `;@` of its lines are skipped, and a list may be open from one line to the next.
//! In it `;` begins a remark to the end of the line, and `"` a text that ends on the same line.

use super::expression::{Expression, Item, Value};
use super::kind;
use crate::diagnostic::{Diagnostic, loose_annotation, unbalanced_annotation};
use crate::lexer::line_ends;
use crate::source::Span;
use crate::tree::{Node, NodeId, NodeKind, Tree};

/// What the comments of a run begin with.
pub const OPENING: &str = ";@";

/// `;@` comments on adjacent lines with nothing else between them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    /// The comments, one for each line.
    pub lines: Vec<NodeId>,
    /// The outermost lists around it, outermost first: the definition, the section and the field.
    pub around: Vec<NodeId>,
    /// The list that encloses it; none outside of all lists.
    pub enclosing: Option<NodeId>,
}

/// How many lists around a run say where it stands.
const AROUND: usize = 3;

/// All runs of a text, in its order.
pub fn runs(tree: &Tree<'_>) -> Vec<Run> {
    let mut runs = Vec::new();
    if !tree.input().contains(OPENING) {
        return runs;
    }
    let nodes = tree.nodes();
    let mut open: Vec<(NodeId, u32)> = Vec::new();
    let mut at = 0;
    while at < nodes.len() {
        while open.pop_if(|(_, next)| *next as usize <= at).is_some() {}
        let id = NodeId(at as u32);
        if tree.is_list(id) {
            open.push((id, nodes[at].next));
        } else if opens(tree, id) {
            let mut lines = vec![id];
            while continues(tree, at) {
                at += 2;
                lines.push(NodeId(at as u32));
            }
            let around = open.iter().take(AROUND).map(|&(list, _)| list).collect();
            runs.push(Run { lines, around, enclosing: open.last().map(|&(list, _)| list) });
        }
        at += 1;
    }
    runs
}

/// Whether the node is a comment that belongs to a run.
fn opens(tree: &Tree<'_>, id: NodeId) -> bool {
    tree.node(id).kind == NodeKind::Comment && tree.slice(id).starts_with(OPENING)
}

/// Whether the comment after the comment `at` stands on the next line, and belongs to its run.
fn continues(tree: &Tree<'_>, at: usize) -> bool {
    let [comment, blanks, next] = tree.nodes().get(at..at + 3).unwrap_or_default() else {
        return false;
    };
    // A `)` is no node, but it leaves a gap.
    let touch = |before: &Node, after: &Node| before.end == after.start;
    blanks.kind == NodeKind::Space
        && touch(comment, blanks)
        && touch(blanks, next)
        && opens(tree, NodeId(at as u32 + 2))
        && line_ends(tree.slice(NodeId(at as u32 + 1))) == 1
}

/// The s-expressions of a run.
#[derive(Debug, Default)]
pub struct Content {
    /// Those that are closed.
    pub expressions: Vec<Expression>,
    /// What is wrong with its parentheses and quotes, if anything: the first of it, since the rest may follow from it.
    pub fault: Option<Diagnostic>,
    /// Words outside of all lists, if its parentheses match.
    pub loose: Option<Diagnostic>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TokenKind {
    Open,
    Close,
    Word,
    /// With its quotes.
    Text,
    /// With a quote at its beginning alone.
    OpenText,
    /// From its `;` to the end of the line.
    Remark,
}

#[derive(Debug, Clone, Copy)]
struct Token {
    kind: TokenKind,
    span: Span,
    /// Whether it is the first of its line.
    first: bool,
}

/// The words, parentheses, texts and remarks of a comment; nothing if it does not begin with `;@`.
pub fn words(comment: &str) -> Option<Vec<&str>> {
    comment.strip_prefix(OPENING).map(|inner| {
        let mut at = 0;
        std::iter::from_fn(|| lex(inner, &mut at)).map(|(_, word)| word).collect()
    })
}

/// Reads the next token of a line from `at` on.
fn lex<'a>(line: &'a str, at: &mut usize) -> Option<(TokenKind, &'a str)> {
    let blank = |letter: char| letter.is_whitespace() || letter == '\u{feff}';
    let rest = line[*at..].trim_start_matches(blank);
    let first = rest.chars().next()?;
    let (kind, length) = match first {
        ';' => (TokenKind::Remark, rest.trim_end().len()),
        '(' => (TokenKind::Open, 1),
        ')' => (TokenKind::Close, 1),
        '"' => match rest[1..].find('"') {
            Some(length) => (TokenKind::Text, length + 2),
            None => (TokenKind::OpenText, rest.trim_end().len()),
        },
        _ => {
            let ends = |letter| blank(letter) || matches!(letter, '(' | ')' | ';' | '"' | '?');
            let skip = first.len_utf8();
            (TokenKind::Word, rest[skip..].find(ends).map_or(rest.len(), |end| skip + end))
        }
    };
    *at = line.len() - rest.len() + length;
    Some((kind, &rest[..length]))
}

/// The tokens of a run without its remarks.
fn tokens(tree: &Tree<'_>, run: &Run) -> Vec<Token> {
    let mut tokens = Vec::new();
    for &line in &run.lines {
        let inner = &tree.slice(line)[OPENING.len()..];
        let start = tree.span(line).start + OPENING.len() as u32;
        let (mut at, mut first) = (0, true);
        while let Some((kind, word)) = lex(inner, &mut at) {
            let end = start + at as u32;
            let span = Span::new(tree.source, end - word.len() as u32, end);
            if kind != TokenKind::Remark {
                tokens.push(Token { kind, span, first });
            }
            first = false;
        }
    }
    tokens
}

/// Reads what a run says.
pub fn content(tree: &Tree<'_>, run: &Run) -> Content {
    let tokens = tokens(tree, run);
    let content = parse(tree, &tokens, false);
    match content.fault {
        // Where something is open at the end, a known kind at the beginning of a line shows where that should have ended.
        Some(_) => parse(tree, &tokens, true),
        None => content,
    }
}

fn parse(tree: &Tree<'_>, tokens: &[Token], repair: bool) -> Content {
    let content = Content::default();
    let mut reader = Reader { tree, content, items: Vec::new(), open: Vec::new() };
    for (index, &token) in tokens.iter().enumerate() {
        let next = tokens.get(index + 1);
        if repair && token.first && reader.starts(token, next) && index > 0 {
            reader.unclosed(tokens[index - 1].span);
            reader.open.clear();
            reader.items.clear();
        }
        reader.token(token);
    }
    if let Some(last) = tokens.last() {
        reader.unclosed(last.span);
    }
    let mut content = reader.content;
    if content.fault.is_some() {
        content.loose = None;
    }
    content
}

struct Reader<'t, 'a> {
    tree: &'t Tree<'a>,
    content: Content,
    /// Of the expression that is being read.
    items: Vec<Item>,
    /// Its lists that are not closed yet, outermost first.
    open: Vec<u32>,
}

impl Reader<'_, '_> {
    fn slice(&self, span: Span) -> &str {
        &self.tree.input()[span.start as usize..span.end as usize]
    }

    /// Whether an annotation of a known kind starts here.
    fn starts(&self, token: Token, next: Option<&Token>) -> bool {
        let known = |next: &Token| kind::find(self.slice(next.span)).is_some();
        token.kind == TokenKind::Open && next.is_some_and(known)
    }

    fn token(&mut self, token: Token) {
        let text = self.slice(token.span);
        match token.kind {
            TokenKind::Open => {
                self.open.push(self.items.len() as u32);
                self.push(Value::List, token.span);
            }
            TokenKind::Close => self.close(token.span),
            TokenKind::Remark => {}
            _ if self.open.is_empty() => {
                let line = self.content.loose.is_none().then(|| self.loose(token));
                self.content.loose = self.content.loose.take().or(line);
            }
            TokenKind::Word => {
                let word = Value::Word(text.to_owned());
                self.push(word, token.span);
            }
            TokenKind::Text => {
                let inner = Value::Text(text[1..text.len() - 1].to_owned());
                self.push(inner, token.span);
            }
            TokenKind::OpenText => {
                let inner = Value::Text(text[1..].to_owned());
                self.push(inner, token.span);
                self.fault(unbalanced_annotation::open_text(token.span));
            }
        }
    }

    fn push(&mut self, value: Value, span: Span) {
        let next = self.items.len() as u32 + 1;
        self.items.push(Item { value, span, next });
    }

    fn close(&mut self, span: Span) {
        let Some(list) = self.open.pop() else {
            return self.fault(unbalanced_annotation::unexpected(span));
        };
        let next = self.items.len() as u32;
        let item = &mut self.items[list as usize];
        (item.span, item.next) = (item.span.to(span), next);
        if self.open.is_empty() {
            let items = std::mem::take(&mut self.items);
            self.content.expressions.push(Expression { items });
        }
    }

    /// Reports the outermost list that is open behind `last`, if one is.
    fn unclosed(&mut self, last: Span) {
        let Some(&list) = self.open.first() else { return };
        let head = match self.items.get(list as usize + 1).map(|item| &item.value) {
            Some(Value::Word(word)) => word.as_str(),
            _ => "",
        };
        let paren = self.items[list as usize].span;
        self.fault(unbalanced_annotation::unclosed(paren, head, (last, self.open.len())));
    }

    fn fault(&mut self, fault: Diagnostic) {
        self.content.fault.get_or_insert(fault);
    }

    /// A word outside of all lists; one that its line begins with probably makes the whole line a remark.
    fn loose(&self, token: Token) -> Diagnostic {
        let text = self.slice(token.span);
        let marker = token.first.then(|| {
            let before = &self.tree.input()[..token.span.start as usize];
            let marker = before.rfind(OPENING).expect("the line of a run begins with it") as u32;
            Span::new(token.span.source, marker, marker + OPENING.len() as u32)
        });
        loose_annotation::loose_annotation(text, token.span, marker)
    }
}
