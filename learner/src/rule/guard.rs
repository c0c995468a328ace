//! What remains open about an action's effects goes in; what has to be demanded of its parameters, so that it makes no difference, comes out.
//!
//! Where one of several atoms is an effect and it is not clear which, they may still all be the same fact: then their terms are demanded to be equal.
//! Where a fact is surely the same afterwards if two parameters are two objects, and is not if they are one, they are demanded to be different.

use lang::model::{Action, Atom, Domain, Term};

use super::candidate::may_be_one;
use super::evidence::{Claim, Evidence, LiteralId, Record};
use super::settle::{Settled, Status};

/// What has to be demanded.
#[derive(Debug, Clone, Default)]
pub(super) struct Guard {
    pub(super) same: Vec<(Term, Term)>,
    pub(super) distinct: Vec<(Term, Term)>,
    /// Which atoms must not hold, since it is not clear whether they are deleted.
    pub(super) absent: Vec<usize>,
    /// Which atoms are added: of all that are the same fact under the guard one that stands for them.
    pub(super) adds: Vec<usize>,
    /// Which are deleted, in the same way.
    pub(super) deletes: Vec<usize>,
}

/// A possible effect that stays unclear.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unclear {
    pub(super) literal: LiteralId,
    pub(super) claim: Claim,
}

/// What is known of the action that is looked at.
pub(super) struct Guarding<'e> {
    pub(super) evidence: &'e Evidence,
    pub(super) settled: &'e Settled,
    pub(super) record: &'e Record,
    pub(super) action: &'e Action,
    /// Which of its atoms are demanded.
    pub(super) required: &'e [bool],
    /// Nothing is taken for granted about what an action deletes that it does not demand.
    pub(super) strict: bool,
    /// Which of its atoms are effects because a partner is demanded.
    pub(super) shared: &'e [bool],
}

impl Guarding<'_> {
    /// The guard, or what no guard helps against.
    pub(super) fn guard(&self) -> Result<Guard, Unclear> {
        let mut guard = Guard::default();
        loop {
            let classes = self.classes(&guard);
            let harm = classes.iter().find_map(|class| self.harm(class, &guard));
            let Some(unclear) = harm else {
                self.settle(&classes, &mut guard);
                self.keep_apart(&classes, &mut guard);
                return Ok(guard);
            };
            let at = (unclear.literal.0 - self.record.first) as usize;
            if unclear.claim == Claim::Deletes && !self.disputed(at) && !self.required[at] {
                guard.absent.push(at);
            } else if !self.unite(unclear, &mut guard) {
                return Err(unclear);
            }
        }
    }

    /// The atoms, those that are the same fact under the guard together.
    fn classes(&self, guard: &Guard) -> Vec<Vec<usize>> {
        let mut classes: Vec<(Atom, Vec<usize>)> = Vec::new();
        for (at, atom) in self.record.atoms.iter().enumerate() {
            if guard.same.is_empty() {
                classes.push((atom.clone(), vec![at]));
                continue;
            }
            let arguments = atom.arguments.iter().map(|term| representative(guard, *term));
            let image = Atom { predicate: atom.predicate, arguments: arguments.collect() };
            match classes.iter_mut().find(|(known, _)| *known == image) {
                Some((_, class)) => class.push(at),
                None => classes.push((image, vec![at])),
            }
        }
        classes.into_iter().map(|(_, class)| class).collect()
    }

    /// Notes the effects that come because all that may have them is the same fact.
    fn settle(&self, classes: &[Vec<usize>], guard: &mut Guard) {
        for class in classes.iter().filter(|class| class.len() > 1) {
            if class.iter().any(|at| self.adds(*at) == Status::Yes) {
                continue;
            }
            if self.whole_clause(class, Claim::Adds) {
                guard.adds.push(class[0]);
            } else if self.whole_clause(class, Claim::Deletes) {
                guard.deletes.push(class[0]);
            }
        }
    }

    fn id(&self, at: usize) -> LiteralId {
        LiteralId(self.record.first + at as u32)
    }

    fn adds(&self, at: usize) -> Status {
        let settled = self.settled.adds[self.id(at).index()];
        if self.shared[at] && settled == Status::Open { Status::Yes } else { settled }
    }

    fn deletes(&self, at: usize) -> Status {
        let settled = self.settled.deletes[self.id(at).index()];
        if self.shared[at] && settled == Status::Open { Status::Yes } else { settled }
    }

    /// Whether something was deleted, and it is not clear whether by this or by another.
    fn disputed(&self, at: usize) -> bool {
        let literal = self.id(at);
        self.settled
            .open
            .iter()
            .any(|clause| clause.claim == Claim::Deletes && clause.literals.contains(&literal))
    }

    /// Whether it may be deleted where it holds. What an action does not demand, and what nothing speaks for, it is taken not to delete.
    fn may_delete(&self, at: usize, guard: &Guard) -> bool {
        self.deletes(at) == Status::Open
            && self.record.counts[at].held > 0
            && (self.strict || self.required[at] || self.disputed(at))
            && !guard.absent.contains(&at)
    }

    /// Whether a literal may be what a clause speaks of.
    fn may(&self, claim: Claim, literal: LiteralId) -> bool {
        let lists = [&self.settled.adds, &self.settled.deletes];
        let [adds, deletes] = lists.map(|list| list[literal.index()] != Status::No);
        (adds && claim != Claim::Deletes) || (deletes && claim != Claim::Adds)
    }

    /// Whether all that may be the cause of some change is in the class, so that it comes in any case.
    fn whole_clause(&self, class: &[usize], claim: Claim) -> bool {
        let inside = |literal: &LiteralId| {
            let at = literal.0.checked_sub(self.record.first);
            at.is_some_and(|at| class.contains(&(at as usize)))
        };
        self.settled.open.iter().any(|clause| {
            let mut open = clause.literals.iter().filter(|literal| self.may(claim, **literal));
            clause.claim == claim && open.all(inside)
        })
    }

    /// Whether some clause says that the fact is kept, and nothing else may delete it.
    fn kept(&self, class: &[usize], guard: &Guard) -> bool {
        if class.iter().any(|at| self.deletes(*at) == Status::Yes) {
            return false;
        }
        self.settled.open.iter().filter(|clause| clause.claim == Claim::Keeps).any(|clause| {
            let mut open = clause.literals.iter().filter(|one| self.may(Claim::Keeps, **one));
            let mut gone = class.iter().filter(|at| self.may_delete(**at, guard));
            open.all(|one| class.iter().any(|at| self.id(*at) == *one))
                && gone.all(|at| clause.literals.contains(&self.id(*at)))
        })
    }

    /// What makes it unclear whether the fact that all of `class` are holds afterwards.
    fn harm(&self, class: &[usize], guard: &Guard) -> Option<Unclear> {
        if self.whole_clause(class, Claim::Adds) {
            return None;
        }
        let held = class.iter().any(|at| self.required[*at]);
        if held && self.kept(class, guard) {
            return None;
        }
        self.doubt(class, guard).filter(|unclear| {
            unclear.claim == Claim::Adds || !self.whole_clause(class, Claim::Deletes)
        })
    }

    /// The same where only effects that are written count, as for atoms that happen to be the same fact.
    fn doubt(&self, class: &[usize], guard: &Guard) -> Option<Unclear> {
        let any = |test: &dyn Fn(usize) -> bool| class.iter().copied().find(|at| test(*at));
        if any(&|at| self.adds(at) == Status::Yes || guard.adds.contains(&at)).is_some() {
            return None;
        }
        let deleted = any(&|at| self.deletes(at) == Status::Yes || guard.deletes.contains(&at));
        let may_delete = any(&|at| self.may_delete(at, guard));
        if let Some(at) = any(&|at| self.adds(at) == Status::Open) {
            let held = class.iter().any(|at| self.required[*at]);
            let kept = deleted.is_none() && may_delete.is_none();
            return (!held || !kept).then(|| Unclear { literal: self.id(at), claim: Claim::Adds });
        }
        let at = may_delete.filter(|_| deleted.is_none())?;
        Some(Unclear { literal: self.id(at), claim: Claim::Deletes })
    }

    /// Demands that all that may be the cause of a change are the same fact; says whether that is possible.
    fn unite(&self, unclear: Unclear, guard: &mut Guard) -> bool {
        let first = self.record.first;
        let own = |literal: &LiteralId| {
            let at = literal.0.checked_sub(first).map(|at| at as usize);
            at.filter(|at| *at < self.record.atoms.len())
        };
        let before = guard.same.len();
        for clause in &self.settled.open {
            let about = clause.claim == unclear.claim || clause.claim == Claim::Keeps;
            if !about || !clause.literals.contains(&unclear.literal) {
                continue;
            }
            let open: Vec<&LiteralId> = clause
                .literals
                .iter()
                .filter(|literal| self.may(clause.claim, **literal))
                .collect();
            let Some(atoms) = open.iter().map(|literal| own(literal)).collect::<Option<Vec<_>>>()
            else {
                continue;
            };
            for at in atoms.iter().skip(1) {
                let pair = [atoms[0], *at].map(|at| &self.record.atoms[at].arguments);
                for (one, other) in pair[0].iter().zip(pair[1]) {
                    let pair = [one, other].map(|term| representative(guard, *term));
                    if pair[0] != pair[1] {
                        guard.same.push((pair[0].min(pair[1]), pair[0].max(pair[1])));
                    }
                }
            }
            if guard.same.len() > before {
                return true;
            }
        }
        false
    }

    /// Demands that terms are different where it would be unclear what holds afterwards if they were not.
    fn keep_apart(&self, classes: &[Vec<usize>], guard: &mut Guard) {
        let fixed = guard.clone();
        let open = |at: &usize| self.adds(*at) == Status::Open || self.may_delete(*at, &fixed);
        let gone = |at: &usize| {
            let written = self.deletes(*at) == Status::Yes || fixed.deletes.contains(at);
            written || self.may_delete(*at, &fixed)
        };
        let doubtful = |class: &&Vec<usize>| class.iter().any(open);
        let deletes = |class: &&Vec<usize>| class.iter().any(gone);
        let deleting: Vec<&Vec<usize>> = classes.iter().filter(deletes).collect();
        for class in classes.iter().filter(doubtful) {
            for other in &deleting {
                if std::ptr::eq(class, *other) {
                    continue;
                }
                let [one, two] = [class, *other].map(|class| &self.record.atoms[class[0]]);
                if one.predicate != two.predicate {
                    continue;
                }
                let both: Vec<usize> = class.iter().chain(other.iter()).copied().collect();
                if self.doubt(&both, &fixed).is_some() {
                    self.separate(one, two, guard);
                }
            }
        }
    }

    /// Demands that two atoms are not the same fact, unless they cannot be, or it is demanded already.
    fn separate(&self, one: &Atom, other: &Atom, guard: &mut Guard) {
        let domain: &Domain = &self.evidence.domain;
        let pairs = one.arguments.iter().zip(&other.arguments).map(|(one, other)| {
            let (one, other) = (representative(guard, *one), representative(guard, *other));
            (one.min(other), one.max(other))
        });
        let pairs: Vec<(Term, Term)> = pairs.filter(|(one, other)| one != other).collect();
        let can = |&(one, other): &(Term, Term)| may_be_one(domain, self.action, one, other);
        if !pairs.iter().all(can) || pairs.iter().any(|pair| guard.distinct.contains(pair)) {
            return;
        }
        // What was never seen to be one object is the least loss.
        let unseen = pairs.iter().find(|pair| !self.record.alike.contains(pair));
        guard.distinct.extend(unseen.or(pairs.first()).copied());
    }
}

/// What a term is called where the guard demands that it is another one.
fn representative(guard: &Guard, term: Term) -> Term {
    let mut term = term;
    while let Some((one, _)) = guard.same.iter().find(|(_, other)| *other == term) {
        term = *one;
    }
    term
}
