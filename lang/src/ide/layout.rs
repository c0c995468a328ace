//! A text goes in; the edits come out that lay it out as the formatter does.

use super::Workspace;
use crate::lexer::{self, Token, TokenKind};
use crate::source::{SourceId, Span};

/// A range of a text and what to put there.
pub type Edit = (Span, String);

/// More edits than this are sent as one.
const MANY: usize = 20_000;

/// Lays a text out; nothing if its parentheses do not match. Only what lies between words changes, so a cursor stays where it is.
pub fn format(workspace: &Workspace, id: SourceId) -> Option<Vec<Edit>> {
    let text = workspace.text(id);
    let formatted = crate::format::format(text)?;
    if formatted == text {
        return Some(Vec::new());
    }
    let gaps = gaps(id, text, &formatted);
    Some(
        gaps.filter(|gaps| gaps.len() <= MANY)
            .unwrap_or_else(|| difference(id, text, &formatted).into_iter().collect()),
    )
}

/// The blanks that differ between two texts of the same tokens.
fn gaps(id: SourceId, old: &str, new: &str) -> Option<Vec<Edit>> {
    let (before, after) = (words(old), words(new));
    if before.len() != after.len() {
        return None;
    }
    let mut edits = Vec::new();
    let (mut from, mut to) = (0, 0);
    let end = |text: &str| Token {
        kind: TokenKind::Space,
        start: text.len() as u32,
        end: text.len() as u32,
    };
    let pairs = before.into_iter().zip(after).chain([(end(old), end(new))]);
    for (was, is) in pairs {
        let (gap, wanted) = (&old[from..was.start as usize], &new[to..is.start as usize]);
        if gap != wanted {
            edits.push((Span::new(id, from as u32, was.start), wanted.to_owned()));
        }
        // A comment may lose the blanks at its end.
        let (word, kept) = (slice(old, was), slice(new, is));
        if !word.starts_with(kept) {
            return None;
        }
        if word.len() > kept.len() {
            edits.push((Span::new(id, was.start + kept.len() as u32, was.end), String::new()));
        }
        (from, to) = (was.end as usize, is.end as usize);
    }
    edits.sort_by_key(|(span, _)| (span.start, span.end));
    Some(edits)
}

fn words(text: &str) -> Vec<Token> {
    let mut tokens = lexer::lex(text);
    tokens.retain(|token| token.kind != TokenKind::Space);
    tokens
}

fn slice(text: &str, token: Token) -> &str {
    &text[token.start as usize..token.end as usize]
}

/// The one edit that makes `new` of `old`: what they have in common at both ends stays.
pub fn difference(id: SourceId, old: &str, new: &str) -> Option<Edit> {
    if old == new {
        return None;
    }
    let same = |mut pairs: std::iter::Zip<std::str::Bytes<'_>, std::str::Bytes<'_>>| {
        pairs.by_ref().take_while(|(a, b)| a == b).count()
    };
    let mut start = same(old.bytes().zip(new.bytes()));
    while !old.is_char_boundary(start) || !new.is_char_boundary(start) {
        start -= 1;
    }
    let (rest, wanted) = (&old[start..], &new[start..]);
    let mut shared =
        rest.bytes().rev().zip(wanted.bytes().rev()).take_while(|(a, b)| a == b).count();
    while !rest.is_char_boundary(rest.len() - shared)
        || !wanted.is_char_boundary(wanted.len() - shared)
    {
        shared -= 1;
    }
    let end = old.len() - shared;
    Some((Span::new(id, start as u32, end as u32), wanted[..wanted.len() - shared].to_owned()))
}

#[cfg(test)]
mod tests {
    use super::{difference, format};
    use crate::ide::fixture::{edited, workspace};
    use crate::source::SourceId;

    #[test]
    fn only_blanks_change() {
        let text = "(define (domain d)   ; one  \r\n(:predicates (p)\n\n\n(q) ))";
        let (workspace, ..) = workspace(&[text]);
        let edits = format(&workspace, SourceId(1)).expect("it can be laid out");
        assert!(edits.len() > 3);
        assert!(edits.iter().all(|(span, new)| {
            workspace.sources().text(*span).trim().is_empty() && new.trim().is_empty()
        }));
        assert_eq!(Some(&edited(&workspace, &edits)[0]), crate::format::format(text).as_ref());
    }

    #[test]
    fn nothing_to_do_and_nothing_that_can_be_done() {
        let (workspace, ..) = workspace(&["(define (domain d))\n", "(define (domain d)"]);
        assert_eq!(format(&workspace, SourceId(1)), Some(Vec::new()));
        assert_eq!(format(&workspace, SourceId(2)), None);
    }

    #[test]
    fn what_differs_is_cut_between_characters() {
        let id = SourceId(0);
        let (span, new) = difference(id, "aéz", "aèz").expect("they differ");
        assert_eq!((span.start, span.end, new.as_str()), (1, 3, "è"));
        assert_eq!(difference(id, "same", "same"), None);
        let (span, new) = difference(id, "aa", "aaa").expect("they differ");
        assert_eq!((span.start, span.end, new.as_str()), (2, 2, "a"));
    }
}
