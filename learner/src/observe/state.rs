//! Flips of relations and states of hands go in; the facts that hold come out, in the words of the vocabulary.

use std::collections::{BTreeMap, BTreeSet};

use super::config::Config;
use super::relation::Flip;
use super::vocabulary::{Ground, Relation, Thing};
use crate::log::{self, Fact, HandId, HandState, Header, Motion, ObjectId};

/// What holds at a frame.
#[derive(Debug, Default)]
pub(super) struct State {
    /// What geometry says: each relation with its things.
    base: BTreeSet<(Relation, Thing, Thing)>,
    /// The objects that were ever seen.
    known: BTreeSet<ObjectId>,
    /// All facts, each with the relation that it stands for.
    facts: BTreeMap<Fact, Ground>,
}

impl State {
    /// Takes a flip.
    pub fn flip(&mut self, flip: &Flip) {
        let entry = (flip.relation, flip.first, flip.second);
        if flip.holds {
            self.base.insert(entry);
        } else {
            self.base.remove(&entry);
        }
    }

    /// An object was seen for the first time.
    pub fn meet(&mut self, object: ObjectId) {
        self.known.insert(object);
    }

    /// All facts that hold now, in the order of their names.
    pub fn facts(&self) -> impl Iterator<Item = &Fact> {
        self.facts.keys()
    }

    /// Works out the facts anew; returns those that changed: first those that hold no longer, then those that hold now.
    pub fn update(
        &mut self,
        hands: &[HandState],
        given: &[Fact],
        header: &Header,
        config: &Config,
    ) -> Vec<(Fact, Ground, bool)> {
        let mut now = BTreeMap::new();
        for ground in self.grounds(hands, header, config) {
            if let Some(fact) = config.vocabulary.fact(header, &ground) {
                now.entry(fact).or_insert(ground);
            }
        }
        for fact in given {
            now.entry(fact.clone()).or_insert_with(|| given_ground(fact, header));
        }
        let ended = self
            .facts
            .iter()
            .filter(|(fact, _)| !now.contains_key(*fact))
            .map(|(fact, ground)| (fact.clone(), ground.clone(), false));
        let begun = now
            .iter()
            .filter(|(fact, _)| !self.facts.contains_key(*fact))
            .map(|(fact, ground)| (fact.clone(), ground.clone(), true));
        let changes = ended.chain(begun).collect();
        self.facts = now;
        changes
    }

    /// The objects that are in one relation with the second thing, as far as geometry says.
    pub fn partners(&self, relation: Relation, second: Thing) -> impl Iterator<Item = Thing> {
        self.base
            .iter()
            .filter(move |entry| entry.0 == relation && entry.2 == second)
            .map(|entry| entry.1)
    }

    /// All relations that hold and are asked for.
    fn grounds(&self, hands: &[HandState], header: &Header, config: &Config) -> Vec<Ground> {
        let held: BTreeSet<ObjectId> = hands.iter().filter_map(|hand| hand.in_hand).collect();
        let rests = |first: Thing, second: Thing| {
            let free = |thing| matches!(thing, Thing::Object(object) if !held.contains(&object));
            config.held_things_rest
                || matches!(first, Thing::Hand(_))
                || free(first)
                || !free(second)
        };
        let mut grounds = Vec::new();
        let mut covered = BTreeSet::new();
        let mut blocked = BTreeSet::new();
        for &(relation, first, second) in &self.base {
            let holds = match relation {
                Relation::OnTop | Relation::Inside | Relation::At => rests(first, second),
                _ => true,
            };
            if !holds {
                continue;
            }
            if matches!((relation, first), (Relation::OnTop | Relation::At, Thing::Object(_))) {
                covered.insert(second);
            }
            if relation == Relation::Blocks {
                blocked.insert(second);
            }
            let things = if first == second { vec![first] } else { vec![first, second] };
            if relation == Relation::Touching {
                grounds.push(Ground { relation, things: vec![second, first] });
            }
            grounds.push(Ground { relation, things });
        }
        for &object in &self.known {
            let thing = Thing::Object(object);
            let what = &header.objects[object.index()];
            let one = |relation| Ground { relation, things: vec![thing] };
            if (what.region || !what.fixed && !what.hollow) && !covered.contains(&thing) {
                grounds.push(one(Relation::Clear));
            }
            if !what.joints.is_empty() {
                if !self.base.contains(&(Relation::Open, thing, thing)) {
                    grounds.push(one(Relation::Closed));
                }
                let slides = what.joints.iter().any(|joint| joint.motion == Motion::Slides);
                if slides && !blocked.contains(&thing) {
                    grounds.push(one(Relation::Unblocked));
                }
            }
        }
        for &small in &self.known {
            for &large in &self.known {
                if is_smaller(&header.objects[small.index()], &header.objects[large.index()]) {
                    let things = vec![Thing::Object(small), Thing::Object(large)];
                    grounds.push(Ground { relation: Relation::Smaller, things });
                }
            }
        }
        for (number, state) in hands.iter().enumerate() {
            let hand = Thing::Hand(HandId(number as u32));
            let with =
                |relation, object| Ground { relation, things: vec![Thing::Object(object), hand] };
            let alone = |relation| Ground { relation, things: vec![hand] };
            grounds.extend(state.in_hand.map(|object| with(Relation::InHand, object)));
            grounds.extend(state.acted_on.map(|object| with(Relation::ActedOn, object)));
            grounds.extend(state.in_hand.is_none().then(|| alone(Relation::HandEmpty)));
            grounds.extend(state.moves.then(|| alone(Relation::HandMoves)));
        }
        grounds.retain(|ground| config.relations.contains(&ground.relation));
        grounds
    }
}

/// A thing is smaller than another if it is narrower by so much, in metres.
const NARROWER: f64 = 0.005;

/// Whether one thing is smaller than another of its type, as far as it matters to what rests on what.
fn is_smaller(small: &log::Object, large: &log::Object) -> bool {
    let loose = |object: &log::Object| !object.fixed && !object.region;
    loose(small)
        && loose(large)
        && small.kind == large.kind
        && small.size.x + NARROWER < large.size.x
        && small.size.y + NARROWER < large.size.y
}

/// What a fact of the log is about.
fn given_ground(fact: &Fact, header: &Header) -> Ground {
    let things = fact.arguments.iter().filter_map(|name| {
        let object = header.objects.iter().position(|object| object.name == *name);
        let hand = header.hands.iter().position(|hand| hand.name == *name);
        object
            .map(|place| Thing::Object(ObjectId(place as u32)))
            .or(hand.map(|place| Thing::Hand(HandId(place as u32))))
    });
    Ground { relation: Relation::Given, things: things.collect() }
}
