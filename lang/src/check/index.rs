//! A table from names to ids that compares without case and allocates nothing for a look-up.

use hashbrown::HashTable;
use hashbrown::hash_table::Entry;

use crate::near;

/// Names of one kind with their ids.
#[derive(Default)]
pub(super) struct Index<'a> {
    table: HashTable<(&'a str, u32)>,
}

impl<'a> Index<'a> {
    /// The id of `name`, whatever its case.
    pub(super) fn find(&self, name: &str) -> Option<u32> {
        self.table
            .find(hash(name), |(other, _)| other.eq_ignore_ascii_case(name))
            .map(|&(_, id)| id)
    }

    /// Gives `name` the id, and returns the one that it had.
    pub(super) fn insert(&mut self, name: &'a str, id: u32) -> Option<u32> {
        match self.table.entry(
            hash(name),
            |(other, _)| other.eq_ignore_ascii_case(name),
            |(other, _)| hash(other),
        ) {
            Entry::Occupied(mut entry) => Some(std::mem::replace(&mut entry.get_mut().1, id)),
            Entry::Vacant(entry) => {
                entry.insert((name, id));
                None
            }
        }
    }

    /// Takes `name` out.
    pub(super) fn remove(&mut self, name: &str) {
        if let Ok(entry) =
            self.table.find_entry(hash(name), |(other, _)| other.eq_ignore_ascii_case(name))
        {
            entry.remove();
        }
    }

    /// The name that is nearest to a misspelt one; of several the one with the least id.
    pub(super) fn nearest(&self, name: &str) -> Option<&'a str> {
        let mut candidates: Vec<(&'a str, u32)> = self.table.iter().copied().collect();
        candidates.sort_unstable_by_key(|&(_, id)| id);
        near::nearest(name, candidates.into_iter().map(|(candidate, _)| candidate))
    }

    /// How many names there are.
    pub(super) fn len(&self) -> usize {
        self.table.len()
    }
}

/// The Fowler–Noll–Vo hash of the name in lower case, with a final mix for the upper bits that the table looks at.
fn hash(name: &str) -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    for byte in name.bytes() {
        hash = (hash ^ u64::from(byte.to_ascii_lowercase())).wrapping_mul(0x0100_0000_01b3);
    }
    hash ^ hash.rotate_left(32).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
