//! The actions of a domain go in; sets of predicates come out of which no action alone makes more true than it makes false,
//! such as that a key is free or that somebody has it (Helmert 2009, *invariant candidates*, section 5, with one parameter).

use std::collections::VecDeque;

use hashbrown::HashSet;

use super::part::{Change, Part};
use crate::model::{Atom, Domain, PredicateId, Term};

/// How many candidates are looked at.
const CANDIDATES: usize = 400;

/// Of all facts of the members that agree on the object at the key, no action alone makes more true than it makes false.
pub(super) struct Invariant {
    members: Vec<Member>,
    /// What it rests on.
    pub(super) trust: Trust,
}

/// What is taken to be true before it is deleted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Trust {
    /// What is demanded.
    Demanded,
    /// Everything, as whoever writes a delete believes.
    Deleted,
}

/// A predicate, and where the object stands that the invariant is about; without it, the invariant is about the whole state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Member {
    predicate: PredicateId,
    key: Option<usize>,
}

impl Invariant {
    /// What the invariant is about where an atom is one of its facts.
    pub(super) fn about(&self, atom: &Atom) -> Option<About> {
        about(&self.members, atom)
    }
}

/// What facts have in common of which an invariant counts how many there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum About {
    State,
    Object(Term),
}

impl About {
    /// The object, if it is one.
    pub(super) fn object(self) -> Option<Term> {
        match self {
            Self::State => None,
            Self::Object(term) => Some(term),
        }
    }
}

fn about(members: &[Member], atom: &Atom) -> Option<About> {
    let member = members.iter().find(|member| member.predicate == atom.predicate)?;
    Some(member.key.map_or(About::State, |position| About::Object(atom.arguments[position])))
}

/// What an action does to a candidate.
enum Verdict {
    Keeps,
    /// It adds too much, whatever else is counted.
    Heavy,
    /// It would keep the candidate if one of these were counted too.
    Lacks(Vec<Member>),
}

/// The invariants that are found.
pub(super) fn find(domain: &Domain, parts: &[Part<'_>], trust: Trust) -> Vec<Invariant> {
    let mut added: Vec<PredicateId> = parts
        .iter()
        .flat_map(|part| &part.changes)
        .flat_map(|change| change.literals)
        .filter(|literal| literal.positive)
        .map(|literal| literal.atom.predicate)
        .collect();
    added.sort_unstable();
    added.dedup();
    let mut open: VecDeque<Vec<Member>> = VecDeque::new();
    for predicate in added {
        let arity = domain.predicates[predicate.index()].parameters.len();
        let keys = (0..arity).map(Some).chain([None]);
        open.extend(keys.map(|key| vec![Member { predicate, key }]));
    }
    let mut seen: HashSet<Vec<Member>> = open.iter().cloned().collect();
    let mut found = Vec::new();
    while let Some(members) = open.pop_front() {
        let broken = parts
            .iter()
            .map(|part| judge(&members, part, trust))
            .find(|verdict| !matches!(verdict, Verdict::Keeps));
        match broken {
            None => found.push(Invariant { members, trust }),
            Some(Verdict::Lacks(wanted)) => {
                for member in wanted {
                    let mut more = members.clone();
                    more.push(member);
                    more.sort_unstable();
                    if seen.len() < CANDIDATES && seen.insert(more.clone()) {
                        open.push_back(more);
                    }
                }
            }
            Some(_) => {}
        }
    }
    unite(&mut found, &mut seen, parts);
    found
}

/// Adds what is kept of what two that share a member count together: a key that is free may be taken, or else put away.
fn unite(found: &mut Vec<Invariant>, seen: &mut HashSet<Vec<Member>>, parts: &[Part<'_>]) {
    let mut at = 0;
    while at < found.len() {
        for other in 0..at {
            let (one, two) = (&found[at], &found[other]);
            if !one.members.iter().any(|member| two.members.contains(member)) {
                continue;
            }
            let mut members = [one.members.as_slice(), &two.members].concat();
            members.sort_unstable();
            members.dedup();
            let clear = members.windows(2).all(|pair| pair[0].predicate != pair[1].predicate);
            let trust = one.trust;
            let new = clear && seen.len() < CANDIDATES && seen.insert(members.clone());
            if new
                && parts.iter().all(|part| matches!(judge(&members, part, trust), Verdict::Keeps))
            {
                found.push(Invariant { members, trust });
            }
        }
        at += 1;
    }
}

fn judge(members: &[Member], part: &Part<'_>, trust: Trust) -> Verdict {
    let mut adds: Vec<(About, &Atom)> = Vec::new();
    for change in &part.changes {
        for literal in change.literals.iter().filter(|literal| literal.positive) {
            let atom = &literal.atom;
            let Some(key) = about(members, atom) else { continue };
            if part.demands(change, atom) {
                continue;
            }
            let twice = adds.iter().any(|&(other, added)| other == key && added != atom);
            if twice || spreads(members, change, key, atom) {
                return Verdict::Heavy;
            }
            adds.push((key, atom));
            let paid = consumed(part, change, trust);
            if paid.iter().all(|atom| about(members, atom) != Some(key)) {
                return Verdict::Lacks(payments(members, &paid, key));
            }
        }
    }
    Verdict::Keeps
}

/// Whether a change may add several facts with one key: another argument is what it is done for each of,
/// and no fact of the same members settles which one that is.
fn spreads(members: &[Member], change: &Change<'_>, key: About, atom: &Atom) -> bool {
    let bound = |term: &Term| match term {
        Term::Variable(id) => change.variables.contains(id),
        Term::Object(_) => false,
    };
    let settled = |term: &Term| {
        change.condition.conjuncts().iter().any(|conjunct| match conjunct {
            crate::condition::Condition::Atom(other, true) => {
                let fixed = about(members, other).and_then(About::object);
                fixed.is_some_and(|fixed| fixed != *term && !bound(&fixed))
                    && other.arguments.contains(term)
            }
            _ => false,
        })
    };
    atom.arguments.iter().any(|term| About::Object(*term) != key && bound(term) && !settled(term))
}

/// What of all that a change consumes could be counted too, so that what it adds is paid for.
fn payments(members: &[Member], consumed: &[&Atom], key: About) -> Vec<Member> {
    let mut found = Vec::new();
    for atom in consumed {
        let predicate = atom.predicate;
        if members.iter().any(|member| member.predicate == predicate) {
            continue;
        }
        match key {
            About::State => found.push(Member { predicate, key: None }),
            About::Object(key) => {
                let places = atom.arguments.iter().enumerate().filter(|(_, term)| **term == key);
                found.extend(places.map(|(place, _)| Member { predicate, key: Some(place) }));
            }
        }
    }
    found
}

/// What is true before and deleted along with a change, and not added again.
fn consumed<'m>(part: &Part<'m>, change: &Change<'m>, trust: Trust) -> Vec<&'m Atom> {
    let along: Vec<_> = part.along(change).collect();
    let again = |atom: &Atom| along.iter().any(|other| other.positive && other.atom == *atom);
    let deleted = along.iter().filter(|literal| !literal.positive).map(|literal| &literal.atom);
    let held = |atom: &Atom| trust == Trust::Deleted || part.demands(change, atom);
    deleted.filter(|atom| held(atom) && !again(atom)).collect()
}
