//! An action goes in; every atom that its precondition and effects can be about comes out.

use lang::model::{Action, Atom, Domain, ObjectId, PredicateId, Term, TypeId, VariableId};

/// The parameters of an action and the constants of its domain.
pub(super) fn terms(domain: &Domain, action: &Action) -> Vec<Term> {
    let variables = (0..action.scope.parameters).map(|at| Term::Variable(VariableId(at)));
    let constants = (0..domain.constants.len() as u32).map(|at| Term::Object(ObjectId(at)));
    variables.chain(constants).collect()
}

/// All atoms over these terms that are well typed: what stands at a position is in any case of one of the types of the position.
pub(super) fn atoms(domain: &Domain, action: &Action) -> Vec<Atom> {
    let terms = terms(domain, action);
    let mut atoms = Vec::new();
    for (at, predicate) in domain.predicates.iter().enumerate() {
        let choices: Vec<Vec<Term>> = predicate
            .parameters
            .iter()
            .map(|position| {
                let fits = |term: &&Term| fits(domain, action, **term, &position.types);
                terms.iter().filter(fits).copied().collect()
            })
            .collect();
        let mut partial: Vec<Vec<Term>> = vec![Vec::new()];
        for choice in &choices {
            let longer = |begun: &Vec<Term>| {
                let begun = begun.clone();
                choice.iter().map(move |term| begun.iter().copied().chain([*term]).collect())
            };
            partial = partial.iter().flat_map(longer).collect();
        }
        let predicate = PredicateId(at as u32);
        atoms.extend(partial.into_iter().map(|arguments| Atom { predicate, arguments }));
    }
    atoms
}

fn fits(domain: &Domain, action: &Action, term: Term, wanted: &[TypeId]) -> bool {
    match term {
        Term::Object(object) => domain.has_type(&domain.constants[object.index()], wanted),
        Term::Variable(variable) => {
            let types = &action.scope.variables[variable.index()].types;
            let within = |of: &TypeId| wanted.iter().any(|above| domain.is_subtype(*of, *above));
            types.iter().all(within)
        }
    }
}

/// The types of a term.
fn types<'d>(domain: &'d Domain, action: &'d Action, term: Term) -> &'d [TypeId] {
    match term {
        Term::Object(object) => &domain.constants[object.index()].types,
        Term::Variable(variable) => &action.scope.variables[variable.index()].types,
    }
}

/// Whether two terms may stand for the same object.
pub(super) fn may_be_one(domain: &Domain, action: &Action, one: Term, other: Term) -> bool {
    if let (Term::Object(one), Term::Object(other)) = (one, other) {
        return one == other;
    }
    let (left, right) = (types(domain, action, one), types(domain, action, other));
    let both = |below: &TypeId| {
        let is_of = |types: &[TypeId]| types.iter().any(|above| domain.is_subtype(*below, *above));
        is_of(left) && is_of(right)
    };
    // An object may also be given both types by `either`; a problem that does so is rare, and a guard too many does no harm there.
    (0..domain.types.len() as u32).map(TypeId).any(|below| both(&below))
}
