//! Pieces of one model go in; the same pieces in the ids of another model come out, unless something they name is not there.

use hashbrown::HashMap;

use crate::model::{
    Action, Atom, Axiom, Effect, Expression, Fact, Formula, FunctionId, FunctionValue, Increase,
    Literal, Node, NodeId, NodeKind, ObjectId, PredicateId, Scope, Term, TypeId, Variable,
    VariableId,
};
use crate::source::Span;

/// Where the entries of one model's tables stand in another's; nothing for those that are not there.
#[derive(Debug, Clone, Default)]
pub(super) struct Ids {
    pub(super) types: Vec<TypeId>,
    pub(super) predicates: Vec<Option<PredicateId>>,
    pub(super) functions: Vec<FunctionId>,
    pub(super) objects: Vec<Option<ObjectId>>,
    /// How many variables stand before those of the piece in the scope it gets into.
    pub(super) shift: u32,
}

/// A piece, or the place of something in it that is not there.
pub(super) type Translated<T> = Result<T, Span>;

impl Ids {
    pub(super) fn types(&self, types: &[TypeId]) -> Vec<TypeId> {
        types.iter().map(|id| self.types[id.index()]).collect()
    }

    pub(super) fn variables(&self, variables: &[Variable]) -> Vec<Variable> {
        let variable = |variable: &Variable| Variable {
            name: variable.name.clone(),
            types: self.types(&variable.types),
        };
        variables.iter().map(variable).collect()
    }

    fn bound(&self, ids: &[VariableId]) -> Vec<VariableId> {
        ids.iter().map(|id| VariableId(id.0 + self.shift)).collect()
    }

    fn terms(&self, terms: &[Term], span: Span) -> Translated<Vec<Term>> {
        terms.iter().map(|term| self.term(*term, span)).collect()
    }

    fn term(&self, term: Term, span: Span) -> Translated<Term> {
        match term {
            Term::Variable(id) => Ok(Term::Variable(VariableId(id.0 + self.shift))),
            Term::Object(id) => self.objects[id.index()].map(Term::Object).ok_or(span),
        }
    }

    fn atom(&self, atom: &Atom, span: Span) -> Translated<Atom> {
        let predicate = self.predicates[atom.predicate.index()].ok_or(span)?;
        Ok(Atom { predicate, arguments: self.terms(&atom.arguments, span)? })
    }

    pub(super) fn objects(&self, ids: &[ObjectId]) -> Option<Box<[ObjectId]>> {
        ids.iter().map(|id| self.objects[id.index()]).collect()
    }

    pub(super) fn fact(&self, fact: &Fact) -> Option<Fact> {
        let predicate = self.predicates[fact.predicate.index()]?;
        Some(Fact { predicate, arguments: self.objects(&fact.arguments)? })
    }

    pub(super) fn value(&self, value: &FunctionValue) -> Option<FunctionValue> {
        let function = self.functions[value.function.index()];
        let arguments = self.objects(&value.arguments)?;
        Some(FunctionValue { function, arguments, value: value.value, span: value.span })
    }

    pub(super) fn formula(&self, formula: &Formula) -> Translated<Formula> {
        let mut nodes = Vec::with_capacity(formula.nodes.len());
        for Node { kind, span } in &formula.nodes {
            let kind = match kind {
                NodeKind::Atom(atom) => NodeKind::Atom(self.atom(atom, *span)?),
                NodeKind::Equal(left, right) => {
                    NodeKind::Equal(self.term(*left, *span)?, self.term(*right, *span)?)
                }
                // In the factored form no agent knows what others do at the same time.
                NodeKind::Action(_) => return Err(*span),
                NodeKind::Forall(ids, child) => NodeKind::Forall(self.bound(ids), *child),
                NodeKind::Exists(ids, child) => NodeKind::Exists(self.bound(ids), *child),
                kind @ (NodeKind::Not(_)
                | NodeKind::And(_)
                | NodeKind::Or(_)
                | NodeKind::Imply(..)) => kind.clone(),
            };
            nodes.push(Node { kind, span: *span });
        }
        Ok(Formula { nodes })
    }

    pub(super) fn axiom(&self, axiom: &Axiom) -> Translated<Axiom> {
        let head = self.predicates[axiom.head.index()].ok_or(axiom.span)?;
        let scope = Scope { variables: self.variables(&axiom.scope.variables), ..axiom.scope };
        Ok(Axiom { head, scope, body: self.formula(&axiom.body)?, span: axiom.span })
    }

    /// An action; the variables before its own are left to be put there.
    pub(super) fn action(&self, action: &Action) -> Translated<Action> {
        let effects = action.effects.iter().map(|effect| self.effect(effect));
        let increases = action.increases.iter().map(|increase| self.increase(increase));
        Ok(Action {
            name: action.name.clone(),
            scope: Scope { variables: self.variables(&action.scope.variables), ..action.scope },
            agent: action.agent,
            precondition: self.formula(&action.precondition)?,
            effects: effects.collect::<Translated<_>>()?,
            increases: increases.collect::<Translated<_>>()?,
            span: action.span,
        })
    }

    /// The same, with room for one variable before all others.
    pub(super) fn shifted(&self, action: &Action) -> Translated<Action> {
        Self { shift: 1, ..self.clone() }.action(action)
    }

    fn effect(&self, effect: &Effect) -> Translated<Effect> {
        let literal = |literal: &Literal| {
            let atom = self.atom(&literal.atom, literal.span)?;
            Ok(Literal { positive: literal.positive, atom, span: literal.span })
        };
        Ok(Effect {
            variables: self.bound(&effect.variables),
            condition: self.formula(&effect.condition)?,
            literals: effect.literals.iter().map(literal).collect::<Translated<_>>()?,
            span: effect.span,
        })
    }

    fn increase(&self, increase: &Increase) -> Translated<Increase> {
        let span = increase.span;
        let value = match &increase.value {
            Expression::Number(number) => Expression::Number(*number),
            Expression::Function(function, terms) => {
                let function = self.functions[function.index()];
                Expression::Function(function, self.terms(terms, span)?)
            }
        };
        Ok(Increase {
            variables: self.bound(&increase.variables),
            condition: self.formula(&increase.condition)?,
            function: self.functions[increase.function.index()],
            arguments: self.terms(&increase.arguments, span)?,
            value,
            span,
        })
    }
}

/// Whether two formulas say the same in the same variables.
fn alike(one: &Formula, other: &Formula) -> bool {
    one.nodes.iter().map(|node| &node.kind).eq(other.nodes.iter().map(|node| &node.kind))
}

/// The types of variables, without their names.
fn typing(variables: &[Variable]) -> impl Iterator<Item = &[TypeId]> {
    variables.iter().map(|variable| variable.types.as_slice())
}

/// Whether two actions do the same, whatever the types of their first parameter, the agent.
pub(super) fn same_action(one: &Action, other: &Action) -> bool {
    let effect = |one: &Effect, other: &Effect| {
        let literals = |effect: &Effect| -> Vec<(bool, Atom)> {
            effect.literals.iter().map(|one| (one.positive, one.atom.clone())).collect()
        };
        one.variables == other.variables
            && alike(&one.condition, &other.condition)
            && literals(one) == literals(other)
    };
    let increase = |one: &Increase, other: &Increase| {
        one.variables == other.variables
            && alike(&one.condition, &other.condition)
            && (one.function, &one.arguments, &one.value)
                == (other.function, &other.arguments, &other.value)
    };
    one.scope.parameters == other.scope.parameters
        && typing(&one.scope.variables).skip(1).eq(typing(&other.scope.variables).skip(1))
        && alike(&one.precondition, &other.precondition)
        && one.effects.len() == other.effects.len()
        && one.effects.iter().zip(&other.effects).all(|(one, other)| effect(one, other))
        && one.increases.len() == other.increases.len()
        && one.increases.iter().zip(&other.increases).all(|(one, other)| increase(one, other))
}

/// Whether two rules say the same.
pub(super) fn same_axiom(one: &Axiom, other: &Axiom) -> bool {
    one.head == other.head
        && typing(&one.scope.variables).eq(typing(&other.scope.variables))
        && alike(&one.body, &other.body)
}

/// A formula with the variables that stand in it, counted as they come.
#[derive(Debug, Clone)]
pub(super) struct Conjunct {
    pub(super) formula: Formula,
    pub(super) scope: Scope,
}

impl Conjunct {
    /// Whether two say the same.
    pub(super) fn same(&self, other: &Self) -> bool {
        alike(&self.formula, &other.formula)
            && typing(&self.scope.variables).eq(typing(&other.scope.variables))
    }
}

/// What a condition demands, one by one.
pub(super) fn conjuncts(formula: &Formula, scope: &Scope) -> Vec<Conjunct> {
    let mut found = Vec::new();
    let mut open = vec![formula.root()];
    while let Some(id) = open.pop() {
        match formula.kind(id) {
            NodeKind::And(children) => open.extend(children.iter().rev()),
            _ => found.push(conjunct(formula, id, scope)),
        }
    }
    found
}

/// The part of a formula that has `root` as its outermost node.
fn conjunct(formula: &Formula, root: NodeId, scope: &Scope) -> Conjunct {
    let mut wanted = vec![root];
    let mut at = 0;
    while at < wanted.len() {
        wanted.extend(children(formula.kind(wanted[at])));
        at += 1;
    }
    wanted.sort_unstable();
    wanted.dedup();
    let place = |id: NodeId| NodeId(wanted.partition_point(|&one| one < id) as u32);
    let mut nodes: Vec<Node> = wanted.iter().map(|id| formula.nodes[id.index()].clone()).collect();
    for node in &mut nodes {
        relink(&mut node.kind, place);
    }
    let mut numbers: HashMap<VariableId, VariableId> = HashMap::new();
    let mut variables = Vec::new();
    let mut number = |id: &mut VariableId| {
        *id = *numbers.entry(*id).or_insert_with(|| {
            variables.push(scope.variables[id.index()].clone());
            VariableId(variables.len() as u32 - 1)
        });
    };
    for node in &mut nodes {
        match &mut node.kind {
            NodeKind::Forall(ids, _) | NodeKind::Exists(ids, _) => {
                ids.iter_mut().for_each(&mut number);
            }
            kind => terms(kind).for_each(|term| {
                if let Term::Variable(id) = term {
                    number(id);
                }
            }),
        }
    }
    Conjunct { formula: Formula { nodes }, scope: Scope { variables, parameters: 0 } }
}

fn children(kind: &NodeKind) -> impl Iterator<Item = NodeId> {
    let children = match kind {
        NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_) => Vec::new(),
        NodeKind::Not(child) | NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => {
            vec![*child]
        }
        NodeKind::And(children) | NodeKind::Or(children) => children.clone(),
        NodeKind::Imply(left, right) => vec![*left, *right],
    };
    children.into_iter()
}

/// Makes the children of a node those at the new places.
fn relink(kind: &mut NodeKind, place: impl Fn(NodeId) -> NodeId) {
    let link = |id: &mut NodeId| *id = place(*id);
    match kind {
        NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_) => {}
        NodeKind::Not(child) | NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => {
            link(child);
        }
        NodeKind::And(children) | NodeKind::Or(children) => children.iter_mut().for_each(link),
        NodeKind::Imply(left, right) => {
            link(left);
            link(right);
        }
    }
}

fn terms(kind: &mut NodeKind) -> impl Iterator<Item = &mut Term> {
    let terms: Vec<&mut Term> = match kind {
        NodeKind::Atom(atom) => atom.arguments.iter_mut().collect(),
        NodeKind::Action(atom) => atom.arguments.iter_mut().collect(),
        NodeKind::Equal(left, right) => vec![left, right],
        _ => Vec::new(),
    };
    terms.into_iter()
}

/// The condition that all of these hold, with the variables of all.
pub(super) fn conjoin(parts: Vec<Conjunct>, span: Span) -> (Formula, Scope) {
    let mut scope = Scope::default();
    let (mut nodes, mut roots) = (Vec::new(), Vec::new());
    for part in parts {
        let (variables, offset) = (scope.variables.len() as u32, nodes.len() as u32);
        for mut node in part.formula.nodes {
            relink(&mut node.kind, |id| NodeId(id.0 + offset));
            match &mut node.kind {
                NodeKind::Forall(ids, _) | NodeKind::Exists(ids, _) => {
                    for id in ids {
                        id.0 += variables;
                    }
                }
                kind => terms(kind).for_each(|term| {
                    if let Term::Variable(id) = term {
                        id.0 += variables;
                    }
                }),
            }
            nodes.push(node);
        }
        roots.push(NodeId(nodes.len() as u32 - 1));
        scope.variables.extend(part.scope.variables);
    }
    if roots.len() != 1 {
        nodes.push(Node { kind: NodeKind::And(roots), span });
    }
    (Formula { nodes }, scope)
}
