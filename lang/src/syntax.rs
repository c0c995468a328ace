//! A [`Tree`] goes in; an [`Domain`](crate::ast::Domain) or an [`Problem`](crate::ast::Problem) comes out, as far as the text can be understood.

mod list;
mod formula;
mod action;
mod agents;
mod network;
mod domain;
mod problem;

use crate::ast::{Feature, Name, Place, Unread};
use crate::diagnostic::{Diagnostics, not_a_pddl_file, unexpected_item};
use crate::lexer;
use crate::source::Span;
use crate::tree::NodeKind::{Atom, Comment, Space};
use crate::tree::{NodeId, Tree};

pub use domain::domain;
pub use problem::problem;

/// Reads one tree and says what is wrong with it.
struct Reader<'a, 't> {
    tree: &'t Tree<'a>,
    diagnostics: &'t mut Diagnostics,
    /// Whether the last thing in the definition was no section, so that what follows it is not reported again.
    lost: bool,
}

impl<'a> Reader<'a, '_> {
    /// The node as a name.
    fn name(&self, id: NodeId) -> Name<'a> {
        Name { text: self.tree.slice(id), span: self.tree.span(id) }
    }

    fn place(&self, id: NodeId) -> Place {
        Place(self.tree.span(id))
    }

    /// The first word of a list.
    fn head(&self, id: NodeId) -> Option<Name<'a>> {
        if !self.tree.is_list(id) {
            return None;
        }
        let first = self.tree.children(id).next()?;
        (!self.tree.is_list(first)).then(|| self.name(first))
    }

    /// Keeps a list as it is.
    fn unread(&self, feature: Feature, keyword: Name<'a>, id: NodeId) -> Unread<'a> {
        Unread { feature, keyword, node: self.name(id) }
    }

    /// Says that something else is expected where the node stands.
    fn unexpected(&mut self, expected: &str, id: NodeId) {
        if !self.tree.is_list(id) && !lexer::is_plain_text(self.tree.slice(id)) {
            // Its characters have been reported already.
            return;
        }
        let span = self.opening(id);
        self.diagnostics.push(unexpected_item::unexpected_item(expected, span));
    }

    /// Says that something else is expected where a word stands, once for all words that stand beside it.
    fn stray(&mut self, expected: &str, id: NodeId) {
        let tree = self.tree;
        let kind = |at: u32| tree.node(NodeId(at)).kind;
        let word = |at: u32| kind(at) == Atom && !tree.slice(NodeId(at)).starts_with(':');
        // Whether the words at `at` and after it stand on different lines.
        let parted = |at: u32| kind(at) == Space && tree.slice(NodeId(at)).contains('\n');
        if id.0 >= 2 && kind(id.0 - 1) == Space && !parted(id.0 - 1) && word(id.0 - 2) {
            let mut before = id.0 - 2;
            while before > 0 && matches!(kind(before - 1), Space | Comment) {
                before -= 1;
            }
            if before > 0 && !tree.is_list(NodeId(before - 1)) {
                return;
            }
        }
        let mut last = id.0;
        let end = tree.nodes().len() as u32;
        while last + 2 < end && kind(last + 1) == Space && !parted(last + 1) {
            if !word(last + 2) {
                break;
            }
            last += 2;
        }
        let span = tree.span(id).to(tree.span(NodeId(last)));
        if last == id.0 && !lexer::is_plain_text(tree.slice(id)) {
            // Its characters have been reported already.
            return;
        }
        let continues = id.0 >= 2
            && parted(id.0 - 1)
            && kind(id.0 - 2) == Comment
            && (last + 1 == end || parted(last + 1));
        let diagnostic = unexpected_item::unexpected_item(expected, span);
        self.diagnostics.push(if continues { diagnostic.in_comment() } else { diagnostic });
    }

    /// The node, or only its parenthesis and first word if it is a long list.
    fn opening(&self, id: NodeId) -> Span {
        let span = self.tree.span(id);
        if !self.tree.is_list(id) || !self.tree.slice(id).contains('\n') {
            return span;
        }
        let first = self.tree.children(id).next().filter(|&first| !self.tree.is_list(first));
        let end = first.map_or(span.start + 1, |first| self.tree.node(first).end);
        Span { end, ..span }
    }

    /// The list `(define (WHOLE NAME) …)`: the name and the sections after it.
    fn definition(&mut self, whole: &str) -> (Name<'a>, Vec<NodeId>) {
        let empty = Span::new(self.tree.source, 0, 0);
        let nothing = (Name { text: "", span: empty }, Vec::new());
        let example = format!("a {whole} starts with `(define ({whole} NAME)`");
        let mut roots = self.tree.roots();
        let Some(first) = roots.next() else {
            let diagnostic = not_a_pddl_file::not_a_pddl_file(
                empty,
                format!("this file contains no {whole}"),
                "nothing here",
                example,
            );
            self.diagnostics.push(diagnostic);
            return nothing;
        };
        if let Some(section) = self.head(first).filter(|head| head.text.starts_with(':')) {
            self.diagnostics.push(not_a_pddl_file::not_a_pddl_file(
                section.span,
                format!("there is no `(define ({whole} NAME) …)` around this"),
                "a section on its own",
                example,
            ));
            let sections = self.tree.roots().filter(|&root| self.tree.is_list(root)).collect();
            return (nothing.0, sections);
        }
        if !self.head(first).is_some_and(|head| head.is("define")) {
            let span = self.opening(first);
            let message = "this is not a PDDL file";
            let diagnostic =
                not_a_pddl_file::not_a_pddl_file(span, message, "expected `(define`", example);
            let titled = |child| self.head(child).is_some_and(|head| head.is(whole));
            let nearly = self.tree.children(first).take(2).any(titled);
            self.diagnostics.push(diagnostic);
            if !nearly {
                return nothing;
            }
        }
        if let Some(next) = roots.next() {
            let span = self.opening(next);
            let diagnostic = not_a_pddl_file::not_a_pddl_file(
                span,
                format!("something follows after the end of the {whole}"),
                "not part of it",
                format!(
                    "put each definition into a file of its own, or check the parentheses before this; what follows the {whole} is not read"
                ),
            );
            self.diagnostics.push(diagnostic);
        }
        let words =
            self.tree.children(first).take_while(|&child| !self.tree.is_list(child)).count();
        let mut children = self.tree.children(first).skip(words).peekable();
        let title = children.next_if(|&child| {
            self.tree.is_list(child)
                && !self.head(child).is_some_and(|head| head.text.starts_with(':'))
        });
        let Some(title) = title else {
            let keyword =
                self.tree.children(first).next().map_or(empty, |define| self.tree.span(define));
            self.diagnostics.push(unexpected_item::missing_item(
                &format!("`({whole} NAME)` after `define`"),
                keyword,
            ));
            return (nothing.0, children.collect());
        };
        match self.title(whole, title) {
            Some(name) => (name, children.collect()),
            None => nothing,
        }
    }

    /// The name in `(WHOLE NAME)`; nothing if the file is something else.
    fn title(&mut self, whole: &str, title: NodeId) -> Option<Name<'a>> {
        let span = self.tree.span(title);
        match self.head(title) {
            Some(head) if head.is(whole) => {}
            Some(head) if head.is("domain") || head.is("problem") => {
                let found = head.text.to_ascii_lowercase();
                let diagnostic = not_a_pddl_file::not_a_pddl_file(
                    head.span,
                    format!("this file is a {found}, where a {whole} is expected"),
                    format!("a {found}"),
                    "give the domain first and the problem second",
                );
                self.diagnostics.push(diagnostic);
                return None;
            }
            _ => self
                .diagnostics
                .push(unexpected_item::unexpected_item(&format!("`({whole} NAME)`"), span)),
        }
        let name = self.tree.children(title).nth(1).filter(|&child| !self.tree.is_list(child));
        if let Some(name) = name {
            return Some(self.name(name));
        }
        self.diagnostics
            .push(unexpected_item::missing_item(&format!("the name of the {whole}"), span));
        Some(Name { text: "", span })
    }
}

/// The word in lower case, if it is short enough to be a keyword.
fn lower<'b>(word: &str, buffer: &'b mut [u8; 24]) -> &'b str {
    let Some(target) = buffer.get_mut(..word.len()) else { return "" };
    target.copy_from_slice(word.as_bytes());
    target.make_ascii_lowercase();
    str::from_utf8(target).expect("lowering ASCII letters keeps UTF-8 whole")
}

/// Whether a word is a number and no name: `15` is one, `15-puzzle` is not.
pub(crate) fn is_number(word: &str) -> bool {
    fn unsigned(word: &str) -> &str {
        word.strip_prefix(['-', '+']).unwrap_or(word)
    }
    let (mantissa, exponent) = match unsigned(word).split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned(word), None),
    };
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let valued = digits(whole) && digits(fraction) && !(whole.is_empty() && fraction.is_empty());
    valued && exponent.is_none_or(|exponent| !exponent.is_empty() && digits(unsigned(exponent)))
}
