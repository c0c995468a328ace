//! Whether some schema can make the number of facts that a candidate covers grow.
//!
//! With deletes first and adds last, a schema is harmless when, in a state in which the candidate is not yet broken, it adds at most one
//! covered fact that does not hold already (else it is *heavy*), and whenever it adds one it also deletes a covered fact that holds and
//! does not add that again (else it is *unbalanced*).

use std::cmp::Ordering;

use lang::model::PredicateId;

use crate::grounded::Grounded;
use crate::invariants::candidate::{Candidate, Part};
use crate::invariants::equality::{Classes, Kinds};
use crate::normal::{Atom, Condition, Filter, Normal, Schema, Term};

/// What the check of a candidate says.
pub(super) enum Verdict {
    /// No schema makes its weight grow.
    Holds,
    /// A schema adds two facts at once.
    Heavy,
    /// A schema adds a fact and deletes none that is covered: these candidates cover one that it does delete.
    Unbalanced(Vec<Open>),
}

/// A condition as far as it is understood.
struct Known<'a> {
    positive: Vec<&'a Atom>,
    negative: Vec<&'a Atom>,
    equal: Vec<(Term, Term)>,
    distinct: Vec<(Term, Term)>,
    /// Whether it says more than that.
    more: bool,
}

impl<'a> Known<'a> {
    /// Whether it always holds.
    fn is_truth(&self) -> bool {
        let literals = self.positive.len() + self.negative.len();
        literals + self.equal.len() + self.distinct.len() == 0 && !self.more
    }

    fn new(condition: &'a Condition) -> Self {
        let mut known = Self {
            positive: Vec::new(),
            negative: Vec::new(),
            equal: Vec::new(),
            distinct: Vec::new(),
            more: !condition.universals.is_empty(),
        };
        for literal in &condition.literals {
            if literal.positive {
                known.positive.push(&literal.atom);
            } else {
                known.negative.push(&literal.atom);
            }
        }
        let mut filters: Vec<&Filter> = condition.filters.iter().collect();
        while let Some(filter) = filters.pop() {
            match filter {
                Filter::All(children) => filters.extend(children),
                Filter::Atom(atom) => known.positive.push(atom),
                Filter::Equal(left, right) => known.equal.push((*left, *right)),
                Filter::Not(child) => match &**child {
                    Filter::Equal(left, right) => known.distinct.push((*left, *right)),
                    Filter::Atom(atom) => known.negative.push(atom),
                    _ => known.more = true,
                },
                Filter::Any(_) | Filter::Exists(..) | Filter::Forall(..) => known.more = true,
            }
        }
        known
    }
}

/// An effect.
struct Change<'a> {
    atom: &'a Atom,
    variables: &'a [u32],
    condition: Known<'a>,
}

/// A schema, prepared.
struct Action<'a> {
    schema: &'a Schema,
    /// For each variable the kinds that it may have, and those of which it may be any object.
    kinds: Vec<(u64, u64)>,
    precondition: Known<'a>,
    adds: Vec<Change<'a>>,
    deletes: Vec<Change<'a>>,
    taken: Vec<Taken<'a>>,
}

/// An atom of a precondition that the schema always deletes, word for word: what balances most adds, so that few need more thought.
struct Taken<'a> {
    atom: &'a Atom,
    /// The only add effect on its predicate, if there is one.
    rival: Option<usize>,
}

impl<'a> Taken<'a> {
    fn all(precondition: &Known<'a>, adds: &[Change<'a>], deletes: &[Change<'a>]) -> Vec<Self> {
        let always = |atom: &Atom| {
            let same = |delete: &&Change| delete.variables.is_empty() && delete.atom == atom;
            deletes.iter().filter(same).any(|delete| delete.condition.is_truth())
        };
        let taken = |&&atom: &&&'a Atom| {
            let mut rivals =
                (0..adds.len()).filter(|&add| adds[add].atom.predicate == atom.predicate);
            let rival = rivals.next();
            (rivals.next().is_none() && always(atom)).then_some(Self { atom, rival })
        };
        precondition.positive.iter().filter_map(|atom| taken(&atom)).collect()
    }
}

/// All schemas, prepared.
pub(super) struct Actions<'a> {
    kinds: &'a Kinds,
    all: Vec<Action<'a>>,
    /// For each predicate the actions that add it, with the effects that do.
    adders: Vec<Vec<(u32, u32)>>,
}

impl<'a> Actions<'a> {
    /// Prepares the schemas of a problem: those with instances, or `all` of them.
    pub(super) fn new(
        normal: &'a Normal,
        grounded: &Grounded,
        all: bool,
        kinds: &'a Kinds,
    ) -> Self {
        let apart = apart(normal, grounded);
        let mut adders = vec![Vec::new(); normal.predicates.len()];
        let mut actions = Vec::with_capacity(normal.schemas.len());
        for schema in &normal.schemas {
            // An action without any instance cannot break anything.
            let apart = match &apart[schema.action.index()] {
                Some(apart) => apart.as_slice(),
                None if all => &[],
                None => continue,
            };
            let change = |effect: &'a crate::normal::Effect| Change {
                atom: &effect.literal.atom,
                variables: &effect.variables,
                condition: Known::new(&effect.condition),
            };
            let (adds, deletes): (Vec<_>, Vec<_>) =
                schema.effects.iter().partition(|effect| effect.literal.positive);
            let mut precondition = Known::new(&schema.condition);
            precondition.distinct.extend(
                apart.iter().map(|&(left, right)| (Term::Variable(left), Term::Variable(right))),
            );
            for (index, add) in adds.iter().enumerate() {
                let adders: &mut Vec<_> = &mut adders[add.literal.atom.predicate.index()];
                adders.push((actions.len() as u32, index as u32));
            }
            let adds: Vec<Change> = adds.into_iter().map(change).collect();
            let deletes: Vec<Change> = deletes.into_iter().map(change).collect();
            actions.push(Action {
                schema,
                kinds: schema.variables.iter().map(|variable| kinds.of(variable)).collect(),
                taken: Taken::all(&precondition, &adds, &deletes),
                precondition,
                adds,
                deletes,
            });
        }
        Self { kinds, all: actions, adders }
    }

    /// Whether some effect adds facts of a predicate.
    pub(super) fn adds(&self, predicate: u32) -> bool {
        !self.adders[predicate as usize].is_empty()
    }

    /// Checks what is open about a candidate.
    ///
    /// Where one that it extends was found harmless, it is harmless itself: it rules out more states and covers more that is deleted.
    pub(super) fn check(&self, open: &Open, work: &mut u64) -> Verdict {
        let candidate = &open.candidate;
        let mut last = None;
        for &(action, _) in &self.adders[open.fresh as usize] {
            *work += 1;
            let again = last.replace(action) == Some(action);
            if !again && self.all[action as usize].is_heavy(candidate, self.kinds, work) {
                return Verdict::Heavy;
            }
        }
        for (position, part) in candidate.parts.iter().enumerate() {
            let adders = &self.adders[part.predicate as usize];
            for (number, &(action, add)) in adders.iter().enumerate().skip(open.checked[position]) {
                *work += 1;
                let action = &self.all[action as usize];
                if action.is_plainly_balanced(add as usize, part, candidate) {
                    continue;
                }
                let scene =
                    action.scene_of(&action.adds[add as usize], part, candidate, self.kinds);
                if scene.is_possible(work) && !action.is_balanced(add as usize, &scene, work) {
                    let settled = |(index, other): (usize, &Part)| match index.cmp(&position) {
                        Ordering::Less => self.adders[other.predicate as usize].len(),
                        Ordering::Equal => number,
                        Ordering::Greater => open.checked[index],
                    };
                    let checked: Vec<usize> =
                        candidate.parts.iter().enumerate().map(settled).collect();
                    let extend = |part: Part| open.extend(&checked, part);
                    return Verdict::Unbalanced(
                        action.extensions(&scene).into_iter().map(extend).collect(),
                    );
                }
            }
        }
        Verdict::Holds
    }
}

/// A candidate and what has been checked of it.
pub(super) struct Open {
    pub(super) candidate: Candidate,
    /// The predicate of the last part: whether what is added of it makes a schema heavy is not known yet.
    fresh: u32,
    /// For each part how many of the add effects on it are known to be balanced.
    checked: Vec<usize>,
}

impl Open {
    /// Nothing of a candidate of one part is known.
    pub(super) fn new(candidate: Candidate) -> Self {
        Self { fresh: candidate.parts[0].predicate, candidate, checked: vec![0] }
    }

    /// With one more part, of which nothing is known.
    fn extend(&self, checked: &[usize], part: Part) -> Self {
        let fresh = part.predicate;
        let place = self.candidate.parts.partition_point(|other| other.predicate < fresh);
        let mut checked = checked.to_vec();
        checked.insert(place, 0);
        Self { candidate: self.candidate.with(part), fresh, checked }
    }
}

/// For each action of the domain the pairs of parameters that are never the same object in an instance; `None` without instances.
fn apart(normal: &Normal, grounded: &Grounded) -> Vec<Option<Vec<(u32, u32)>>> {
    let count = normal.schemas.iter().map(|schema| schema.action.index() + 1).max().unwrap_or(0);
    let mut parameters = vec![0; count];
    for schema in &normal.schemas {
        parameters[schema.action.index()] = schema.parameters as u32;
    }
    let mut apart: Vec<Option<Vec<(u32, u32)>>> = vec![None; count];
    for operator in &grounded.operators {
        let arguments =
            &grounded.arguments[operator.arguments.start as usize..operator.arguments.end as usize];
        let count = parameters[operator.action.index()];
        let pairs = apart[operator.action.index()].get_or_insert_with(|| {
            (0..count).flat_map(|left| (left + 1..count).map(move |right| (left, right))).collect()
        });
        pairs.retain(|&(left, right)| arguments[left as usize] != arguments[right as usize]);
    }
    apart
}

/// An atom whose quantified variables may be those of a second copy.
#[derive(Clone, Copy)]
struct Placed<'a> {
    atom: &'a Atom,
    copy: bool,
}

/// What is assumed about a state and a binding of the variables of a schema.
#[derive(Clone)]
struct Scene<'a> {
    candidate: &'a Candidate,
    /// How many variables an instance binds: those behind have a second copy.
    bound: u32,
    /// By how much the second copy is shifted.
    shift: u32,
    classes: Classes<'a>,
    distinct: Vec<(Term, Term)>,
    positive: Vec<Placed<'a>>,
    negative: Vec<Placed<'a>>,
    /// The parameters of the candidate.
    key: Vec<Term>,
}

impl<'a> Scene<'a> {
    fn term(&self, term: Term, copy: bool) -> Term {
        match term {
            Term::Variable(variable) if copy && variable >= self.bound => {
                Term::Variable(variable + self.shift)
            }
            term => term,
        }
    }

    fn argument(&self, placed: Placed<'a>, position: usize) -> Term {
        self.term(placed.atom.arguments[position], placed.copy)
    }

    /// Assumes a condition.
    fn assume(&mut self, known: &Known<'a>, copy: bool) {
        for &(left, right) in &known.equal {
            self.classes.unify(self.term(left, copy), self.term(right, copy));
        }
        for &(left, right) in &known.distinct {
            self.distinct.push((self.term(left, copy), self.term(right, copy)));
        }
        self.positive.extend(known.positive.iter().map(|&atom| Placed { atom, copy }));
        self.negative.extend(known.negative.iter().map(|&atom| Placed { atom, copy }));
    }

    /// Whether two atoms are the same for sure.
    fn same(&self, left: Placed<'a>, right: Placed<'a>) -> bool {
        left.atom.predicate == right.atom.predicate
            && (0..left.atom.arguments.len()).all(|position| {
                self.classes.same(self.argument(left, position), self.argument(right, position))
            })
    }

    /// Whether two terms are different objects for sure.
    fn apart(&self, left: Term, right: Term) -> bool {
        let (left, right) = (self.classes.root(left), self.classes.root(right));
        let objects = matches!((left, right), (Term::Object(a), Term::Object(b)) if a != b);
        let said = |&(a, b): &(Term, Term)| {
            let (a, b) = (self.classes.root(a), self.classes.root(b));
            (a, b) == (left, right) || (b, a) == (left, right)
        };
        objects
            || self.classes.kinds(left) & self.classes.kinds(right) == 0
            || self.distinct.iter().any(said)
    }

    /// Whether the candidate covers an atom under its parameters for sure; then the part that does.
    fn covers(&self, placed: Placed<'a>) -> Option<&'a Part> {
        let part = self.candidate.part(placed.atom.predicate.0)?;
        let equal = |(&term, &position): (&Term, &u32)| {
            self.classes.same(term, self.argument(placed, position as usize))
        };
        self.key.iter().zip(&part.order).all(equal).then_some(part)
    }

    /// Whether nothing is known to contradict itself, and the candidate is not broken already.
    fn is_possible(&self, work: &mut u64) -> bool {
        *work += 1 + ((self.negative.len() + 1) * self.positive.len() + self.distinct.len()) as u64;
        if self.classes.is_broken()
            || self.distinct.iter().any(|&(left, right)| self.classes.same(left, right))
            || self
                .negative
                .iter()
                .any(|&atom| self.positive.iter().any(|&other| self.same(atom, other)))
        {
            return false;
        }
        let mut first: Option<(Placed<'a>, &Part)> = None;
        for &atom in &self.positive {
            let Some(part) = self.covers(atom) else { continue };
            let Some((other, other_part)) = first else {
                first = Some((atom, part));
                continue;
            };
            let differ = match (part.counted, other_part.counted) {
                _ if part.predicate != other_part.predicate => true,
                (Some(position), Some(_)) => self.apart(
                    self.argument(atom, position as usize),
                    self.argument(other, position as usize),
                ),
                _ => false,
            };
            if differ {
                return false;
            }
        }
        true
    }
}

impl<'a> Action<'a> {
    /// The action is applicable, its effect `add` fires, and what it adds, which the candidate covers, does not hold yet.
    fn scene_of(
        &self,
        add: &Change<'a>,
        part: &Part,
        candidate: &'a Candidate,
        kinds: &'a Kinds,
    ) -> Scene<'a> {
        let bound = self.schema.bound;
        let possible =
            self.kinds.iter().chain(&self.kinds[bound..]).map(|&(some, _)| some).collect();
        let mut scene = Scene {
            candidate,
            bound: bound as u32,
            shift: (self.kinds.len() - bound) as u32,
            classes: Classes::new(kinds, possible),
            distinct: Vec::new(),
            positive: Vec::new(),
            negative: vec![Placed { atom: add.atom, copy: false }],
            key: part.order.iter().map(|&position| add.atom.arguments[position as usize]).collect(),
        };
        scene.assume(&self.precondition, false);
        scene.assume(&add.condition, false);
        scene
    }

    /// Whether two covered facts that do not hold may be added at once.
    fn is_heavy(&self, candidate: &'a Candidate, kinds: &'a Kinds, work: &mut u64) -> bool {
        for (index, add) in self.adds.iter().enumerate() {
            let Some(part) = candidate.part(add.atom.predicate.0) else { continue };
            let mut scene = None;
            for (position, second) in self.adds.iter().enumerate().skip(index) {
                let Some(other) = candidate.part(second.atom.predicate.0) else { continue };
                if position == index && second.variables.is_empty() {
                    continue;
                }
                let scene = scene.get_or_insert_with(|| self.scene_of(add, part, candidate, kinds));
                let mut scene = scene.clone();
                scene.assume(&second.condition, true);
                let (first, second) = (
                    Placed { atom: add.atom, copy: false },
                    Placed { atom: second.atom, copy: true },
                );
                for (parameter, &argument) in other.order.iter().enumerate() {
                    scene
                        .classes
                        .unify(scene.key[parameter], scene.argument(second, argument as usize));
                }
                if scene.same(first, second) {
                    continue;
                }
                if part.predicate == other.predicate
                    && let Some(counted) = part.counted
                {
                    scene.distinct.push((
                        scene.argument(first, counted as usize),
                        scene.argument(second, counted as usize),
                    ));
                }
                scene.negative.push(second);
                if scene.is_possible(work) {
                    return true;
                }
            }
        }
        false
    }

    /// Whether the schema always deletes an atom that is covered word for word as the added one is.
    fn is_plainly_balanced(&self, add: usize, part: &Part, candidate: &Candidate) -> bool {
        let added = &self.adds[add];
        self.taken.iter().any(|taken| {
            let Some(other) = candidate.part(taken.atom.predicate.0) else { return false };
            let same = |(&left, &right): (&u32, &u32)| {
                added.atom.arguments[left as usize] == taken.atom.arguments[right as usize]
            };
            // Another instance of the same effect might add it again.
            let again = match taken.rival {
                None => false,
                Some(rival) => rival != add || !added.variables.is_empty(),
            };
            !again && part.order.iter().zip(&other.order).all(same)
        })
    }

    /// Whether a covered fact that holds is deleted for good where the add fires.
    fn is_balanced(&self, add: usize, scene: &Scene<'a>, work: &mut u64) -> bool {
        scene
            .positive
            .iter()
            .any(|&held| scene.covers(held).is_some() && self.takes_away(add, held, scene, work))
    }

    /// Whether some effect deletes what holds, for sure.
    fn loses(&self, held: Placed<'a>, scene: &Scene<'a>) -> bool {
        let mut deletes =
            self.deletes.iter().filter(|delete| delete.atom.predicate == held.atom.predicate);
        deletes.any(|delete| self.deletes(delete, held, scene))
    }

    /// Whether some effect deletes what holds, for sure, and none adds it again.
    fn takes_away(&self, add: usize, held: Placed<'a>, scene: &Scene<'a>, work: &mut u64) -> bool {
        self.loses(held, scene)
            && !self.adds.iter().enumerate().any(|(position, again)| {
                let other = position != add || !again.variables.is_empty();
                other
                    && again.atom.predicate == held.atom.predicate
                    && Self::may_add(again, held, scene, work)
            })
    }

    /// Whether an add may make the atom true.
    fn may_add(again: &Change<'a>, held: Placed<'a>, scene: &Scene<'a>, work: &mut u64) -> bool {
        let mut scene = scene.clone();
        scene.assume(&again.condition, true);
        let added = Placed { atom: again.atom, copy: true };
        for position in 0..held.atom.arguments.len() {
            scene.classes.unify(scene.argument(held, position), scene.argument(added, position));
        }
        scene.is_possible(work)
    }

    /// Whether an instance of the delete fires for sure and deletes what holds.
    fn deletes(&self, delete: &Change<'a>, held: Placed<'a>, scene: &Scene<'a>) -> bool {
        let mut binding: Vec<(u32, Term)> = Vec::new();
        for (position, &term) in delete.atom.arguments.iter().enumerate() {
            let value = scene.argument(held, position);
            match term {
                Term::Variable(variable) if delete.variables.contains(&variable) => {
                    match binding.iter().find(|&&(bound, _)| bound == variable) {
                        Some(&(_, bound)) if scene.classes.same(bound, value) => {}
                        None if scene.classes.kinds(value) & !self.kinds[variable as usize].1
                            == 0 =>
                        {
                            binding.push((variable, value));
                        }
                        _ => return false,
                    }
                }
                term if scene.classes.same(term, value) => {}
                _ => return false,
            }
        }
        Self::implied(&delete.condition, delete.variables, &binding, scene)
    }

    /// Whether a condition holds for sure under a binding of its quantified variables.
    fn implied(
        known: &Known<'a>,
        variables: &[u32],
        binding: &[(u32, Term)],
        scene: &Scene<'a>,
    ) -> bool {
        let value = |term: Term| match term {
            Term::Variable(variable) if variables.contains(&variable) => {
                binding.iter().find(|&&(bound, _)| bound == variable).map(|&(_, value)| value)
            }
            term => Some(term),
        };
        let same = |left: Term, right: Term| {
            value(left).is_some_and(|left| scene.classes.same(left, right))
        };
        let among = |atom: &Atom, list: &[Placed<'a>]| {
            list.iter().any(|&other| {
                other.atom.predicate == atom.predicate
                    && atom
                        .arguments
                        .iter()
                        .enumerate()
                        .all(|(position, &term)| same(term, scene.argument(other, position)))
            })
        };
        // The atom that is added is assumed not to hold, which only says something about facts that change.
        !known.more
            && known.positive.iter().all(|atom| among(atom, &scene.positive))
            && known.negative.iter().all(|atom| among(atom, &scene.negative))
            && known
                .equal
                .iter()
                .all(|&(left, right)| value(right).is_some_and(|right| same(left, right)))
            && known.distinct.iter().all(|&(left, right)| {
                value(left)
                    .is_some_and(|left| value(right).is_some_and(|right| scene.apart(left, right)))
            })
    }

    /// Parts that would help: an atom over the same parameters that holds and is deleted where the add fires.
    ///
    /// Whether that atom may be added again is left to the check of the extended candidate, which knows more.
    fn extensions(&self, scene: &Scene<'a>) -> Vec<Part> {
        let mut extended = Vec::new();
        for &held in &scene.positive {
            let PredicateId(predicate) = held.atom.predicate;
            let arity = held.atom.arguments.len();
            let fits = arity == scene.key.len() || arity == scene.key.len() + 1;
            if !fits || scene.candidate.part(predicate).is_some() || !self.loses(held, scene) {
                continue;
            }
            let mut orders: Vec<Vec<u32>> = vec![Vec::new()];
            for &term in &scene.key {
                let mut longer = Vec::new();
                for order in &orders {
                    for position in (0..arity as u32).filter(|position| !order.contains(position)) {
                        if scene.classes.same(term, scene.argument(held, position as usize)) {
                            longer.push(order.iter().copied().chain([position]).collect());
                        }
                    }
                }
                orders = longer;
            }
            for order in orders {
                let counted = (0..arity as u32).find(|position| !order.contains(position));
                extended.push(Part { predicate, order, counted });
            }
        }
        extended
    }
}
