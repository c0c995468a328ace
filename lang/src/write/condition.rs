//! Formulas and what is applied to terms.

use super::Writer;
use super::variable::{Hidden, Variables};
use crate::model::{Formula, NodeId, NodeKind, Term, VariableId};

/// What is still to be written of a formula.
enum Step {
    Node(NodeId),
    /// The end of a connective.
    End,
    /// The end of a quantifier.
    Release(Hidden),
}

impl Writer<'_> {
    /// Writes a formula, with a blank before it.
    pub(super) fn condition(&mut self, formula: &Formula, variables: &mut Variables<'_>) {
        let mut steps = vec![Step::Node(formula.root())];
        while let Some(step) = steps.pop() {
            match step {
                Step::Node(id) => {
                    self.push(" ");
                    self.node(formula, id, variables, &mut steps);
                }
                Step::End => self.push(")"),
                Step::Release(hidden) => {
                    variables.release(hidden);
                    self.push(")");
                }
            }
        }
    }

    /// Writes a node as far as its first operand.
    fn node(
        &mut self,
        formula: &Formula,
        id: NodeId,
        variables: &mut Variables<'_>,
        steps: &mut Vec<Step>,
    ) {
        let mut open = |word: &str, operands: &[NodeId]| {
            self.text.push('(');
            self.text.push_str(word);
            steps.push(Step::End);
            steps.extend(operands.iter().rev().map(|&operand| Step::Node(operand)));
        };
        match formula.kind(id) {
            NodeKind::Not(child) => open("not", &[*child]),
            NodeKind::And(children) => open("and", children),
            NodeKind::Or(children) => open("or", children),
            NodeKind::Imply(left, right) => open("imply", &[*left, *right]),
            NodeKind::Forall(ids, child) => {
                let hidden = self.quantifier("forall", ids, variables);
                steps.extend([Step::Release(hidden), Step::Node(*child)]);
            }
            NodeKind::Exists(ids, child) => {
                let hidden = self.quantifier("exists", ids, variables);
                steps.extend([Step::Release(hidden), Step::Node(*child)]);
            }
            NodeKind::Atom(atom) => {
                let name = &self.domain.predicates[atom.predicate.index()].name.text;
                self.apply(name, &atom.arguments, variables);
            }
            NodeKind::Action(atom) => {
                let name = &self.domain.actions[atom.action.index()].name.text;
                self.apply(name, &atom.arguments, variables);
            }
            NodeKind::Equal(left, right) => self.apply("=", &[*left, *right], variables),
        }
    }

    /// `(QUANTIFIER (VARIABLES)`, after which the variables are bound.
    pub(super) fn quantifier(
        &mut self,
        word: &str,
        ids: &[VariableId],
        variables: &mut Variables<'_>,
    ) -> Hidden {
        let hidden = variables.bind(ids);
        let list = self.typed(ids, variables, false);
        self.push(&format!("({word} ({list})"));
        hidden
    }

    /// `(NAME TERM …)`
    pub(super) fn apply(&mut self, name: &str, arguments: &[Term], variables: &Variables<'_>) {
        self.push("(");
        self.push(name);
        for argument in arguments {
            self.push(" ");
            self.push(match argument {
                Term::Variable(id) => variables.name(*id),
                Term::Object(id) => &self.objects[id.index()].name.text,
            });
        }
        self.push(")");
    }
}
