//! A deed goes in; a readable name for the action that it is an instance of comes out, such as `put-plate-in-drawer`.

use crate::log::{Header, ObjectId};
use crate::observe::{Relation, Thing};

use super::deed::{Deed, Verb};

/// The name of the action by what it does to which types of things.
pub fn name(header: &Header, deed: &Deed) -> String {
    let kind = |object: ObjectId| header.objects[object.index()].kind.to_ascii_lowercase();
    let what = deed.object.map(kind);
    let object = deed.object.map(Thing::Object);
    // What the object rests on or in, before or after.
    let support = |after: bool| {
        let mut found: Vec<(Relation, Thing)> = deed
            .changes
            .iter()
            .filter(|(told, holds)| *holds == after && Some(told.ground.things[0]) == object)
            .filter(|(told, _)| told.ground.things.len() == 2)
            .map(|(told, _)| (told.ground.relation, told.ground.things[1]))
            .collect();
        found.sort_unstable();
        found.into_iter().find_map(|(relation, thing)| {
            let preposition = match (relation, after) {
                (Relation::OnTop, true) => "on",
                (Relation::Inside, true) => "in",
                (Relation::At, true) => "at",
                (Relation::Blocks, true) => "before",
                (Relation::Inside, false) => "out-of",
                (Relation::OnTop | Relation::At | Relation::Blocks, false) => "from",
                _ => return None,
            };
            let Thing::Object(thing) = thing else { return None };
            Some(format!("{preposition}-{}", kind(thing)))
        })
    };
    let begun = |relation: Relation| {
        deed.changes.iter().find_map(|(told, holds)| match told.ground.things.first() {
            Some(&Thing::Object(thing)) if *holds && told.ground.relation == relation => {
                Some(thing)
            }
            _ => None,
        })
    };
    let mut words: Vec<String> = Vec::new();
    match deed.verb {
        Verb::Take => {
            words.push("take".to_owned());
            words.extend(what);
            words.extend(support(false));
        }
        Verb::Put => {
            words.push("put".to_owned());
            words.extend(what);
            words.extend(support(true));
        }
        Verb::Handle | Verb::Push | Verb::Use => {
            let opened = begun(Relation::Open).map(|thing| ("open", thing));
            let closed = begun(Relation::Closed).map(|thing| ("close", thing));
            if let Some((verb, thing)) = opened.or(closed) {
                words.extend([verb.to_owned(), kind(thing)]);
                words.extend(
                    what.filter(|what| *what != kind(thing)).map(|what| format!("with-{what}")),
                );
            } else if deed.verb == Verb::Use {
                words.push("use".to_owned());
                words.extend(what);
                let on = deed.changes.iter().flat_map(|(told, _)| &told.ground.things).find_map(
                    |thing| match thing {
                        Thing::Object(thing) if Some(*thing) != deed.object => Some(kind(*thing)),
                        _ => None,
                    },
                );
                words.extend(on.map(|on| format!("on-{on}")));
            } else {
                words.push(if deed.verb == Verb::Push { "push" } else { "move" }.to_owned());
                words.extend(what);
                words.extend(support(true).or_else(|| support(false)));
            }
        }
        Verb::Go => {
            let some = |wanted: bool| deed.changes.iter().any(|(_, holds)| *holds == wanted);
            let word = match (some(false), some(true)) {
                (true, true) => "move",
                (false, _) => "enter",
                (true, false) => "leave",
            };
            words.push(word.to_owned());
        }
        Verb::Hold => {
            words.push("hold".to_owned());
            words.extend(what);
        }
    }
    words.join("-")
}
