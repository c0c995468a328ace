//! A graph goes in; its Markov equivalence class comes out as a partly directed graph, and a graph of the class again.
//!
//! Graphs that differ only in undirected arcs of the class fit any data equally well (Verma and Pearl 1990; Chickering 1995).

use crate::graph::Dag;
use crate::set::Set;
use crate::variable::VariableId;

/// A graph some of whose arcs have no direction: which are directed is known of all graphs of a class.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Pattern {
    parents: Vec<Set>,
    children: Vec<Set>,
    neighbours: Vec<Set>,
}

/// How two variables of a pattern are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Join {
    /// Not at all.
    None,
    /// From the one with the lower number to the other.
    Forward,
    /// From the one with the higher number to the other.
    Backward,
    /// Without a direction.
    Undirected,
}

impl Pattern {
    /// A pattern of this many variables without an arc.
    pub fn empty(variables: usize) -> Self {
        let none = vec![Set::EMPTY; variables];
        Self { parents: none.clone(), children: none.clone(), neighbours: none }
    }

    /// The graph itself, every arc directed.
    pub fn directed(graph: &Dag) -> Self {
        let mut this = Self::empty(graph.len());
        for (parent, child) in graph.arcs() {
            this.direct(parent, child);
        }
        this
    }

    /// The class of a graph: its skeleton and v-structures, closed under Meek's rules (Meek 1995).
    pub fn of(graph: &Dag) -> Self {
        let directed = Self::directed(graph);
        let mut this = Self::empty(graph.len());
        for (parent, child) in graph.arcs() {
            let collides = directed
                .parents(child)
                .without(parent)
                .iter()
                .any(|other| !directed.joined(parent, other));
            if collides {
                this.direct(parent, child);
            } else {
                this.join(parent, child);
            }
        }
        this.close();
        this
    }

    /// How many variables there are.
    pub fn len(&self) -> usize {
        self.parents.len()
    }

    /// Whether there is no variable.
    pub fn is_empty(&self) -> bool {
        self.parents.is_empty()
    }

    /// The variables.
    pub fn ids(&self) -> impl Iterator<Item = VariableId> + use<> {
        (0..self.parents.len() as u16).map(VariableId)
    }

    /// What points to a variable.
    pub fn parents(&self, id: VariableId) -> Set {
        self.parents[id.index()]
    }

    /// What is joined to a variable without a direction.
    pub fn neighbours(&self, id: VariableId) -> Set {
        self.neighbours[id.index()]
    }

    /// What a variable points to.
    pub fn children(&self, id: VariableId) -> Set {
        self.children[id.index()]
    }

    /// Everything that is joined to a variable.
    pub fn adjacent(&self, id: VariableId) -> Set {
        self.parents(id).union(self.neighbours(id)).union(self.children(id))
    }

    /// Whether two variables are joined.
    pub fn joined(&self, one: VariableId, other: VariableId) -> bool {
        self.adjacent(one).contains(other)
    }

    /// How two variables are joined.
    pub fn between(&self, one: VariableId, other: VariableId) -> Join {
        let (low, high) = (one.min(other), one.max(other));
        if self.parents(high).contains(low) {
            Join::Forward
        } else if self.parents(low).contains(high) {
            Join::Backward
        } else if self.neighbours(low).contains(high) {
            Join::Undirected
        } else {
            Join::None
        }
    }

    /// The directed arcs, each from its parent to its child.
    pub fn arcs(&self) -> Vec<(VariableId, VariableId)> {
        let of = |child: VariableId| self.parents(child).iter().map(move |parent| (parent, child));
        self.ids().flat_map(of).collect()
    }

    /// The undirected arcs, the lower number first.
    pub fn undirected(&self) -> Vec<(VariableId, VariableId)> {
        let of = |one: VariableId| {
            self.neighbours(one)
                .iter()
                .filter(move |&other| one < other)
                .map(move |other| (one, other))
        };
        self.ids().flat_map(of).collect()
    }

    /// Joins two variables with a direction, whatever was between them.
    pub fn direct(&mut self, parent: VariableId, child: VariableId) {
        self.part(parent, child);
        self.parents[child.index()] = self.parents(child).with(parent);
        self.children[parent.index()] = self.children(parent).with(child);
    }

    /// Joins two variables without a direction, whatever was between them.
    pub fn join(&mut self, one: VariableId, other: VariableId) {
        self.part(one, other);
        self.neighbours[one.index()] = self.neighbours(one).with(other);
        self.neighbours[other.index()] = self.neighbours(other).with(one);
    }

    /// Takes away what is between two variables.
    pub fn part(&mut self, one: VariableId, other: VariableId) {
        for (a, b) in [(one, other), (other, one)] {
            self.parents[a.index()] = self.parents(a).without(b);
            self.children[a.index()] = self.children(a).without(b);
            self.neighbours[a.index()] = self.neighbours(a).without(b);
        }
    }

    /// Directs what must be directed since its other direction would make a new v-structure or a cycle: Meek's four rules, until none
    /// applies.
    pub fn close(&mut self) {
        loop {
            let forced = self.undirected().into_iter().find_map(|(one, other)| {
                [(one, other), (other, one)]
                    .into_iter()
                    .find(|&(from, to)| self.is_forced(from, to))
            });
            let Some((from, to)) = forced else { return };
            self.direct(from, to);
        }
    }

    /// Whether an undirected arc must point from one variable to the other.
    fn is_forced(&self, from: VariableId, to: VariableId) -> bool {
        // 1: something points to `from` and is not joined to `to`.
        let first = self.parents(from).iter().any(|other| !self.joined(other, to));
        // 2: a way leads over another variable already.
        let second = !self.children(from).and(self.parents(to)).is_empty();
        // 3: two that are not joined point to `to`, and are joined to `from` without a direction.
        let both = self.neighbours(from).and(self.parents(to));
        let third = || {
            both.iter().any(|one| both.iter().any(|other| one < other && !self.joined(one, other)))
        };
        // 4: `from - one`, `one -> other -> to`, and `from` is joined to `other`, and `one` is not to `to`.
        let fourth = || {
            self.neighbours(from).iter().any(|one| {
                !self.joined(one, to)
                    && self
                        .parents(to)
                        .iter()
                        .any(|other| self.parents(other).contains(one) && self.joined(from, other))
            })
        };
        first || second || third() || fourth()
    }

    /// A graph of this class: the same arcs, with no v-structure that is not here (Dor and Tarsi 1992). Of several, the one whose
    /// last variables have the highest numbers. None where there is no such graph.
    pub fn extension(&self) -> Option<Dag> {
        let mut rest = self.clone();
        let mut left = Set::first(self.len());
        let mut parents: Vec<Vec<VariableId>> = self.parents.iter().map(|set| set.list()).collect();
        while !left.is_empty() {
            let sink = left.list().into_iter().rev().find(|&id| rest.is_removable(id))?;
            for neighbour in rest.neighbours(sink).iter() {
                parents[sink.index()].push(neighbour);
            }
            for other in rest.adjacent(sink).iter() {
                rest.part(sink, other);
            }
            left = left.without(sink);
        }
        Dag::new(parents).ok()
    }

    /// Whether a variable can come last: it points to nothing, and each neighbour is joined to all that is joined to it.
    fn is_removable(&self, id: VariableId) -> bool {
        let adjacent = self.adjacent(id);
        self.children(id).is_empty()
            && self
                .neighbours(id)
                .iter()
                .all(|neighbour| adjacent.without(neighbour).is_within(self.adjacent(neighbour)))
    }

    /// In how many pairs of variables this differs from another pattern over the same variables: the structural Hamming distance,
    /// one for each pair (Tsamardinos et al. 2006).
    pub fn distance(&self, other: &Self) -> usize {
        let pairs = self.ids().flat_map(|one| self.ids().map(move |two| (one, two)));
        pairs
            .filter(|(one, two)| one < two && self.between(*one, *two) != other.between(*one, *two))
            .count()
    }

    /// The same pattern, where `names[i]` is the new number of variable `i`.
    #[must_use]
    pub fn renumbered(&self, names: &[VariableId]) -> Self {
        let mut this = Self::empty(self.len());
        for (parent, child) in self.arcs() {
            this.direct(names[parent.index()], names[child.index()]);
        }
        for (one, other) in self.undirected() {
            this.join(names[one.index()], names[other.index()]);
        }
        this
    }
}

/// The question that decides an undirected arc.
pub fn question(one: &str, other: &str) -> String {
    format!(
        "Does `{one}` cause `{other}`, or does `{other}` cause `{one}`? Both graphs fit these data equally well. \
         If one of the two is set first, it is the cause."
    )
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// All graphs over four variables.
    fn graphs() -> Vec<Dag> {
        let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
            .map(|(a, b)| (VariableId(a), VariableId(b)));
        let mut graphs = Vec::new();
        for code in 0..3_usize.pow(6) {
            let arcs = pairs.iter().enumerate().filter_map(|(at, &(a, b))| {
                match code / 3_usize.pow(at as u32) % 3 {
                    0 => None,
                    1 => Some((a, b)),
                    _ => Some((b, a)),
                }
            });
            graphs.extend(Dag::of_arcs(4, arcs));
        }
        graphs
    }

    /// Skeleton and v-structures: what makes a class, by definition.
    fn class(graph: &Dag) -> (Vec<bool>, Vec<bool>) {
        let pattern = Pattern::directed(graph);
        let all: Vec<VariableId> = pattern.ids().collect();
        let mut skeleton = Vec::new();
        let mut colliders = Vec::new();
        for &a in &all {
            for &b in &all {
                skeleton.push(a != b && pattern.joined(a, b));
                for &c in &all {
                    let parents = pattern.parents(c);
                    colliders.push(
                        a < b
                            && parents.contains(a)
                            && parents.contains(b)
                            && !pattern.joined(a, b),
                    );
                }
            }
        }
        (skeleton, colliders)
    }

    #[test]
    fn a_pattern_directs_what_all_graphs_of_its_class_agree_on() {
        let mut classes: BTreeMap<_, Vec<Dag>> = BTreeMap::new();
        let graphs = graphs();
        assert_eq!(graphs.len(), 543, "there are so many over four variables");
        for graph in graphs {
            classes.entry(class(&graph)).or_default().push(graph);
        }
        assert_eq!(classes.len(), 185, "and so many classes");
        for members in classes.values() {
            for graph in members {
                let pattern = Pattern::of(graph);
                for (a, b) in
                    (0..4).flat_map(|a| (a + 1..4).map(move |b| (VariableId(a), VariableId(b))))
                {
                    let forward = members.iter().filter(|one| one.parents(b).contains(&a)).count();
                    let backward = members.iter().filter(|one| one.parents(a).contains(&b)).count();
                    let expected = match (forward, backward) {
                        (0, 0) => Join::None,
                        (_, 0) => Join::Forward,
                        (0, _) => Join::Backward,
                        _ => Join::Undirected,
                    };
                    assert_eq!(pattern.between(a, b), expected, "{graph:?}");
                }
                let extension = pattern.extension().expect("a class has graphs");
                assert!(members.contains(&extension), "{graph:?} became {extension:?}");
            }
        }
    }

    #[test]
    fn a_pattern_without_a_graph_says_so() {
        // A square without diagonals and without colliders.
        let mut square = Pattern::empty(4);
        for (a, b) in [(0, 1), (1, 2), (2, 3), (0, 3)] {
            square.join(VariableId(a), VariableId(b));
        }
        assert_eq!(square.extension(), None);
    }
}
