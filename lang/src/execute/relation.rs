//! Tuples of objects go in; membership, and the rows that hold a given object at a given position, come out.

use std::hash::{Hash, Hasher};
use std::sync::OnceLock;

use hashbrown::HashTable;
use rustc_hash::{FxHashMap, FxHasher};

use crate::model::ObjectId;

/// The rows in which an object stands at one position.
type Index = FxHashMap<ObjectId, Vec<u32>>;

/// A set of tuples of equal length.
///
/// Rows are numbered without gaps, and removal moves the last row into the gap.
/// Each position is indexed when a query first asks for it, and kept up to date from then on.
#[derive(Debug, Clone)]
pub(crate) struct Relation {
    arity: usize,
    len: usize,
    cells: Vec<ObjectId>,
    rows: HashTable<u32>,
    indexes: Box<[OnceLock<Index>]>,
}

fn hash(tuple: &[ObjectId]) -> u64 {
    let mut hasher = FxHasher::default();
    tuple.hash(&mut hasher);
    hasher.finish()
}

/// The tuple of row `row`; apart from `self`, so that the hash table can be borrowed beside the cells.
fn tuple(cells: &[ObjectId], arity: usize, row: u32) -> &[ObjectId] {
    &cells[row as usize * arity..(row as usize + 1) * arity]
}

impl Relation {
    /// The empty set of tuples of length `arity`.
    pub(crate) fn new(arity: usize) -> Self {
        Self {
            arity,
            len: 0,
            cells: Vec::new(),
            rows: HashTable::new(),
            indexes: (0..arity).map(|_| OnceLock::new()).collect(),
        }
    }

    /// How many tuples there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// The tuple of row `row`, which is below [`Relation::len`].
    pub(crate) fn row(&self, row: u32) -> &[ObjectId] {
        tuple(&self.cells, self.arity, row)
    }

    /// All tuples, in the order of the rows.
    pub(crate) fn tuples(&self) -> impl Iterator<Item = &[ObjectId]> {
        (0..self.len as u32).map(|row| self.row(row))
    }

    fn find(&self, wanted: &[ObjectId]) -> Option<u32> {
        self.rows.find(hash(wanted), |&row| self.row(row) == wanted).copied()
    }

    /// Whether `wanted` is in the set.
    pub(crate) fn contains(&self, wanted: &[ObjectId]) -> bool {
        self.find(wanted).is_some()
    }

    /// Adds `new`; false if it was there.
    pub(crate) fn insert(&mut self, new: &[ObjectId]) -> bool {
        debug_assert_eq!(new.len(), self.arity, "a tuple is as long as its relation is wide");
        if self.contains(new) {
            return false;
        }
        let row = self.len as u32;
        self.len += 1;
        self.cells.extend_from_slice(new);
        let (cells, arity) = (&self.cells, self.arity);
        self.rows.insert_unique(hash(new), row, |&row| hash(tuple(cells, arity, row)));
        for (index, &object) in self.indexes.iter_mut().zip(new) {
            if let Some(index) = index.get_mut() {
                index.entry(object).or_default().push(row);
            }
        }
        true
    }

    /// Removes `old`; false if it was not there.
    pub(crate) fn remove(&mut self, old: &[ObjectId]) -> bool {
        let Some(gap) = self.find(old) else { return false };
        let last = self.len as u32 - 1;
        self.renumber(gap, None);
        if gap != last {
            self.renumber(last, Some(gap));
            let start = last as usize * self.arity;
            self.cells.copy_within(start..start + self.arity, gap as usize * self.arity);
        }
        self.len -= 1;
        self.cells.truncate(self.len * self.arity);
        true
    }

    /// Lets the table and the indexes know row `old` as `new`, or no longer.
    fn renumber(&mut self, old: u32, new: Option<u32>) {
        let entry = self
            .rows
            .find_entry(hash(tuple(&self.cells, self.arity, old)), |&row| row == old)
            .expect("every row is in the table");
        match new {
            Some(new) => *entry.into_mut() = new,
            None => drop(entry.remove()),
        }
        let objects = tuple(&self.cells, self.arity, old);
        for (index, object) in self.indexes.iter_mut().zip(objects) {
            let Some(bucket) = index.get_mut().and_then(|index| index.get_mut(object)) else {
                continue;
            };
            let at = bucket.iter().position(|&row| row == old).expect("an index names every row");
            match new {
                Some(new) => bucket[at] = new,
                None => drop(bucket.swap_remove(at)),
            }
        }
    }

    /// The rows that hold `object` at `position`.
    pub(crate) fn rows_with(&self, position: usize, object: ObjectId) -> &[u32] {
        let index = self.indexes[position].get_or_init(|| {
            let mut index = Index::default();
            for row in 0..self.len as u32 {
                index.entry(self.row(row)[position]).or_default().push(row);
            }
            index
        });
        index.get(&object).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(left: u32, right: u32) -> [ObjectId; 2] {
        [ObjectId(left), ObjectId(right)]
    }

    #[test]
    fn indexes_follow_insertion_and_removal() {
        let mut relation = Relation::new(2);
        for right in 0..4 {
            assert!(relation.insert(&pair(1, right)));
        }
        assert!(!relation.insert(&pair(1, 2)));
        assert_eq!(relation.rows_with(0, ObjectId(1)).len(), 4);
        assert!(relation.remove(&pair(1, 0)));
        assert!(!relation.remove(&pair(1, 0)));
        assert!(relation.insert(&pair(2, 3)));
        let at = |relation: &Relation, position, object| {
            let mut found: Vec<_> = relation
                .rows_with(position, ObjectId(object))
                .iter()
                .map(|&row| relation.row(row).to_vec())
                .collect();
            found.sort();
            found
        };
        assert_eq!(at(&relation, 1, 3), [pair(1, 3), pair(2, 3)]);
        assert_eq!(at(&relation, 0, 1), [pair(1, 1), pair(1, 2), pair(1, 3)]);
        assert_eq!(at(&relation, 1, 0), Vec::<Vec<_>>::new());
    }

    #[test]
    fn a_relation_without_positions_holds_or_not() {
        let mut relation = Relation::new(0);
        assert!(!relation.contains(&[]));
        assert!(relation.insert(&[]));
        assert!(!relation.insert(&[]));
        assert_eq!(relation.tuples().count(), 1);
        assert!(relation.remove(&[]));
        assert_eq!(relation.len(), 0);
    }
}
