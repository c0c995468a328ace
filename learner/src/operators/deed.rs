//! A record of a demonstration goes in; deeds come out: what each hand did, with what, when, and what changed by it.
//!
//! A time in which a hand holds something is cut in two where the thing rests on nothing: before that it is *taken*, after that it is *put*.
//! What is not lifted, like a drawer, or cannot be said to be in a hand, is one deed from grip to release.
//! Each change belongs to the hand that held what it is about, or else to the one that touched it, or else to the nearest that was near; never to the only one there is.

use crate::log::{HandId, ObjectId};
use crate::observe::{Relation, Thing};

use super::record::{Grip, Record, Told, Turn};

/// What was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verb {
    /// Something came into the hand.
    Take,
    /// Something came out of the hand.
    Put,
    /// Something that cannot be taken was moved by a hand that held it.
    Handle,
    /// Something was moved by a hand that did not hold it.
    Push,
    /// What the hand held changed something else.
    Use,
    /// The hand went from one place to another.
    Go,
    /// The hand held something, while another hand changed something about it.
    Hold,
}

/// What one hand did to one thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Deed {
    /// What it did.
    pub verb: Verb,
    /// The hand.
    pub hand: HandId,
    /// To what; none where it only went somewhere.
    pub object: Option<ObjectId>,
    /// What changed by it, in the order of time, each with whether it holds afterwards.
    pub changes: Vec<(Told, bool)>,
    /// What else takes part in it, besides the object and what the changes are about.
    pub also: Vec<ObjectId>,
    /// When the hand set out for it, in seconds.
    pub from: f64,
    /// When it was done, in seconds.
    pub to: f64,
    /// When its effects count as there, in seconds; deeds are put into a sequence by it.
    pub at: f64,
    /// The places in the list of deeds of those of other hands without which it could not have been done.
    pub with: Vec<usize>,
}

/// What a demonstration consists of.
#[derive(Debug, Clone, Default)]
pub struct Deeds {
    /// In the order of [`Deed::at`].
    pub deeds: Vec<Deed>,
    /// What hands held, and when.
    pub grips: Vec<Grip>,
    /// Changes that no hand was near enough to have done.
    pub strays: Vec<Turn>,
}

/// A hand this near to what changed may have done it, in metres, as far as nothing better is known: the distance of `actedOn`.
const NEAR: f64 = 0.15;
/// A change belongs to a grip that ended so shortly before, or began so shortly after, in seconds.
const LATE: f64 = 0.8;
/// A way from one place to another takes so long at most, in seconds.
const WAY: f64 = 1.5;
/// Two sides of one change are seen within so many seconds.
const SAME: f64 = 0.1;
/// Changes that come so shortly after one another may be one deed, in seconds.
const TOGETHER: f64 = 0.4;

/// Finds the deeds; `takes` says which things can be said to be in a hand.
pub fn deeds(record: &Record, mut takes: impl FnMut(HandId, ObjectId) -> bool) -> Deeds {
    let grips = record.grips();
    let mut own: Vec<Vec<&Turn>> = vec![Vec::new(); grips.len()];
    let mut loose: Vec<(HandId, &Turn)> = Vec::new();
    let mut shared: Vec<(usize, HandId, &Turn)> = Vec::new();
    let mut going: Vec<(HandId, &Turn)> = Vec::new();
    let mut strays = Vec::new();
    for turn in &record.changes {
        let ground = &turn.told.ground;
        if ground.relation.of_hand() {
            continue;
        }
        if let (Relation::At, Thing::Hand(hand)) = (ground.relation, ground.things[0]) {
            going.push((hand, turn));
            continue;
        }
        // That something becomes clear or unblocked is only the other side of what left it, and belongs to that.
        let cause = cause(record, turn);
        let hands = responsible(cause);
        let Some(&first) = hands.first() else {
            strays.push(turn.clone());
            continue;
        };
        let found = hands.iter().filter_map(|&hand| Some((hand, grip_of(&grips, hand, cause)?)));
        let mut found: Vec<(HandId, usize)> = found.collect();
        // The one that has in hand what the relation says something of does it; who holds the other thing helps.
        found.sort_by_key(|&(_, grip)| {
            cause.told.ground.things[0] != Thing::Object(grips[grip].object)
        });
        match found.first() {
            None => loose.push((first, turn)),
            Some(&(_, grip)) => {
                own[grip].push(turn);
                shared.extend(found[1..].iter().map(|&(hand, _)| (grip, hand, turn)));
            }
        }
    }
    let mut deeds = Vec::new();
    for (number, grip) in grips.iter().enumerate() {
        // What another hand worked on meanwhile was taken even if it stayed where it was.
        let helps = own[number].is_empty()
            && !grips.iter().any(|other| {
                other.object == grip.object
                    && other.hand != grip.hand
                    && other.from < grip.to
                    && other.to > grip.from
            })
            && shared.iter().any(|(_, hand, turn)| {
                *hand == grip.hand && grip_of(&grips, *hand, turn) == Some(number)
            });
        let lifted = helps || own[number].iter().any(|turn| is_support(turn, grip.object));
        let helpers: Vec<(HandId, &Turn)> = shared
            .iter()
            .filter(|(of, _, _)| *of == number)
            .map(|&(_, hand, turn)| (hand, turn))
            .collect();
        let first = deeds.len();
        if lifted && takes(grip.hand, grip.object) {
            take_and_put(record, grip, &own[number], &mut deeds);
        } else {
            handle(record, grip, &own[number], &mut deeds);
        }
        for (hand, turn) in helpers {
            help(record, &grips, hand, turn, first, &mut deeds);
        }
    }
    push(record, &loose, &mut deeds);
    go(&going, &mut deeds);
    for deed in &mut deeds {
        deed.changes = lasting(&deed.changes);
    }
    sequence(&mut deeds);
    Deeds { deeds, grips, strays }
}

/// What a change is the other side of: the beginning or end of the relation that covers or blocks the thing. Other changes are their own cause.
fn cause<'r>(record: &'r Record, turn: &'r Turn) -> &'r Turn {
    let causes: &[Relation] = match turn.told.ground.relation {
        Relation::Clear => &[Relation::OnTop, Relation::At],
        Relation::Unblocked => &[Relation::Blocks],
        _ => return turn,
    };
    let thing = turn.told.ground.things[0];
    record
        .changes
        .iter()
        .filter(|other| causes.contains(&other.told.ground.relation) && other.holds != turn.holds)
        .filter(|other| other.told.ground.things[1] == thing)
        .map(|other| ((other.time - turn.time).abs(), other))
        .filter(|(away, _)| *away <= SAME)
        .min_by(|one, other| one.0.total_cmp(&other.0))
        .map_or(turn, |(_, other)| other)
}

/// The hands that did a change: those that held what it is about, or else those that touched it, or else the nearest that was near.
pub(super) fn responsible(turn: &Turn) -> Vec<HandId> {
    let of = |good: &dyn Fn(&crate::observe::Credit) -> bool| -> Vec<HandId> {
        turn.credits.iter().filter(|credit| good(credit)).map(|credit| credit.hand).collect()
    };
    let holders = of(&|credit| credit.holds);
    if !holders.is_empty() {
        return holders;
    }
    let touching = of(&|credit| credit.touches);
    if !touching.is_empty() {
        return touching;
    }
    let nearest =
        turn.credits.iter().filter(|credit| credit.distance <= NEAR).min_by(|one, other| {
            (!one.acts, one.distance)
                .partial_cmp(&(!other.acts, other.distance))
                .expect("distances are numbers")
        });
    nearest.map(|credit| credit.hand).into_iter().collect()
}

/// The grip of a hand that is nearest in time to a change of what it holds.
fn grip_of(grips: &[Grip], hand: HandId, turn: &Turn) -> Option<usize> {
    let away = |grip: &Grip| (grip.from - turn.time).max(turn.time - grip.to).max(0.0);
    let mut near: Vec<(f64, usize)> = grips
        .iter()
        .enumerate()
        .filter(|(_, grip)| grip.hand == hand && away(grip) <= LATE)
        .filter(|(_, grip)| turn.objects.contains(&grip.object))
        .map(|(number, grip)| (away(grip), number))
        .collect();
    near.sort_by(|one, other| one.partial_cmp(other).expect("times are numbers"));
    near.first().map(|&(_, number)| number)
}

/// Whether a change is about what the first thing rests on or in.
fn is_support(turn: &Turn, object: ObjectId) -> bool {
    let ground = &turn.told.ground;
    matches!(ground.relation, Relation::OnTop | Relation::Inside | Relation::At)
        && ground.things[0] == Thing::Object(object)
}

/// One deed from grip to release.
fn handle(record: &Record, grip: &Grip, turns: &[&Turn], deeds: &mut Vec<Deed>) {
    let from = record.begin(grip.hand, grip.from);
    let done = turns.iter().map(|turn| turn.time).reduce(f64::max).unwrap_or(grip.to);
    deeds.push(Deed {
        verb: Verb::Handle,
        hand: grip.hand,
        object: Some(grip.object),
        changes: turns.iter().map(|turn| (turn.told.clone(), turn.holds)).collect(),
        also: Vec::new(),
        from,
        to: grip.to.max(done),
        at: done,
        with: Vec::new(),
    });
}

/// The deeds of a hand with a thing that it takes up, uses and puts down.
fn take_and_put(record: &Record, grip: &Grip, turns: &[&Turn], deeds: &mut Vec<Deed>) {
    let support = || turns.iter().filter(|turn| is_support(turn, grip.object));
    // What a hand has just taken may still seem to rest for a moment: what ends is part of taking, as long as it rests on nothing new.
    let settled = support()
        .filter(|turn| {
            turn.holds && turn.time > grip.from + TOGETHER.min((grip.to - grip.from) / 2.0)
        })
        .map(|turn| turn.time)
        .reduce(f64::min)
        .unwrap_or(f64::INFINITY);
    let lifted = support()
        .filter(|turn| !turn.holds && turn.time < settled)
        .map(|turn| turn.time)
        .reduce(f64::max)
        .unwrap_or(grip.from)
        .max(grip.from);
    let rests = settled.min(grip.to.max(lifted));
    let parted = (lifted + TOGETHER).min(f64::midpoint(lifted, rests)).max(lifted);
    let mut taking = Vec::new();
    let mut putting = Vec::new();
    let mut using: Vec<&Turn> = Vec::new();
    for &turn in turns {
        let mine = turn.told.ground.things.contains(&Thing::Object(grip.object))
            || turn.told.ground.relation == Relation::Clear;
        if turn.time <= parted {
            taking.push(turn);
        } else if mine || turn.time >= grip.to.min(settled) - TOGETHER {
            putting.push(turn);
        } else {
            using.push(turn);
        }
    }
    let hand = Thing::Hand(grip.hand);
    let of_hand = |holds: bool| {
        // What the hand itself is said to do changes with the grip.
        record.changes.iter().filter(move |turn| {
            let relation = turn.told.ground.relation;
            let grips = relation == Relation::InHand
                && turn.told.ground.things[0] == Thing::Object(grip.object);
            let time = if holds { grip.from } else { grip.to };
            turn.told.ground.things.contains(&hand)
                && (turn.time - time).abs() < 1e-9
                && ((grips && turn.holds == holds)
                    || (relation == Relation::HandEmpty && turn.holds != holds))
        })
    };
    let told = |turns: &mut dyn Iterator<Item = &Turn>| -> Vec<(Told, bool)> {
        turns.map(|turn| (turn.told.clone(), turn.holds)).collect()
    };
    let empty = Deed {
        verb: Verb::Take,
        hand: grip.hand,
        object: Some(grip.object),
        changes: Vec::new(),
        also: Vec::new(),
        from: record.begin(grip.hand, grip.from),
        to: parted,
        at: grip.from,
        with: Vec::new(),
    };
    deeds.push(Deed {
        changes: told(&mut of_hand(true).chain(taking.iter().copied())),
        ..empty.clone()
    });
    for group in groups(&using) {
        let times = (group[0].time, group[group.len() - 1].time);
        deeds.push(Deed {
            verb: Verb::Use,
            changes: told(&mut group.iter().copied()),
            from: parted,
            to: times.1,
            at: times.1,
            ..empty.clone()
        });
    }
    if !grip.open || !putting.is_empty() {
        deeds.push(Deed {
            verb: Verb::Put,
            changes: told(&mut of_hand(false).chain(putting.iter().copied())),
            from: parted,
            to: putting.iter().map(|turn| turn.time).fold(grip.to, f64::max),
            at: grip.to,
            ..empty
        });
    }
}

/// Changes without those that were undone again: what a thing brushes on its way is none.
fn lasting(changes: &[(Told, bool)]) -> Vec<(Told, bool)> {
    let mut list: Vec<(Told, bool)> = Vec::new();
    for (told, holds) in changes {
        match list.iter().position(|(other, was)| other == told && was != holds) {
            Some(place) => drop(list.remove(place)),
            None => list.push((told.clone(), *holds)),
        }
    }
    list
}

/// Changes that come shortly after one another.
fn groups<'t>(turns: &[&'t Turn]) -> Vec<Vec<&'t Turn>> {
    let mut groups: Vec<Vec<&Turn>> = Vec::new();
    for &turn in turns {
        match groups.last_mut() {
            Some(group) if turn.time - group[group.len() - 1].time <= TOGETHER => group.push(turn),
            _ => groups.push(vec![turn]),
        }
    }
    groups
}

/// The part of a hand that held something, while another changed something about it.
fn help(
    record: &Record,
    grips: &[Grip],
    hand: HandId,
    turn: &Turn,
    first: usize,
    deeds: &mut Vec<Deed>,
) {
    let Some(grip) = grip_of(grips, hand, turn).map(|number| &grips[number]) else { return };
    // It only counts while it holds: who has just let go helps no more.
    if turn.time < grip.from || turn.time > grip.to {
        return;
    }
    let mine = |deed: &Deed| {
        deed.changes.iter().any(|(told, holds)| *told == turn.told && *holds == turn.holds)
    };
    let Some(main) = (first..deeds.len()).find(|&place| mine(&deeds[place])) else { return };
    let there = deeds[main].with.iter().any(|&other| deeds[other].hand == hand);
    if there {
        return;
    }
    // What needs both hands is done before either lets go.
    deeds[main].at = deeds[main].at.min(grip.to - 1e-3).max(turn.time);
    let deed = Deed {
        verb: Verb::Hold,
        hand,
        object: Some(grip.object),
        changes: Vec::new(),
        also: deeds[main].object.into_iter().collect(),
        from: record.begin(hand, grip.from),
        to: deeds[main].to,
        // It demands what holds before the deed that it helps, so it stands before that.
        at: deeds[main].at - 1e-6,
        with: vec![main],
    };
    deeds.push(deed);
    let place = deeds.len() - 1;
    deeds[main].with.push(place);
}

/// What hands moved without holding it.
fn push(record: &Record, loose: &[(HandId, &Turn)], deeds: &mut Vec<Deed>) {
    for hand in 0..record.header.hands.len() {
        let hand = HandId(hand as u32);
        let turns: Vec<&Turn> =
            loose.iter().filter(|(of, _)| *of == hand).map(|&(_, turn)| turn).collect();
        for group in groups(&turns) {
            let object = group[0].credits.iter().find(|credit| credit.hand == hand);
            let last = group[group.len() - 1].time;
            deeds.push(Deed {
                verb: Verb::Push,
                hand,
                object: object.map(|credit| credit.object),
                changes: group.iter().map(|turn| (turn.told.clone(), turn.holds)).collect(),
                also: Vec::new(),
                from: record.begin(hand, group[0].time),
                to: last,
                at: last,
                with: Vec::new(),
            });
        }
    }
}

/// How hands went from place to place. Who leaves a place and is at no other for a while has left it for good.
fn go(going: &[(HandId, &Turn)], deeds: &mut Vec<Deed>) {
    let mut hands: Vec<HandId> = going.iter().map(|&(hand, _)| hand).collect();
    hands.sort_unstable();
    hands.dedup();
    for hand in hands {
        let turns: Vec<&Turn> =
            going.iter().filter(|(of, _)| *of == hand).map(|&(_, turn)| turn).collect();
        let mut pending: Vec<&Turn> = Vec::new();
        for (place, &turn) in turns.iter().enumerate() {
            pending.push(turn);
            let next = turns.get(place + 1);
            let goes_on = !turn.holds && next.is_some_and(|next| next.time - turn.time <= WAY);
            if goes_on {
                continue;
            }
            deeds.push(Deed {
                verb: Verb::Go,
                hand,
                object: None,
                changes: pending.iter().map(|turn| (turn.told.clone(), turn.holds)).collect(),
                also: Vec::new(),
                from: pending[0].time,
                to: turn.time,
                at: turn.time,
                with: Vec::new(),
            });
            pending.clear();
        }
    }
}

/// Puts deeds into the order of their effects, and their places with them.
pub(super) fn sequence(deeds: &mut Vec<Deed>) {
    let mut order: Vec<usize> = (0..deeds.len()).collect();
    order.sort_by(|&one, &other| deeds[one].at.total_cmp(&deeds[other].at).then(one.cmp(&other)));
    let mut place = vec![0; order.len()];
    for (new, &old) in order.iter().enumerate() {
        place[old] = new;
    }
    let mut sorted: Vec<Deed> = order.iter().map(|&old| deeds[old].clone()).collect();
    for deed in &mut sorted {
        for other in &mut deed.with {
            *other = place[*other];
        }
    }
    *deeds = sorted;
}
