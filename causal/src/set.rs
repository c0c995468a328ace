//! Variables go in and out of a set of at most 128, kept as bits.

use crate::variable::VariableId;

/// As many variables as structures are learned over.
pub const MOST_VARIABLES: usize = 128;

/// A set of variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Set(pub u128);

impl Set {
    /// The set of nothing.
    pub const EMPTY: Self = Self(0);

    /// The set of one variable.
    pub fn of(id: VariableId) -> Self {
        Self(1 << id.0)
    }

    /// The set of the first variables, so many.
    pub fn first(many: usize) -> Self {
        if many >= MOST_VARIABLES { Self(u128::MAX) } else { Self((1 << many) - 1) }
    }

    /// Whether a variable is in it.
    pub fn contains(self, id: VariableId) -> bool {
        self.0 >> id.0 & 1 == 1
    }

    /// With a variable.
    #[must_use]
    pub fn with(self, id: VariableId) -> Self {
        Self(self.0 | 1 << id.0)
    }

    /// Without a variable.
    #[must_use]
    pub fn without(self, id: VariableId) -> Self {
        Self(self.0 & !(1 << id.0))
    }

    /// What is in this or the other.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// What is in this and not in the other.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether all of this is in the other.
    pub fn is_within(self, other: Self) -> bool {
        self.0 & !other.0 == 0
    }

    /// Whether nothing is in it.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many variables are in it.
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The variables in it, in rising order.
    pub fn iter(self) -> impl Iterator<Item = VariableId> + Clone {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            (rest != 0).then(|| {
                let id = VariableId(rest.trailing_zeros() as u16);
                rest &= rest - 1;
                id
            })
        })
    }

    /// Its variables as a list.
    pub fn list(self) -> Vec<VariableId> {
        self.iter().collect()
    }

    /// Its subsets of this size, in rising order of their bits read from the first variable.
    pub fn subsets(self, size: usize) -> Vec<Self> {
        let all = self.list();
        let mut chosen: Vec<usize> = (0..size).collect();
        let mut subsets = Vec::new();
        if size > all.len() {
            return subsets;
        }
        loop {
            subsets.push(chosen.iter().map(|&at| all[at]).collect());
            // The last place that can still move on.
            let Some(at) = (0..size).rev().find(|&at| chosen[at] < all.len() - size + at) else {
                return subsets;
            };
            chosen[at] += 1;
            for next in at + 1..size {
                chosen[next] = chosen[next - 1] + 1;
            }
        }
    }
}

impl FromIterator<VariableId> for Set {
    fn from_iter<I: IntoIterator<Item = VariableId>>(ids: I) -> Self {
        ids.into_iter().fold(Self::EMPTY, Self::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subsets_are_all_of_one_size() {
        let set: Set = [1, 4, 7, 9].into_iter().map(VariableId).collect();
        let pairs: Vec<Vec<u16>> =
            set.subsets(2).iter().map(|pair| pair.iter().map(|id| id.0).collect()).collect();
        assert_eq!(pairs, [[1, 4], [1, 7], [1, 9], [4, 7], [4, 9], [7, 9]]);
        assert_eq!(set.subsets(0), [Set::EMPTY]);
        assert!(set.subsets(5).is_empty());
    }
}
