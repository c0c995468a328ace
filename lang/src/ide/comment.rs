//! A declaration goes in; what the comments above it and at the end of its line say comes out.

use super::{Workspace, path};
use crate::source::Span;
use crate::tree::{NodeKind, Tree};

/// The words of the author about what is declared at `span`; empty if there are none.
///
/// These are the comment lines right above the line of the declaration, if it opens that line, and the comment at its end.
pub(super) fn about(workspace: &Workspace, tree: &Tree<'_>, span: Span) -> String {
    let text = workspace.text(span.source);
    let line = text[..span.start as usize].rfind('\n').map_or(0, |at| at + 1);
    let mut words = Vec::new();
    let opens = text[line..span.start as usize].trim_start().trim_start_matches('(');
    if opens.is_empty() || opens.starts_with(':') && !opens.trim_end().contains(' ') {
        words.extend(above(&text[..line]));
    }
    words.extend(behind(text, tree, span).and_then(content));
    words.join("\n")
}

/// The comment lines that a text ends with.
fn above(text: &str) -> Vec<String> {
    let lines = text.trim_end_matches('\n').rsplit('\n').map(str::trim);
    let comments = lines.take_while(|line| line.starts_with(';') && !text.ends_with("\n\n"));
    let mut words: Vec<String> = comments.filter_map(content).collect();
    words.reverse();
    words
}

/// The comment at the end of the line on which a declaration stands, unless another declaration stands between.
fn behind<'a>(text: &'a str, tree: &Tree<'_>, span: Span) -> Option<&'a str> {
    let end = text[span.end as usize..].find('\n').map_or(text.len(), |at| span.end as usize + at);
    let first = tree.nodes().partition_point(|node| node.start < span.end);
    let comment = tree.nodes()[first..]
        .iter()
        .take_while(|node| (node.start as usize) < end)
        .find(|node| node.kind == NodeKind::Comment)?;
    // Of several lists on the line the last is meant.
    let own = path(tree, span.start).into_iter().rev().nth(1);
    let list = |start: u32| {
        tree.nodes()[first..].iter().any(|node| {
            node.kind == NodeKind::List && node.start >= start && node.end <= comment.start
        })
    };
    let closed = own.map(|own| tree.node(own).end).filter(|&closed| closed <= comment.start);
    if closed.is_some_and(list) {
        return None;
    }
    Some(text[comment.start as usize..end].trim_end())
}

/// What a comment says, if it is for people.
fn content(comment: &str) -> Option<String> {
    let marked = [";@", ";;(", ";;)", ";;!"].iter().any(|mark| comment.starts_with(mark));
    let words = comment.trim_start_matches(';');
    let words = words.strip_prefix(' ').unwrap_or(words).trim_end();
    let said = words.chars().any(char::is_alphanumeric);
    (said && !marked && !words.trim_start().starts_with("caveat:")).then(|| words.to_owned())
}

#[cfg(test)]
mod tests {
    use super::about;
    use crate::ide::fixture::workspace;

    /// What is said about the name at the cursor.
    #[track_caller]
    fn said(text: &str) -> String {
        let (workspace, id, offset) = workspace(&[text]);
        let at = workspace.at(id, offset).expect("a name stands here");
        about(&workspace, &workspace.tree(id), at.span)
    }

    #[test]
    fn lines_above_and_the_end_of_the_line() {
        let text = "(define (domain d)
  ; not about it

  ;;; first
  ; second
  ;----------
  (:action a$0 ; third
    :effect (p)) ; not about it
)";
        assert_eq!(said(text), "first\nsecond\nthird");
    }

    #[test]
    fn of_several_on_a_line_the_last_has_the_comment() {
        let text = "(define (domain d) (:predicates\n  (p) (q) ; about q\n  (r)))";
        assert_eq!(said(&text.replace("(p", "(p$0")), "");
        assert_eq!(said(&text.replace("(q", "(q$0")), "about q");
        assert_eq!(said(&text.replace("(r", "(r$0")), "");
    }

    #[test]
    fn what_speaks_to_programs_is_left_out() {
        let text = "(define (domain d)\n;;( fold\n; caveat: allow(unused-parameter)\n;@ (causal)\n(:action a$0))";
        assert_eq!(said(text), "");
    }

    #[test]
    fn names_in_lists() {
        let text = "(define (domain d) (:types\n  ; things\n  a b - c ; both\n ))";
        assert_eq!(said(&text.replace(" a b", " a$0 b")), "things\nboth");
        assert_eq!(said(&text.replace(" a b", " a b$0")), "both");
    }
}
