//! A condition goes in; the literals of its outermost conjunction, and warnings about what is always the same, stands twice or binds in vain, come out.

use hashbrown::{HashMap, HashSet};

use crate::diagnostic::{
    Diagnostics, circular_rule, constant_condition, contradictory_goal, disjoint_types,
    fixed_parameter, never_applicable, repeated_condition, unused_variable,
};
use crate::model::{
    Action, Atom, Axiom, Domain, Expression, Formula, Node, NodeId, NodeKind, Object, Scope, Term,
    TypeId, VariableId,
};
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
    for id in operands(formula, formula.root()) {
        let span = formula.nodes[id.index()].span;
        match formula.kind(id) {
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

/// The conjuncts of an `and`, those of `and`s in it taken apart, in the order of the text; anything else is its own only conjunct.
fn operands(formula: &Formula, root: NodeId) -> Vec<NodeId> {
    let mut operands = Vec::new();
    let mut open = vec![root];
    while let Some(id) = open.pop() {
        match formula.kind(id) {
            NodeKind::And(children) => open.extend(children.iter().rev()),
            _ => operands.push(id),
        }
    }
    operands
}

/// All literals of a conjunction of literals; nothing if the formula is something else.
pub(super) fn literals(formula: &Formula) -> Option<Vec<Literal<'_>>> {
    let (literals, whole) = conjuncts(formula);
    whole.then_some(literals)
}

/// What is in scope where conditions are looked at.
#[derive(Clone, Copy)]
pub(super) struct Place<'m> {
    pub(super) domain: &'m Domain,
    pub(super) objects: &'m [Object],
    pub(super) scope: &'m Scope,
}

impl<'m> Place<'m> {
    fn types(&self, term: Term) -> &'m [TypeId] {
        match term {
            Term::Variable(id) => &self.scope.variables[id.index()].types,
            Term::Object(id) => &self.objects[id.index()].types,
        }
    }

    /// As the text has it.
    pub(super) fn describe(&self, term: Term) -> &'m str {
        match term {
            Term::Variable(id) => &self.scope.variables[id.index()].name.text,
            Term::Object(id) => &self.objects[id.index()].name.text,
        }
    }
}

/// Warns of parts that are always true or always false, or that stand there twice.
pub(super) fn check(formula: &Formula, place: Place<'_>, found: &mut Diagnostics) {
    let mut apart: HashMap<(TypeId, TypeId), bool> = HashMap::new();
    for node in &formula.nodes {
        let value = match &node.kind {
            NodeKind::Equal(left, right) if left == right => true,
            NodeKind::Equal(Term::Object(_), Term::Object(_)) => false,
            NodeKind::Or(children) if children.is_empty() => false,
            &NodeKind::Equal(left, right) => {
                disjoint(left, right, node, place, &mut apart, found);
                continue;
            }
            _ => continue,
        };
        found.push(constant_condition::constant_condition(value, node.span));
    }
    repeated(formula, found);
}

/// Warns of terms that are compared though no object has the types of both.
fn disjoint(
    left: Term,
    right: Term,
    node: &Node,
    place: Place<'_>,
    apart: &mut HashMap<(TypeId, TypeId), bool>,
    found: &mut Diagnostics,
) {
    // What a concurrency constraint demands stands nowhere in the text, nor do its variables.
    let unwritten = |term| match term {
        Term::Variable(id) => place.scope.variables[VariableId::index(id)].name.span == node.span,
        Term::Object(_) => false,
    };
    if unwritten(left) || unwritten(right) {
        return;
    }
    let (lefts, rights) = (place.types(left), place.types(right));
    let types = &place.domain.types;
    let mut overlap = |one: TypeId, other: TypeId| {
        // A type below both would do.
        !*apart.entry((one, other)).or_insert_with(|| {
            !types.iter().any(|of| {
                [one, other].iter().all(|above| of.ancestors.binary_search(above).is_ok())
            })
        })
    };
    let meet = lefts.iter().any(|&one| rights.iter().any(|&other| overlap(one, other)));
    if let (false, [one, ..], [other, ..]) = (meet, lefts, rights) {
        let terms = [place.describe(left), place.describe(right)];
        let names = [one, other].map(|id| types[id.index()].name.text.as_str());
        found.push(disjoint_types::disjoint_types(terms, names, node.span));
    }
}

/// Warns of operands of one `and` or `or` that are the same.
fn repeated(formula: &Formula, found: &mut Diagnostics) {
    let mut inner = vec![false; formula.nodes.len()];
    for node in &formula.nodes {
        if let NodeKind::And(children) = &node.kind {
            for child in children {
                inner[child.index()] = true;
            }
        }
    }
    let classes = classes(formula);
    for (index, node) in formula.nodes.iter().enumerate() {
        let operands = match &node.kind {
            // An `and` in an `and` is part of the outer one.
            NodeKind::And(_) if !inner[index] => operands(formula, NodeId(index as u32)),
            NodeKind::Or(children) => children.clone(),
            _ => continue,
        };
        let mut seen: HashMap<u32, Span> = HashMap::new();
        for operand in operands {
            let span = formula.nodes[operand.index()].span;
            let first = *seen.entry(classes[operand.index()]).or_insert(span);
            if first != span {
                found.push(repeated_condition::repeated_condition(span, first));
            }
        }
    }
}

/// What a node says in terms of the classes of its operands.
#[derive(PartialEq, Eq, Hash)]
enum Shape<'m> {
    Atom(&'m Atom),
    Equal(Term, Term),
    Of(&'static str, Vec<u32>),
    /// A binder has variables of its own, so no two are the same.
    Alone(u32),
}

/// A number for each node, the same for those that say the same.
fn classes(formula: &Formula) -> Vec<u32> {
    let mut known: HashMap<Shape<'_>, u32> = HashMap::new();
    let mut classes: Vec<u32> = Vec::with_capacity(formula.nodes.len());
    for (index, node) in formula.nodes.iter().enumerate() {
        let of = |ids: &[NodeId]| ids.iter().map(|id| classes[id.index()]).collect();
        let shape = match &node.kind {
            NodeKind::Atom(atom) => Shape::Atom(atom),
            // Some write both ways of comparing two things on purpose.
            &NodeKind::Equal(left, right) => Shape::Equal(left, right),
            NodeKind::Not(child) => Shape::Of("not", of(&[*child])),
            // What the model does not hold stands there as nothing, and no two such need be the same.
            NodeKind::And(children) if children.is_empty() => Shape::Alone(index as u32),
            NodeKind::And(children) => Shape::Of("and", of(children)),
            NodeKind::Or(children) => Shape::Of("or", of(children)),
            NodeKind::Imply(left, right) => Shape::Of("imply", of(&[*left, *right])),
            _ => Shape::Alone(index as u32),
        };
        let next = known.len() as u32;
        classes.push(*known.entry(shape).or_insert(next));
    }
    classes
}

/// A conjunct and the one that contradicts it, if there are such.
fn contradiction(formula: &Formula) -> Option<(Span, Span)> {
    let mut seen: HashMap<&Atom, (bool, Span)> = HashMap::new();
    conjuncts(formula).0.into_iter().find_map(|literal| {
        let &mut (positive, first) =
            seen.entry(literal.atom).or_insert((literal.positive, literal.span));
        (positive != literal.positive).then_some((literal.span, first))
    })
}

/// Warns of an action whose precondition contradicts itself; says whether it does.
pub(super) fn contradictions(action: &Action, found: &mut Diagnostics) -> bool {
    let Some((span, first)) = contradiction(&action.precondition) else { return false };
    let owner = format!("action `{}`", action.name.text);
    found.push(never_applicable::never_applicable(&owner, span, first));
    true
}

/// Warns of a goal that contradicts itself; says whether it does.
pub(super) fn impossible(goal: &Formula, found: &mut Diagnostics) -> bool {
    let Some((span, first)) = contradiction(goal) else { return false };
    found.push(contradictory_goal::contradictory_goal(span, first));
    true
}

/// Warns of a rule that demands what it concludes.
pub(super) fn circular(axiom: &Axiom, domain: &Domain, found: &mut Diagnostics) {
    let head = |literal: &Literal<'_>| {
        let parameters = (0..axiom.scope.parameters).map(|id| Term::Variable(VariableId(id)));
        literal.positive
            && literal.atom.predicate == axiom.head
            && literal.atom.arguments.iter().copied().eq(parameters)
    };
    if let Some(literal) = conjuncts(&axiom.body).0.iter().find(|literal| head(literal)) {
        let name = &domain.predicates[axiom.head.index()].name.text;
        found.push(circular_rule::circular_rule(name, literal.span));
    }
}

/// Warns of parameters that can only be what they are compared with.
pub(super) fn fixed(action: &Action, place: Place<'_>, found: &mut Diagnostics) {
    let formula = &action.precondition;
    for id in operands(formula, formula.root()) {
        let &NodeKind::Equal(left, right) = formula.kind(id) else { continue };
        let (parameter, other) = match (left, right) {
            _ if left == right => continue,
            // Of two parameters, the later one can go.
            (Term::Variable(one), Term::Variable(other)) if one < other => (other, left),
            (Term::Variable(one), other) | (other, Term::Variable(one)) => (one, other),
            (Term::Object(_), Term::Object(_)) => continue,
        };
        let variable = &place.scope.variables[parameter.index()];
        // An agent that is named by an object has no variable in the text.
        if variable.name.span == action.span {
            continue;
        }
        found.push(fixed_parameter::fixed_parameter(
            &variable.name.text,
            place.describe(other),
            &action.name.text,
            formula.nodes[id.index()].span,
            variable.name.span,
        ));
    }
}

/// Which variables of a scope something names, and what binds the others.
#[derive(Default)]
pub(super) struct Named {
    named: HashSet<VariableId>,
    binders: HashMap<VariableId, Span>,
}

impl Named {
    fn terms<'m>(&mut self, terms: impl IntoIterator<Item = &'m Term>) {
        for term in terms {
            if let Term::Variable(id) = term {
                self.named.insert(*id);
            }
        }
    }

    fn bind(&mut self, variables: &[VariableId], span: Span) {
        for &id in variables {
            self.binders.entry(id).or_insert(span);
        }
    }

    pub(super) fn formula(&mut self, formula: &Formula) {
        for node in &formula.nodes {
            match &node.kind {
                NodeKind::Atom(atom) => self.terms(&atom.arguments),
                NodeKind::Equal(left, right) => self.terms([left, right]),
                NodeKind::Action(atom) => self.terms(&atom.arguments),
                NodeKind::Forall(variables, _) | NodeKind::Exists(variables, _) => {
                    self.bind(variables, node.span);
                }
                _ => {}
            }
        }
    }

    pub(super) fn action(&mut self, action: &Action) {
        self.formula(&action.precondition);
        for effect in &action.effects {
            self.bind(&effect.variables, effect.span);
            self.formula(&effect.condition);
            effect.literals.iter().for_each(|literal| self.terms(&literal.atom.arguments));
        }
        for increase in &action.increases {
            self.formula(&increase.condition);
            self.terms(&increase.arguments);
            if let Expression::Function(_, arguments) = &increase.value {
                self.terms(arguments);
            }
        }
    }

    /// Warns of variables that a quantifier binds and nothing names.
    pub(super) fn report(&self, scope: &Scope, owner: &str, found: &mut Diagnostics) {
        let bound = scope.parameters as usize;
        let mut after: HashMap<String, Span> = HashMap::new();
        for (index, variable) in scope.variables.iter().enumerate().skip(bound).rev() {
            let (name, id) = (&variable.name, VariableId(index as u32));
            let next = after.insert(name.text.to_ascii_lowercase(), name.span);
            // One that is bound again inside has been reported, and that explains it.
            let hidden = next
                .zip(self.binders.get(&id))
                .is_some_and(|(next, binder)| (binder.start..binder.end).contains(&next.start));
            if !self.named.contains(&id) && !hidden {
                found.push(unused_variable::unused_variable(&name.text, owner, name.span));
            }
        }
    }
}
