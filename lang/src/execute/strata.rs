//! Axioms go in; groups of derived predicates, each of which depends only on itself and on earlier groups, come out.

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::query::{Goal, Query};
use crate::diagnostic::Diagnostic;
use crate::diagnostic::unstratified_axioms::unstratified_axioms;
use crate::model::{AxiomId, Domain, Formula, NodeId, NodeKind, PredicateId};
use crate::source::Span;

/// A derived predicate depends on its own negation, so that the axioms have no meaning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unstratified {
    /// The axiom that uses the negation.
    pub axiom: AxiomId,
    /// The head of the axiom.
    pub head: PredicateId,
    /// The predicate that is negated, and which depends on the head.
    pub negated: PredicateId,
    /// Where it is negated.
    pub span: Span,
}

impl Unstratified {
    /// What to tell the author of the domain.
    pub fn diagnostic(&self, domain: &Domain) -> Diagnostic {
        let name = |id: PredicateId| domain.predicates[id.index()].name.text.as_str();
        let rule = domain.axioms[self.axiom.index()].span;
        unstratified_axioms(name(self.head), name(self.negated), self.span, rule)
    }
}

/// Whether the axioms of `domain` have a meaning: no derived predicate depends on its own negation.
pub fn stratified(domain: &Domain) -> Result<(), Unstratified> {
    Strata::new(domain).map(drop)
}

/// How an axiom's body uses one of its nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Use {
    /// Whether the node must be true; otherwise it must be false.
    pub(crate) value: bool,
    /// The node above it.
    pub(crate) parent: Option<NodeId>,
}

/// How each node of `formula` is used by it.
pub(crate) fn uses(formula: &Formula) -> Vec<Use> {
    let mut uses = vec![Use { value: true, parent: None }; formula.nodes.len()];
    for at in (0..formula.nodes.len()).rev() {
        let parent = NodeId(at as u32);
        let value = uses[at].value;
        let mut set =
            |child: NodeId, value| uses[child.index()] = Use { value, parent: Some(parent) };
        match formula.kind(parent) {
            NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_) => {}
            NodeKind::Not(child) => set(*child, !value),
            NodeKind::And(children) | NodeKind::Or(children) => {
                for &child in children {
                    set(child, value);
                }
            }
            NodeKind::Imply(left, right) => {
                set(*left, !value);
                set(*right, value);
            }
            NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => set(*child, value),
        }
    }
    uses
}

/// An atom of the component in the body of one of its rules, and what else the rule then asks for.
#[derive(Debug, Clone)]
pub(crate) struct Recursion {
    /// The rule, as a position in [`Component::rules`].
    pub(crate) rule: usize,
    /// The atom.
    pub(crate) atom: NodeId,
    /// What else must hold.
    pub(crate) others: Vec<Goal>,
}

/// An axiom, ready to be asked.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub(crate) axiom: AxiomId,
    pub(crate) query: Query,
    /// Whether the rule uses an atom of its component below a universal quantifier, so that it must be asked as a whole again.
    pub(crate) whole: bool,
}

/// Derived predicates that depend on each other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Component {
    pub(crate) predicates: Vec<PredicateId>,
    /// The axioms with these heads.
    pub(crate) rules: Vec<Rule>,
    pub(crate) recursions: Vec<Recursion>,
    /// The earlier components that the rules use, sorted.
    pub(crate) below: Vec<usize>,
    /// The predicates that are not derived and that the rules use, sorted.
    pub(crate) base: Vec<PredicateId>,
}

/// All components, in an order in which each depends only on earlier ones.
#[derive(Debug, Clone, Default)]
pub(crate) struct Strata {
    pub(crate) components: Vec<Component>,
    /// For each predicate its component and its position there.
    places: Vec<Option<(usize, usize)>>,
    /// For each predicate that is not derived the components that depend on it, also by way of others, sorted.
    dependents: Vec<Vec<usize>>,
}

impl Strata {
    /// Orders the axioms of `domain`.
    pub(crate) fn new(domain: &Domain) -> Result<Self, Unstratified> {
        let mut strata = Self {
            components: Vec::new(),
            places: vec![None; domain.predicates.len()],
            dependents: vec![Vec::new(); domain.predicates.len()],
        };
        for (at, group) in groups(domain).into_iter().enumerate() {
            for (position, predicate) in group.iter().enumerate() {
                strata.places[predicate.index()] = Some((at, position));
            }
            strata.components.push(Component { predicates: group, ..Component::default() });
        }
        for at in 0..domain.axioms.len() {
            strata.add(domain, AxiomId(at as u32))?;
        }
        strata.close();
        Ok(strata)
    }

    /// Where `predicate` is derived: the component and the position in it.
    pub(crate) fn place(&self, predicate: PredicateId) -> Option<(usize, usize)> {
        self.places[predicate.index()]
    }

    /// The components that depend on `predicate`, which is not derived.
    pub(crate) fn dependents(&self, predicate: PredicateId) -> &[usize] {
        &self.dependents[predicate.index()]
    }

    fn add(&mut self, domain: &Domain, id: AxiomId) -> Result<(), Unstratified> {
        let axiom = &domain.axioms[id.index()];
        let (component, _) = self.place(axiom.head).expect("the head of an axiom is derived");
        let uses = uses(&axiom.body);
        let mut rule = Rule { axiom: id, query: Query::new(&axiom.body), whole: false };
        let position = self.components[component].rules.len();
        for (at, node) in axiom.body.nodes.iter().enumerate() {
            let NodeKind::Atom(atom) = &node.kind else { continue };
            let place = self.place(atom.predicate);
            let own = &mut self.components[component];
            match place {
                None => own.base.push(atom.predicate),
                Some((other, _)) if other != component => own.below.push(other),
                Some(_) if !uses[at].value => {
                    let (head, negated, span) = (axiom.head, atom.predicate, node.span);
                    return Err(Unstratified { axiom: id, head, negated, span });
                }
                Some(_) => match beside(&axiom.body, &uses, NodeId(at as u32)) {
                    Some(others) => own.recursions.push(Recursion {
                        rule: position,
                        atom: NodeId(at as u32),
                        others,
                    }),
                    None => rule.whole = true,
                },
            }
        }
        self.components[component].rules.push(rule);
        Ok(())
    }

    /// Sorts the dependencies and follows them.
    fn close(&mut self) {
        let mut above: Vec<Vec<usize>> = vec![Vec::new(); self.components.len()];
        let mut direct: Vec<Vec<usize>> = vec![Vec::new(); self.places.len()];
        for (at, component) in self.components.iter_mut().enumerate() {
            component.below.sort_unstable();
            component.below.dedup();
            component.base.sort_unstable();
            component.base.dedup();
            component.below.iter().for_each(|&below| above[below].push(at));
            component.base.iter().for_each(|base| direct[base.index()].push(at));
        }
        for (dependents, mut open) in self.dependents.iter_mut().zip(direct) {
            let mut seen = vec![false; if open.is_empty() { 0 } else { above.len() }];
            while let Some(component) = open.pop() {
                if !std::mem::replace(&mut seen[component], true) {
                    dependents.push(component);
                    open.extend(&above[component]);
                }
            }
            dependents.sort_unstable();
        }
    }
}

/// The strongly connected groups of derived predicates, each after those that it depends on.
fn groups(domain: &Domain) -> Vec<Vec<PredicateId>> {
    let mut graph = DiGraph::<PredicateId, ()>::new();
    let mut nodes: Vec<Option<NodeIndex>> = vec![None; domain.predicates.len()];
    for axiom in &domain.axioms {
        nodes[axiom.head.index()].get_or_insert_with(|| graph.add_node(axiom.head));
    }
    for axiom in &domain.axioms {
        let head = nodes[axiom.head.index()].expect("heads are nodes");
        for node in &axiom.body.nodes {
            let NodeKind::Atom(atom) = &node.kind else { continue };
            if let Some(used) = nodes[atom.predicate.index()] {
                graph.update_edge(head, used, ());
            }
        }
    }
    kosaraju_scc(&graph)
        .into_iter()
        .map(|group| {
            let mut predicates: Vec<_> = group.into_iter().map(|node| graph[node]).collect();
            predicates.sort();
            predicates
        })
        .collect()
}

/// What a body asks for beside `atom`, once it is decided that the atom is the reason; none if it stands below a universal quantifier.
fn beside(body: &Formula, uses: &[Use], atom: NodeId) -> Option<Vec<Goal>> {
    let mut goals = Vec::new();
    let mut child = atom;
    while let Some(parent) = uses[child.index()].parent {
        let value = uses[parent.index()].value;
        match (body.kind(parent), value) {
            (NodeKind::Not(_), _)
            | (NodeKind::And(_), false)
            | (NodeKind::Or(_) | NodeKind::Imply(..), true) => {}
            (NodeKind::And(children), true) | (NodeKind::Or(children), false) => {
                goals.extend(
                    children
                        .iter()
                        .filter(|&&other| other != child)
                        .map(|&other| Goal::is(other, value)),
                );
            }
            (NodeKind::Imply(left, right), false) => {
                goals.push(if child == *left { Goal::Fails(*right) } else { Goal::Holds(*left) });
            }
            (NodeKind::Exists(variables, _), true) | (NodeKind::Forall(variables, _), false) => {
                goals.extend(variables.iter().map(|&variable| Goal::Binds(variable)));
            }
            (NodeKind::Exists(..), false) | (NodeKind::Forall(..), true) => return None,
            (NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_), _) => {
                unreachable!("it has no children")
            }
        }
        child = parent;
    }
    Some(goals)
}
