//! A text goes in; the parts that can be folded away come out, and what encloses a place.

use super::{Workspace, path};
use crate::source::{SourceId, Span};
use crate::tree::NodeKind;

/// What a [`Fold`] hides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoldKind {
    /// A list.
    List,
    /// Comment lines one after the other.
    Comment,
    /// What stands between the comments `;;(` and `;;)`.
    Region,
}

/// A part of several lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fold {
    /// From the first byte to the last.
    pub span: Span,
    /// What it is.
    pub kind: FoldKind,
}

/// Everything that takes several lines.
pub fn folds(workspace: &Workspace, id: SourceId) -> Vec<Fold> {
    let tree = workspace.tree(id);
    let text = tree.input();
    let ends: Vec<u32> = text
        .bytes()
        .enumerate()
        .filter(|&(_, byte)| byte == b'\n')
        .map(|(at, _)| at as u32)
        .collect();
    let line = |offset: u32| ends.partition_point(|&end| end < offset);
    let mut folds = Vec::new();
    let mut push = |start: u32, end: u32, kind| {
        if line(start) < line(end) {
            folds.push(Fold { span: Span::new(id, start, end), kind });
        }
    };
    // The first and the last comment of a run, and the line of the last.
    let mut run: Option<(u32, u32, usize)> = None;
    let mut regions = Vec::new();
    for node in tree.nodes() {
        match node.kind {
            NodeKind::List | NodeKind::OpenList => push(node.start, node.end, FoldKind::List),
            NodeKind::Comment => {
                let comment = &text[node.start as usize..node.end as usize];
                if comment.starts_with(";;(") {
                    regions.push(node.start);
                } else if comment.starts_with(";;)")
                    && let Some(start) = regions.pop()
                {
                    push(start, node.end, FoldKind::Region);
                }
                let begin = ends.partition_point(|&end| end < node.start).checked_sub(1);
                let begin = begin.map_or(0, |at| ends[at] + 1);
                let alone = text[begin as usize..node.start as usize].trim().is_empty();
                let here = line(node.start);
                run = match run {
                    Some((first, _, last)) if alone && last + 1 == here => {
                        Some((first, node.end, here))
                    }
                    other => {
                        if let Some((first, last, _)) = other {
                            push(first, last, FoldKind::Comment);
                        }
                        alone.then_some((node.start, node.end, here))
                    }
                };
            }
            NodeKind::Atom | NodeKind::Space | NodeKind::Stray => {}
        }
    }
    if let Some((first, last, _)) = run {
        push(first, last, FoldKind::Comment);
    }
    folds
}

/// What encloses a byte: its word, the contents of its list, the list, and so on outwards.
pub fn selections(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let tree = workspace.tree(id);
    let mut found: Vec<Span> = Vec::new();
    for node in path(&tree, offset).into_iter().rev() {
        let span = tree.span(node);
        if tree.node(node).kind == NodeKind::List && span.end - span.start > 2 {
            found.push(Span { start: span.start + 1, end: span.end - 1, ..span });
        }
        found.push(span);
    }
    found.push(Span::new(id, 0, tree.input().len() as u32));
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::{FoldKind, folds, selections};
    use crate::ide::fixture::workspace;
    use crate::source::SourceId;

    #[test]
    fn lists_runs_of_comments_and_regions() {
        let text = "; one\n; two\n\n; alone\n(define (domain d)\n ;;( types\n (:types a) ; here\n ; and below\n ;;)\n (:action a\n  :effect (p)))\n";
        let (workspace, ..) = workspace(&[text]);
        let found: Vec<(FoldKind, &str)> = folds(&workspace, SourceId(1))
            .into_iter()
            .map(|fold| (fold.kind, workspace.sources().text(fold.span)))
            .collect();
        let kinds = |wanted| found.iter().filter(move |(kind, _)| *kind == wanted);
        assert_eq!(
            kinds(FoldKind::Comment).map(|(_, text)| *text).collect::<Vec<_>>(),
            ["; one\n; two", "; and below\n ;;)"]
        );
        assert_eq!(kinds(FoldKind::Region).count(), 1);
        assert_eq!(kinds(FoldKind::List).count(), 2);
    }

    #[test]
    fn what_encloses_a_word() {
        let (workspace, id, offset) = workspace(&["(define (domain d) (:predicates (p ?$0x)))"]);
        let found: Vec<&str> = selections(&workspace, id, offset)
            .into_iter()
            .map(|span| workspace.sources().text(span))
            .collect();
        assert_eq!(
            found,
            [
                "?x",
                "p ?x",
                "(p ?x)",
                ":predicates (p ?x)",
                "(:predicates (p ?x))",
                "define (domain d) (:predicates (p ?x))",
                "(define (domain d) (:predicates (p ?x)))",
            ]
        );
    }
}
