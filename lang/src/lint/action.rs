//! The actions of a domain go in as they are written; warnings come out about those that change nothing, and those that are written twice.

use std::fmt::Write;

use hashbrown::HashMap;

use super::text::{Section, Text, Words};
use crate::diagnostic::{Diagnostics, action_without_effect, identical_actions};
use crate::tree::{NodeId, NodeKind};

/// How many actions that are written twice are told one by one: a program that writes actions may write many of them.
const SHOWN: usize = 10;

/// What there is to say about the actions.
pub(super) fn check(text: &Text<'_, '_>, words: &Words, found: &mut Diagnostics) {
    // Methods name actions, and one that does nothing is how HDDL writes a test.
    if words.counts(":method") > 0 {
        return;
    }
    let tree = text.tree;
    let mut known: HashMap<String, NodeId> = HashMap::new();
    let mut twins = 0;
    for section in text.all(":action").chain(text.all(":durative-action")) {
        let Some(name) = tree.children(section.list).nth(1).filter(|&name| !tree.is_list(name))
        else {
            continue;
        };
        // In MA-PDDL conditions name actions, so that one may matter by being done.
        if words.counts(tree.slice(name)) > 1 {
            continue;
        }
        if tests_only(text, section) {
            found.push(action_without_effect::action_without_effect(
                tree.slice(name),
                tree.span(name),
            ));
        }
        let &mut first = known.entry(written(text, section, name)).or_insert(name);
        if first != name && twins < SHOWN {
            twins += 1;
            found.push(identical_actions::identical_actions(
                tree.slice(name),
                tree.span(name),
                tree.slice(first),
                tree.span(first),
            ));
        }
    }
}

/// Whether an action demands something and has no effect. One that does not even demand anything is there to do nothing.
fn tests_only(text: &Text<'_, '_>, section: Section) -> bool {
    text.is(section.keyword, ":action")
        && says_something(text, section, ":precondition")
        && !says_something(text, section, ":effect")
}

/// Whether there is more than `()` and `and` in a field.
fn says_something(text: &Text<'_, '_>, section: Section, field: &str) -> bool {
    let tree = text.tree;
    let mut items = tree.children(section.list);
    let Some(value) = items.find(|&item| text.is(item, field)).and_then(|_| items.next()) else {
        return false;
    };
    (value.0..tree.node(value).next)
        .map(NodeId)
        .any(|id| tree.node(id).kind == NodeKind::Atom && !text.is(id, "and"))
}

/// All of an action but its name, with its variables numbered in the order in which they stand there.
fn written(text: &Text<'_, '_>, section: Section, name: NodeId) -> String {
    let tree = text.tree;
    let mut out = String::new();
    let mut numbers: HashMap<String, usize> = HashMap::new();
    let mut open: Vec<u32> = Vec::new();
    for id in section.list.0..tree.node(section.list).next {
        let node = tree.node(NodeId(id));
        while open.pop_if(|end| *end <= id).is_some() {
            out.push(')');
        }
        match node.kind {
            NodeKind::List | NodeKind::OpenList => {
                open.push(node.next);
                out.push('(');
            }
            NodeKind::Atom if NodeId(id) != name => {
                let word = tree.slice(NodeId(id)).to_ascii_lowercase();
                if word.starts_with('?') {
                    let next = numbers.len();
                    let number = *numbers.entry(word).or_insert(next);
                    write!(out, "?{number}").expect("writing to a string cannot fail");
                } else {
                    out.push_str(&word);
                }
                out.push(' ');
            }
            _ => {}
        }
    }
    out
}
