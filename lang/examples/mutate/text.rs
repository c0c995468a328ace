//! A valid text goes in; its tokens, its lists and its names come out, ready for one of them to be broken.

use lang::diagnostic::Diagnostics;
use lang::lexer::{self, Token, TokenKind};
use lang::model::Domain;
use lang::source::{SourceId, Sources};
use lang::symbol::{Namespace, Occurrence, Role};
use lang::tree::{self, NodeId, Tree};

/// A text with everything that is known of it.
pub struct Text<'a> {
    pub whole: &'a str,
    /// Parentheses and words, without blanks and comments.
    pub tokens: Vec<Token>,
    pub tree: Tree<'a>,
    pub names: Vec<Occurrence>,
    /// The domain that it is, or that it is a problem of.
    pub domain: &'a Domain,
    pub is_domain: bool,
}

impl<'a> Text<'a> {
    pub fn new(text: &'a str, is_domain: bool, domain: &'a Domain) -> Self {
        let mut sources = Sources::default();
        let id = sources.add("text", text);
        let names = if is_domain {
            lang::index_domain(&sources, id).2
        } else {
            lang::index_problem(&sources, id, domain).2
        };
        let mut tokens = lexer::lex(text);
        tokens.retain(|token| {
            matches!(token.kind, TokenKind::Open | TokenKind::Close | TokenKind::Atom)
        });
        let tree = tree::parse(SourceId(0), text, &mut Diagnostics::default());
        Self { whole: text, tokens, tree, names: names.list, domain, is_domain }
    }

    pub fn slice(&self, start: u32, end: u32) -> &'a str {
        &self.whole[start as usize..end as usize]
    }

    /// Names of the kind that are used, not declared.
    pub fn uses(&self, namespace: Namespace) -> Vec<Occurrence> {
        let mut uses = self.names.clone();
        uses.retain(|one| one.symbol.namespace() == namespace && one.role != Role::Declare);
        uses
    }

    /// Whether some name of the kind is spelt so: in a list of the text if one is given, else in the text or the domain.
    pub fn is_taken(&self, namespace: Namespace, word: &str, within: Option<NodeId>) -> bool {
        let constants = self.domain.constants.iter().map(|object| object.name.text.as_str());
        let elsewhere: Vec<&str> = match namespace {
            Namespace::Predicate => {
                self.domain.predicates.iter().map(|one| one.name.text.as_str()).collect()
            }
            Namespace::Function => {
                self.domain.functions.iter().map(|one| one.name.text.as_str()).collect()
            }
            Namespace::Type => self.domain.types.iter().map(|one| one.name.text.as_str()).collect(),
            Namespace::Object => constants.collect(),
            _ => Vec::new(),
        };
        let range = within.map(|list| self.tree.node(list));
        let mut here = self.names.iter().filter(|one| {
            one.symbol.namespace() == namespace
                && range.is_none_or(|list| (list.start..list.end).contains(&one.span.start))
        });
        elsewhere.iter().any(|other| other.eq_ignore_ascii_case(word))
            || here.any(|one| self.slice(one.span.start, one.span.end).eq_ignore_ascii_case(word))
    }

    /// The lists directly in the definition, each with its first word.
    pub fn sections(&self) -> Vec<(NodeId, NodeId)> {
        let Some(definition) = self.tree.roots().next() else { return Vec::new() };
        let children = self.tree.children(definition).skip(2);
        children
            .filter(|&child| self.tree.is_list(child))
            .filter_map(|child| Some((child, self.tree.children(child).next()?)))
            .collect()
    }

    /// The section in which a byte stands.
    pub fn section_at(&self, at: u32) -> Option<(NodeId, NodeId)> {
        let inside = |&(list, _): &(NodeId, NodeId)| {
            let node = self.tree.node(list);
            (node.start..node.end).contains(&at)
        };
        self.sections().into_iter().find(inside)
    }

    /// The innermost list around a byte.
    pub fn list_at(&self, at: u32) -> Option<NodeId> {
        let nodes = self.tree.nodes();
        let mut lists = (0..nodes.len() as u32).map(NodeId).filter(|&id| self.tree.is_list(id));
        lists.rfind(|&id| {
            let node = self.tree.node(id);
            node.start < at && at < node.end
        })
    }
}

/// The text with its lines as they are wanted.
pub fn layout(text: String, how: Option<&str>) -> String {
    let bare = |text: &str| {
        let tokens = lexer::lex(text);
        let kept = tokens.iter().filter(|token| token.kind != TokenKind::Comment);
        kept.map(|token| &text[token.start as usize..token.end as usize]).collect::<String>()
    };
    match how {
        Some("line") => bare(&text).split_whitespace().collect::<Vec<_>>().join(" "),
        Some("flat") => text.lines().map(str::trim).collect::<Vec<_>>().join("\n"),
        Some("ours") => lang::format::format(&text).unwrap_or(text),
        Some(other) => panic!("there is no layout `{other}`"),
        None => text,
    }
}

/// The line of a byte; the first has number one.
pub fn line_of(text: &str, at: usize) -> usize {
    1 + text[..at].matches('\n').count()
}

/// Numbers that look random and are the same on every run: `SplitMix64`.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64, name: &str) -> Self {
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        Self(name.bytes().fold(seed ^ 0xcbf2_9ce4_8422_2325, mix))
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % end as u64) as usize
    }

    /// One of them.
    pub fn pick<'s, T>(&mut self, from: &'s [T]) -> Option<&'s T> {
        if from.is_empty() { None } else { Some(&from[self.below(from.len())]) }
    }
}
