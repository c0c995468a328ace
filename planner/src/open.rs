//! Keyed entries go in; the one with the smallest key comes out.
//!
//! A key is a pair, ordered by the first part, then by the second: A* uses (f, h), the greedy searches (h, 0).
//! Entries of equal key leave newest first ([`Order::Lifo`]) or oldest first ([`Order::Fifo`]).
//!
//! Keys are small in most tasks, so there is one bucket a key, and all buckets share a pool of chunks: no bucket is ever copied to grow,
//! and a chunk that is empty serves the next bucket. Where costs make the keys huge, the list turns into a binary heap by itself.

mod buckets;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use buckets::Buckets;

/// Which entry of equal key comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// The newest.
    Lifo,
    /// The oldest.
    Fifo,
}

/// A priority queue of `T`.
#[derive(Debug, Clone)]
pub struct Open<T> {
    order: Order,
    store: Store<T>,
    len: usize,
}

#[derive(Debug, Clone)]
enum Store<T> {
    Buckets(Buckets<T>),
    Heap { heap: BinaryHeap<Ranked<T>>, count: u64 },
}

/// A heap entry: compared by key, then by rank, never by the item.
#[derive(Debug, Clone, Copy)]
struct Ranked<T> {
    key: Reverse<(u32, u32)>,
    rank: u64,
    item: T,
}

impl<T> PartialEq for Ranked<T> {
    fn eq(&self, other: &Self) -> bool {
        (self.key, self.rank) == (other.key, other.rank)
    }
}

impl<T> Eq for Ranked<T> {}

impl<T> PartialOrd for Ranked<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Ranked<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        (self.key, self.rank).cmp(&(other.key, other.rank))
    }
}

impl<T: Copy + Default> Open<T> {
    /// An empty list.
    pub fn new(order: Order) -> Self {
        Self { order, store: Store::Buckets(Buckets::default()), len: 0 }
    }

    /// How many entries it holds.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The smallest key.
    pub fn first_key(&mut self) -> Option<(u32, u32)> {
        if self.len == 0 {
            return None;
        }
        match &mut self.store {
            Store::Buckets(buckets) => Some(buckets.seek()),
            Store::Heap { heap, .. } => heap.peek().map(|entry| entry.key.0),
        }
    }

    /// Adds an entry.
    #[inline]
    pub fn push(&mut self, key: (u32, u32), item: T) {
        if let Store::Buckets(buckets) = &mut self.store {
            if buckets.reach(key) {
                buckets.push(key, item, self.order);
                self.len += 1;
                return;
            }
            self.turn_into_heap();
        }
        if let Store::Heap { heap, count } = &mut self.store {
            heap.push(Ranked { key: Reverse(key), rank: rank(self.order, *count), item });
            *count += 1;
            self.len += 1;
        }
    }

    /// Takes the first entry with its key.
    #[inline]
    pub fn pop(&mut self) -> Option<((u32, u32), T)> {
        if self.len == 0 {
            return None;
        }
        self.len -= 1;
        match &mut self.store {
            Store::Buckets(buckets) => {
                let key = buckets.seek();
                Some((key, buckets.pop(key, self.order)))
            }
            Store::Heap { heap, .. } => heap.pop().map(|entry| (entry.key.0, entry.item)),
        }
    }

    #[cold]
    fn turn_into_heap(&mut self) {
        let mut entries = Vec::with_capacity(self.len);
        if let Store::Buckets(buckets) = &mut self.store {
            for _ in 0..self.len {
                let key = buckets.seek();
                entries.push((key, buckets.pop(key, self.order)));
            }
        }
        // Oldest first within a key, so that the count gives the age.
        if self.order == Order::Lifo {
            entries.reverse();
        }
        let mut count = 0;
        let mut ranked = BinaryHeap::with_capacity(entries.len() + 1);
        for (key, item) in entries {
            ranked.push(Ranked { key: Reverse(key), rank: rank(self.order, count), item });
            count += 1;
        }
        self.store = Store::Heap { heap: ranked, count };
    }
}

fn rank(order: Order, count: u64) -> u64 {
    match order {
        Order::Lifo => count,
        Order::Fifo => u64::MAX - count,
    }
}

#[cfg(test)]
mod tests {
    use super::{Open, Order};

    fn drain(open: &mut Open<u32>) -> Vec<((u32, u32), u32)> {
        std::iter::from_fn(|| open.pop()).collect()
    }

    #[test]
    fn smaller_keys_leave_first_and_order_decides_among_equals() {
        for (order, expected) in [(Order::Lifo, [5, 2, 4, 3, 1]), (Order::Fifo, [2, 5, 3, 4, 1])] {
            let mut open = Open::new(order);
            for (key, item) in [((7, 0), 1), ((3, 1), 2), ((3, 2), 3), ((3, 2), 4), ((3, 1), 5)] {
                open.push(key, item);
            }
            assert_eq!(
                drain(&mut open).iter().map(|entry| entry.1).collect::<Vec<_>>(),
                expected,
                "{order:?}"
            );
        }
    }

    #[test]
    fn a_bucket_of_many_chunks_keeps_its_order() {
        for order in [Order::Lifo, Order::Fifo] {
            let mut open = Open::new(order);
            let mut seen = Vec::new();
            // Two in, one out: chunks are freed and used again meanwhile.
            for item in 0..1000 {
                open.push((1, 1), 2 * item);
                open.push((1, 1), 2 * item + 1);
                seen.push(open.pop().expect("two were pushed").1);
            }
            seen.extend(drain(&mut open).iter().map(|entry| entry.1));
            let expected: Vec<u32> = match order {
                Order::Fifo => (0..2000).collect(),
                Order::Lifo => (0..1000)
                    .map(|item| 2 * item + 1)
                    .chain((0..1000).rev().map(|item| 2 * item))
                    .collect(),
            };
            assert_eq!(seen, expected, "{order:?}");
        }
    }

    #[test]
    fn huge_keys_turn_the_list_into_a_heap_with_the_same_order() {
        for order in [Order::Lifo, Order::Fifo] {
            let (mut small, mut huge) = (Open::new(order), Open::new(order));
            for item in 0..500_u32 {
                let key = (item * 7 % 5, item * 3 % 4);
                small.push(key, item);
                huge.push(key, item);
            }
            small.push((9, 9), 500);
            huge.push((4_000_000_000, 9), 500);
            for item in 501..600 {
                small.push((2, 2), item);
                huge.push((2, 2), item);
            }
            let items =
                |open: &mut Open<u32>| drain(open).iter().map(|entry| entry.1).collect::<Vec<_>>();
            assert_eq!(items(&mut small), items(&mut huge), "{order:?}");
        }
    }
}
