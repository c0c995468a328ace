//! An array that grows without moving: values come one by one, and references by position stay cheap.
//!
//! A `Vec` that doubles holds the old and the new buffer at once, which is the moment at which a search runs out of memory.

/// Values per segment, as a power of two.
const SHIFT: u32 = 14;

/// An array in segments of equal size.
#[derive(Debug, Clone)]
pub struct Segmented<T> {
    segments: Vec<Box<[T]>>,
    len: usize,
    default: T,
}

impl<T: Copy> Segmented<T> {
    /// An empty array; places that are not yet written hold `default`.
    pub fn new(default: T) -> Self {
        Self { segments: Vec::new(), len: 0, default }
    }

    /// How many values it holds.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Appends a value.
    #[inline]
    pub fn push(&mut self, value: T) {
        let segment = self.len >> SHIFT;
        if segment == self.segments.len() {
            self.segments.push(vec![self.default; 1 << SHIFT].into_boxed_slice());
        }
        self.segments[segment][self.len & ((1 << SHIFT) - 1)] = value;
        self.len += 1;
    }

    /// The value at `index`, which is less than [`Self::len`].
    #[inline]
    pub fn get(&self, index: usize) -> T {
        self.segments[index >> SHIFT][index & ((1 << SHIFT) - 1)]
    }

    /// Replaces the value at `index`, which is less than [`Self::len`].
    #[inline]
    pub fn set(&mut self, index: usize, value: T) {
        self.segments[index >> SHIFT][index & ((1 << SHIFT) - 1)] = value;
    }
}
