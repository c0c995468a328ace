//! Traces go in; groups of facts that exclude each other in all of their states come out, for the annotations `:exactly-one` and `:at-most-one`.
//!
//! That two facts never held together may be chance. So a group is only made of predicates between which something was seen to change hands:
//! a step ended the one fact of an object and began the other.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lang::model::{Domain, ObjectId, PredicateId};

use crate::trace::{State, Trace};

/// Atoms of which no two hold for the same object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Invariant {
    /// The atoms.
    pub parts: Vec<Part>,
    /// One of them holds in every state.
    pub exactly: bool,
}

/// An atom of an [`Invariant`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part {
    /// Its predicate.
    pub predicate: PredicateId,
    /// Which of its arguments is the object that all parts share; none where the whole world is.
    pub key: Option<u8>,
}

/// How often each part holds for each object in one state.
type Counts = BTreeMap<(Part, Option<ObjectId>), u32>;

/// The groups that hold in all states of all traces, the widest first.
pub fn invariants(domain: &Domain, traces: &[Trace]) -> Vec<Invariant> {
    let mut most: BTreeMap<Part, u32> = BTreeMap::new();
    let mut together: BTreeSet<(Part, Part)> = BTreeSet::new();
    let mut exchanged: BTreeSet<(Part, Part)> = BTreeSet::new();
    let all: Vec<Vec<Counts>> = traces
        .iter()
        .map(|trace| trace.states.iter().map(|state| counts(domain, trace, state)).collect())
        .collect();
    for (trace, states) in traces.iter().zip(&all) {
        for state in states {
            for (&(part, object), &count) in state {
                let entry = most.entry(part).or_default();
                *entry = count.max(*entry);
                let others = state.range((Part { predicate: PredicateId(0), key: None }, None)..);
                together.extend(
                    others
                        .filter(|((other, of), _)| {
                            *of == object
                                && *other != part
                                && other.key.is_some() == part.key.is_some()
                        })
                        .map(|((other, _), _)| (part, *other)),
                );
            }
        }
        for (joint, (before, after)) in
            trace.steps.iter().zip(states.iter().zip(states.iter().skip(1)))
        {
            if joint.whole {
                exchange(before, after, &mut exchanged);
            }
        }
    }
    let alone: Vec<Part> =
        most.iter().filter(|(_, most)| **most <= 1).map(|(part, _)| *part).collect();
    let mut groups: Vec<Vec<Part>> = Vec::new();
    for &seed in &alone {
        let mut group = vec![seed];
        while let Some(&next) = alone.iter().find(|&&part| {
            !group.contains(&part)
                && group.iter().all(|&one| {
                    !together.contains(&(one, part)) && one.key.is_some() == part.key.is_some()
                })
                && group.iter().any(|&one| exchanged.contains(&(one, part)))
        }) {
            group.push(next);
        }
        group.sort_unstable();
        // A single part says something where it passes from one thing to another.
        let says = group.len() > 1
            && group.iter().all(|&part| {
                part.key.is_some() || arity(domain, part) == 0 || varied(traces, part)
            });
        if says && !groups.contains(&group) {
            groups.push(group);
        }
    }
    // What is not always one of them may be a matter of chance.
    let exactly = |parts: &Vec<Part>| always(domain, traces, &all, parts);
    let mut found: Vec<Invariant> = groups
        .into_iter()
        .filter(exactly)
        .map(|parts| Invariant { parts, exactly: true })
        .collect();
    // What follows from another group is no news.
    let copies = found.clone();
    found.retain(|one| {
        !copies.iter().any(|other| {
            other != one
                && (other.exactly || !one.exactly)
                && one.parts.iter().all(|part| other.parts.contains(part))
        })
    });
    found.sort_by_key(|one| (std::cmp::Reverse(one.parts.len()), one.parts.clone()));
    found
}

/// Whether more than one object had a property.
fn varied(traces: &[Trace], part: Part) -> bool {
    let objects: BTreeSet<String> = traces
        .iter()
        .flat_map(|trace| trace.facts.iter().map(move |fact| (trace, fact)))
        .filter(|(_, fact)| fact.predicate == part.predicate)
        .map(|(trace, fact)| trace.objects[fact.arguments[0].index()].name.text.clone())
        .collect();
    objects.len() > 1
}

fn arity(domain: &Domain, part: Part) -> usize {
    domain.predicates[part.predicate.index()].parameters.len()
}

/// How often each part holds for each object.
fn counts(domain: &Domain, trace: &Trace, state: &State) -> Counts {
    let mut counts = Counts::new();
    for &id in state.facts() {
        let fact = &trace.facts[id.index()];
        let predicate = fact.predicate;
        for (place, &object) in fact.arguments.iter().enumerate() {
            let part = Part { predicate, key: Some(place as u8) };
            *counts.entry((part, Some(object))).or_default() += 1;
        }
        if domain.predicates[predicate.index()].parameters.len() <= 1 {
            *counts.entry((Part { predicate, key: None }, None)).or_default() += 1;
        }
    }
    counts
}

/// Notes which parts gave way to which for some object.
fn exchange(before: &Counts, after: &Counts, exchanged: &mut BTreeSet<(Part, Part)>) {
    let keys: BTreeSet<&(Part, Option<ObjectId>)> = before.keys().chain(after.keys()).collect();
    let mut lost: BTreeMap<Option<ObjectId>, Vec<Part>> = BTreeMap::new();
    let mut won: BTreeMap<Option<ObjectId>, Vec<Part>> = BTreeMap::new();
    for key in keys {
        let (was, is) =
            (before.get(key).copied().unwrap_or(0), after.get(key).copied().unwrap_or(0));
        if was > is {
            lost.entry(key.1).or_default().push(key.0);
        }
        if is > was {
            won.entry(key.1).or_default().push(key.0);
        }
    }
    for (object, parts) in lost {
        for &part in &parts {
            for &other in won.get(&object).into_iter().flatten() {
                exchanged.insert((part, other));
                exchanged.insert((other, part));
            }
        }
    }
}

/// Whether one part holds in every state, for every object of which all parts can be said.
fn always(domain: &Domain, traces: &[Trace], all: &[Vec<Counts>], parts: &[Part]) -> bool {
    let fits = |trace: &Trace, object: ObjectId| {
        parts.iter().all(|part| {
            let Some(key) = part.key else { return false };
            let wanted =
                &domain.predicates[part.predicate.index()].parameters[usize::from(key)].types;
            domain.has_type(&trace.objects[object.index()], wanted)
        })
    };
    let mut met: BTreeSet<Part> = BTreeSet::new();
    let always = traces.iter().zip(all).all(|(trace, states)| {
        let objects: Vec<Option<ObjectId>> = if parts[0].key.is_none() {
            vec![None]
        } else {
            (0..trace.objects.len() as u32)
                .map(ObjectId)
                .filter(|&id| fits(trace, id))
                .map(Some)
                .collect()
        };
        states.iter().all(|state| {
            objects.iter().all(|&object| {
                let held = parts.iter().filter(|part| state.contains_key(&(**part, object)));
                let held: Vec<Part> = held.copied().collect();
                met.extend(&held);
                !held.is_empty()
            })
        })
    });
    always && parts.iter().all(|part| met.contains(part))
}

/// An invariant as an annotation without `;@`, such as `(:exactly-one (open ?drawer) (closed ?drawer))`.
pub fn annotation(domain: &Domain, invariant: &Invariant) -> String {
    let mut text = if invariant.exactly { "(:exactly-one" } else { "(:at-most-one" }.to_owned();
    let first = invariant.parts[0];
    let shared = first.key.map(|key| {
        let variable = &domain.predicates[first.predicate.index()].parameters[usize::from(key)];
        domain.types[variable.types[0].index()].name.text.to_ascii_lowercase()
    });
    let mut used: Vec<String> = shared.iter().cloned().collect();
    for part in &invariant.parts {
        let predicate = &domain.predicates[part.predicate.index()];
        let _ = write!(text, " ({}", predicate.name.text);
        for (place, variable) in predicate.parameters.iter().enumerate() {
            let name = if part.key == Some(place as u8) {
                shared.clone().expect("a part with a key has a shared variable")
            } else {
                let stem = domain.types[variable.types[0].index()].name.text.to_ascii_lowercase();
                let mut name = stem.clone();
                for number in 2.. {
                    if !used.contains(&name) {
                        break;
                    }
                    name = format!("{stem}{number}");
                }
                used.push(name.clone());
                name
            };
            let _ = write!(text, " ?{name}");
        }
        text.push(')');
    }
    text.push(')');
    text
}
