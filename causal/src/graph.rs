//! Arcs go in; a directed acyclic graph comes out, or the cycle that they make (thesis §2.1, equation 2.1).

use thiserror::Error;

use crate::variable::VariableId;

/// A directed acyclic graph over variables: the parents of each, in rising order.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Dag {
    parents: Vec<Vec<VariableId>>,
}

/// Variables each of which is a parent of the next, and the last of the first.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the arcs make a cycle through {} variables", .0.len())]
pub struct Cycle(pub Vec<VariableId>);

impl Dag {
    /// A graph of this many variables without an arc.
    pub fn empty(variables: usize) -> Self {
        Self { parents: vec![Vec::new(); variables] }
    }

    /// A graph in which each variable has these parents; or the cycle that they make.
    ///
    /// # Panics
    /// If a parent is not one of the variables.
    pub fn new(mut parents: Vec<Vec<VariableId>>) -> Result<Self, Cycle> {
        let variables = parents.len();
        for set in &mut parents {
            set.sort_unstable();
            set.dedup();
            assert!(set.iter().all(|id| id.index() < variables), "parents are variables");
        }
        let graph = Self { parents };
        match graph.cycle() {
            None => Ok(graph),
            Some(cycle) => Err(Cycle(cycle)),
        }
    }

    /// A graph with these arcs, each from a parent to its child; or the cycle that they make.
    pub fn of_arcs(
        variables: usize,
        arcs: impl IntoIterator<Item = (VariableId, VariableId)>,
    ) -> Result<Self, Cycle> {
        let mut parents = vec![Vec::new(); variables];
        for (parent, child) in arcs {
            parents[child.index()].push(parent);
        }
        Self::new(parents)
    }

    /// How many variables there are.
    pub fn len(&self) -> usize {
        self.parents.len()
    }

    /// Whether there is no variable.
    pub fn is_empty(&self) -> bool {
        self.parents.is_empty()
    }

    /// Some variables and whatever causes them, directly or through others, in rising order.
    pub fn ancestors(&self, of: impl IntoIterator<Item = VariableId>) -> Vec<VariableId> {
        let mut found = vec![false; self.len()];
        let mut open: Vec<VariableId> = of.into_iter().collect();
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut found[id.index()], true) {
                open.extend(self.parents(id));
            }
        }
        (0..self.len() as u16).map(VariableId).filter(|id| found[id.index()]).collect()
    }

    /// The parents of a variable, in rising order.
    pub fn parents(&self, child: VariableId) -> &[VariableId] {
        &self.parents[child.index()]
    }

    /// The children of each variable, in rising order.
    pub fn children(&self) -> Vec<Vec<VariableId>> {
        let mut children = vec![Vec::new(); self.len()];
        for (parent, child) in self.arcs() {
            children[parent.index()].push(child);
        }
        children
    }

    /// All arcs, each from a parent to its child, ordered by the child.
    pub fn arcs(&self) -> impl Iterator<Item = (VariableId, VariableId)> {
        self.parents.iter().enumerate().flat_map(|(child, parents)| {
            parents.iter().map(move |&parent| (parent, VariableId(child as u16)))
        })
    }

    /// The variables, each after its parents; of several that could be next, the one with the least number.
    pub fn order(&self) -> Vec<VariableId> {
        self.sorted()
    }

    /// As much of the [order](Self::order) as there is: all of it where there is no cycle.
    fn sorted(&self) -> Vec<VariableId> {
        let children = self.children();
        let mut open: Vec<usize> = self.parents.iter().map(Vec::len).collect();
        let mut ready: std::collections::BTreeSet<VariableId> =
            (0..self.len()).filter(|&at| open[at] == 0).map(|at| VariableId(at as u16)).collect();
        let mut order = Vec::with_capacity(self.len());
        while let Some(next) = ready.pop_first() {
            order.push(next);
            for child in &children[next.index()] {
                open[child.index()] -= 1;
                if open[child.index()] == 0 {
                    ready.insert(*child);
                }
            }
        }
        order
    }

    /// A cycle, if there is one, in the direction of its arcs.
    fn cycle(&self) -> Option<Vec<VariableId>> {
        let order = self.sorted();
        if order.len() == self.len() {
            return None;
        }
        let mut sorted = vec![false; self.len()];
        for id in order {
            sorted[id.index()] = true;
        }
        // Whoever was not sorted has a parent that was not: going up must come round.
        let mut at = VariableId(sorted.iter().position(|done| !done)? as u16);
        let mut path: Vec<VariableId> = Vec::new();
        loop {
            if let Some(start) = path.iter().position(|&before| before == at) {
                let mut cycle = path.split_off(start);
                cycle.reverse();
                return Some(cycle);
            }
            path.push(at);
            at = *self.parents(at).iter().find(|parent| !sorted[parent.index()])?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arcs(pairs: &[(u16, u16)]) -> Vec<(VariableId, VariableId)> {
        pairs.iter().map(|&(parent, child)| (VariableId(parent), VariableId(child))).collect()
    }

    #[test]
    fn parents_come_before_their_children() {
        let graph = Dag::of_arcs(4, arcs(&[(3, 1), (1, 0), (3, 0)])).unwrap();
        assert_eq!(graph.order(), [2, 3, 1, 0].map(VariableId));
        assert_eq!(graph.parents(VariableId(0)), [1, 3].map(VariableId));
    }

    #[test]
    fn a_cycle_is_named_in_the_direction_of_its_arcs() {
        let Cycle(cycle) =
            Dag::of_arcs(5, arcs(&[(0, 1), (1, 2), (2, 3), (3, 1), (3, 4)])).unwrap_err();
        let mut turned = cycle.clone();
        turned.rotate_left(cycle.iter().position(|id| id.0 == 1).unwrap());
        assert_eq!(turned, [1, 2, 3].map(VariableId));
    }
}
