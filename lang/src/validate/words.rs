//! Facts, steps and conditions go in; the text by which messages speak of them comes out.

use crate::execute::{Misfit, Undefined, value};
use crate::model::{
    ActionAtom, Atom, Domain, Fact, Formula, NodeId, NodeKind, ObjectId, Problem, Scope, Term,
    TypeId, VariableId,
};
use crate::plan::Step;

/// Conditions longer than this many bytes are cut.
const LONGEST: usize = 200;

/// The names by which a domain and its problem speak.
#[derive(Debug, Clone, Copy)]
pub(super) struct Words<'a> {
    pub(super) domain: &'a Domain,
    pub(super) problem: &'a Problem,
}

impl Words<'_> {
    pub(super) fn object(self, object: ObjectId) -> String {
        self.problem.objects[object.index()].name.text.clone()
    }

    pub(super) fn fact(self, fact: &Fact) -> String {
        let name = &self.domain.predicates[fact.predicate.index()].name.text;
        list(name, fact.arguments.iter().map(|&object| self.object(object)))
    }

    /// `a`, or `a or b` for several types.
    pub(super) fn types(self, types: &[TypeId]) -> String {
        let names: Vec<_> =
            types.iter().map(|id| self.domain.types[id.index()].name.text.as_str()).collect();
        names.join(" or ")
    }

    /// Why a step is not an instance of its action.
    pub(super) fn misfit(self, step: &Step, misfit: Misfit) -> String {
        let scope = &self.domain.actions[step.action.index()].scope;
        match misfit {
            Misfit::Count(count) => {
                format!("it has {count} arguments, and its action {} parameters", scope.parameters)
            }
            Misfit::Type(position) => {
                let parameter = &scope.variables[position];
                format!(
                    "{} is not of type {}, as {} must be",
                    self.object(step.arguments[position]),
                    self.types(&parameter.types),
                    parameter.name.text,
                )
            }
        }
    }

    /// What a cost lacks.
    pub(super) fn undefined(self, undefined: &Undefined) -> String {
        let name = &self.domain.functions[undefined.function.index()].name.text;
        let objects = undefined.arguments.iter().map(|&object| self.object(object));
        format!("its cost needs {}, which has no value", list(name, objects))
    }

    /// The node as PDDL, with what is bound in place of variables.
    pub(super) fn formula(
        self,
        scope: &Scope,
        formula: &Formula,
        node: NodeId,
        binding: &[Option<ObjectId>],
    ) -> String {
        enum Piece {
            Text(&'static str),
            Node(NodeId),
        }
        let mut text = String::new();
        let mut pieces = vec![Piece::Node(node)];
        let below = |pieces: &mut Vec<Piece>, children: &[NodeId]| {
            pieces.push(Piece::Text(")"));
            for &child in children.iter().rev() {
                pieces.push(Piece::Node(child));
                pieces.push(Piece::Text(" "));
            }
        };
        while let Some(piece) = pieces.pop() {
            if text.len() > LONGEST {
                text.push('…');
                break;
            }
            let node = match piece {
                Piece::Text(piece) => {
                    text.push_str(piece);
                    continue;
                }
                Piece::Node(node) => node,
            };
            let term = |&term: &Term| self.term(scope, term, binding);
            match formula.kind(node) {
                NodeKind::Atom(Atom { predicate, arguments }) => {
                    let name = &self.domain.predicates[predicate.index()].name.text;
                    text.push_str(&list(name, arguments.iter().map(term)));
                }
                NodeKind::Action(ActionAtom { action, arguments }) => {
                    let name = &self.domain.actions[action.index()].name.text;
                    text.push_str(&list(name, arguments.iter().map(term)));
                }
                NodeKind::Equal(left, right) => {
                    text.push_str(&list("=", [left, right].into_iter().map(term)));
                }
                NodeKind::Not(child) => {
                    text.push_str("(not");
                    below(&mut pieces, &[*child]);
                }
                NodeKind::And(children) => {
                    text.push_str("(and");
                    below(&mut pieces, children);
                }
                NodeKind::Or(children) => {
                    text.push_str("(or");
                    below(&mut pieces, children);
                }
                NodeKind::Imply(left, right) => {
                    text.push_str("(imply");
                    below(&mut pieces, &[*left, *right]);
                }
                NodeKind::Forall(variables, child) => {
                    text.push_str("(forall ");
                    text.push_str(&self.variables(scope, variables));
                    below(&mut pieces, &[*child]);
                }
                NodeKind::Exists(variables, child) => {
                    text.push_str("(exists ");
                    text.push_str(&self.variables(scope, variables));
                    below(&mut pieces, &[*child]);
                }
            }
        }
        text
    }

    fn term(self, scope: &Scope, term: Term, binding: &[Option<ObjectId>]) -> String {
        match (value(term, binding), term) {
            (Some(object), _) | (None, Term::Object(object)) => self.object(object),
            (None, Term::Variable(variable)) => scope.variables[variable.index()].name.text.clone(),
        }
    }

    fn variables(self, scope: &Scope, variables: &[VariableId]) -> String {
        let each: Vec<_> = variables
            .iter()
            .map(|id| {
                let variable = &scope.variables[id.index()];
                match variable.types.as_slice() {
                    // Everything is an object, which need not be said.
                    [] | [TypeId(0)] => variable.name.text.clone(),
                    [one] => format!("{} - {}", variable.name.text, self.types(&[*one])),
                    several => {
                        let types = self.types(several).replace(" or ", " ");
                        format!("{} - (either {types})", variable.name.text)
                    }
                }
            })
            .collect();
        format!("({})", each.join(" "))
    }
}

/// `(name argument …)`.
pub(super) fn list(name: &str, arguments: impl Iterator<Item = String>) -> String {
    let mut text = format!("({name}");
    for argument in arguments {
        text.push(' ');
        text.push_str(&argument);
    }
    text.push(')');
    text
}
