//! What was observed in the beginning of a demonstration goes in; a problem as text comes out, in the words of a domain.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lang::format::format;
use lang::model::{Domain, TypeId};

use crate::log::{Fact, Header};
use crate::operators::record::{Record, Told};
use crate::operators::words::Words;

/// What a problem is made of.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Situation {
    /// Objects with their types.
    pub objects: Vec<(String, String)>,
    /// What holds.
    pub facts: BTreeSet<Fact>,
}

/// What held in the beginning of a demonstration, as far as the domain has words for it.
pub fn beginning(domain: &Domain, record: &Record, words: &Words) -> Situation {
    situation(domain, record, words, &record.initial)
}

/// What held in its end.
pub fn end(domain: &Domain, record: &Record, words: &Words) -> Situation {
    let mut state = record.initial.clone();
    for turn in &record.changes {
        if turn.holds {
            state.insert(turn.told.clone());
        } else {
            state.remove(&turn.told);
        }
    }
    situation(domain, record, words, &state)
}

fn situation(domain: &Domain, record: &Record, words: &Words, state: &BTreeSet<Told>) -> Situation {
    let header = &record.header;
    let mut objects: Vec<(String, String)> = Vec::new();
    let mut types: BTreeMap<String, TypeId> = BTreeMap::new();
    let known: Vec<&str> = domain.constants.iter().map(|one| one.name.text.as_str()).collect();
    let things = header.objects.iter().map(|one| (one.name.clone(), one.kind.clone()));
    let actors = words.actors.iter().flatten().map(|name| (name.clone(), words.actor_type.clone()));
    for (object, kind) in things.chain(actors) {
        let Some(of) = type_of(domain, header, &kind) else { continue };
        if types.insert(object.to_ascii_lowercase(), of).is_none()
            && !known.iter().any(|one| one.eq_ignore_ascii_case(&object))
        {
            objects.push((object, domain.types[of.index()].name.text.clone()));
        }
    }
    let fits = |fact: &Fact| {
        domain.predicates.iter().any(|predicate| {
            predicate.name.text.eq_ignore_ascii_case(&fact.predicate)
                && predicate.parameters.len() == fact.arguments.len()
                && predicate.parameters.iter().zip(&fact.arguments).all(|(variable, name)| {
                    types.get(&name.to_ascii_lowercase()).is_some_and(|&of| {
                        variable.types.iter().any(|&wanted| domain.is_subtype(of, wanted))
                    })
                })
        })
    };
    let facts = state.iter().filter_map(|told| words.fact(header, told, None)).filter(fits);
    Situation { objects, facts: facts.collect() }
}

/// The nearest type that the domain has, from that of an object upwards.
fn type_of(domain: &Domain, header: &Header, kind: &str) -> Option<TypeId> {
    let mut kind = kind.to_owned();
    for _ in 0..=header.types.len() {
        let found = domain.types.iter().position(|one| one.name.text.eq_ignore_ascii_case(&kind));
        if let Some(place) = found {
            return Some(TypeId(place as u32));
        }
        kind = header.types.iter().find(|one| one.name == kind)?.parent.clone()?;
    }
    None
}

/// What came about from one situation to another: the goal of who showed it, as far as that can be seen.
pub fn achieved(before: &Situation, after: &Situation) -> String {
    let facts: Vec<String> = after.facts.difference(&before.facts).map(fact).collect();
    match facts.as_slice() {
        [one] => one.clone(),
        several => format!("(and {})", several.join(" ")),
    }
}

fn fact(fact: &Fact) -> String {
    let mut text = format!("({}", fact.predicate);
    for argument in &fact.arguments {
        text.push(' ');
        text.push_str(argument);
    }
    text.push(')');
    text
}

/// A problem in which `situation` is the beginning; `goal` is the text of a condition.
pub fn text(domain: &Domain, title: &str, situation: &Situation, goal: &str) -> String {
    let mut text = format!("(define (problem {title})\n(:domain {})\n(:objects", domain.name.text);
    let mut by_type: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (object, kind) in &situation.objects {
        by_type.entry(kind).or_default().push(object);
    }
    for (kind, names) in by_type {
        let _ = write!(text, "\n{} - {kind}", names.join(" "));
    }
    text.push_str(")\n(:init");
    for one in &situation.facts {
        text.push('\n');
        text.push_str(&fact(one));
    }
    let _ = write!(text, ")\n(:goal {goal}))\n");
    format(&text).unwrap_or(text)
}
