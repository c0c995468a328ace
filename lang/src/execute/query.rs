//! A formula goes in; for each of its nodes, the variables that are free in it, come out.

use super::strata;
use crate::model::{ActionAtom, Atom, Formula, NodeId, NodeKind, ObjectId, Term, VariableId};

/// Something that a solution must satisfy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Goal {
    /// The node is true.
    Holds(NodeId),
    /// The node is false.
    Fails(NodeId),
    /// The variable stands for some object of its type.
    Binds(VariableId),
}

impl Goal {
    /// That the node has the truth value `value`.
    pub(crate) fn is(node: NodeId, value: bool) -> Self {
        if value { Self::Holds(node) } else { Self::Fails(node) }
    }
}

/// How a goal can be satisfied: negation, which the goal carries, has gone down to atoms and equalities.
#[derive(Debug)]
pub(crate) enum Shape<'a> {
    /// An atom has this truth value.
    Atom(&'a Atom, bool),
    /// The action stands in the joint action, or does not.
    Action(NodeId, &'a ActionAtom, bool),
    /// The terms are equal, or are not.
    Equal(Term, Term, bool),
    /// All of them must be, the last one first.
    All(Vec<Goal>),
    /// One of them must be, the last one first.
    Any(Vec<Goal>),
    /// The goal must be for one binding of the variables.
    Some(&'a [VariableId], Goal),
    /// The goal must not be for any binding of the variables.
    No(&'a [VariableId], Goal),
}

/// The shape of `goal`, which is about a node of `formula`.
pub(crate) fn shape(formula: &Formula, goal: Goal) -> Shape<'_> {
    let (node, value) = match goal {
        Goal::Holds(node) => (node, true),
        Goal::Fails(node) => (node, false),
        Goal::Binds(variable) => unreachable!("{variable:?} is no node"),
    };
    let each = |nodes: &[NodeId]| nodes.iter().rev().map(|&node| Goal::is(node, value)).collect();
    match (formula.kind(node), value) {
        (NodeKind::Atom(atom), value) => Shape::Atom(atom, value),
        (NodeKind::Action(atom), value) => Shape::Action(node, atom, value),
        (NodeKind::Equal(left, right), value) => Shape::Equal(*left, *right, value),
        (NodeKind::Not(child), value) => Shape::All(vec![Goal::is(*child, !value)]),
        (NodeKind::And(nodes), true) | (NodeKind::Or(nodes), false) => Shape::All(each(nodes)),
        (NodeKind::And(nodes), false) | (NodeKind::Or(nodes), true) => Shape::Any(each(nodes)),
        (NodeKind::Imply(left, right), true) => {
            Shape::Any(vec![Goal::Holds(*right), Goal::Fails(*left)])
        }
        (NodeKind::Imply(left, right), false) => {
            Shape::All(vec![Goal::Fails(*right), Goal::Holds(*left)])
        }
        (NodeKind::Exists(variables, child), true)
        | (NodeKind::Forall(variables, child), false) => {
            Shape::Some(variables, Goal::is(*child, value))
        }
        (NodeKind::Exists(variables, child), false)
        | (NodeKind::Forall(variables, child), true) => {
            Shape::No(variables, Goal::is(*child, !value))
        }
    }
}

/// What [`super::solutions::Solutions`] needs to know about a formula beforehand.
#[derive(Debug, Clone)]
pub(crate) struct Query {
    /// For each node the position of its free variables in `sets`.
    free: Vec<u32>,
    /// For each node whether the formula needs it to be false, counting all that stands above it; empty without action atoms.
    negative: Vec<bool>,
    /// Sets of variables, sorted; a node shares the set of its child where both are equal.
    sets: Vec<Vec<VariableId>>,
}

/// The variables among `terms`.
fn variables(terms: &[Term]) -> Vec<VariableId> {
    let mut found: Vec<_> = terms
        .iter()
        .filter_map(|term| match term {
            Term::Variable(variable) => Some(*variable),
            Term::Object(_) => None,
        })
        .collect();
    found.sort();
    found.dedup();
    found
}

impl Query {
    /// Looks through `formula` once.
    pub(crate) fn new(formula: &Formula) -> Self {
        let asks = formula.nodes.iter().any(|node| matches!(node.kind, NodeKind::Action(_)));
        let uses = if asks { strata::uses(formula) } else { Vec::new() };
        let mut query = Self {
            free: Vec::with_capacity(formula.nodes.len()),
            negative: uses.into_iter().map(|used| !used.value).collect(),
            sets: vec![Vec::new()],
        };
        for node in &formula.nodes {
            let set = match &node.kind {
                NodeKind::Atom(Atom { arguments, .. })
                | NodeKind::Action(ActionAtom { arguments, .. }) => {
                    query.store(variables(arguments))
                }
                NodeKind::Equal(left, right) => query.store(variables(&[*left, *right])),
                NodeKind::Not(child) => query.free[child.index()],
                NodeKind::And(children) | NodeKind::Or(children) => query.union(children),
                NodeKind::Imply(left, right) => query.union(&[*left, *right]),
                NodeKind::Forall(bound, child) | NodeKind::Exists(bound, child) => {
                    let below = query.free[child.index()];
                    let mut set = query.sets[below as usize].clone();
                    set.retain(|variable| !bound.contains(variable));
                    if set.len() == query.sets[below as usize].len() {
                        below
                    } else {
                        query.store(set)
                    }
                }
            };
            query.free.push(set);
        }
        query
    }

    fn store(&mut self, set: Vec<VariableId>) -> u32 {
        if set.is_empty() {
            return 0;
        }
        self.sets.push(set);
        self.sets.len() as u32 - 1
    }

    fn union(&mut self, children: &[NodeId]) -> u32 {
        let mut sets: Vec<u32> = children.iter().map(|child| self.free[child.index()]).collect();
        sets.sort_unstable();
        sets.dedup();
        let mut union: Vec<_> =
            sets.iter().flat_map(|&set| self.sets[set as usize].iter().copied()).collect();
        union.sort();
        union.dedup();
        let same = sets.iter().find(|&&set| self.sets[set as usize].len() == union.len());
        same.copied().unwrap_or_else(|| self.store(union))
    }

    /// Whether nothing is left to bind in `goal`.
    pub(crate) fn closed(&self, binding: &[Option<ObjectId>], goal: Goal) -> bool {
        match goal {
            Goal::Holds(node) | Goal::Fails(node) => {
                self.free(node).iter().all(|variable| binding[variable.index()].is_some())
            }
            Goal::Binds(variable) => binding[variable.index()].is_some(),
        }
    }

    /// Whether the formula needs the action atom `node` to be false.
    pub(crate) fn negative(&self, node: NodeId) -> bool {
        self.negative[node.index()]
    }

    /// The variables that are free in `node`, sorted.
    pub(crate) fn free(&self, node: NodeId) -> &[VariableId] {
        &self.sets[self.free[node.index()] as usize]
    }
}
