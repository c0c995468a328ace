//! The text of a problem goes in; warnings come out about initial facts that stand there twice, with their opposite, or although rules derive them.

use std::hash::{Hash, Hasher};

use hashbrown::hash_table::Entry;
use hashbrown::{HashSet, HashTable};
use rustc_hash::FxHasher;

use super::text::Text;
use crate::diagnostic::{Diagnostics, contradictory_fact, derived_fact, repeated_fact};
use crate::model::Domain;
use crate::tree::{NodeId, NodeKind, Tree};

/// How many repeated facts are told one by one, so that a text full of them is not answered with another.
const SHOWN: usize = 10;

/// An entry that has been read.
struct Seen {
    hash: u64,
    atom: NodeId,
    positive: bool,
}

/// What there is to say about the initial state.
pub(super) fn check(text: &Text<'_, '_>, domain: &Domain, found: &mut Diagnostics) {
    let tree = text.tree;
    let derived: HashSet<String> = domain
        .predicates
        .iter()
        .filter(|predicate| predicate.derived)
        .map(|predicate| predicate.name.text.to_ascii_lowercase())
        .collect();
    let mut told: HashSet<String> = HashSet::new();
    let mut seen: HashTable<Seen> = HashTable::new();
    let mut repeated = 0;
    for entry in text.all(":init").flat_map(|section| tree.children(section.list).skip(1)) {
        let mut parts = tree.children(entry);
        let (atom, positive) = match (parts.next(), parts.next()) {
            (Some(word), Some(atom)) if text.is(word, "not") && tree.is_list(atom) => (atom, false),
            _ => (entry, true),
        };
        if !derived.is_empty()
            && let Some(head) = tree.children(atom).next()
            && let name = tree.slice(head).to_ascii_lowercase()
            && derived.contains(&name)
            && told.insert(name)
        {
            found.push(derived_fact::derived_fact(tree.slice(head), tree.span(atom)));
        }
        let hash = hash(tree, atom);
        let same = |seen: &Seen| seen.hash == hash && equal(tree, atom, seen.atom);
        match seen.entry(hash, same, |seen| seen.hash) {
            Entry::Vacant(vacant) => {
                vacant.insert(Seen { hash, atom, positive });
            }
            Entry::Occupied(occupied) => {
                let first = occupied.get().atom;
                if occupied.get().positive != positive {
                    found.push(contradictory_fact::contradictory_fact(
                        tree.span(entry),
                        tree.span(first),
                    ));
                } else if repeated < SHOWN {
                    repeated += 1;
                    found.push(repeated_fact::repeated_fact(tree.span(entry), tree.span(first)));
                }
            }
        }
    }
}

/// The parentheses and words of a node, in order.
fn tokens<'t>(tree: &'t Tree<'_>, node: NodeId) -> impl Iterator<Item = (bool, &'t str)> {
    let end = tree.node(node).next;
    (node.0..end).map(NodeId).filter_map(move |id| match tree.node(id).kind {
        NodeKind::List | NodeKind::OpenList => Some((true, "")),
        NodeKind::Atom => Some((false, tree.slice(id))),
        _ => None,
    })
}

/// Whether two entries are written alike, but for blanks, comments and case.
///
/// Where lists end is not looked at: no two well-formed entries differ in that alone.
fn equal(tree: &Tree<'_>, left: NodeId, right: NodeId) -> bool {
    let (mut left, mut right) = (tokens(tree, left), tokens(tree, right));
    loop {
        match (left.next(), right.next()) {
            (None, None) => return true,
            (Some((list, word)), Some((other, with)))
                if list == other && word.eq_ignore_ascii_case(with) => {}
            _ => return false,
        }
    }
}

fn hash(tree: &Tree<'_>, node: NodeId) -> u64 {
    let mut hasher = FxHasher::default();
    for (list, word) in tokens(tree, node) {
        list.hash(&mut hasher);
        // Eight letters at a time.
        for letters in word.as_bytes().chunks(8) {
            let mut eight = [0; 8];
            eight[..letters.len()].copy_from_slice(letters);
            eight.make_ascii_lowercase();
            eight.hash(&mut hasher);
        }
    }
    hasher.finish()
}
