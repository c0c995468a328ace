//! What the initial state and the names of predicates suggest about facts that no action changes: groups of which one fact holds, taken as no accident.
//!
//! Nothing else can be known of them, since the actions say nothing. Whoever asks is told that a group is presumed, and may do without.

use std::collections::BTreeSet;

use lang::model::{Domain, ObjectId, PredicateId};

use super::open::Open;
use super::vocabulary::{Group, Origin, by_predicate, gather};
use crate::grounded::FactId;

/// Names of opposites.
const OPPOSITES: [(&str, &str); 14] = [
    ("open", "closed"),
    ("open", "shut"),
    ("opened", "closed"),
    ("clear", "blocked"),
    ("clear", "obstructed"),
    ("free", "occupied"),
    ("free", "busy"),
    ("free", "taken"),
    ("empty", "full"),
    ("on", "off"),
    ("locked", "open"),
    ("clean", "dirty"),
    ("alive", "dead"),
    ("enabled", "disabled"),
];

/// Words in the name of a predicate of one argument that say that it is the place of a single thing.
const PLACES: [&str; 7] = ["at", "loc", "location", "pos", "position", "place", "where"];

/// The groups that are presumed of predicates that are in none of `known`.
pub(super) fn groups(open: &Open, domain: &Domain, known: &[Group]) -> Vec<Group> {
    let mut settled: BTreeSet<PredicateId> = known
        .iter()
        .flat_map(|group| &group.facts)
        .map(|fact| open.grounded.facts[fact.index()].predicate)
        .collect();
    let facts = by_predicate(open);
    let mut groups = Vec::new();
    let single: Vec<PredicateId> = facts
        .keys()
        .copied()
        .filter(|id| id.index() < domain.predicates.len() && !open.changes[id.index()])
        .filter(|id| domain.predicates[id.index()].parameters.len() == 1)
        .collect();
    for (number, &one) in single.iter().enumerate() {
        for &other in &single[number + 1..] {
            if settled.contains(&one) || settled.contains(&other) {
                continue;
            }
            let (left, right) = (&facts[&one], &facts[&other]);
            let pairs =
                gather(left.iter().chain(right).map(|&fact| (open.arguments(fact).to_vec(), fact)));
            if are_opposites(open, domain, one, other, &pairs) {
                settled.extend([one, other]);
                groups.extend(presumed(pairs));
            }
        }
    }
    for (&predicate, facts) in &facts {
        if settled.contains(&predicate) || open.changes[predicate.index()] {
            continue;
        }
        if let Some(instances) = function(open, domain, predicate, facts) {
            groups.extend(presumed(instances));
        }
    }
    groups
}

fn presumed(instances: Vec<Vec<FactId>>) -> impl Iterator<Item = Group> {
    instances.into_iter().map(|facts| Group { facts, exactly: true, origin: Origin::Presumed })
}

fn holding(open: &Open, group: &[FactId]) -> usize {
    group.iter().filter(|fact| open.initial[fact.index()]).count()
}

/// Whether a group is about objects that exist: of new ones the initial state says nothing.
fn is_old(open: &Open, group: &[FactId]) -> bool {
    group.iter().any(|&fact| open.needs(fact).is_empty())
}

/// Whether two predicates of one argument are never both true of an object: they are called opposites, or of every object exactly one is true, and each of
/// some. `pairs` has the facts of both, by object.
fn are_opposites(
    open: &Open,
    domain: &Domain,
    one: PredicateId,
    other: PredicateId,
    pairs: &[Vec<FactId>],
) -> bool {
    if pairs.iter().any(|pair| pair.len() != 2 || holding(open, pair) > 1) {
        return false;
    }
    let name = |id: PredicateId| domain.predicates[id.index()].name.text.to_lowercase();
    let (left, right) = (name(one), name(other));
    let named = OPPOSITES.iter().any(|&(a, b)| {
        let replaced = |from: &str, a: &str, b: &str| {
            let words: Vec<&str> = from.split(['-', '_']).collect();
            let swap = |word: &&str| if *word == a { b.to_owned() } else { (*word).to_owned() };
            words.iter().map(swap).collect::<Vec<_>>()
        };
        let words = |name: &str| name.split(['-', '_']).map(str::to_owned).collect::<Vec<_>>();
        left != right
            && (replaced(&left, a, b) == words(&right) || replaced(&right, a, b) == words(&left))
    });
    let negated = |a: &str, b: &str| {
        ["un", "not-", "not_", "non-", "in", "dis"]
            .iter()
            .any(|prefix| a.strip_prefix(prefix) == Some(b))
    };
    let some = |id: PredicateId| {
        let of = |fact: &&FactId| open.grounded.facts[fact.index()].predicate == id;
        pairs.iter().flatten().filter(of).any(|fact| open.initial[fact.index()])
    };
    let mut old = pairs.iter().filter(|pair| is_old(open, pair));
    let shown = old.all(|pair| holding(open, pair) == 1) && some(one) && some(other);
    named || negated(&left, &right) || negated(&right, &left) || shown
}

/// The facts of a predicate by all arguments but one, if for all of them exactly one holds. A predicate of one argument has to be called like a place.
fn function(
    open: &Open,
    domain: &Domain,
    predicate: PredicateId,
    facts: &[FactId],
) -> Option<Vec<Vec<FactId>>> {
    let arity = open.arguments(*facts.first()?).len();
    if arity == 1 {
        let name = domain.predicates.get(predicate.index())?.name.text.to_lowercase();
        if !name.split(['-', '_']).any(|word| PLACES.contains(&word)) {
            return None;
        }
    }
    (0..arity).rev().find_map(|counted| {
        let keyed = facts.iter().map(|&fact| {
            let mut key: Vec<ObjectId> = open.arguments(fact).to_vec();
            key.remove(counted);
            (key, fact)
        });
        let instances = gather(keyed);
        let one = |group: &Vec<FactId>| group.len() > 1 && holding(open, group) == 1;
        let old: Vec<&Vec<FactId>> = instances.iter().filter(|one| is_old(open, one)).collect();
        ((old.len() > 1 || arity == 1) && old.into_iter().all(one)).then_some(instances)
    })
}
