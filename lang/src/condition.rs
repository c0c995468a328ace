//! A flat [`Formula`] goes in; the same condition as a tree in negation normal form comes out, to be rewritten and made flat again.

use crate::model::{ActionAtom, Atom, Formula, Node, NodeId, NodeKind, Term, VariableId};
use crate::source::Span;

/// How deep a formula may be nested to become a tree, since what walks a tree is recursive.
pub const DEEPEST: usize = 500;

/// A condition in which negation stands only before atoms, in the variables of some scope.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Condition {
    /// A predicate holds, or does not.
    Atom(Atom, bool),
    /// Two terms are the same object, or are not.
    Equal(Term, Term, bool),
    /// An action stands in the joint action, or does not.
    Action(ActionAtom, bool),
    /// All hold.
    All(Vec<Condition>),
    /// One holds.
    Any(Vec<Condition>),
    /// It holds for every binding of the variables.
    Forall(Vec<VariableId>, Box<Condition>),
    /// It holds for some binding of the variables.
    Exists(Vec<VariableId>, Box<Condition>),
}

impl Condition {
    /// What always holds.
    pub const TRUE: Self = Self::All(Vec::new());
    /// What never holds.
    pub const FALSE: Self = Self::Any(Vec::new());

    /// The condition that `formula` is; nothing if it is nested deeper than [`DEEPEST`].
    pub fn new(formula: &Formula) -> Option<Self> {
        (depth(formula) <= DEEPEST).then(|| Self::convert(formula, formula.root(), true))
    }

    fn convert(formula: &Formula, id: NodeId, holds: bool) -> Self {
        let each = |ids: &[NodeId]| {
            ids.iter().map(move |&id| Self::convert(formula, id, holds)).collect::<Vec<_>>()
        };
        match (formula.kind(id), holds) {
            (NodeKind::Atom(atom), _) => Self::Atom(atom.clone(), holds),
            (NodeKind::Equal(left, right), _) => Self::Equal(*left, *right, holds),
            (NodeKind::Action(atom), _) => Self::Action(atom.clone(), holds),
            (NodeKind::Not(child), _) => Self::convert(formula, *child, !holds),
            (NodeKind::And(ids), true) | (NodeKind::Or(ids), false) => Self::all(each(ids)),
            (NodeKind::And(ids), false) | (NodeKind::Or(ids), true) => Self::any(each(ids)),
            (NodeKind::Imply(left, right), _) => {
                let parts =
                    [Self::convert(formula, *left, !holds), Self::convert(formula, *right, holds)];
                if holds { Self::any(parts) } else { Self::all(parts) }
            }
            (NodeKind::Forall(variables, child), true)
            | (NodeKind::Exists(variables, child), false) => {
                Self::forall(variables.clone(), Self::convert(formula, *child, holds))
            }
            (NodeKind::Exists(variables, child), true)
            | (NodeKind::Forall(variables, child), false) => {
                Self::exists(variables.clone(), Self::convert(formula, *child, holds))
            }
        }
    }

    /// All of `parts`, flattened.
    pub fn all(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut list: Vec<Self> = Vec::new();
        for part in parts {
            match part {
                Self::All(parts) => list.extend(parts),
                Self::Any(parts) if parts.is_empty() => return Self::FALSE,
                part => list.push(part),
            }
        }
        dedup(&mut list);
        if list.len() == 1 { list.remove(0) } else { Self::All(list) }
    }

    /// One of `parts`, flattened.
    pub fn any(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut list: Vec<Self> = Vec::new();
        for part in parts {
            match part {
                Self::Any(parts) => list.extend(parts),
                Self::All(parts) if parts.is_empty() => return Self::TRUE,
                part => list.push(part),
            }
        }
        dedup(&mut list);
        if list.len() == 1 { list.remove(0) } else { Self::Any(list) }
    }

    /// `body` for every binding of `variables`.
    pub fn forall(variables: Vec<VariableId>, body: Self) -> Self {
        // An empty type makes it true, so a false body does not make it false.
        if variables.is_empty() || body == Self::TRUE {
            return body;
        }
        Self::Forall(variables, Box::new(body))
    }

    /// `body` for some binding of `variables`.
    pub fn exists(variables: Vec<VariableId>, body: Self) -> Self {
        if variables.is_empty() || body == Self::FALSE {
            return body;
        }
        Self::Exists(variables, Box::new(body))
    }

    /// The opposite.
    #[must_use]
    #[expect(
        clippy::should_implement_trait,
        reason = "it is called by its name, like the others here"
    )]
    pub fn not(self) -> Self {
        match self {
            Self::Atom(atom, holds) => Self::Atom(atom, !holds),
            Self::Equal(left, right, holds) => Self::Equal(left, right, !holds),
            Self::Action(atom, holds) => Self::Action(atom, !holds),
            Self::All(parts) => Self::any(parts.into_iter().map(Self::not)),
            Self::Any(parts) => Self::all(parts.into_iter().map(Self::not)),
            Self::Forall(variables, body) => Self::exists(variables, body.not()),
            Self::Exists(variables, body) => Self::forall(variables, body.not()),
        }
    }

    /// The same with another leaf in place of each leaf.
    #[must_use]
    pub fn map(self, leaf: &mut dyn FnMut(Self) -> Self) -> Self {
        match self {
            Self::All(parts) => Self::all(parts.into_iter().map(|part| part.map(leaf))),
            Self::Any(parts) => Self::any(parts.into_iter().map(|part| part.map(leaf))),
            Self::Forall(variables, body) => Self::forall(variables, body.map(leaf)),
            Self::Exists(variables, body) => Self::exists(variables, body.map(leaf)),
            part => leaf(part),
        }
    }

    /// The same with other terms. What quantifiers bind stays.
    #[must_use]
    pub fn substitute(self, term: &dyn Fn(Term) -> Term) -> Self {
        self.map(&mut |leaf| match leaf {
            Self::Atom(mut atom, holds) => {
                atom.arguments.iter_mut().for_each(|argument| *argument = term(*argument));
                Self::Atom(atom, holds)
            }
            Self::Equal(left, right, holds) => equal(term(left), term(right), holds),
            Self::Action(mut atom, holds) => {
                atom.arguments.iter_mut().for_each(|argument| *argument = term(*argument));
                Self::Action(atom, holds)
            }
            other => other,
        })
    }

    /// The same with other variables, also where quantifiers bind them.
    #[must_use]
    pub fn rename(self, new: &dyn Fn(VariableId) -> Term) -> Self {
        let term = |term| match term {
            Term::Variable(variable) => new(variable),
            object @ Term::Object(_) => object,
        };
        let bound = |variables: Vec<VariableId>| {
            let each = variables.into_iter().filter_map(|variable| match new(variable) {
                Term::Variable(variable) => Some(variable),
                Term::Object(_) => None,
            });
            each.collect::<Vec<_>>()
        };
        match self {
            Self::All(parts) => Self::all(parts.into_iter().map(|part| part.rename(new))),
            Self::Any(parts) => Self::any(parts.into_iter().map(|part| part.rename(new))),
            Self::Forall(variables, body) => Self::forall(bound(variables), body.rename(new)),
            Self::Exists(variables, body) => Self::exists(bound(variables), body.rename(new)),
            leaf => leaf.substitute(&term),
        }
    }

    /// Shows every leaf.
    pub fn visit(&self, leaf: &mut dyn FnMut(&Self)) {
        match self {
            Self::All(parts) | Self::Any(parts) => parts.iter().for_each(|part| part.visit(leaf)),
            Self::Forall(_, body) | Self::Exists(_, body) => body.visit(leaf),
            part => leaf(part),
        }
    }

    /// Lists what quantifiers bind, the outer ones first.
    pub fn bound(&self, list: &mut Vec<VariableId>) {
        match self {
            Self::All(parts) | Self::Any(parts) => parts.iter().for_each(|part| part.bound(list)),
            Self::Forall(variables, body) | Self::Exists(variables, body) => {
                list.extend(variables);
                body.bound(list);
            }
            _ => {}
        }
    }

    /// Whether some leaf is as asked.
    pub fn some(&self, mut wanted: impl FnMut(&Self) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |leaf| found |= wanted(leaf));
        found
    }

    /// The terms of a leaf.
    pub fn terms(&self) -> Vec<Term> {
        match self {
            Self::Atom(atom, _) => atom.arguments.clone(),
            Self::Action(atom, _) => atom.arguments.clone(),
            Self::Equal(left, right, _) => vec![*left, *right],
            _ => Vec::new(),
        }
    }

    /// Whether a variable occurs.
    pub fn mentions(&self, variable: VariableId) -> bool {
        self.some(|leaf| leaf.terms().contains(&Term::Variable(variable)))
    }

    /// The parts that must all hold.
    pub fn conjuncts(&self) -> &[Self] {
        match self {
            Self::All(parts) => parts,
            part => std::slice::from_ref(part),
        }
    }

    /// As a flat formula, all of it at `span`.
    pub fn formula(&self, span: Span) -> Formula {
        let mut nodes = Vec::new();
        self.write(span, &mut nodes);
        Formula { nodes }
    }

    fn write(&self, span: Span, nodes: &mut Vec<Node>) -> NodeId {
        let literal = |kind, holds: bool, nodes: &mut Vec<Node>| {
            nodes.push(Node { kind, span });
            if !holds {
                let child = NodeId(nodes.len() as u32 - 1);
                nodes.push(Node { kind: NodeKind::Not(child), span });
            }
        };
        match self {
            Self::Atom(atom, holds) => literal(NodeKind::Atom(atom.clone()), *holds, nodes),
            Self::Equal(left, right, holds) => {
                literal(NodeKind::Equal(*left, *right), *holds, nodes);
            }
            Self::Action(atom, holds) => literal(NodeKind::Action(atom.clone()), *holds, nodes),
            Self::All(parts) => {
                let ids = parts.iter().map(|part| part.write(span, nodes)).collect();
                nodes.push(Node { kind: NodeKind::And(ids), span });
            }
            Self::Any(parts) => {
                let ids = parts.iter().map(|part| part.write(span, nodes)).collect();
                nodes.push(Node { kind: NodeKind::Or(ids), span });
            }
            Self::Forall(variables, body) => {
                let body = body.write(span, nodes);
                nodes.push(Node { kind: NodeKind::Forall(variables.clone(), body), span });
            }
            Self::Exists(variables, body) => {
                let body = body.write(span, nodes);
                nodes.push(Node { kind: NodeKind::Exists(variables.clone(), body), span });
            }
        }
        NodeId(nodes.len() as u32 - 1)
    }
}

/// How deep a formula is nested.
pub fn depth(formula: &Formula) -> usize {
    let mut depths: Vec<usize> = Vec::with_capacity(formula.nodes.len());
    for node in &formula.nodes {
        let below = |id: &NodeId| depths[id.index()];
        let depth = match &node.kind {
            NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_) => 0,
            NodeKind::Not(child) | NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => {
                below(child)
            }
            NodeKind::And(children) | NodeKind::Or(children) => {
                children.iter().map(below).max().unwrap_or(0)
            }
            NodeKind::Imply(left, right) => below(left).max(below(right)),
        };
        depths.push(depth + 1);
    }
    depths[formula.root().index()]
}

/// That two terms are the same, or are not; decided where it can be.
pub fn equal(left: Term, right: Term, holds: bool) -> Condition {
    // In one order, so that the same is seen to be the same.
    let (left, right) = if right < left { (right, left) } else { (left, right) };
    let known = match (left, right) {
        _ if left == right => Some(true),
        (Term::Object(_), Term::Object(_)) => Some(false),
        _ => None,
    };
    match known {
        Some(same) if same == holds => Condition::TRUE,
        Some(_) => Condition::FALSE,
        None => Condition::Equal(left, right, holds),
    }
}

/// Leaves out what stands there twice, where the list is short enough to look.
fn dedup(list: &mut Vec<Condition>) {
    if list.len() > 64 {
        return;
    }
    let mut at = 0;
    while at < list.len() {
        let (before, rest) = list.split_at(at);
        if before.contains(&rest[0]) {
            list.remove(at);
        } else {
            at += 1;
        }
    }
}
