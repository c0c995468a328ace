//! The bucket store of an open list: keys and items go in, the bucket of the smallest key is found by walking up.

use super::Order;

/// Entries per chunk.
const CHUNK: u32 = 60;
/// Chunks allocated at once.
const BLOCK: u32 = 64;
/// More buckets than this, counting empty ones below used keys, are refused.
const MOST_BUCKETS: usize = 1 << 19;
const NONE: u32 = u32::MAX;

/// Buckets by key, their entries in chunks of one pool.
#[derive(Debug, Clone)]
pub(super) struct Buckets<T> {
    levels: Vec<Level>,
    lowest: usize,
    allocated: usize,
    pool: Pool<T>,
}

impl<T> Default for Buckets<T> {
    fn default() -> Self {
        Self {
            levels: Vec::new(),
            lowest: 0,
            allocated: 0,
            pool: Pool { blocks: Vec::new(), links: Vec::new(), free: NONE },
        }
    }
}

/// The buckets whose keys agree in the first part.
#[derive(Debug, Clone, Default)]
struct Level {
    buckets: Vec<Bucket>,
    lowest: usize,
    len: usize,
}

/// A run of entries from `start` in chunk `first` to `end` in chunk `last`.
/// A chunk links to the next one in first-in-first-out order, and to the one before in last-in-first-out order, which uses `last` and `end` alone.
#[derive(Debug, Clone, Copy)]
struct Bucket {
    first: u32,
    last: u32,
    start: u32,
    end: u32,
}

const EMPTY: Bucket = Bucket { first: NONE, last: NONE, start: 0, end: 0 };

impl<T: Copy + Default> Buckets<T> {
    /// Makes the bucket of `key`, unless the keys are too far apart.
    #[inline]
    pub(super) fn reach(&mut self, key: (u32, u32)) -> bool {
        let (level, bucket) = (key.0 as usize, key.1 as usize);
        self.levels.get(level).is_some_and(|level| bucket < level.buckets.len())
            || self.extend(level, bucket)
    }

    #[cold]
    fn extend(&mut self, level: usize, bucket: usize) -> bool {
        let more_levels = (level + 1).saturating_sub(self.levels.len());
        let more_buckets =
            bucket + 1 - self.levels.get(level).map_or(0, |level| level.buckets.len());
        if self.allocated + more_levels + more_buckets > MOST_BUCKETS {
            return false;
        }
        self.allocated += more_levels + more_buckets;
        if more_levels > 0 {
            self.levels.resize_with(level + 1, Level::default);
        }
        self.levels[level].buckets.resize(bucket + 1, EMPTY);
        true
    }

    /// Adds to the bucket of a key that was reached.
    #[inline]
    pub(super) fn push(&mut self, key: (u32, u32), item: T, order: Order) {
        let level = &mut self.levels[key.0 as usize];
        self.lowest = self.lowest.min(key.0 as usize);
        level.lowest =
            if level.len == 0 { key.1 as usize } else { level.lowest.min(key.1 as usize) };
        level.len += 1;
        let bucket = &mut level.buckets[key.1 as usize];
        if bucket.last == NONE || bucket.end == CHUNK {
            let chunk = self.pool.allocate();
            match order {
                Order::Lifo => self.pool.links[chunk as usize] = bucket.last,
                Order::Fifo => {
                    self.pool.links[chunk as usize] = NONE;
                    if bucket.last == NONE {
                        bucket.first = chunk;
                        bucket.start = 0;
                    } else {
                        self.pool.links[bucket.last as usize] = chunk;
                    }
                }
            }
            bucket.last = chunk;
            bucket.end = 0;
        }
        *self.pool.item(bucket.last, bucket.end) = item;
        bucket.end += 1;
    }

    /// The smallest key; there is at least one entry.
    #[inline]
    pub(super) fn seek(&mut self) -> (u32, u32) {
        while self.levels[self.lowest].len == 0 {
            self.lowest += 1;
        }
        let level = &mut self.levels[self.lowest];
        while level.buckets[level.lowest].last == NONE {
            level.lowest += 1;
        }
        (self.lowest as u32, level.lowest as u32)
    }

    /// Takes an entry from the bucket of `key`, which has one.
    #[inline]
    pub(super) fn pop(&mut self, key: (u32, u32), order: Order) -> T {
        let level = &mut self.levels[key.0 as usize];
        level.len -= 1;
        let bucket = &mut level.buckets[key.1 as usize];
        match order {
            Order::Lifo => {
                bucket.end -= 1;
                let item = *self.pool.item(bucket.last, bucket.end);
                if bucket.end == 0 {
                    let before = self.pool.links[bucket.last as usize];
                    self.pool.release(bucket.last);
                    *bucket = Bucket {
                        last: before,
                        end: if before == NONE { 0 } else { CHUNK },
                        ..EMPTY
                    };
                }
                item
            }
            Order::Fifo => {
                let item = *self.pool.item(bucket.first, bucket.start);
                bucket.start += 1;
                if bucket.first == bucket.last && bucket.start == bucket.end {
                    self.pool.release(bucket.first);
                    *bucket = EMPTY;
                } else if bucket.start == CHUNK {
                    let next = self.pool.links[bucket.first as usize];
                    self.pool.release(bucket.first);
                    bucket.first = next;
                    bucket.start = 0;
                }
                item
            }
        }
    }
}

/// Chunks of entries, linked in lists; those that are free form one list too.
#[derive(Debug, Clone)]
struct Pool<T> {
    blocks: Vec<Box<[T]>>,
    links: Vec<u32>,
    free: u32,
}

impl<T: Copy + Default> Pool<T> {
    #[inline]
    fn item(&mut self, chunk: u32, index: u32) -> &mut T {
        &mut self.blocks[(chunk / BLOCK) as usize][(chunk % BLOCK * CHUNK + index) as usize]
    }

    fn allocate(&mut self) -> u32 {
        if self.free == NONE {
            let first = self.links.len() as u32;
            self.blocks.push(vec![T::default(); (BLOCK * CHUNK) as usize].into_boxed_slice());
            self.links
                .extend((1..=BLOCK).map(|next| if next == BLOCK { NONE } else { first + next }));
            self.free = first;
        }
        let chunk = self.free;
        self.free = self.links[chunk as usize];
        chunk
    }

    fn release(&mut self, chunk: u32) {
        self.links[chunk as usize] = self.free;
        self.free = chunk;
    }
}
