//! Conditions: preconditions, goals, bodies of axioms and what `when` demands.

use super::requirement::Need;
use super::scope::{Bindings, Hidden};
use super::{Report, World, unread};
use crate::ast::{Connective, Formula, NodeKind as Ast, Quantifier};
use crate::diagnostic::{when_in_condition, wrong_operand_count};
use crate::model::{self, Node, NodeId, NodeKind, VariableId};
use crate::source::Span;

/// A node whose operands are being checked.
struct Frame<'a> {
    kind: Kind<'a>,
    children: Vec<NodeId>,
    /// The node of the formula after its last operand.
    end: u32,
    span: Span,
}

enum Kind<'a> {
    Connective(Connective),
    Quantifier(Quantifier, Vec<VariableId>, Hidden<'a>),
}

/// Checks the node `root` of `formula` and what is in it.
pub(super) fn check<'a>(
    formula: &Formula<'a>,
    root: usize,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> model::Formula {
    let mut condition = Condition { nodes: Vec::new(), bindings, world, report };
    let end = formula.nodes[root].next;
    let mut open: Vec<Frame<'a>> = Vec::new();
    let mut at = root as u32;
    loop {
        while let Some(frame) = open.pop_if(|frame| frame.end == at) {
            let id = condition.finish(frame);
            if let Some(parent) = open.last_mut() {
                parent.children.push(id);
            }
        }
        if at >= end {
            break;
        }
        let node = &formula.nodes[at as usize];
        let span = node.place.0;
        let leaf = match &node.kind {
            Ast::Connective(Connective::When) => {
                condition.report.push(when_in_condition::when_in_condition(node.keyword.0));
                condition.bindings.unsure = true;
                at = node.next;
                condition.truth(span)
            }
            Ast::Connective(connective) => {
                condition.need(formula, at as usize, *connective);
                open.push(Frame {
                    kind: Kind::Connective(*connective),
                    children: Vec::new(),
                    end: node.next,
                    span,
                });
                at += 1;
                continue;
            }
            Ast::Quantifier(quantifier, list) => {
                let need =
                    if *quantifier == Quantifier::Forall { Need::Forall } else { Need::Exists };
                condition.report.need(need, node.keyword.0);
                let (variables, hidden) = condition.bindings.bind(list, world, condition.report);
                let kind = Kind::Quantifier(*quantifier, variables, hidden);
                open.push(Frame { kind, children: Vec::new(), end: node.next, span });
                at += 1;
                continue;
            }
            leaf => {
                at = node.next;
                condition.leaf(leaf, formula, span)
            }
        };
        if let Some(parent) = open.last_mut() {
            parent.children.push(leaf);
        }
    }
    model::Formula { nodes: condition.nodes }
}

/// Both must hold.
pub(super) fn conjoin(parts: Vec<model::Formula>, span: Span) -> model::Formula {
    let mut parts: Vec<_> = parts.into_iter().filter(|part| !part.is_truth()).collect();
    if parts.len() <= 1 {
        return parts.pop().unwrap_or_else(|| model::Formula::truth(span));
    }
    let mut nodes: Vec<Node> = Vec::new();
    let mut roots = Vec::new();
    for part in parts {
        let offset = nodes.len() as u32;
        let shift = |id: &mut NodeId| id.0 += offset;
        for mut node in part.nodes {
            match &mut node.kind {
                NodeKind::Atom(_) | NodeKind::Equal(..) => {}
                NodeKind::Not(child) | NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => {
                    shift(child);
                }
                NodeKind::And(children) | NodeKind::Or(children) => {
                    children.iter_mut().for_each(shift);
                }
                NodeKind::Imply(left, right) => {
                    shift(left);
                    shift(right);
                }
            }
            nodes.push(node);
        }
        roots.push(NodeId(nodes.len() as u32 - 1));
    }
    nodes.push(Node { kind: NodeKind::And(roots), span });
    model::Formula { nodes }
}

/// A condition while it is built.
struct Condition<'c, 'w, 'd, 'a> {
    nodes: Vec<Node>,
    bindings: &'c mut Bindings<'a>,
    world: &'c World<'w, 'a>,
    report: &'c mut Report<'d>,
}

impl<'a> Condition<'_, '_, '_, 'a> {
    fn push(&mut self, kind: NodeKind, span: Span) -> NodeId {
        self.nodes.push(Node { kind, span });
        NodeId(self.nodes.len() as u32 - 1)
    }

    /// What stands for a part that has been reported as wrong.
    fn truth(&mut self, span: Span) -> NodeId {
        self.push(NodeKind::And(Vec::new()), span)
    }

    /// The requirement that a connective needs.
    fn need(&mut self, formula: &Formula<'a>, at: usize, connective: Connective) {
        let need = match connective {
            Connective::And | Connective::When => return,
            Connective::Or | Connective::Imply => Need::Disjunction,
            Connective::Not => match formula.nodes.get(at + 1).map(|node| &node.kind) {
                Some(Ast::Atom(_)) => Need::Negation,
                Some(Ast::Connective(_)) => Need::Disjunction,
                _ => return,
            },
        };
        self.report.need(need, formula.nodes[at].keyword.0);
    }

    fn leaf(&mut self, leaf: &Ast<'a>, formula: &Formula<'a>, span: Span) -> NodeId {
        let kind = match leaf {
            Ast::Atom(atom) => {
                let arguments = formula.arguments(atom);
                self.bindings
                    .atom(atom.name, arguments, span, self.world, self.report)
                    .map(NodeKind::Atom)
            }
            Ast::Equal(equal) => {
                let arguments = formula.arguments(equal);
                self.report.need(Need::Equality, equal.name.span);
                let mut terms = Vec::new();
                for &argument in arguments {
                    terms.extend(self.bindings.term(argument, self.world, self.report));
                }
                if arguments.len() != 2 {
                    self.report.push(wrong_operand_count::wrong_operand_count(
                        "=",
                        2,
                        arguments.len(),
                        span,
                    ));
                }
                match terms.as_slice() {
                    &[left, right] if arguments.len() == 2 => Some(NodeKind::Equal(left, right)),
                    _ => None,
                }
            }
            Ast::Unread(part) => {
                self.bindings.unsure = true;
                unread(self.world, part, self.report);
                None
            }
            Ast::Increase(function, _) => {
                self.bindings.unsure = true;
                self.report.push(crate::diagnostic::unexpected_item::unexpected_item(
                    "a condition; `increase` is an effect",
                    function.name.span,
                ));
                None
            }
            Ast::Connective(_) | Ast::Quantifier(..) => None,
        };
        match kind {
            Some(kind) => self.push(kind, span),
            None => self.truth(span),
        }
    }

    /// Puts a node together from its operands.
    fn finish(&mut self, frame: Frame<'a>) -> NodeId {
        let Frame { kind, mut children, span, .. } = frame;
        let given = children.len();
        let (word, expected) = match &kind {
            Kind::Connective(connective) => {
                let expected = match connective {
                    Connective::Not => Some(1),
                    Connective::Imply => Some(2),
                    _ => None,
                };
                (connective.word(), expected)
            }
            Kind::Quantifier(quantifier, ..) => (quantifier.word(), Some(1)),
        };
        if let Some(expected) = expected.filter(|&expected| expected != given) {
            // A quantifier's list of variables counts as an operand for the reader.
            let list = usize::from(matches!(kind, Kind::Quantifier(..)));
            self.report.push(wrong_operand_count::wrong_operand_count(
                word,
                expected + list,
                given + list,
                span,
            ));
        }
        match (kind, children.as_slice()) {
            (Kind::Quantifier(quantifier, variables, hidden), _) => {
                self.bindings.restore(hidden);
                let body = match children.pop() {
                    Some(body) if given == 1 => body,
                    _ => return self.truth(span),
                };
                let kind = match quantifier {
                    Quantifier::Forall => NodeKind::Forall(variables, body),
                    Quantifier::Exists => NodeKind::Exists(variables, body),
                };
                self.push(kind, span)
            }
            (Kind::Connective(Connective::And | Connective::Or), &[only]) => only,
            (Kind::Connective(Connective::And), _) => self.push(NodeKind::And(children), span),
            (Kind::Connective(Connective::Or), _) => self.push(NodeKind::Or(children), span),
            (Kind::Connective(Connective::Not), &[child]) => self.push(NodeKind::Not(child), span),
            (Kind::Connective(Connective::Imply), &[left, right]) => {
                self.push(NodeKind::Imply(left, right), span)
            }
            (Kind::Connective(_), _) => self.truth(span),
        }
    }
}
