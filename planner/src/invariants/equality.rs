//! Which terms of a schema are the same object, which never are, and of what kinds they can be.

use lang::model::{Domain, ObjectId, Problem, TypeId};

use crate::normal::{Term, Variable};

/// The kind that stands for all those that do not have a bit of their own.
const REST: u32 = 63;

/// Objects with the same types are of one kind; a set of kinds is a word.
pub(super) struct Kinds {
    objects: Vec<u64>,
    /// For each type the kinds of which some object is of that type, and those of which all objects are.
    types: Vec<(u64, u64)>,
}

impl Kinds {
    /// Sorts objects by their types. With more than 63 kinds, those found later share a bit.
    pub(super) fn new(domain: &Domain, problem: &Problem) -> Self {
        let mut found: Vec<Vec<TypeId>> = Vec::new();
        let mut objects = Vec::with_capacity(problem.objects.len());
        for object in &problem.objects {
            let mut types: Vec<TypeId> = object
                .types
                .iter()
                .flat_map(|id| domain.types[id.index()].ancestors.iter().copied())
                .collect();
            types.sort_unstable();
            types.dedup();
            let kind = found.iter().position(|other| *other == types).unwrap_or_else(|| {
                found.push(types);
                found.len() - 1
            });
            objects.push(1 << (kind as u32).min(REST));
        }
        let sets = |id: usize| {
            let has = |kind: &Vec<TypeId>| kind.binary_search(&TypeId(id as u32)).is_ok();
            let bit = |kind: usize| 1u64 << (kind as u32).min(REST);
            let some = (0..found.len())
                .filter(|&kind| has(&found[kind]))
                .fold(0, |set, kind| set | bit(kind));
            let lacking = (0..found.len())
                .filter(|&kind| !has(&found[kind]))
                .fold(0, |set, kind| set | bit(kind));
            (some, some & !lacking)
        };
        Self { types: (0..domain.types.len()).map(sets).collect(), objects }
    }

    /// The kinds that a variable may have, and those of which it may be any object.
    pub(super) fn of(&self, variable: &Variable) -> (u64, u64) {
        let sets = variable.types.iter().map(|id| self.types[id.index()]);
        sets.fold((0, 0), |(some, all), (more, every)| (some | more, all | every))
    }

    /// The kind of an object.
    pub(super) fn object(&self, object: ObjectId) -> u64 {
        self.objects[object.index()]
    }
}

/// Classes of terms that are the same object.
#[derive(Clone)]
pub(super) struct Classes<'a> {
    kinds: &'a Kinds,
    /// For each variable a term that is the same; itself at the root of a class without an object.
    parents: Vec<Term>,
    /// For each root the kinds that it may have.
    possible: Vec<u64>,
    /// Whether the equalities contradict each other.
    broken: bool,
}

impl<'a> Classes<'a> {
    /// Every variable on its own.
    pub(super) fn new(kinds: &'a Kinds, possible: Vec<u64>) -> Self {
        let parents = (0..possible.len() as u32).map(Term::Variable).collect();
        Self { kinds, parents, possible, broken: false }
    }

    /// The one that stands for all terms that are the same.
    pub(super) fn root(&self, mut term: Term) -> Term {
        while let Term::Variable(variable) = term {
            let parent = self.parents[variable as usize];
            if parent == term {
                break;
            }
            term = parent;
        }
        term
    }

    /// Whether both are the same object for sure.
    pub(super) fn same(&self, left: Term, right: Term) -> bool {
        left == right || self.root(left) == self.root(right)
    }

    /// The kinds that a term may have.
    pub(super) fn kinds(&self, term: Term) -> u64 {
        match self.root(term) {
            Term::Variable(variable) => self.possible[variable as usize],
            Term::Object(object) => self.kinds.object(object),
        }
    }

    /// Makes both the same object.
    pub(super) fn unify(&mut self, left: Term, right: Term) {
        let (left, right) = (self.root(left), self.root(right));
        if left == right {
            return;
        }
        let shared = self.kinds(left) & self.kinds(right);
        self.broken |= shared == 0;
        match (left, right) {
            (Term::Variable(variable), root) | (root, Term::Variable(variable)) => {
                self.parents[variable as usize] = root;
                if let Term::Variable(root) = root {
                    self.possible[root as usize] = shared;
                }
            }
            (Term::Object(_), Term::Object(_)) => self.broken = true,
        }
    }

    /// Whether the equalities contradict each other.
    pub(super) fn is_broken(&self) -> bool {
        self.broken
    }
}
