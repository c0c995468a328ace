//! A seed goes in; a table with a bottle and its lid comes out, and how two hands open or close it (figure 3.4d to f of the thesis).
//!
//! The lid sits on a thread. A bottle that stands unheld turns with its lid, since the thread resists more than the table does.

use super::person::{Person, Side};
use super::scenario::{Goal, Layout, Script, fact, kind, two_hands};
use super::skill::Skill;
use super::space::{at, turned};
use super::stage::Stage;
use super::thing::{self, Thing};
use crate::chance::Chance;
use learner::log::{HandId, Joint, Motion, ObjectId};
use nalgebra::{Isometry3, Vector3};

const TOP: f64 = 0.75;
/// Of bottle and lid, in metres.
const RADIUS: f64 = 0.035;
const HEIGHT: f64 = 0.16;
const LID: f64 = 0.025;
/// How far the lid is turned to come off, in radians.
const THREAD: f64 = 2.4;

pub(crate) fn goals(open: bool) -> Vec<Goal> {
    if open {
        vec![Goal {
            name: "close-bottle",
            facts: vec![fact("closed", &["lid"]), fact("on-top", &["lid", "bottle"])],
        }]
    } else {
        vec![Goal {
            name: "open-bottle",
            facts: vec![fact("open", &["lid"]), fact("on-top", &["lid", "table"])],
        }]
    }
}

pub(crate) fn layout(chance: &mut Chance, open: bool) -> Layout {
    let size = Vector3::new(1.2, 0.8, 0.05);
    let place =
        Vector3::new(chance.within((-0.12, 0.12)), chance.within((-0.1, 0.1)), TOP + HEIGHT / 2.0);
    let side = if chance.happens(0.5) { 1.0 } else { -1.0 };
    let beside = Vector3::new(
        place.x + side * chance.within((0.18, 0.28)),
        place.y + chance.within((-0.08, 0.05)),
        TOP + LID / 2.0,
    );
    let seat = place + Vector3::z() * (HEIGHT / 2.0 + LID / 2.0);
    let turn = chance.within((-1.0, 1.0));
    // A hand around the bottle, with the palm at −x of its frame; hands come from their own side.
    let around = Isometry3::new(
        Vector3::new(-RADIUS, 0.0, -0.02),
        -Vector3::y() * std::f64::consts::FRAC_PI_2,
    );
    let bottle =
        thing::disc("bottle", "bottle", (RADIUS, HEIGHT), 0.45, turned(place, turn), around);
    let lid_pose = turned(if open { beside } else { seat }, turn);
    let rim = at(0.0, -0.03, 0.004);
    let mut lid: Thing = thing::disc("lid", "lid", (RADIUS, LID), 0.03, lid_pose, rim);
    lid.object.joints.push(Joint {
        name: "thread".to_owned(),
        motion: Motion::Turns,
        axis: Vector3::z(),
        lower: 0.0,
        upper: THREAD,
    });
    lid.start = if open { THREAD } else { 0.0 };
    Layout {
        things: vec![thing::table("table", size, at(0.0, 0.0, TOP - size.z / 2.0)), bottle, lid],
        scenery: Vec::new(),
        types: vec![
            kind("table", None),
            kind("thing", None),
            kind("bottle", Some("thing")),
            kind("lid", Some("thing")),
        ],
        agents: vec!["person".to_owned()],
        hands: two_hands(Vector3::new(0.0, -0.38, TOP + 0.18), 0.26),
        screw: Some((ObjectId(2), ObjectId(1))),
    }
}

pub(crate) fn script(person: &Person, chance: &mut Chance, stage: &Stage, open: bool) -> Script {
    let (table, bottle, lid) = (ObjectId(0), ObjectId(1), ObjectId(2));
    // The preferred hand turns, the other holds.
    let turner = HandId(u32::from(person.hand == Side::Right));
    let holder = HandId(1 - turner.0);
    let home = |hand: HandId| Skill::Go(stage.hand(hand));
    let lifts = chance.happens(0.6);
    let lift = if lifts { chance.within((0.05, 0.12)) } else { 0.0 };
    let place = |object: ObjectId| {
        let off = stage.pose(object).translation.vector - stage.pose(table).translation.vector;
        Vector3::new(off.x, off.y, 0.0)
    };
    let mut holds =
        vec![Skill::Pause(chance.within((0.4, 0.8))), Skill::Take { thing: bottle, lift }];
    let mut turns = vec![Skill::Pause(chance.within((0.4, 0.9)))];
    let away = if turner.0 == 1 { 1.0 } else { -1.0 };
    if open {
        turns.push(Skill::Take { thing: lid, lift: chance.within((0.08, 0.14)) });
        turns.push(Skill::Await { hand: holder, skills: 2 });
        turns.push(Skill::Seat { lid, bottle });
        turns.push(Skill::Turn { lid, angle: -(THREAD + 0.15) });
        turns.push(Skill::Leave);
    } else {
        turns.push(Skill::Await { hand: holder, skills: 2 });
        turns.push(Skill::Take { thing: lid, lift: 0.0 });
        turns.push(Skill::Turn { lid, angle: THREAD + 0.25 });
        let off =
            Vector3::new(away * chance.within((0.17, 0.26)), chance.within((-0.08, 0.06)), 0.0);
        turns.push(Skill::Put { thing: lid, on: table, place: Some(place(bottle) + off) });
    }
    let turned = turns.len();
    turns.push(home(turner));
    holds.push(Skill::Await { hand: turner, skills: turned });
    if lifts {
        holds.push(Skill::Put { thing: bottle, on: table, place: Some(place(bottle)) });
    } else {
        holds.push(Skill::Leave);
    }
    holds.push(home(holder));
    let mut hands = vec![Vec::new(), Vec::new()];
    hands[holder.index()] = holds;
    hands[turner.index()] = turns;
    let goal = goals(open).swap_remove(0).facts;
    Script { hands, goal }
}
