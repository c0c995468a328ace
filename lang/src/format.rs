//! Text goes in; the same tokens and comments come out, laid out as a careful person would.
//!
//! Line ends that the author set between facts, names and operands stay.
//! What is added is what everybody agrees on: sections and fields on lines of their own, two blanks for each level,
//! one operand in a line where a conjunction does not fit into one.
//! Annotations are laid out like code, with `;@` before each line of theirs.
//! Nothing here recurses on the depth of the text.

mod annotation;

use std::iter::Peekable;
use std::vec::IntoIter;

use crate::annotation::{Run, runs};
use crate::diagnostic::Diagnostics;
use crate::lexer::line_ends;
use crate::source::SourceId;
use crate::tree::{self, Node, NodeId, NodeKind, Tree};

/// Lines are kept shorter than this, in Unicode scalar values, where there is a place to break them.
const WIDTH: usize = 80;

/// How far each level stands to the right of the line on which it opens.
const STEP: usize = 2;

/// Lays `text` out; nothing if its parentheses do not match, since its structure is a guess then.
///
/// The result has the same tokens and comments in the same order, ends with a line end, and formats to itself.
pub fn format(text: &str) -> Option<String> {
    lay_out(text, WIDTH, true)
}

/// Lays `text` out in lines of at most `width`; `annotated` says whether its comments may be annotations.
fn lay_out(text: &str, width: usize, annotated: bool) -> Option<String> {
    let tree = tree::parse(SourceId(0), text, &mut Diagnostics::default());
    let sound = |node: &Node| !matches!(node.kind, NodeKind::OpenList | NodeKind::Stray);
    if !tree.nodes().iter().all(sound) {
        return None;
    }
    let runs = if annotated { runs(&tree) } else { Vec::new() };
    let mut layout = Layout {
        tree: &tree,
        width,
        runs: runs.into_iter().peekable(),
        out: String::with_capacity(text.len() + text.len() / 8),
        column: 0,
        indent: 0,
        open: Vec::new(),
        ends: 0,
        after_comment: false,
    };
    layout.all();
    Some(layout.out)
}

/// What kind of list it is, as far as that says where lines end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// `(define …)`
    Definition,
    /// `(:action NAME :field value …)`
    Fields,
    /// `(and …)`, `(or …)`
    Operands,
    /// `(:predicates …)`, `(:functions …)`
    Declarations,
    /// Anything else.
    Plain,
}

/// A list that is laid out over several lines.
struct Frame {
    next: u32,
    /// Of the line on which it opens.
    indent: usize,
    shape: Shape,
    /// How many words and lists of it have been written.
    written: usize,
    /// The last of them, if it was a word.
    last: Option<NodeId>,
}

impl Frame {
    fn new(next: u32, indent: usize, shape: Shape) -> Self {
        Self { next, indent, shape, written: 0, last: None }
    }
}

/// How something is set off from what stands before it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Gap {
    Line,
    Space,
    /// A line end if the author set one, or where the line would get too long.
    Author,
}

struct Layout<'t, 'a> {
    tree: &'t Tree<'a>,
    width: usize,
    /// The annotations that are still to come.
    runs: Peekable<IntoIter<Run>>,
    out: String,
    /// How much of the current line is written.
    column: usize,
    /// How far the current line is indented.
    indent: usize,
    open: Vec<Frame>,
    /// How many line ends have been read since the last word or comment.
    ends: usize,
    after_comment: bool,
}

impl Layout<'_, '_> {
    fn all(&mut self) {
        let nodes = self.tree.nodes();
        let mut at = 0;
        while at < nodes.len() as u32 {
            self.close(at);
            let (id, node) = (NodeId(at), nodes[at as usize]);
            at += 1;
            match node.kind {
                NodeKind::Space => self.ends += line_ends(self.tree.slice(id)),
                NodeKind::Comment => {
                    if let Some(run) = self.runs.next_if(|run| run.lines[0] == id) {
                        at = run.lines[run.lines.len() - 1].0 + 1;
                        self.run(&run);
                    } else {
                        self.comment(id, self.tree.slice(id).trim_end());
                    }
                }
                NodeKind::Atom => {
                    self.separate(id, self.tree.slice(id).chars().count());
                    self.write(self.tree.slice(id));
                    self.count(Some(id));
                }
                _ => at = self.list(id, node),
            }
        }
        self.close(nodes.len() as u32);
        if !self.out.is_empty() {
            self.out.push('\n');
        }
    }

    /// Writes a list in one piece if it stands in one line and fits, and else its parenthesis; returns the node to go on with.
    fn list(&mut self, id: NodeId, node: Node) -> u32 {
        let flat = self.flat(id, node);
        // What fits on no line of its own may as well begin on this one.
        let width = flat.as_ref().map_or(1, |flat| flat.chars().count());
        self.separate(id, if self.inner() + width <= self.width { width } else { 1 });
        let whole = flat.filter(|flat| self.column + flat.chars().count() <= self.width);
        self.count(None);
        if let Some(flat) = whole {
            self.write(&flat);
            return node.next;
        }
        self.write("(");
        let shape = self.shape(id);
        self.open.push(Frame::new(node.next, self.indent, shape));
        id.0 + 1
    }

    /// The list in one line, if the author wrote what it contains in one line and it is short.
    fn flat(&self, id: NodeId, node: Node) -> Option<String> {
        if self.shape(id) == Shape::Definition {
            return None;
        }
        let nodes = self.tree.nodes();
        let mut flat = String::new();
        let mut open: Vec<(NodeId, Frame)> = Vec::new();
        let mut ends = false;
        for at in id.0..node.next {
            while open.pop_if(|(_, frame)| frame.next == at).is_some() {
                flat.push(')');
                ends = false;
            }
            let (item, one) = (NodeId(at), nodes[at as usize]);
            match one.kind {
                NodeKind::Space => {
                    ends |= line_ends(self.tree.slice(item)) > 0;
                    continue;
                }
                NodeKind::Atom | NodeKind::List => {}
                _ => return None,
            }
            let word = (one.kind == NodeKind::Atom).then_some(item);
            if let Some((list, frame)) = open.last_mut() {
                if frame.written > 0 {
                    flat.push(' ');
                    if ends {
                        frame.shape = self.shape(*list);
                        // A line end that would not be kept must not count, or the result would be laid out in another way.
                        if self.gap(frame, item) != Gap::Space {
                            return None;
                        }
                    }
                }
                (frame.written, frame.last) = (frame.written + 1, word);
            }
            ends = false;
            if word.is_some() {
                flat.push_str(self.tree.slice(item));
            } else {
                flat.push('(');
                open.push((item, Frame::new(one.next, 0, Shape::Plain)));
            }
            if flat.len() > 4 * WIDTH {
                return None;
            }
        }
        flat.push_str(&")".repeat(open.len()));
        Some(flat)
    }

    fn shape(&self, id: NodeId) -> Shape {
        let Some(first) = self.tree.children(id).next().filter(|&first| !self.tree.is_list(first))
        else {
            return Shape::Plain;
        };
        match self.tree.slice(first).to_ascii_lowercase().as_str() {
            "define" => Shape::Definition,
            ":action"
            | ":durative-action"
            | ":process"
            | ":event"
            | ":method"
            | ":task"
            | ":htn"
            | ":concurrency-constraint"
            | ":causal" => Shape::Fields,
            "and" | "or" => Shape::Operands,
            ":predicates" | ":functions" | ":measured" | ":observed" | ":exactly-one"
            | ":at-most-one" => Shape::Declarations,
            _ => Shape::Plain,
        }
    }

    /// Ends all lists that end before the node `at`.
    fn close(&mut self, at: u32) {
        while let Some(frame) = self.open.pop_if(|frame| frame.next == at) {
            if self.after_comment {
                self.line(frame.indent, false);
            }
            self.write(")");
            self.ends = 0;
        }
    }

    /// Writes a run of annotations.
    fn run(&mut self, run: &Run) {
        let width = self.width.saturating_sub(self.inner());
        let lines = annotation::lines(self.tree, run, width);
        let mut lines = lines.iter();
        self.comment(run.lines[0], lines.next().map_or("", String::as_str));
        for line in lines {
            self.line(self.inner(), false);
            self.write(line);
        }
        self.after_comment = true;
    }

    /// Writes the comment `id`, of which `text` is the text.
    fn comment(&mut self, id: NodeId, text: &str) {
        let own_line = self.ends > 0 || self.after_comment;
        if own_line && !self.out.is_empty() {
            self.line(self.inner(), self.ends > 1);
        } else if !self.out.is_empty() {
            // Comments that stand below one another stay so.
            let before = id.0.checked_sub(1).map(|before| self.tree.nodes()[before as usize]);
            let blanks = before.filter(|node| node.kind == NodeKind::Space);
            let blanks = blanks.map_or(1, |node| (node.end - node.start) as usize);
            self.write(&" ".repeat(blanks.min(WIDTH)));
        }
        self.write(text);
        (self.after_comment, self.ends) = (true, 0);
    }

    /// Writes what stands between the next item, of which `width` is to go on the line, and the one before it.
    fn separate(&mut self, id: NodeId, width: usize) {
        let inner = self.inner();
        let blank = self.ends > 1;
        let (first, gap) = match self.open.last() {
            None => (self.out.is_empty(), Gap::Line),
            Some(frame) => (frame.written == 0, self.gap(frame, id)),
        };
        let breaks = self.after_comment
            || match gap {
                Gap::Line => true,
                Gap::Space => false,
                Gap::Author => self.ends > 0 || self.column + 1 + width > self.width,
            };
        if breaks && (!first || self.after_comment) {
            self.line(inner, blank);
        } else if !first {
            self.write(" ");
        }
        self.ends = 0;
    }

    fn gap(&self, frame: &Frame, id: NodeId) -> Gap {
        let word = (!self.tree.is_list(id)).then(|| self.tree.slice(id));
        let last = frame.last.map(|last| self.tree.slice(last));
        if word == Some("-") || last == Some("-") {
            return Gap::Space;
        }
        match frame.shape {
            Shape::Definition if frame.written == 1 => Gap::Space,
            Shape::Definition => Gap::Line,
            Shape::Fields if word.is_some_and(|word| word.starts_with(':')) => Gap::Line,
            Shape::Fields
                if frame.written == 1 || last.is_some_and(|last| last.starts_with(':')) =>
            {
                Gap::Space
            }
            Shape::Operands | Shape::Declarations if word.is_none() => Gap::Line,
            _ => Gap::Author,
        }
    }

    /// How far the items of the innermost list are indented.
    fn inner(&self) -> usize {
        self.open.last().map_or(0, |frame| frame.indent + STEP)
    }

    fn count(&mut self, word: Option<NodeId>) {
        if let Some(frame) = self.open.last_mut() {
            frame.written += 1;
            frame.last = word;
        }
    }

    fn write(&mut self, text: &str) {
        self.out.push_str(text);
        self.column += text.chars().count();
        self.after_comment = false;
    }

    fn line(&mut self, indent: usize, blank: bool) {
        self.out.push_str(if blank { "\n\n" } else { "\n" });
        self.out.extend(std::iter::repeat_n(' ', indent));
        (self.column, self.indent, self.after_comment) = (indent, indent, false);
    }
}
