//! The typed lists of a text go in; warnings come out about names at the end that were left without a type.

use super::text::Text;
use crate::diagnostic::{Diagnostics, untyped_tail};
use crate::lexer;
use crate::tree::{NodeId, NodeKind};

/// Warns of lists in which the last names have no type although others do.
///
/// In `:types` it is usual to end so, since the last types are the outermost.
pub(super) fn check(text: &Text<'_, '_>, found: &mut Diagnostics) {
    let tree = text.tree;
    for &section in &text.sections {
        if [":objects", ":constants"].iter().any(|one| text.is(section.keyword, one)) {
            tail(text, tree.children(section.list).skip(1), found);
        }
        if [":init", ":types", ":requirements"].iter().any(|one| text.is(section.keyword, one)) {
            continue;
        }
        let inside = section.list.0 + 1..tree.node(section.list).next;
        for list in inside.map(NodeId).filter(|&id| tree.node(id).kind == NodeKind::List) {
            // A list of parameters starts with a variable; a declaration or a rule with a name and variables after it.
            let mut items = tree.children(list);
            let first = items.next().filter(|&first| !tree.is_list(first));
            let Some(first) = first else { continue };
            if tree.slice(first).starts_with('?') {
                tail(text, tree.children(list), found);
            } else if items.next().is_some_and(|second| tree.slice(second).starts_with('?')) {
                tail(text, tree.children(list).skip(1), found);
            }
        }
    }
}

/// Warns if names stand after the last type.
fn tail(text: &Text<'_, '_>, items: impl Iterator<Item = NodeId>, found: &mut Diagnostics) {
    let tree = text.tree;
    let mut items = items;
    let (mut last, mut names) = (None, Vec::new());
    while let Some(item) = items.next() {
        let word = tree.slice(item);
        if tree.is_list(item) {
            names.clear();
        } else if lexer::is_dash(word) {
            last = items.next();
            names.clear();
        } else if word.starts_with('-') {
            // `-truck` stands for `- truck`.
            last = Some(item);
            names.clear();
        } else {
            names.push(item);
        }
    }
    if let (Some(of), [first, .., end] | [first @ end]) = (last, names.as_slice()) {
        let span = tree.span(*first).to(tree.span(*end));
        found.push(untyped_tail::untyped_tail(
            &tree.input()[span.start as usize..span.end as usize],
            span,
            tree.slice(of),
            tree.span(of),
        ));
    }
}
