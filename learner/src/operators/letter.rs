//! Records of demonstrations go in; the operators of algorithm 4 of the thesis come out, as it is printed, for comparison with what [`super::learn`] makes of the same.
//!
//! What the printed text leaves open is decided so: nothing is created in the first frame, which has no state before it (line 5);
//! an environment change is credited as [`super::deed`] does it (line 15); operators are equal if they are so up to the names of their variables (line 18).

use std::collections::BTreeMap;

use lang::model::{ActionId, Atom, ObjectId, PredicateId, Term, TypeId, VariableId};

use crate::log::{Fact, HandId, HandState, Header};
use crate::observe::{Ground, Relation, Thing};
use crate::rule::{Action, Learned, Rule};
use crate::segment::Tree;
use crate::trace::vocabulary::declare_action;
use crate::truth::Activity;

use super::deed::responsible;
use super::record::{Record, Told};
use super::words::{Lexicon, Words};

/// An operator in the making, of certain objects.
#[derive(Debug, Clone)]
struct Entry {
    hand: HandId,
    activity: Activity,
    /// The state of the hand before, and in the end.
    before: Vec<Told>,
    after: Vec<Told>,
    /// What changed around it, and whether it holds afterwards.
    changes: Vec<(Told, bool)>,
}

/// An operator of any objects, by which equal ones are found.
type Shape = (String, Vec<TypeId>, [Vec<(PredicateId, Vec<usize>)>; 2]);

/// Learns operators from demonstrations by algorithm 4.
pub fn learn(
    demonstrations: &[(Record, Words)],
    known: Option<&lang::model::Domain>,
    title: &str,
    tree: &Tree,
) -> Learned {
    let mut lexicon = Lexicon::new(title, known);
    let mut collected: Vec<(Shape, u32, BTreeMap<String, u32>)> = Vec::new();
    for (record, words) in demonstrations {
        let objects = lexicon.objects(&record.header, words);
        for entry in buffer(record, tree) {
            let Some(shape) = shape(&entry, record, words, &mut lexicon, &objects) else {
                continue;
            };
            let place = collected.iter().position(|(other, _, _)| *other == shape);
            let place = place.unwrap_or_else(|| {
                collected.push((shape, 0, BTreeMap::new()));
                collected.len() - 1
            });
            collected[place].1 += 1;
            *collected[place].2.entry(record.name.clone()).or_default() += 1;
        }
    }
    let mut actions = Vec::new();
    let mut names: BTreeMap<String, u32> = BTreeMap::new();
    for ((stem, types, [before, after]), count, sources) in collected {
        let number = names.entry(stem.clone()).or_default();
        *number += 1;
        let name = if *number == 1 { stem } else { format!("{stem}-{number}") };
        let types: Vec<Vec<TypeId>> = types.into_iter().map(|one| vec![one]).collect();
        let action = declare_action(&mut lexicon.domain, &name, &types, false);
        actions.push(operator(action, count, sources, &before, &after));
    }
    Learned {
        domain: lexicon.domain(),
        rule: Rule::Changed,
        actions,
        refused: Vec::new(),
        strays: 0,
    }
}

/// Lines 2 to 16: the operators of one demonstration.
fn buffer(record: &Record, tree: &Tree) -> Vec<Entry> {
    let mut events: Vec<(f64, usize, usize)> = Vec::new();
    for (hand, runs) in record.hands.iter().enumerate() {
        events.extend(runs.iter().enumerate().skip(1).map(|(place, run)| (run.from, hand, place)));
    }
    let hands = record.hands.len();
    events.extend(record.changes.iter().enumerate().map(|(place, turn)| (turn.time, hands, place)));
    events.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    let mut entries: Vec<Entry> = Vec::new();
    let mut last: Vec<Option<usize>> = vec![None; hands];
    for (_, hand, place) in events {
        if hand == hands {
            let turn = &record.changes[place];
            if turn.told.ground.relation.of_hand() {
                continue;
            }
            for hand in responsible(turn) {
                if let Some(entry) = last[hand.index()] {
                    entries[entry].changes.push((turn.told.clone(), turn.holds));
                }
            }
            continue;
        }
        let id = HandId(hand as u32);
        let (before, now) = (record.hands[hand][place - 1].state, record.hands[hand][place].state);
        let told = |state| predicates(&record.header, id, state);
        if tree.classify(&before) == tree.classify(&now) {
            if let Some(entry) = last[hand] {
                entries[entry].after = told(&now);
            }
        } else {
            last[hand] = Some(entries.len());
            entries.push(Entry {
                hand: id,
                activity: tree.classify(&now),
                before: told(&before),
                after: told(&now),
                changes: Vec::new(),
            });
        }
    }
    entries
}

/// `STATEVARTOPREDICATE`: the variables of a hand as what holds.
fn predicates(header: &Header, hand: HandId, state: &HandState) -> Vec<Told> {
    let name = &header.hands[hand.index()].name;
    let told = |relation, object: Option<crate::log::ObjectId>| {
        let mut things = Vec::new();
        let mut arguments = Vec::new();
        if let Some(object) = object {
            things.push(Thing::Object(object));
            arguments.push(header.objects[object.index()].name.clone());
        }
        things.push(Thing::Hand(hand));
        arguments.push(name.clone());
        let fact = Fact { predicate: String::new(), arguments };
        Told { ground: Ground { relation, things }, fact }
    };
    let mut list = Vec::new();
    if state.moves {
        list.push(told(Relation::HandMoves, None));
    }
    if state.acted_on.is_some() {
        list.push(told(Relation::ActedOn, state.acted_on));
    }
    list.push(match state.in_hand {
        None => told(Relation::HandEmpty, None),
        held => told(Relation::InHand, held),
    });
    list
}

/// Lines 7 to 9: what is relevant, of any objects of the same types.
fn shape(
    entry: &Entry,
    record: &Record,
    words: &Words,
    lexicon: &mut Lexicon,
    objects: &[lang::model::Object],
) -> Option<Shape> {
    words.actors[entry.hand.index()].as_ref()?;
    let mut order: Vec<ObjectId> = Vec::new();
    let mut atoms = |told: &Told| {
        let fact = words.fact(&record.header, told, Some(entry.hand))?;
        let (predicate, arguments) = lexicon.fact(objects, &fact)?;
        let places = arguments.iter().map(|id| {
            let known = order.iter().position(|other| other == id);
            known.unwrap_or_else(|| {
                order.push(*id);
                order.len() - 1
            })
        });
        Some((predicate, places.collect::<Vec<usize>>()))
    };
    let mut before: Vec<_> = entry.before.iter().filter_map(&mut atoms).collect();
    let mut after: Vec<_> = entry.after.iter().filter_map(&mut atoms).collect();
    // Only what changed around the hand, by what came of it in the end.
    let mut around: Vec<(Told, bool, bool)> = Vec::new();
    for (told, holds) in &entry.changes {
        match around.iter_mut().find(|(other, _, _)| other == told) {
            Some((_, _, end)) => *end = *holds,
            None => around.push((told.clone(), !holds, *holds)),
        }
    }
    for (told, was, is) in around.iter().filter(|(_, was, is)| was != is) {
        let Some(atom) = atoms(told) else { continue };
        if *was {
            before.push(atom.clone());
        }
        if *is {
            after.push(atom);
        }
    }
    for list in [&mut before, &mut after] {
        list.sort();
        list.dedup();
    }
    if before == after {
        return None;
    }
    let types = order.iter().map(|id| objects[id.index()].types[0]).collect();
    let mut name = match entry.activity {
        Activity::Idle => "idle",
        Activity::Reach => "reach",
        Activity::Take => "take",
        Activity::Put => "put",
        Activity::Granular => "granular",
    }
    .to_owned();
    for told in entry.after.iter().rev() {
        if let Some(Thing::Object(object)) = told.ground.things.first() {
            name.push('-');
            name.push_str(&record.header.objects[object.index()].kind.to_ascii_lowercase());
        }
    }
    Some((name, types, [before, after]))
}

/// An operator with its precondition and effect.
fn operator(
    action: ActionId,
    count: u32,
    sources: BTreeMap<String, u32>,
    before: &[(PredicateId, Vec<usize>)],
    after: &[(PredicateId, Vec<usize>)],
) -> Action {
    let atom = |(predicate, places): &(PredicateId, Vec<usize>)| Atom {
        predicate: *predicate,
        arguments: places.iter().map(|&place| Term::Variable(VariableId(place as u32))).collect(),
    };
    let only = |these: &[(PredicateId, Vec<usize>)], those: &[(PredicateId, Vec<usize>)]| {
        these.iter().filter(|one| !those.contains(one)).map(atom).collect::<Vec<Atom>>()
    };
    let required: Vec<Atom> = before.iter().map(atom).collect();
    Action {
        action,
        count,
        sources: sources.into_iter().collect(),
        changed: required.clone(),
        required,
        absent: only(after, before),
        same: Vec::new(),
        distinct: Vec::new(),
        adds: only(after, before),
        deletes: only(before, after),
        doubts: Vec::new(),
        partners: Vec::new(),
    }
}
