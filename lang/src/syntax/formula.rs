//! Conditions and effects.

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{
    Amount, Application, Connective, Feature, Formula, Name, Node, NodeKind, Quantifier,
};
use crate::tree::{self, NodeId};

/// How the loop goes on after a node.
enum Step {
    /// Its operands start at this node of the tree.
    Into(u32),
    /// It has none.
    Over,
}

impl<'a> Reader<'a, '_> {
    /// Reads the node and everything in it as a condition or an effect.
    pub(super) fn formula(&mut self, root: NodeId) -> Formula<'a> {
        let mut formula = Formula::default();
        // Nodes whose operands are being read, each with the end of its list.
        let mut open: Vec<(usize, u32)> = Vec::new();
        let end = self.tree.node(root).next;
        let mut at = root.0;
        while at < end {
            close(&mut formula, &mut open, at);
            let node = self.tree.node(NodeId(at));
            match node.kind {
                tree::NodeKind::List | tree::NodeKind::OpenList => {
                    let index = formula.nodes.len();
                    match self.node(NodeId(at), &mut formula) {
                        Step::Into(first) => {
                            open.push((index, node.next));
                            at = first;
                        }
                        Step::Over => at = node.next,
                    }
                }
                tree::NodeKind::Atom => {
                    self.unexpected("a formula in parentheses", NodeId(at));
                    self.push(NodeKind::Connective(Connective::And), NodeId(at), &mut formula);
                    at = node.next;
                }
                _ => at = node.next,
            }
        }
        close(&mut formula, &mut open, end);
        formula
    }

    fn push(&self, kind: NodeKind<'a>, id: NodeId, formula: &mut Formula<'a>) {
        let place = self.place(id);
        let keyword = self.head(id).map_or(place, |head| crate::ast::Place(head.span));
        let next = formula.nodes.len() as u32 + 1;
        formula.nodes.push(Node { kind, next, place, keyword });
    }

    /// Reads the first word of a list, and all of it unless formulas follow.
    fn node(&mut self, id: NodeId, formula: &mut Formula<'a>) -> Step {
        let Some(first) = self.tree.children(id).next() else {
            self.push(NodeKind::Connective(Connective::And), id, formula);
            return Step::Over;
        };
        if self.tree.is_list(first) {
            self.unexpected("a predicate or a connective after `(`", id);
            self.push(NodeKind::Connective(Connective::And), id, formula);
            return Step::Over;
        }
        let head = self.name(first);
        let after = self.tree.node(first).next;
        let connective = match lower(head.text, &mut [0; 24]) {
            "and" => Connective::And,
            "or" => Connective::Or,
            "not" => Connective::Not,
            "imply" => Connective::Imply,
            "when" => Connective::When,
            "forall" => return self.quantifier(Quantifier::Forall, id, formula),
            "exists" => return self.quantifier(Quantifier::Exists, id, formula),
            _ => {
                let kind = self.leaf(head, id, formula);
                self.push(kind, id, formula);
                return Step::Over;
            }
        };
        self.push(NodeKind::Connective(connective), id, formula);
        Step::Into(after)
    }

    fn quantifier(
        &mut self,
        quantifier: Quantifier,
        id: NodeId,
        formula: &mut Formula<'a>,
    ) -> Step {
        let tree = self.tree;
        let Some(list) = tree.children(id).nth(1).filter(|&list| tree.is_list(list)) else {
            self.unexpected(&format!("`({} (?x - TYPE) FORMULA)`", quantifier.word()), id);
            self.push(NodeKind::Connective(Connective::And), id, formula);
            return Step::Over;
        };
        let variables = self.typed_list(tree.children(list), Names::Variables, &mut Vec::new());
        self.push(NodeKind::Quantifier(quantifier, variables), id, formula);
        Step::Into(tree.node(list).next)
    }

    /// A list that contains no formulas, or none that is read yet.
    fn leaf(&mut self, head: Name<'a>, id: NodeId, formula: &mut Formula<'a>) -> NodeKind<'a> {
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        let first_is_list = operands.clone().next().is_some_and(|first| tree.is_list(first));
        let some_list = operands.clone().any(|operand| tree.is_list(operand));
        let feature = match lower(head.text, &mut [0; 24]) {
            "=" => {
                let plain = operands
                    .all(|operand| !tree.is_list(operand) && !is_number(tree.slice(operand)));
                match self.application(id, &mut formula.terms) {
                    Some(equal) if plain => return NodeKind::Equal(equal),
                    _ => Feature::NumericConditions,
                }
            }
            "<" | ">" | "<=" | ">=" => Feature::NumericConditions,
            "increase" => match self.increase(id, formula) {
                Some(increase) => return increase,
                None => Feature::NumericEffects,
            },
            "decrease" | "assign" | "scale-up" | "scale-down" if some_list => {
                Feature::NumericEffects
            }
            "preference" if some_list => Feature::Preferences,
            "always" | "sometime" | "within" | "at-most-once" | "sometime-after"
            | "sometime-before" | "always-within" | "hold-during" | "hold-after"
                if some_list =>
            {
                Feature::Constraints
            }
            "at" | "over" if some_list && !first_is_list => Feature::DurativeActions,
            "oneof" | "probabilistic" if some_list => Feature::Nondeterminism,
            _ => match self.application(id, &mut formula.terms) {
                Some(atom) => return NodeKind::Atom(atom),
                None => Feature::ObjectFluents,
            },
        };
        NodeKind::Unread(self.unread(feature, head, id))
    }

    /// `(increase (FUNCTION …) AMOUNT)`, if the amount is a number or the value of a function.
    fn increase(&mut self, id: NodeId, formula: &mut Formula<'a>) -> Option<NodeKind<'a>> {
        let mut operands = self.tree.children(id).skip(1);
        let (Some(target), Some(amount), None) =
            (operands.next(), operands.next(), operands.next())
        else {
            return None;
        };
        let start = formula.terms.len();
        let read = self.application(target, &mut formula.terms).and_then(|function| {
            let amount = self.amount(amount, &mut formula.terms)?;
            Some(NodeKind::Increase(function, amount))
        });
        if read.is_none() {
            formula.terms.truncate(start);
        }
        read
    }

    fn amount(&self, id: NodeId, terms: &mut Vec<Name<'a>>) -> Option<Amount<'a>> {
        let name = self.head(id).unwrap_or(self.name(id));
        if !self.tree.is_list(id) && is_number(name.text) {
            return Some(Amount::Number(name));
        }
        if matches!(name.text, "+" | "-" | "*" | "/") || name.is_variable() {
            return None;
        }
        let function: Application<'a> = self.application(id, terms)?;
        Some(Amount::Function(function, self.place(id)))
    }
}

/// Ends the nodes whose lists end at `at` or before.
fn close(formula: &mut Formula<'_>, open: &mut Vec<(usize, u32)>, at: u32) {
    let next = formula.nodes.len() as u32;
    while let Some((index, _)) = open.pop_if(|&mut (_, end)| end <= at) {
        formula.nodes[index].next = next;
    }
}
