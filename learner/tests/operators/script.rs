//! A demonstration as a few lines of text goes in; the [`Record`] that an observer would have made of it comes out, without noise and without physics.
//!
//! ```text
//! things red blue - cube table - table     what there is; hands are `left` and `right`
//! holds (on-top red table)                 from the beginning
//! 1.0 left takes red                       the hand reaches for half a second, then holds
//! 1.2 - (on-top red table) left holding    what ends (-) or begins (+), and where hands are: `holding`, `touching`, or how many metres away
//! 2.0 left lets go
//! 3.0 left is taught                       teach mode is on from here to the end
//! ```

use std::fmt::Write;

use learner::log::{Hand, HandId, HandState, Header, Object, ObjectId, Type};
use learner::observe::{Credit, Ground, Relation, Thing, Vocabulary};
use learner::operators::deed::{Deeds, Verb};
use learner::operators::record::{Record, Run, Told, Turn};
use nalgebra::Vector3;

/// What a hand does from a time on.
type Event = (f64, HandState, bool);

/// The record of a script.
pub fn record(name: &str, script: &str) -> Record {
    let mut header = Header {
        frame: "world".to_owned(),
        rate: 90.0,
        types: Vec::new(),
        agents: vec!["person".to_owned()],
        hands: ["left", "right"]
            .map(|name| Hand { name: name.to_owned(), agent: 0, reach: None })
            .to_vec(),
        objects: Vec::new(),
    };
    let mut record = Record {
        name: name.to_owned(),
        header: header.clone(),
        initial: [].into(),
        changes: Vec::new(),
        hands: Vec::new(),
        end: 0.0,
        frames: 0,
    };
    let idle = HandState { moves: false, acted_on: None, in_hand: None };
    let mut events: [Vec<Event>; 2] = [vec![(0.0, idle, false)], vec![(0.0, idle, false)]];
    for line in script.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (first, rest) = line.split_once(' ').expect("a line has several words");
        match first {
            "things" => header.objects.extend(things(rest)),
            "types" => {
                let (name, parent) = rest.split_once(" - ").expect("a type and the one above it");
                header.types.push(Type { name: name.to_owned(), parent: Some(parent.to_owned()) });
            }
            "holds" => record.initial.extend(facts(rest).map(|fact| told(&header, fact))),
            _ => {
                let time: f64 = first.parse().expect("a line begins with its time");
                record.end = record.end.max(time);
                happen(&header, time, rest, &mut events, &mut record.changes);
            }
        }
    }
    record.end += 1.0;
    record.frames = (record.end * header.rate) as u64;
    record.changes.sort_by(|one, other| one.time.total_cmp(&other.time));
    let ends = record.end;
    record.hands = events
        .into_iter()
        .map(|list| {
            let ends = list.iter().skip(1).map(|event| event.0).chain([ends]).collect::<Vec<_>>();
            let runs = list.iter().zip(ends);
            runs.map(|(&(from, state, teach), to)| Run { state, teach, from, to }).collect()
        })
        .collect();
    record.header = header;
    record
}

/// Objects such as `red blue - cube table - table`.
fn things(text: &str) -> Vec<Object> {
    let mut all = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    let mut words = text.split_whitespace();
    while let Some(word) = words.next() {
        if word != "-" {
            names.push(word);
            continue;
        }
        let kind = words.next().expect("a type follows the dash");
        all.extend(names.drain(..).map(|name| Object {
            name: name.to_owned(),
            kind: kind.to_owned(),
            size: Vector3::repeat(0.05),
            fixed: ["table", "spot"].contains(&kind),
            hollow: kind == "drawer",
            region: kind == "spot",
            joints: Vec::new(),
        }));
    }
    assert!(names.is_empty(), "each object has a type");
    all
}

/// Each `(…)` of a text.
fn facts(text: &str) -> impl Iterator<Item = &str> {
    text.split('(').skip(1).map(|part| part.split(')').next().expect("parentheses are closed"))
}

/// What a fact says, in the words that are usual.
pub fn told(header: &Header, fact: &str) -> Told {
    let mut words = fact.split_whitespace();
    let relation = words.next().expect("a fact has a predicate");
    let relation: Relation = serde_json::from_value(relation.into()).expect("it is a relation");
    let things = words.map(|name| match header.hand(name) {
        Some(hand) => Thing::Hand(hand),
        None => Thing::Object(object(header, name)),
    });
    let ground = Ground { relation, things: things.collect() };
    let fact = Vocabulary::default().fact(header, &ground).expect("each relation has its words");
    Told { ground, fact }
}

fn object(header: &Header, name: &str) -> ObjectId {
    let place = header.objects.iter().position(|one| one.name == name);
    ObjectId(place.unwrap_or_else(|| panic!("there is no {name}")) as u32)
}

/// A line that begins with a time.
fn happen(
    header: &Header,
    time: f64,
    text: &str,
    events: &mut [Vec<Event>; 2],
    changes: &mut Vec<Turn>,
) {
    let change = |fact: &str, holds: bool, credits: Vec<Credit>| {
        let told = told(header, fact);
        let objects = told.ground.things.iter().filter_map(|thing| match thing {
            Thing::Object(object) => Some(*object),
            Thing::Hand(_) => None,
        });
        let objects = objects.collect();
        Turn { time, told, holds, objects, credits }
    };
    if let Some((sign, rest)) = text.split_once(" (").filter(|(sign, _)| "+-".contains(sign)) {
        let (fact, who) = rest.split_once(')').expect("parentheses are closed");
        let about = told(header, fact).ground.things;
        let main = about.iter().find_map(|thing| match thing {
            Thing::Object(object) => Some(*object),
            Thing::Hand(_) => None,
        });
        let words: Vec<&str> = who.split_whitespace().collect();
        let credits = words.chunks(2).map(|pair| Credit {
            hand: header.hand(pair[0]).expect("it is a hand"),
            object: main.expect("a change is about an object"),
            distance: pair[1].parse().unwrap_or(0.0),
            holds: pair[1] == "holding",
            touches: ["holding", "touching"].contains(&pair[1]),
            acts: false,
        });
        let credits = credits.collect();
        changes.push(change(fact, sign == "+", credits));
        return;
    }
    let (name, deed) = text.split_once(' ').expect("a hand does something");
    let hand = header.hand(name).unwrap_or_else(|| panic!("there is no hand {name}"));
    let list = &mut events[hand.index()];
    let (_, before, teach) = *list.last().expect("hands begin somewhere");
    if let Some(what) = deed.strip_prefix("takes ") {
        let object = object(header, what);
        let reach = HandState { moves: true, acted_on: Some(object), in_hand: None };
        list.push((time - 0.5, reach, teach));
        list.push((time, HandState { moves: true, acted_on: None, in_hand: Some(object) }, teach));
        changes.push(change(&format!("hand-empty {name}"), false, Vec::new()));
        changes.push(change(&format!("in-hand {what} {name}"), true, Vec::new()));
    } else if deed == "lets go" {
        let what = &header.objects[before.in_hand.expect("it holds something").index()].name;
        list.push((time, HandState { moves: false, acted_on: None, in_hand: None }, teach));
        changes.push(change(&format!("hand-empty {name}"), true, Vec::new()));
        changes.push(change(&format!("in-hand {what} {name}"), false, Vec::new()));
    } else if deed == "is taught" {
        list.push((time, before, true));
    } else {
        panic!("no hand can do this: {deed}");
    }
}

/// Deeds as lines: what, by whom, with what, which changes, and with whom.
pub fn lines(record: &Record, found: &Deeds) -> Vec<String> {
    let hand = |hand: HandId| record.header.hands[hand.index()].name.as_str();
    let object = |object: ObjectId| record.header.objects[object.index()].name.as_str();
    let line = |deed: &learner::operators::deed::Deed| {
        let verb = match deed.verb {
            Verb::Take => "take",
            Verb::Put => "put",
            Verb::Handle => "handle",
            Verb::Push => "push",
            Verb::Use => "use",
            Verb::Go => "go",
            Verb::Hold => "hold",
        };
        let mut text = format!("{} {verb}", hand(deed.hand));
        if let Some(what) = deed.object {
            let _ = write!(text, " {}", object(what));
        }
        for (told, holds) in &deed.changes {
            let sign = if *holds { '+' } else { '-' };
            let words: Vec<&str> = std::iter::once(&told.fact.predicate)
                .chain(&told.fact.arguments)
                .map(String::as_str)
                .collect();
            let _ = write!(text, " {sign}({})", words.join(" "));
        }
        for &with in &deed.with {
            let _ = write!(text, " with {}", hand(found.deeds[with].hand));
        }
        text
    };
    found.deeds.iter().map(line).collect()
}
