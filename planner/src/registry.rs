//! Packed states go in; each gets a [`StateId`], the same one every time.
//!
//! States lie back to back in segments that never move. The hash table holds only ids, five bytes a slot, and looks the words up where they lie.
//! When it is full it is thrown away before its successor is built from the states in order, so that old and new never stand in memory together.

use hashbrown::HashTable;
use hashbrown::hash_table::Entry;

/// States per segment, as a power of two.
const SHIFT: u32 = 14;

/// Indexes the states of a [`Registry`] in the order in which they came.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StateId(pub u32);

impl StateId {
    /// The position in tables that this id indexes.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// All states seen, each once.
#[derive(Debug, Clone)]
pub struct Registry {
    width: usize,
    segments: Vec<Box<[u32]>>,
    table: HashTable<u32>,
    len: u32,
}

impl Registry {
    /// An empty registry for states of `width` words.
    pub fn new(width: usize) -> Self {
        Self { width, segments: Vec::new(), table: HashTable::new(), len: 0 }
    }

    /// How many states it holds.
    #[inline]
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The packed words of a state.
    #[inline]
    pub fn words(&self, id: StateId) -> &[u32] {
        words(&self.segments, self.width, id.0)
    }

    /// The id of a state, and whether it is new.
    #[inline]
    pub fn insert(&mut self, state: &[u32]) -> (StateId, bool) {
        if self.table.len() == self.table.capacity() {
            self.grow();
        }
        let (segments, width) = (&self.segments, self.width);
        let entry = self.table.entry(
            hash(state),
            |&id| words(segments, width, id) == state,
            |&id| hash(words(segments, width, id)),
        );
        match entry {
            Entry::Occupied(entry) => (StateId(*entry.get()), false),
            Entry::Vacant(entry) => {
                let id = self.len;
                entry.insert(id);
                self.append(state);
                (StateId(id), true)
            }
        }
    }

    fn append(&mut self, state: &[u32]) {
        let segment = (self.len >> SHIFT) as usize;
        if segment == self.segments.len() {
            self.segments.push(vec![0; self.width << SHIFT].into_boxed_slice());
        }
        let start = (self.len & ((1 << SHIFT) - 1)) as usize * self.width;
        self.segments[segment][start..start + self.width].copy_from_slice(state);
        self.len = self.len.checked_add(1).expect("memory ends before 2^32 states");
    }

    #[cold]
    fn grow(&mut self) {
        let capacity = (self.table.capacity() * 2).max(1 << 10);
        self.table = HashTable::new();
        self.table = HashTable::with_capacity(capacity);
        let (segments, width) = (&self.segments, self.width);
        for id in 0..self.len {
            self.table.insert_unique(hash(words(segments, width, id)), id, |&id| {
                hash(words(segments, width, id))
            });
        }
    }
}

#[inline]
fn words(segments: &[Box<[u32]>], width: usize, id: u32) -> &[u32] {
    let start = (id & ((1 << SHIFT) - 1)) as usize * width;
    &segments[(id >> SHIFT) as usize][start..start + width]
}

/// Folds two words at a time by a full multiplication, whose halves both carry every input bit: the table takes its slot from the low bits
/// and its tag from the high ones.
#[inline]
fn hash(words: &[u32]) -> u64 {
    const FIRST: u64 = 0x9E37_79B9_7F4A_7C15;
    const SECOND: u64 = 0xD6E8_FEB8_6659_FD93;
    let fold = |a: u64, b: u64| {
        let product = u128::from(a) * u128::from(b);
        (product as u64) ^ ((product >> 64) as u64)
    };
    let mut hash = FIRST;
    let mut pairs = words.chunks_exact(2);
    for pair in &mut pairs {
        hash = fold(hash ^ (u64::from(pair[0]) | u64::from(pair[1]) << 32), SECOND);
    }
    if let [last] = pairs.remainder() {
        hash = fold(hash ^ u64::from(*last), SECOND);
    }
    fold(hash ^ FIRST, SECOND)
}
