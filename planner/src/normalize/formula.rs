//! Formulas in negation normal form, with every static part kept whole as a [`Filter`].

use lang::model::{self, Formula, NodeId, NodeKind};

use crate::normal::{Atom, Filter, Kind, Literal, Predicate, Term};

/// A formula in which negation stands only before atoms.
#[derive(Debug, Clone)]
pub enum Nnf {
    /// A part over static predicates and equality.
    Filter(Filter),
    /// A literal over a predicate that changes.
    Literal(Literal),
    /// All hold.
    All(Vec<Nnf>),
    /// One holds.
    Any(Vec<Nnf>),
    /// It holds for some binding.
    Exists(Vec<u32>, Box<Nnf>),
    /// It holds for all bindings.
    Forall(Vec<u32>, Box<Nnf>),
}

/// The negation normal form of `formula`, in the variables of its scope.
pub fn nnf(formula: &Formula, predicates: &[Predicate]) -> Nnf {
    convert(formula, formula.root(), true, predicates)
}

fn convert(formula: &Formula, id: NodeId, positive: bool, predicates: &[Predicate]) -> Nnf {
    let children = |ids: &[NodeId]| {
        ids.iter().map(|&id| convert(formula, id, positive, predicates)).collect::<Vec<_>>()
    };
    match formula.kind(id) {
        NodeKind::Atom(model_atom) => {
            let atom = atom(model_atom);
            if predicates[atom.predicate.index()].kind == Kind::Static {
                Nnf::Filter(signed(Filter::Atom(atom), positive))
            } else {
                Nnf::Literal(Literal { positive, atom })
            }
        }
        NodeKind::Equal(left, right) => {
            Nnf::Filter(signed(Filter::Equal(term(*left), term(*right)), positive))
        }
        NodeKind::Action(_) => unreachable!("what asks about joint actions is refused before"),
        NodeKind::Not(child) => convert(formula, *child, !positive, predicates),
        NodeKind::And(ids) if positive => all(children(ids)),
        NodeKind::And(ids) => any(children(ids)),
        NodeKind::Or(ids) if positive => any(children(ids)),
        NodeKind::Or(ids) => all(children(ids)),
        NodeKind::Imply(left, right) => {
            let left = convert(formula, *left, !positive, predicates);
            let right = convert(formula, *right, positive, predicates);
            if positive { any(vec![left, right]) } else { all(vec![left, right]) }
        }
        NodeKind::Forall(bound, child) if positive => {
            forall(variables(bound), convert(formula, *child, positive, predicates))
        }
        NodeKind::Forall(bound, child) => {
            exists(variables(bound), convert(formula, *child, positive, predicates))
        }
        NodeKind::Exists(bound, child) if positive => {
            exists(variables(bound), convert(formula, *child, positive, predicates))
        }
        NodeKind::Exists(bound, child) => {
            forall(variables(bound), convert(formula, *child, positive, predicates))
        }
    }
}

fn variables(bound: &[model::VariableId]) -> Vec<u32> {
    bound.iter().map(|variable| variable.0).collect()
}

/// An atom of the model in the variables of its scope.
pub fn atom(atom: &model::Atom) -> Atom {
    Atom {
        predicate: atom.predicate,
        arguments: atom.arguments.iter().copied().map(term).collect(),
    }
}

/// A term of the model in the variables of its scope.
pub fn term(term: model::Term) -> Term {
    match term {
        model::Term::Variable(variable) => Term::Variable(variable.0),
        model::Term::Object(object) => Term::Object(object),
    }
}

fn signed(filter: Filter, positive: bool) -> Filter {
    if positive { filter } else { Filter::Not(Box::new(filter)) }
}

/// The negation of a static part.
pub fn negate(filter: Filter) -> Filter {
    match filter {
        Filter::Not(child) => *child,
        other => Filter::Not(Box::new(other)),
    }
}

/// The conjunction, flattened, with its static parts first.
pub fn all(children: Vec<Nnf>) -> Nnf {
    let mut filters = Vec::new();
    let mut rest = Vec::new();
    for child in children {
        match child {
            Nnf::Filter(Filter::All(more)) => filters.extend(more),
            Nnf::Filter(filter) => filters.push(filter),
            Nnf::All(more) => {
                for child in more {
                    if let Nnf::Filter(filter) = child {
                        filters.push(filter);
                    } else {
                        rest.push(child);
                    }
                }
            }
            other => rest.push(other),
        }
    }
    if rest.is_empty() {
        return Nnf::Filter(single(filters, Filter::All));
    }
    let mut parts: Vec<Nnf> = filters.into_iter().map(Nnf::Filter).collect();
    parts.append(&mut rest);
    single(parts, Nnf::All)
}

/// The disjunction, flattened, with all its static parts merged into one, which stands first.
pub fn any(children: Vec<Nnf>) -> Nnf {
    let mut filters = Vec::new();
    let mut rest = Vec::new();
    let mut queue = children;
    queue.reverse();
    while let Some(child) = queue.pop() {
        match child {
            Nnf::Filter(Filter::Any(more)) => filters.extend(more),
            Nnf::Filter(filter) => filters.push(filter),
            Nnf::Any(more) => queue.extend(more.into_iter().rev()),
            other => rest.push(other),
        }
    }
    if rest.is_empty() {
        return Nnf::Filter(single(filters, Filter::Any));
    }
    if !filters.is_empty() {
        rest.insert(0, Nnf::Filter(single(filters, Filter::Any)));
    }
    single(rest, Nnf::Any)
}

fn single<T>(mut parts: Vec<T>, wrap: impl FnOnce(Vec<T>) -> T) -> T {
    if parts.len() == 1 { parts.pop().expect("it has one part") } else { wrap(parts) }
}

/// The existential quantification.
fn exists(bound: Vec<u32>, child: Nnf) -> Nnf {
    match child {
        Nnf::Filter(filter) => Nnf::Filter(Filter::Exists(bound, Box::new(filter))),
        Nnf::Exists(mut more, child) => {
            more.extend(bound);
            Nnf::Exists(more, child)
        }
        other => Nnf::Exists(bound, Box::new(other)),
    }
}

/// The universal quantification, drawn into conjunctions.
fn forall(bound: Vec<u32>, child: Nnf) -> Nnf {
    match child {
        Nnf::Filter(filter) => Nnf::Filter(Filter::Forall(bound, Box::new(filter))),
        Nnf::All(children) => {
            all(children.into_iter().map(|child| forall(bound.clone(), child)).collect())
        }
        Nnf::Forall(mut more, child) => {
            more.extend(bound);
            Nnf::Forall(more, child)
        }
        other => Nnf::Forall(bound, Box::new(other)),
    }
}

/// The variables that occur in `formula` without being bound in it, in order of first occurrence.
pub fn free(formula: &Nnf) -> Vec<u32> {
    free_of_all(std::slice::from_ref(formula))
}

/// The variables that occur in `formulas` without being bound in them, in order of first occurrence.
pub fn free_of_all(formulas: &[Nnf]) -> Vec<u32> {
    let mut walk = Occurrences::default();
    for formula in formulas {
        walk.formula(formula);
    }
    walk.free()
}

/// Every binder has variables of its own, so what is free is what occurs and is bound nowhere.
#[derive(Default)]
struct Occurrences {
    seen: Vec<u32>,
    bound: Vec<u32>,
}

impl Occurrences {
    fn free(self) -> Vec<u32> {
        let bound = self.bound;
        self.seen.into_iter().filter(|variable| !bound.contains(variable)).collect()
    }

    fn terms(&mut self, terms: &[Term]) {
        for &term in terms {
            if let Term::Variable(variable) = term
                && !self.seen.contains(&variable)
            {
                self.seen.push(variable);
            }
        }
    }

    fn filter(&mut self, filter: &Filter) {
        match filter {
            Filter::Atom(atom) => self.terms(&atom.arguments),
            Filter::Equal(left, right) => self.terms(&[*left, *right]),
            Filter::Not(child) => self.filter(child),
            Filter::All(children) | Filter::Any(children) => {
                for child in children {
                    self.filter(child);
                }
            }
            Filter::Exists(bound, child) | Filter::Forall(bound, child) => {
                self.bound.extend(bound);
                self.filter(child);
            }
        }
    }

    fn formula(&mut self, formula: &Nnf) {
        match formula {
            Nnf::Filter(filter) => self.filter(filter),
            Nnf::Literal(literal) => self.terms(&literal.atom.arguments),
            Nnf::All(children) | Nnf::Any(children) => {
                for child in children {
                    self.formula(child);
                }
            }
            Nnf::Exists(bound, child) | Nnf::Forall(bound, child) => {
                self.bound.extend(bound);
                self.formula(child);
            }
        }
    }
}
