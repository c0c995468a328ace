//! What may be an invariant: for every binding of its parameters, the number of facts that it covers never grows.

/// The facts of one predicate that a candidate covers.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Part {
    /// Indexes the predicates of the normal form.
    pub predicate: u32,
    /// For each parameter of the candidate the argument that has its value. At most one argument is left over: the counted one,
    /// which may have any value.
    pub order: Vec<u32>,
    /// The counted argument.
    pub counted: Option<u32>,
}

/// A set of parts, one for a predicate at most, sorted by predicate. Parameters are numbered as they stand in the first part, so that
/// two candidates that say the same are equal.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Candidate {
    /// Its parts.
    pub parts: Vec<Part>,
}

impl Candidate {
    /// The candidates of one predicate: all arguments are parameters, or all but one.
    pub(super) fn initial(predicate: u32, arity: usize) -> impl Iterator<Item = Self> {
        let arity = arity as u32;
        std::iter::once(None).chain((0..arity).map(Some)).map(move |counted| {
            let order = (0..arity).filter(|&position| Some(position) != counted).collect();
            Self { parts: vec![Part { predicate, order, counted }] }
        })
    }

    /// How many parameters it has.
    pub fn parameters(&self) -> usize {
        self.parts[0].order.len()
    }

    /// The part of a predicate.
    pub fn part(&self, predicate: u32) -> Option<&Part> {
        let found = self.parts.binary_search_by_key(&predicate, |part| part.predicate);
        found.ok().map(|index| &self.parts[index])
    }

    /// With one more part.
    pub(super) fn with(&self, part: Part) -> Self {
        let mut parts = self.parts.clone();
        parts.push(part);
        parts.sort_unstable();
        let mut ranks: Vec<usize> = (0..self.parameters()).collect();
        ranks.sort_by_key(|&parameter| parts[0].order[parameter]);
        for part in &mut parts {
            part.order = ranks.iter().map(|&parameter| part.order[parameter]).collect();
        }
        Self { parts }
    }
}
