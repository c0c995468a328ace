//! [`Token`](crate::lexer::Token)s go in; a lossless [`Tree`] of parentheses comes out, for any text whatever.
//!
//! nom reads one item at a time; a loop with a stack of its own puts the items into a flat arena: [`builder`].
//! So nothing recurses, however deep the text nests.
//! Parentheses are repaired on the way, as a careful person would, by the keywords of sections and fields, by what may stand in which list, and by how lines are indented:
//! [`outline`] finds the sections in which they do not match, and [`repair`] the places where some are missing or too many.
//! Where that finds nothing, a list that is still open where a section starts, or at the end, is closed there;
//! a `)` that closes nothing, or that closes the whole definition before another section, is dropped.
//! Each repair is reported once.

mod builder;
mod outline;
mod repair;
mod shape;
mod word;

use crate::source::{SourceId, Span};

pub use builder::parse;

/// What a [`Node`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeKind {
    /// `( … )`
    List,
    /// A list of which a parenthesis was missing: its `(` if it does not start with one, else its `)`.
    OpenList,
    /// One word.
    Atom,
    /// A comment.
    Comment,
    /// Blanks.
    Space,
    /// A parenthesis that was dropped.
    Stray,
}

/// A node of the [`Tree`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// What it is.
    pub kind: NodeKind,
    /// The first byte.
    pub start: u32,
    /// The byte after the last, with the `)` of a list that has one.
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
        let opens = |list: &Node| self.input.as_bytes().get(list.start as usize) == Some(&b'(');
        let close = |open: &mut Vec<Node>, text: &mut String, at: u32| {
            while let Some(list) = open.pop_if(|list| list.next == at) {
                if list.kind == NodeKind::List || !opens(&list) {
                    text.push_str(&self.input[list.end as usize - 1..list.end as usize]);
                }
            }
        };
        for (index, &node) in self.nodes.iter().enumerate() {
            close(&mut open, &mut text, index as u32);
            match node.kind {
                NodeKind::List | NodeKind::OpenList => {
                    if opens(&node) {
                        text.push('(');
                    }
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
