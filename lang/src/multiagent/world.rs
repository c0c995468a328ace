//! The types and objects of a problem go in; what can be the same object, and so how conditions simplify, comes out.

use crate::condition::{self, Condition};
use crate::model::{Domain, Problem, Term, TypeId, Variable, VariableId};

/// The objects of each type.
#[derive(Debug)]
pub(super) struct World<'a> {
    pub(super) domain: &'a Domain,
    pub(super) problem: &'a Problem,
}

impl<'a> World<'a> {
    pub(super) fn new(domain: &'a Domain, problem: &'a Problem) -> Self {
        Self { domain, problem }
    }

    /// How many objects are of one of `types`.
    pub(super) fn count(&self, types: &[TypeId]) -> usize {
        self.problem.objects.iter().filter(|object| self.domain.has_type(object, types)).count()
    }

    /// Whether some object is of one of `types` and of one of `others`.
    pub(super) fn overlap(&self, types: &[TypeId], others: &[TypeId]) -> bool {
        let both =
            |object| self.domain.has_type(object, types) && self.domain.has_type(object, others);
        self.problem.objects.iter().any(both)
    }

    /// Whether every object of one of `types` is of one of `wanted`.
    pub(super) fn covers(&self, wanted: &[TypeId], types: &[TypeId]) -> bool {
        if types.iter().all(|&one| wanted.iter().any(|&other| self.domain.is_subtype(one, other))) {
            return true;
        }
        let objects = &self.problem.objects;
        objects
            .iter()
            .filter(|object| self.domain.has_type(object, types))
            .all(|object| self.domain.has_type(object, wanted))
    }

    /// The types that a term has, given the variables of its scope.
    pub(super) fn types<'b>(&'b self, term: Term, variables: &'b [Variable]) -> &'b [TypeId] {
        match term {
            Term::Variable(variable) => &variables[variable.index()].types,
            Term::Object(object) => &self.problem.objects[object.index()].types,
        }
    }
}

/// What is known about the variables of a condition.
pub(super) struct Simplifier<'a> {
    pub(super) world: &'a World<'a>,
    pub(super) variables: &'a [Variable],
    /// Terms of which no two are the same object: the agents of a joint action.
    pub(super) distinct: &'a [Term],
}

impl Simplifier<'_> {
    /// The same condition, with equalities decided where they can be and variables replaced by what they are equal to.
    pub(super) fn simplify(&self, condition: Condition) -> Condition {
        match condition {
            Condition::All(parts) => {
                Condition::all(parts.into_iter().map(|part| self.simplify(part)))
            }
            Condition::Any(parts) => {
                Condition::any(parts.into_iter().map(|part| self.simplify(part)))
            }
            Condition::Equal(left, right, holds) => self.equal(left, right, holds),
            Condition::Exists(variables, body) => self.exists(variables, self.simplify(*body)),
            Condition::Forall(variables, body) => {
                self.exists(variables, self.simplify(body.not())).not()
            }
            leaf => leaf,
        }
    }

    fn equal(&self, left: Term, right: Term, holds: bool) -> Condition {
        let apart = left != right
            && (self.distinct.contains(&left) && self.distinct.contains(&right)
                || !self.world.overlap(self.types(left), self.types(right)));
        if apart {
            return if holds { Condition::FALSE } else { Condition::TRUE };
        }
        condition::equal(left, right, holds)
    }

    fn types(&self, term: Term) -> &[TypeId] {
        self.world.types(term, self.variables)
    }

    /// `body`, which is simplified, for some binding of `variables`.
    fn exists(&self, mut variables: Vec<VariableId>, body: Condition) -> Condition {
        if let Condition::Any(parts) = body {
            let each = parts.into_iter().map(|part| self.exists(variables.clone(), part));
            return Condition::any(each);
        }
        if let Some((variable, term)) = self.pin(&variables, &body) {
            variables.retain(|&other| other != variable);
            let replaced = body.substitute(&|old| {
                if old == Term::Variable(variable) { term } else { old }
            });
            return self.exists(variables, self.simplify(replaced));
        }
        if let Some(body) = self.distribute(&variables, &body) {
            return self.exists(variables, body);
        }
        // A variable that nothing mentions asks only whether there is an object.
        let idle = |variable: &VariableId| !body.mentions(*variable);
        let empty =
            |variable: &VariableId| self.world.count(&self.variables[variable.index()].types) == 0;
        if variables.iter().any(|variable| idle(variable) && empty(variable)) {
            return Condition::FALSE;
        }
        variables.retain(|variable| !idle(variable));
        Condition::exists(variables, body)
    }

    /// One of the `variables` that must be equal to a term that it can always be.
    fn pin(&self, variables: &[VariableId], body: &Condition) -> Option<(VariableId, Term)> {
        body.conjuncts().iter().find_map(|part| {
            let &Condition::Equal(left, right, true) = part else { return None };
            [(left, right), (right, left)].into_iter().find_map(|(term, other)| {
                let Term::Variable(variable) = term else { return None };
                let types = &self.variables[variable.index()].types;
                let fits =
                    variables.contains(&variable) && self.world.covers(types, self.types(other));
                fits.then_some((variable, other))
            })
        })
    }

    /// The body with its first disjunction of pins multiplied out.
    fn distribute(&self, variables: &[VariableId], body: &Condition) -> Option<Condition> {
        let parts = body.conjuncts();
        let pins = |part: &Condition| match part {
            Condition::Any(parts) => {
                !parts.is_empty() && parts.iter().all(|part| self.pin(variables, part).is_some())
            }
            _ => false,
        };
        let at = parts.iter().position(pins)?;
        let Condition::Any(alternatives) = &parts[at] else { return None };
        let rest = || parts.iter().enumerate().filter(|&(other, _)| other != at);
        let each = alternatives.iter().map(|alternative| {
            let rest = rest().map(|(_, part)| part.clone());
            Condition::all(std::iter::once(alternative.clone()).chain(rest))
        });
        Some(Condition::any(each.collect::<Vec<_>>()))
    }
}
