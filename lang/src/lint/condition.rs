//! A condition goes in; the literals of its outermost conjunction, and warnings about what is always the same, come out.

use hashbrown::HashMap;

use crate::diagnostic::{Diagnostics, constant_condition, never_applicable};
use crate::model::{Action, Atom, Formula, NodeId, NodeKind, Term};
use crate::source::Span;

/// An atom or its opposite, as a conjunct.
pub(super) struct Literal<'m> {
    pub(super) atom: &'m Atom,
    pub(super) positive: bool,
    pub(super) span: Span,
}

/// The conjuncts that are atoms or negated atoms, and whether there are no others.
pub(super) fn conjuncts(formula: &Formula) -> (Vec<Literal<'_>>, bool) {
    let (mut literals, mut whole) = (Vec::new(), true);
    let mut open: Vec<NodeId> = vec![formula.root()];
    while let Some(id) = open.pop() {
        let span = formula.nodes[id.index()].span;
        match formula.kind(id) {
            NodeKind::And(children) => open.extend(children.iter().rev()),
            NodeKind::Atom(atom) => literals.push(Literal { atom, positive: true, span }),
            NodeKind::Not(child) => match formula.kind(*child) {
                NodeKind::Atom(atom) => literals.push(Literal { atom, positive: false, span }),
                _ => whole = false,
            },
            _ => whole = false,
        }
    }
    (literals, whole)
}

/// All literals of a conjunction of literals; nothing if the formula is something else.
pub(super) fn literals(formula: &Formula) -> Option<Vec<Literal<'_>>> {
    let (literals, whole) = conjuncts(formula);
    whole.then_some(literals)
}

/// Warns of parts that are always true or always false.
pub(super) fn constants(formula: &Formula, found: &mut Diagnostics) {
    for node in &formula.nodes {
        let value = match &node.kind {
            NodeKind::Equal(left, right) if left == right => true,
            NodeKind::Equal(Term::Object(_), Term::Object(_)) => false,
            NodeKind::Or(children) if children.is_empty() => false,
            _ => continue,
        };
        found.push(constant_condition::constant_condition(value, node.span));
    }
}

/// Warns of an action whose precondition contradicts itself.
pub(super) fn contradictions(action: &Action, found: &mut Diagnostics) {
    let mut seen: HashMap<&Atom, (bool, Span)> = HashMap::new();
    for literal in conjuncts(&action.precondition).0 {
        let &mut (positive, first) =
            seen.entry(literal.atom).or_insert((literal.positive, literal.span));
        if positive != literal.positive {
            let owner = format!("action `{}`", action.name.text);
            found.push(never_applicable::never_applicable(&owner, literal.span, first));
            return;
        }
    }
}
