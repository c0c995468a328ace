//! Costs with facts go in; they come out by ascending cost.
//!
//! One bucket per cost while costs are small, then a binary heap: walking over a hundred thousand empty buckets takes longer than an evaluation.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Costs from here on go through the heap.
const MOST_BUCKETS: usize = 1 << 12;

/// A monotone priority queue: nothing goes in below what came out last, until it is cleared.
#[derive(Debug, Clone)]
pub(super) struct Queue {
    buckets: Vec<Vec<u32>>,
    heap: BinaryHeap<Reverse<(u32, u32)>>,
    /// Once a cost was too large, for good.
    uses_heap: bool,
    lowest: usize,
    len: usize,
}

impl Queue {
    pub(super) fn new() -> Self {
        Self { buckets: Vec::new(), heap: BinaryHeap::new(), uses_heap: false, lowest: 0, len: 0 }
    }

    #[inline]
    pub(super) fn push(&mut self, cost: u32, fact: u32) {
        let at = cost as usize;
        if self.uses_heap || at >= MOST_BUCKETS {
            self.push_on_heap(cost, fact);
            return;
        }
        if at >= self.buckets.len() {
            self.buckets.resize_with(at + 1, Vec::new);
        }
        self.lowest = self.lowest.min(at);
        self.buckets[at].push(fact);
        self.len += 1;
    }

    #[inline]
    pub(super) fn pop(&mut self) -> Option<(u32, u32)> {
        if self.uses_heap {
            return self.heap.pop().map(|Reverse(entry)| entry);
        }
        if self.len == 0 {
            return None;
        }
        loop {
            if let Some(fact) = self.buckets[self.lowest].pop() {
                self.len -= 1;
                return Some((self.lowest as u32, fact));
            }
            self.lowest += 1;
        }
    }

    pub(super) fn clear(&mut self) {
        if self.len > 0 {
            for bucket in &mut self.buckets[self.lowest..] {
                bucket.clear();
            }
            self.len = 0;
        }
        self.lowest = self.buckets.len();
        self.heap.clear();
    }

    #[cold]
    fn push_on_heap(&mut self, cost: u32, fact: u32) {
        if !self.uses_heap {
            self.uses_heap = true;
            for (bucket, cost) in self.buckets.iter_mut().zip(0..) {
                self.heap.extend(bucket.drain(..).map(|fact| Reverse((cost, fact))));
            }
        }
        self.heap.push(Reverse((cost, fact)));
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_BUCKETS, Queue};

    fn drain(queue: &mut Queue) -> Vec<u32> {
        std::iter::from_fn(|| queue.pop())
            .map(|(cost, fact)| {
                assert_eq!(cost % 100, fact, "an entry keeps its cost");
                cost
            })
            .collect()
    }

    #[test]
    fn costs_ascend_before_and_after_a_huge_one() {
        let mut queue = Queue::new();
        queue.push(5, 5);
        queue.push(2, 2);
        assert_eq!(queue.pop(), Some((2, 2)));
        queue.push(3, 3);
        let huge = (MOST_BUCKETS as u32 / 100 + 1) * 100;
        queue.push(huge, 0);
        queue.push(7, 7);
        assert_eq!(drain(&mut queue), [3, 5, 7, huge]);
        queue.push(4, 4);
        queue.clear();
        assert_eq!(queue.pop(), None);
    }

    #[test]
    fn a_cleared_queue_takes_low_costs_again() {
        let mut queue = Queue::new();
        for cost in [9, 1, 9] {
            queue.push(cost, cost);
        }
        queue.pop();
        queue.clear();
        queue.push(3, 3);
        queue.push(0, 0);
        assert_eq!(drain(&mut queue), [0, 3]);
    }
}
