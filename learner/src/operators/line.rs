//! Deeds go in; a trace comes out: one state after another, in the words of a domain, and between them one named action each.

use std::collections::{BTreeMap, BTreeSet};

use lang::model::{ActionId, Object, ObjectId, PredicateId, TypeId};
use lang::plan::Step;

use crate::log::HandId;
use crate::observe::Thing;
use crate::trace::vocabulary::{declare_action, find_object};
use crate::trace::{FactId, Joint, Trace};

use super::deed::{Deed, Deeds, Verb};
use super::name;
use super::record::{Record, Told};
use super::words::{Lexicon, Words};

/// A deed as an instance of an action.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Its place in [`Deeds::deeds`].
    pub deed: usize,
    /// The action.
    pub action: ActionId,
    /// Its arguments, which index the objects of the trace.
    pub arguments: Vec<ObjectId>,
}

/// A demonstration as a trace.
#[derive(Debug, Clone)]
pub struct Line {
    /// The trace.
    pub trace: Trace,
    /// The deeds that stand in it, in its order.
    pub instances: Vec<Instance>,
    /// The deeds for whose effects there are no words, by their names.
    pub mute: Vec<String>,
    /// How many changes were left out because nobody was near.
    pub strays: usize,
}

/// The state as it is written down, and what it is written with.
struct Scribe<'a> {
    record: &'a Record,
    words: &'a Words,
    lexicon: &'a mut Lexicon,
    objects: Vec<Object>,
}

impl Scribe<'_> {
    /// What holds, as facts; only what the acting hand does where the words name no hands.
    fn facts(
        &mut self,
        state: &BTreeSet<Told>,
        acting: Option<HandId>,
    ) -> BTreeSet<(PredicateId, Vec<ObjectId>)> {
        let mut facts = BTreeSet::new();
        for told in state {
            if let Some(fact) = self.words.fact(&self.record.header, told, acting) {
                facts.extend(self.lexicon.fact(&self.objects, &fact));
            }
        }
        facts
    }

    /// The arguments of a deed: who does it, to what, and what else changes.
    fn arguments(
        &self,
        deed: &Deed,
        changed: &[&(PredicateId, Vec<ObjectId>)],
        agents: bool,
    ) -> Option<Vec<ObjectId>> {
        let header = &self.record.header;
        let mut arguments: Vec<ObjectId> = Vec::new();
        let mut add = |id: Option<ObjectId>| {
            arguments.extend(id.filter(|id| !arguments.contains(id)));
        };
        let actor = self.words.actors[deed.hand.index()].as_deref();
        let actor = actor.and_then(|name| find_object(&self.objects, name));
        let named = self.words.names_hands();
        if agents || named {
            add(Some(actor?));
        }
        let objects = deed.object.into_iter().chain(deed.also.iter().copied());
        for object in objects {
            add(find_object(&self.objects, &header.objects[object.index()].name));
        }
        for (_, of) in changed {
            for &id in of {
                add(Some(id));
            }
        }
        Some(arguments)
    }
}

/// Writes deeds down; new actions, and new words where the domain is open, go into `lexicon`.
///
/// With `agents` the one who acts is the agent of each action.
pub fn line(
    record: &Record,
    deeds: &Deeds,
    words: &Words,
    lexicon: &mut Lexicon,
    agents: bool,
) -> Line {
    let objects = lexicon.objects(&record.header, words);
    let mut scribe = Scribe { record, words, lexicon, objects };
    let mut state: BTreeSet<Told> = record.initial.clone();
    let mut trace = Trace::new(record.name.clone(), &scribe.lexicon.domain);
    trace.objects.clone_from(&scribe.objects);
    let mut instances = Vec::new();
    let mut mute: BTreeMap<String, u32> = BTreeMap::new();
    let whole = words.names_hands();
    let mut strays = deeds.strays.iter().peekable();
    let mut cut = true;
    for (place, deed) in deeds.deeds.iter().enumerate() {
        while let Some(stray) = strays.next_if(|stray| stray.time <= deed.at) {
            set(&mut state, &stray.told, stray.holds);
            cut = true;
        }
        let acting = (!whole).then_some(deed.hand);
        let before = scribe.facts(&state, acting);
        for (told, holds) in &deed.changes {
            set(&mut state, told, *holds);
        }
        let after = scribe.facts(&state, acting);
        let changed: Vec<_> = before.symmetric_difference(&after).collect();
        // What holds before and after in some other words changed nothing that can be said.
        if words.actors[deed.hand.index()].is_none() {
            cut |= !changed.is_empty();
            continue;
        }
        if changed.is_empty() && deed.verb != Verb::Hold {
            if !deed.changes.is_empty() {
                *mute.entry(name::name(&record.header, deed)).or_default() += 1;
            }
            continue;
        }
        let changed = ordered(deed, &changed, &mut scribe);
        let Some(arguments) = scribe.arguments(deed, &changed, agents) else {
            // The one who acts is nobody in the words of the domain.
            *mute.entry(name::name(&record.header, deed)).or_default() += 1;
            cut = true;
            continue;
        };
        let action = action(&mut scribe, record, deed, &arguments, agents);
        let before: Vec<FactId> = put(&mut trace, &before);
        let after: Vec<FactId> = put(&mut trace, &after);
        // Where the words name no hands, each deed is seen by the hand that does it, so that states do not follow from one another.
        if trace.states.is_empty() {
            trace.state(before);
        } else if cut || !whole {
            trace.step(Joint { parts: Vec::new(), whole: false });
            trace.state(before);
        }
        cut = false;
        let step = Step { action, arguments: arguments.clone().into_boxed_slice() };
        trace.step(Joint { parts: vec![Some(step)], whole: true });
        trace.state(after);
        instances.push(Instance { deed: place, action, arguments });
    }
    let mute = mute.into_keys().collect();
    Line { trace, instances, mute, strays: deeds.strays.len() }
}

/// Makes something hold or not.
fn set(state: &mut BTreeSet<Told>, told: &Told, holds: bool) {
    if holds {
        state.insert(told.clone());
    } else {
        state.remove(told);
    }
}

/// Facts as ids of the trace.
fn put(trace: &mut Trace, facts: &BTreeSet<(PredicateId, Vec<ObjectId>)>) -> Vec<FactId> {
    facts.iter().map(|(predicate, arguments)| trace.fact(*predicate, arguments)).collect()
}

/// What changed in the order in which the deed tells of it, so that arguments stand in the order in which a person would name them.
fn ordered<'f>(
    deed: &Deed,
    changed: &[&'f (PredicateId, Vec<ObjectId>)],
    scribe: &mut Scribe<'_>,
) -> Vec<&'f (PredicateId, Vec<ObjectId>)> {
    let mut rank: Vec<(PredicateId, Vec<ObjectId>)> = Vec::new();
    let mut turns: Vec<&Told> = deed.changes.iter().map(|(told, _)| told).collect();
    // First what is said of the thing itself.
    let main = deed.object.map(Thing::Object);
    turns.sort_by_key(|told| (told.ground.things.first().copied() != main, told.ground.relation));
    for told in turns {
        if let Some(fact) = scribe.words.fact(&scribe.record.header, told, Some(deed.hand)) {
            rank.extend(scribe.lexicon.fact(&scribe.objects, &fact));
        }
    }
    let mut changed = changed.to_vec();
    let at = |fact: &(PredicateId, Vec<ObjectId>)| {
        rank.iter().position(|other| other == fact).unwrap_or(usize::MAX)
    };
    changed.sort_by_key(|&fact| (at(fact), fact));
    changed
}

/// The action of which a deed is an instance; it is declared if there is none of this name with these types of parameters.
fn action(
    scribe: &mut Scribe<'_>,
    record: &Record,
    deed: &Deed,
    arguments: &[ObjectId],
    agents: bool,
) -> ActionId {
    let types: Vec<TypeId> =
        arguments.iter().map(|id| scribe.objects[id.index()].types[0]).collect();
    let stem = name::name(&record.header, deed);
    let domain = &mut scribe.lexicon.domain;
    for number in 1.. {
        let text = if number == 1 { stem.clone() } else { format!("{stem}-{number}") };
        let found = domain.actions.iter().position(|one| one.name.text.eq_ignore_ascii_case(&text));
        let Some(place) = found else {
            let types: Vec<Vec<TypeId>> = types.iter().map(|&one| vec![one]).collect();
            return declare_action(domain, &text, &types, agents);
        };
        let action = &domain.actions[place];
        let parameters = &action.scope.variables[..action.scope.parameters as usize];
        let fits = action.agent == agents
            && parameters.len() == types.len()
            && parameters.iter().zip(&types).all(|(variable, &of)| {
                variable.types.iter().any(|&wanted| domain.is_subtype(of, wanted))
            });
        if fits {
            return ActionId(place as u32);
        }
    }
    unreachable!("there is always another number")
}
