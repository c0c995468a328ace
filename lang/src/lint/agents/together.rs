//! Two actions go in, and which of their terms are the same object; whether two agents can take them in one joint step comes out.
//!
//! Objects that need not be the same are taken as different ones, so that an answer is about the most general such pair.

use std::cell::Cell;

use hashbrown::{HashMap, HashSet};

use super::invariant::{About, Invariant};
use super::part::{AGENT, Part};
use crate::condition::Condition;
use crate::model::{ActionAtom, Atom, Domain, ObjectId, PredicateId, Term, TypeId, VariableId};

/// Which of the two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    First,
    Second,
}

impl Side {
    pub(super) fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }
}

/// Both of them.
const SIDES: [Side; 2] = [Side::First, Side::Second];

/// What keeps two actions from being taken in one step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// One agent would have to take both.
    Agent,
    /// No object is of all the types it would have to be of.
    Types,
    /// They demand what cannot hold together.
    Opposite,
    /// The condition of one does not hold beside the other.
    Refused(Side),
}

/// How much is asked of an answer that the two exclude each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Proof {
    /// It may be so for other reasons than that the terms are as they are.
    Likely,
    /// It is so whatever objects the terms stand for.
    Certain,
}

/// How many parts of conditions are looked at: quantifiers that stand in one another have many instances.
const STEPS: u32 = 20_000;

/// Two actions, each by an agent of its own.
pub(super) struct Together<'p, 'm> {
    domain: &'m Domain,
    parts: [&'p Part<'m>; 2],
    /// What holds of each beside its precondition.
    beside: [&'p Condition; 2],
    proof: Proof,
    /// For each variable of the first, of the second and for each constant, one that is the same object; itself if it speaks for all of them.
    same: Vec<usize>,
    /// How many more parts of conditions are looked at.
    steps: Cell<u32>,
}

/// What the variables of quantifiers stand for, the innermost last; nothing if it may be anything.
type Binding = Vec<(VariableId, Option<usize>)>;

impl<'p, 'm> Together<'p, 'm> {
    pub(super) fn new(
        domain: &'m Domain,
        parts: [&'p Part<'m>; 2],
        beside: [&'p Condition; 2],
        proof: Proof,
    ) -> Self {
        let variables = parts.iter().map(|part| part.action.scope.variables.len());
        let terms = variables.sum::<usize>() + domain.constants.len();
        Self { domain, parts, beside, proof, same: (0..terms).collect(), steps: Cell::new(STEPS) }
    }

    pub(super) fn part(&self, side: Side) -> &'p Part<'m> {
        self.parts[side as usize]
    }

    /// The place of a term in `same`.
    fn place(&self, side: Side, term: Term) -> usize {
        let first = self.parts[0].action.scope.variables.len();
        match (side, term) {
            (Side::First, Term::Variable(id)) => id.index(),
            (Side::Second, Term::Variable(id)) => first + id.index(),
            (_, Term::Object(id)) => {
                first + self.parts[1].action.scope.variables.len() + id.index()
            }
        }
    }

    fn speaker(&self, mut place: usize) -> usize {
        while self.same[place] != place {
            place = self.same[place];
        }
        place
    }

    /// Which object a term stands for, as a number that equal ones share.
    pub(super) fn object(&self, side: Side, term: Term) -> usize {
        self.speaker(self.place(side, term))
    }

    /// Makes two terms the same; says whether they were not.
    fn merge(&mut self, one: usize, other: usize) -> bool {
        let (one, other) = (self.speaker(one), self.speaker(other));
        self.same[one] = other;
        one != other
    }

    /// Makes the terms of the one side those of the other.
    pub(super) fn unify(&mut self, first: &[Term], second: &[Term]) {
        for (&one, &other) in first.iter().zip(second) {
            let (one, other) = (self.place(Side::First, one), self.place(Side::Second, other));
            self.merge(one, other);
        }
    }

    /// Makes two terms of the first the same.
    pub(super) fn equate(&mut self, left: Term, right: Term) {
        let (left, right) = (self.place(Side::First, left), self.place(Side::First, right));
        self.merge(left, right);
    }

    /// Whether one agent would have to take both.
    pub(super) fn one_agent(&self) -> bool {
        let [first, second] = SIDES.map(|side| self.object(side, AGENT));
        first == second
    }

    /// The conditions that hold for a side, taken apart.
    fn conjuncts(&self, side: Side) -> impl Iterator<Item = &'p Condition> + use<'p, 'm> {
        let [precondition, beside] = [&self.part(side).precondition, self.beside[side as usize]];
        precondition.conjuncts().iter().chain(beside.conjuncts())
    }

    /// The atoms that hold, or do not, whenever the two are taken.
    fn demands(&self) -> Vec<(Side, &'p Atom, bool)> {
        let of = |side| {
            self.conjuncts(side).filter_map(move |conjunct| match conjunct {
                Condition::Atom(atom, holds) => Some((side, atom, *holds)),
                _ => None,
            })
        };
        SIDES.into_iter().flat_map(of).collect()
    }

    /// Whether two atoms are the same fact.
    pub(super) fn same_fact(&self, one: (Side, &Atom), other: (Side, &Atom)) -> bool {
        let objects = |(side, atom): (Side, &Atom)| -> Vec<usize> {
            atom.arguments.iter().map(|&term| self.object(side, term)).collect()
        };
        one.1.predicate == other.1.predicate && objects(one) == objects(other)
    }

    /// Whether a side demands a fact.
    pub(super) fn holds(&self, side: Side, fact: (Side, &Atom)) -> bool {
        let demands = self.demands();
        demands
            .iter()
            .any(|&(by, atom, holds)| by == side && holds && self.same_fact((by, atom), fact))
    }

    /// Whether each of the two agents has this object by a fact that never changes, so that it is most likely of one of them only.
    pub(super) fn is_tied(&self, object: usize, fixed: &[bool]) -> bool {
        let demands = self.demands();
        SIDES.into_iter().all(|side| {
            demands.iter().any(|&(by, atom, holds)| {
                by == side
                    && holds
                    && fixed[atom.predicate.index()]
                    && atom.arguments.contains(&AGENT)
                    && atom.arguments.iter().any(|&term| self.object(side, term) == object)
            })
        })
    }

    /// Draws the conclusions of what is demanded, and looks for what keeps two agents from taking both in one step.
    pub(super) fn settle(&mut self, exclusive: &[Invariant]) -> Option<Obstacle> {
        while self.conclude(exclusive) {}
        if self.one_agent() {
            return Some(Obstacle::Agent);
        }
        if !self.objects_exist() {
            return Some(Obstacle::Types);
        }
        if self.contradict() || (self.proof == Proof::Likely && self.disagree(exclusive)) {
            return Some(Obstacle::Opposite);
        }
        let refuses = |side: &Side| {
            self.fails(*side, &self.part(*side).precondition, &Binding::new(), false)
                || self.fails(*side, self.beside[*side as usize], &Binding::new(), true)
        };
        SIDES.into_iter().find(refuses).map(Obstacle::Refused)
    }

    /// Whether a fact is demanded and its opposite too.
    fn contradict(&self) -> bool {
        let fact = |side: Side, atom: &Atom| -> (PredicateId, Vec<usize>) {
            let objects = atom.arguments.iter().map(|&term| self.object(side, term));
            (atom.predicate, objects.collect())
        };
        let (held, denied): (Vec<_>, Vec<_>) =
            self.demands().into_iter().partition(|(_, _, holds)| *holds);
        let held: HashSet<_> = held.into_iter().map(|(side, atom, _)| fact(side, atom)).collect();
        denied.into_iter().any(|(side, atom, _)| held.contains(&fact(side, atom)))
    }

    /// Makes the same what equations and invariants say is the same; says whether something was not.
    fn conclude(&mut self, exclusive: &[Invariant]) -> bool {
        let mut equal: Vec<(usize, usize)> = Vec::new();
        for side in SIDES {
            for conjunct in self.conjuncts(side) {
                if let Condition::Equal(left, right, true) = conjunct {
                    equal.push((self.place(side, *left), self.place(side, *right)));
                }
            }
        }
        if self.proof == Proof::Likely {
            for [(one, left), (other, right)] in self.rivals(exclusive) {
                if left.predicate == right.predicate {
                    let terms = left.arguments.iter().zip(&right.arguments);
                    equal.extend(terms.map(|(&l, &r)| (self.place(one, l), self.place(other, r))));
                }
            }
        }
        equal.into_iter().fold(false, |changed, (one, other)| self.merge(one, other) || changed)
    }

    /// Whether facts are demanded of which only one can hold.
    fn disagree(&self, exclusive: &[Invariant]) -> bool {
        let rivals = self.rivals(exclusive);
        rivals.iter().any(|[left, right]| left.1.predicate != right.1.predicate)
    }

    /// The demanded facts of which an invariant says that only one can hold, each with the first of its kind.
    fn rivals(&self, exclusive: &[Invariant]) -> Vec<[(Side, &'p Atom); 2]> {
        let demands = self.demands();
        let mut rivals = Vec::new();
        for invariant in exclusive {
            let mut first: HashMap<usize, (Side, &'p Atom)> = HashMap::new();
            for &(side, atom, holds) in &demands {
                // Of the whole state there may be many such facts from the start; of one object that is rare.
                let about = invariant.about(atom).and_then(About::object).filter(|_| holds);
                let Some(about) = about else { continue };
                let before = *first.entry(self.object(side, about)).or_insert((side, atom));
                if !std::ptr::eq(before.1, atom) || before.0 != side {
                    rivals.push([before, (side, atom)]);
                }
            }
        }
        rivals
    }

    /// Whether something may be of all types that are asked of one object.
    fn objects_exist(&self) -> bool {
        let mut asked: Vec<(Vec<&[TypeId]>, Option<ObjectId>)> =
            vec![(Vec::new(), None); self.same.len()];
        for side in SIDES {
            for (id, variable) in self.part(side).action.scope.variables.iter().enumerate() {
                let place = self.object(side, Term::Variable(VariableId(id as u32)));
                asked[place].0.push(&variable.types);
            }
        }
        for id in (0..self.domain.constants.len()).map(|id| ObjectId(id as u32)) {
            let place = self.object(Side::First, Term::Object(id));
            if asked[place].1.replace(id).is_some() {
                return false;
            }
        }
        let asked = asked.iter().filter(|(lists, object)| lists.len() > 1 || object.is_some());
        asked.into_iter().all(|(lists, object)| match object {
            Some(id) => {
                let object = &self.domain.constants[id.index()];
                lists.iter().all(|list| list.is_empty() || self.domain.has_type(object, list))
            }
            None => self.domain.types.iter().any(|of| {
                let below = |above: &TypeId| of.ancestors.binary_search(above).is_ok();
                lists.iter().all(|list| list.is_empty() || list.iter().any(below))
            }),
        })
    }

    /// Which object a term of a condition stands for, if that is known.
    fn known(&self, side: Side, term: Term, binding: &Binding) -> Option<usize> {
        if let Term::Variable(id) = term
            && let Some((_, bound)) = binding.iter().rev().find(|(variable, _)| *variable == id)
        {
            return bound.map(|place| self.speaker(place));
        }
        let quantified = match term {
            Term::Variable(id) => self.part(side).quantifies(id),
            Term::Object(_) => false,
        };
        (!quantified).then(|| self.object(side, term))
    }

    /// Whether a condition of a side does not hold when the two are taken. The own atom counts where `own` says so.
    fn fails(&self, side: Side, condition: &Condition, binding: &Binding, own: bool) -> bool {
        let Some(left) = self.steps.get().checked_sub(1) else {
            return self.proof == Proof::Likely;
        };
        self.steps.set(left);
        match condition {
            Condition::Atom(..) => false,
            Condition::Equal(left, right, holds) => {
                let terms = [left, right].map(|term| self.known(side, *term, binding));
                let [Some(left), Some(right)] = terms else { return false };
                if *holds { left != right && self.proof == Proof::Likely } else { left == right }
            }
            Condition::Action(atom, false) => {
                let others = [side.other()].into_iter().chain(own.then_some(side));
                others.into_iter().any(|other| self.is_part(side, atom, binding, other))
            }
            Condition::Action(atom, true) => self.is_refused(side, atom, binding),
            Condition::All(parts) => parts.iter().any(|part| self.fails(side, part, binding, own)),
            Condition::Any(parts) => parts.iter().all(|part| self.fails(side, part, binding, own)),
            Condition::Exists(variables, body) => {
                self.fails(side, body, &extended(binding, variables), own)
            }
            Condition::Forall(variables, body) => {
                let anything = extended(binding, variables);
                let mut instances = vec![anything.clone()];
                body.visit(&mut |leaf| {
                    if let Condition::Action(atom, false) = leaf {
                        let others = [side.other()].into_iter().chain(own.then_some(side));
                        let instance = |other| self.instance(side, atom, &anything, other);
                        instances.extend(others.filter_map(instance));
                    }
                });
                instances.iter().any(|instance| self.fails(side, body, instance, own))
            }
        }
    }

    /// Whether an action atom is one of the two.
    fn is_part(&self, side: Side, atom: &ActionAtom, binding: &Binding, of: Side) -> bool {
        let part = self.part(of);
        let own = part.parameters().map(|term| Some(self.object(of, term)));
        atom.action == part.id
            && atom.arguments.iter().map(|&term| self.known(side, term, binding)).eq(own)
    }

    /// Whether the agent of an action atom does something else.
    fn is_refused(&self, side: Side, atom: &ActionAtom, binding: &Binding) -> bool {
        let Some(agent) = atom.arguments.first() else { return false };
        let agent = self.known(side, *agent, binding);
        SIDES.into_iter().any(|of| {
            let part = self.part(of);
            let differs = || {
                let mut terms = atom.arguments.iter().zip(part.parameters());
                terms.any(|(&term, own)| {
                    let known = self.known(side, term, binding);
                    known.is_some_and(|known| known != self.object(of, own))
                })
            };
            agent == Some(self.object(of, AGENT))
                && (atom.action != part.id || (self.proof == Proof::Likely && differs()))
        })
    }

    /// What the variables of a quantifier must be for an action atom to be one of the two, if it can be that.
    /// Those of quantifiers further inside are left for them.
    fn instance(
        &self,
        side: Side,
        atom: &ActionAtom,
        binding: &Binding,
        of: Side,
    ) -> Option<Binding> {
        let part = self.part(of);
        let mut instance = binding.clone();
        for (&term, own) in atom.arguments.iter().zip(part.parameters()) {
            let place = self.place(of, own);
            let open = match term {
                Term::Variable(id) => instance.iter_mut().rev().find(|(bound, _)| *bound == id),
                Term::Object(_) => None,
            };
            match open {
                Some((id, bound @ None)) if self.may_be(side, *id, of, own) => *bound = Some(place),
                Some((_, None)) => return None,
                _ => {
                    let known = self.known(side, term, &instance);
                    if known.is_some_and(|known| known != self.speaker(place)) {
                        return None;
                    }
                }
            }
        }
        (atom.action == part.id).then_some(instance)
    }

    /// Whether a variable of a quantifier may stand for a parameter; where a proof is asked, for whatever the parameter stands for.
    fn may_be(&self, side: Side, variable: VariableId, of: Side, parameter: Term) -> bool {
        let Term::Variable(parameter) = parameter else { return true };
        let wanted = &self.part(side).action.scope.variables[variable.index()].types;
        let given = &self.part(of).action.scope.variables[parameter.index()].types;
        let fits = |sub: &TypeId| wanted.iter().any(|&above| self.domain.is_subtype(*sub, above));
        self.proof == Proof::Likely || wanted.is_empty() || given.iter().all(fits)
    }
}

/// With variables of which nothing is known.
fn extended(binding: &Binding, variables: &[VariableId]) -> Binding {
    binding.iter().copied().chain(variables.iter().map(|&variable| (variable, None))).collect()
}
