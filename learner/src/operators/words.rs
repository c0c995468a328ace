//! What was observed between hands and objects goes in; facts in the words of a domain come out, and the domain that declares these words.

use std::collections::{BTreeMap, BTreeSet};

use lang::model::{Domain, ObjectId, PredicateId, TypeId};

use super::record::Told;
use crate::log::{self, Fact, HandId, Header};
use crate::observe::{Ground, Relation, Thing, Vocabulary};
use crate::trace::vocabulary::{
    declare_predicate, declare_type, empty, find_object, object, variables,
};

/// Which hands act, under which names, and how what they do is said.
#[derive(Debug, Clone)]
pub struct Words {
    /// How relations are written.
    pub vocabulary: Vocabulary,
    /// For each hand of the header, in its order, the name of the one who acts in its place; none where the hand is left out.
    pub actors: Vec<Option<String>>,
    /// The type of those who act.
    pub actor_type: String,
    /// The words of a domain that is there already; otherwise the words of the demonstrations are declared.
    pub known: Option<Domain>,
}

/// The type of those who act, unless something else is said.
pub const ACTOR: &str = "hand";

impl Words {
    /// Every hand acts under its own name.
    pub fn of(header: &Header, vocabulary: Vocabulary) -> Self {
        let actors = header.hands.iter().map(|hand| Some(hand.name.clone())).collect();
        Self { vocabulary, actors, actor_type: ACTOR.to_owned(), known: None }
    }

    /// Whether the vocabulary says which hand it is that holds something.
    pub fn names_hands(&self) -> bool {
        self.vocabulary.in_hand.variables.len() > 1
    }

    /// A relation as a fact, as far as there are words for it.
    ///
    /// Where the words do not say which hand holds something, only what the hand of `acting` does is said.
    pub fn fact(&self, header: &Header, told: &Told, acting: Option<HandId>) -> Option<Fact> {
        let hands = told.ground.things.iter().filter_map(|thing| match thing {
            Thing::Hand(hand) => Some(*hand),
            Thing::Object(_) => None,
        });
        for hand in hands {
            self.actors[hand.index()].as_ref()?;
            if !self.names_hands() && acting.is_some_and(|acting| acting != hand) {
                return None;
            }
        }
        // How far a hand gets is a matter of places; of a thing it changes with every place that the thing is brought to.
        if let (Relation::Reachable, Thing::Object(object)) =
            (told.ground.relation, told.ground.things[0])
        {
            let what = &header.objects[object.index()];
            if !what.fixed && !what.region {
                return None;
            }
        }
        let fact = match told.ground.relation {
            Relation::Given => told.fact.clone(),
            _ => self.vocabulary.fact(header, &told.ground)?,
        };
        Some(Fact {
            predicate: fact.predicate,
            arguments: fact.arguments.iter().map(|name| self.acting(header, name)).collect(),
        })
    }

    /// The name under which a hand acts; of an object its own.
    fn acting(&self, header: &Header, name: &str) -> String {
        let hand = header.hands.iter().position(|hand| hand.name == name);
        let actor = hand.and_then(|hand| self.actors[hand].clone());
        actor.unwrap_or_else(|| name.to_owned())
    }
}

/// A domain in the making, into which the words of demonstrations are put.
#[derive(Debug, Clone)]
pub struct Lexicon {
    /// The types, predicates and actions so far.
    pub domain: Domain,
    /// Its words are given: what does not fit them is left out.
    closed: bool,
    predicates: BTreeMap<String, PredicateId>,
    /// What was left out: predicates and types that the domain does not have.
    pub missing: BTreeSet<String>,
}

impl Lexicon {
    /// The words of a domain that is there, or none yet.
    pub fn new(title: &str, known: Option<&Domain>) -> Self {
        let (domain, closed) = match known {
            Some(known) => (crate::trace::vocabulary::of(known), true),
            None => (empty(title), false),
        };
        let predicates = domain
            .predicates
            .iter()
            .enumerate()
            .map(|(at, one)| (one.name.text.to_ascii_lowercase(), PredicateId(at as u32)))
            .collect();
        Self { domain, closed, predicates, missing: BTreeSet::new() }
    }

    /// The type of an object of the header: its own, or the nearest one above it that the domain has.
    pub fn type_of(&mut self, header: &Header, kind: &str) -> Option<TypeId> {
        let mut chain = vec![kind.to_owned()];
        while let Some(parent) = header
            .types
            .iter()
            .find(|one| one.name == chain[chain.len() - 1])
            .and_then(|one| one.parent.clone())
            && !chain.contains(&parent)
        {
            chain.push(parent);
        }
        if self.closed {
            let found = chain.iter().find_map(|name| find_type(&self.domain, name));
            if found.is_none() {
                self.missing.insert(format!("the type `{kind}`"));
            }
            return found;
        }
        let mut above = None;
        for name in chain.iter().rev() {
            above = Some(declare_type(&mut self.domain, name, above));
        }
        above
    }

    /// All objects of a header and those who act, for a trace.
    pub fn objects(&mut self, header: &Header, words: &Words) -> Vec<lang::model::Object> {
        let mut objects = self.domain.constants.clone();
        let mut names: Vec<(String, String)> =
            header.objects.iter().map(|one| (one.name.clone(), one.kind.clone())).collect();
        if words.names_hands() || !self.closed {
            let actors = words.actors.iter().flatten();
            names.extend(actors.map(|name| (name.clone(), words.actor_type.clone())));
        }
        for (name, kind) in names {
            if find_object(&objects, &name).is_none()
                && let Some(of) = self.type_of(header, &kind)
            {
                objects.push(object(&name, vec![of]));
            }
        }
        objects
    }

    /// A fact with its ids; none where the domain has no words for it.
    pub fn fact(
        &mut self,
        objects: &[lang::model::Object],
        fact: &Fact,
    ) -> Option<(PredicateId, Vec<ObjectId>)> {
        let arguments: Option<Vec<ObjectId>> =
            fact.arguments.iter().map(|name| find_object(objects, name)).collect();
        let arguments = arguments?;
        let types: Vec<TypeId> = arguments.iter().map(|id| objects[id.index()].types[0]).collect();
        let key = fact.predicate.to_ascii_lowercase();
        let Some(&predicate) = self.predicates.get(&key) else {
            if self.closed {
                self.missing.insert(format!("the predicate `{}`", fact.predicate));
                return None;
            }
            let types: Vec<Vec<TypeId>> = types.into_iter().map(|one| vec![one]).collect();
            let id = declare_predicate(&mut self.domain, &fact.predicate, &types);
            self.predicates.insert(key, id);
            return Some((id, arguments));
        };
        let declared = &self.domain.predicates[predicate.index()].parameters;
        if declared.len() != arguments.len() {
            let count = arguments.len();
            self.missing.insert(format!("a predicate `{}` of {count} arguments", fact.predicate));
            return None;
        }
        let mut wider = Vec::new();
        for (variable, &of) in declared.iter().zip(&types) {
            let fits = variable.types.iter().any(|&wanted| self.domain.is_subtype(of, wanted));
            if !fits && self.closed {
                return None;
            }
            wider.push(if fits { variable.types[0] } else { self.common(variable.types[0], of) });
        }
        for (variable, of) in
            self.domain.predicates[predicate.index()].parameters.iter_mut().zip(wider)
        {
            variable.types = vec![of];
        }
        Some((predicate, arguments))
    }

    /// The nearest type above both.
    fn common(&self, one: TypeId, other: TypeId) -> TypeId {
        let mut at = one;
        while !self.domain.is_subtype(other, at) {
            at = self.domain.types[at.index()].parents.first().copied().unwrap_or(TypeId(0));
        }
        at
    }

    /// Whether an object can be said to be in a hand; what cannot is opened, pushed or moved, and never taken.
    pub fn holdable(
        &mut self,
        header: &Header,
        words: &Words,
        objects: &[lang::model::Object],
        hand: HandId,
        what: log::ObjectId,
    ) -> bool {
        let ground = Ground {
            relation: Relation::InHand,
            things: vec![Thing::Object(what), Thing::Hand(hand)],
        };
        let Some(fact) = words.vocabulary.fact(header, &ground) else { return false };
        let known = self.missing.clone();
        let found = words
            .fact(header, &Told { ground, fact }, Some(hand))
            .is_some_and(|fact| self.fact(objects, &fact).is_some());
        self.missing = known;
        found
    }
}

impl Lexicon {
    /// The domain, in which the parameters of predicates are named after their types as these are now.
    pub fn domain(&self) -> Domain {
        let mut domain = self.domain.clone();
        if !self.closed {
            for place in 0..domain.predicates.len() {
                let parameters = &domain.predicates[place].parameters;
                let types: Vec<Vec<TypeId>> =
                    parameters.iter().map(|variable| variable.types.clone()).collect();
                domain.predicates[place].parameters = variables(&domain, &types);
            }
        }
        domain
    }
}

/// The type of this name.
fn find_type(domain: &Domain, name: &str) -> Option<TypeId> {
    let at = domain.types.iter().position(|one| one.name.text.eq_ignore_ascii_case(name));
    at.map(|at| TypeId(at as u32))
}
