//! Tuples of objects in, indexed look-ups out: an append-only relation over interned objects.
//!
//! Rows lie flat in one array and are numbered in the order of insertion. A row is *known* from its insertion on, and *visible* to joins
//! once it is published, in the same order. Indexes are built when a join first asks for them, and see published rows only.

use hashbrown::{HashMap, HashTable};
use std::hash::{BuildHasherDefault, Hasher};

/// No row.
pub const NONE: u32 = u32::MAX;

/// A relation with a fixed number of columns.
#[derive(Debug, Default)]
pub struct Relation {
    arity: usize,
    rows: Vec<u32>,
    len: u32,
    visible: u32,
    /// What a row costs that is not among the first `free` ones.
    price: u32,
    free: u32,
    set: HashTable<u32>,
    indexes: Vec<Index>,
    /// Distinct values of each column, and the number of visible rows when they were counted.
    distinct: (Vec<u32>, u32),
}

/// The visible rows by their values in some columns; rows with equal values are chained, the newest first.
#[derive(Debug)]
struct Index {
    columns: Vec<u32>,
    heads: Heads,
    next: Vec<u32>,
    /// The first row of each chain among those that are free, where others are not.
    free: Option<Heads>,
}

/// The first row of each chain.
#[derive(Debug, Clone)]
enum Heads {
    /// Of an index over one column, by object.
    Dense(Vec<u32>),
    /// Of an index over several columns, by the hash of the values. Rows of equal hash share a chain.
    Hashed(HashMap<u64, u32, BuildHasherDefault<Identity>>),
}

/// Passes a value on that is a hash already.
#[derive(Debug, Default)]
pub struct Identity(u64);

impl Hasher for Identity {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, _: &[u8]) {
        unreachable!("only u64 keys are hashed");
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = value;
    }
}

/// Mixes values into a hash whose high and low bits are both good.
#[inline]
fn hash(values: impl IntoIterator<Item = u32>) -> u64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for value in values {
        let product = u128::from(state ^ u64::from(value)) * 0xd6e8_feb8_6659_fd93;
        state = (product as u64) ^ ((product >> 64) as u64) ^ 0x9e37_79b9_7f4a_7c15;
    }
    state
}

impl Relation {
    /// An empty relation with `arity` columns.
    pub fn new(arity: usize) -> Self {
        Self { arity, ..Self::default() }
    }

    /// Sets what every row costs that is inserted from now on; those before it are free, as all are unless this is said.
    pub fn charge(&mut self, price: u32) {
        (self.price, self.free) = (price, self.len);
    }

    /// What a row costs.
    #[inline]
    pub fn price(&self, row: u32) -> u32 {
        if row < self.free { 0 } else { self.price }
    }

    /// What every row costs that is not free; 0 where all are.
    #[inline]
    pub fn charged(&self) -> u32 {
        self.price
    }

    /// How many visible rows are free: the first ones.
    #[inline]
    pub fn free(&self) -> u32 {
        if self.price == 0 { self.visible } else { self.free.min(self.visible) }
    }

    /// How many rows are known.
    pub fn len(&self) -> u32 {
        self.len
    }

    /// How many rows joins see: those with numbers below this.
    pub fn visible(&self) -> u32 {
        self.visible
    }

    /// The values of a row.
    #[inline]
    pub fn row(&self, row: u32) -> &[u32] {
        let start = row as usize * self.arity;
        &self.rows[start..start + self.arity]
    }

    /// The number of the row with these values, if it is known.
    #[inline]
    pub fn find(&self, values: &[u32]) -> Option<u32> {
        self.set.find(hash(values.iter().copied()), |&row| self.row(row) == values).copied()
    }

    /// Makes a row known; says its number and whether it is new.
    pub fn insert(&mut self, values: &[u32]) -> (u32, bool) {
        let hash_of = hash(values.iter().copied());
        let (arity, rows) = (self.arity, &self.rows);
        let row_at = |row: u32| &rows[row as usize * arity..(row as usize + 1) * arity];
        if let Some(&row) = self.set.find(hash_of, |&row| row_at(row) == values) {
            return (row, false);
        }
        self.set.insert_unique(hash_of, self.len, |&row| hash(row_at(row).iter().copied()));
        self.rows.extend_from_slice(values);
        self.len += 1;
        (self.len - 1, true)
    }

    /// Shows the next known row to joins.
    pub fn publish(&mut self) {
        let row = self.visible;
        let values = &self.rows[row as usize * self.arity..(row as usize + 1) * self.arity];
        for index in &mut self.indexes {
            if self.price > 0 && row == self.free {
                index.free = Some(index.heads.clone());
            }
            index.insert(row, values);
        }
        self.visible += 1;
    }

    /// Shows all known rows to joins.
    pub fn publish_all(&mut self) {
        while self.visible < self.len {
            self.publish();
        }
    }

    /// The number of the index over `columns`, which is built if there is none; `objects` bounds the values.
    pub fn index(&mut self, columns: &[u32], objects: u32) -> usize {
        if let Some(found) = self.indexes.iter().position(|index| index.columns == columns) {
            return found;
        }
        let heads = if columns.len() == 1 {
            Heads::Dense(vec![NONE; objects as usize])
        } else {
            Heads::Hashed(HashMap::default())
        };
        let mut index = Index {
            columns: columns.to_vec(),
            heads,
            next: Vec::with_capacity(self.visible as usize),
            free: None,
        };
        for row in 0..self.visible {
            if self.price > 0 && row == self.free {
                index.free = Some(index.heads.clone());
            }
            index.insert(row, self.row(row));
        }
        self.indexes.push(index);
        self.indexes.len() - 1
    }

    /// The first row of the chain for `values`, or [`NONE`]. A chain may hold rows with other values.
    #[inline]
    pub fn first(&self, index: usize, values: &[u32]) -> u32 {
        self.indexes[index].heads.of(values)
    }

    /// The first row of the chain for `values` that is free, or [`NONE`]; all rows after it are free, too.
    #[inline]
    pub fn first_free(&self, index: usize, values: &[u32]) -> u32 {
        let index = &self.indexes[index];
        index.free.as_ref().unwrap_or(&index.heads).of(values)
    }

    /// The row after `row` in its chain, or [`NONE`].
    #[inline]
    pub fn next(&self, index: usize, row: u32) -> u32 {
        self.indexes[index].next[row as usize]
    }

    /// How many distinct values each column has, counted anew when the relation has doubled since.
    pub fn distinct(&mut self, objects: u32) -> &[u32] {
        let (counts, counted) = &self.distinct;
        if counts.is_empty() || self.visible > counted * 2 {
            let mut counts = vec![0; self.arity];
            let mut seen = vec![u32::MAX; objects as usize];
            for (column, count) in counts.iter_mut().enumerate() {
                for row in 0..self.visible as usize {
                    let value = self.rows[row * self.arity + column] as usize;
                    if seen[value] != column as u32 {
                        seen[value] = column as u32;
                        *count += 1;
                    }
                }
            }
            self.distinct = (counts, self.visible);
        }
        &self.distinct.0
    }
}

impl Heads {
    #[inline]
    fn of(&self, values: &[u32]) -> u32 {
        match self {
            Heads::Dense(heads) => heads[values[0] as usize],
            Heads::Hashed(heads) => {
                heads.get(&hash(values.iter().copied())).copied().unwrap_or(NONE)
            }
        }
    }
}

impl Index {
    fn insert(&mut self, row: u32, values: &[u32]) {
        let head = match &mut self.heads {
            Heads::Dense(heads) => &mut heads[values[self.columns[0] as usize] as usize],
            Heads::Hashed(heads) => heads
                .entry(hash(self.columns.iter().map(|&column| values[column as usize])))
                .or_insert(NONE),
        };
        self.next.push(*head);
        *head = row;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_once_known_and_chained_once_published() {
        let mut relation = Relation::new(2);
        assert_eq!(relation.insert(&[1, 2]), (0, true));
        assert_eq!(relation.insert(&[1, 3]), (1, true));
        assert_eq!(relation.insert(&[1, 2]), (0, false));
        assert_eq!(relation.find(&[1, 3]), Some(1));
        assert_eq!(relation.find(&[3, 1]), None);
        relation.publish();
        let index = relation.index(&[0], 4);
        assert_eq!(relation.first(index, &[1]), 0);
        relation.publish_all();
        let first = relation.first(index, &[1]);
        assert_eq!((first, relation.next(index, first), relation.next(index, 0)), (1, 0, NONE));
        assert_eq!(relation.distinct(4), &[1, 2]);
    }

    #[test]
    fn free_rows_have_chains_of_their_own() {
        let mut relation = Relation::new(2);
        relation.insert(&[1, 2]);
        relation.insert(&[2, 2]);
        relation.charge(3);
        relation.insert(&[1, 3]);
        let early = relation.index(&[0], 4);
        relation.publish_all();
        let late = relation.index(&[1], 4);
        assert_eq!((relation.first(early, &[1]), relation.first_free(early, &[1])), (2, 0));
        assert_eq!((relation.first(late, &[3]), relation.first_free(late, &[3])), (2, NONE));
        assert_eq!(relation.first_free(late, &[2]), 1);
        assert_eq!((relation.free(), relation.visible()), (2, 3));
    }

    #[test]
    fn a_relation_without_columns_holds_one_row() {
        let mut relation = Relation::new(0);
        assert_eq!(relation.find(&[]), None);
        assert_eq!(relation.insert(&[]), (0, true));
        assert_eq!(relation.insert(&[]), (0, false));
        assert_eq!(relation.find(&[]), Some(0));
    }
}
