//! A seed goes in; the kitchen of the guided demonstrations comes out (figure 3.2 of the thesis): plates on two tables, two drawers and chairs, and what is done there.
//!
//! The names are those of `domains/closed-drawer` and `domains/blocked-drawer`, so what is learned here extends those domains.

use super::cubes::{in_turn_from, stray};
use super::person::{Person, Side};
use super::scenario::{Goal, Layout, Script, Task, fact, kind, two_hands};
use super::skill::Skill;
use super::space::{at, turned};
use super::stage::Stage;
use super::thing::{self, Form, Part, Thing};
use crate::chance::Chance;
use learner::log::HandId;
use nalgebra::Vector3;

/// Where the fronts of closed drawers are, along y.
const FRONT: f64 = 0.30;
/// How far drawers open, in metres.
const TRAVEL: f64 = 0.30;

pub(crate) fn goals() -> Vec<Goal> {
    vec![Goal {
        name: "plate-in-drawer",
        facts: vec![fact("inside", &["red-plate", "pink-drawer"])],
    }]
}

pub(crate) fn layout(chance: &mut Chance, blocked: bool) -> Layout {
    let top = 0.75;
    let table = Vector3::new(0.7, 0.7, 0.04);
    let size = Vector3::new(0.5, 0.45, 0.15);
    let mut near = |place: Vector3<f64>, x: f64, y: f64| {
        place + Vector3::new(chance.within((-x, x)), chance.within((-y, y)), 0.0)
    };
    // The tables stand across the room, so that carrying a plate is a walk.
    let tables = [Vector3::new(-0.8, -1.9, top - 0.02), Vector3::new(0.9, -1.9, top - 0.02)];
    let drawers = [-0.35, 0.35].map(|x| Vector3::new(x, FRONT + size.y / 2.0, 0.62));
    let plates = tables.map(|place| near(place + Vector3::z() * 0.03, 0.2, 0.2));
    let away = near(Vector3::new(1.3, -0.7, 0.431), 0.1, 0.1);
    let before = near(Vector3::new(drawers[0].x, FRONT - 0.05 - 0.21, 0.431), 0.05, 0.01);
    let mut things: Vec<Thing> = vec![
        thing::table("table1", table, at(tables[0].x, tables[0].y, tables[0].z)),
        thing::table("table2", table, at(tables[1].x, tables[1].y, tables[1].z)),
    ];
    for (name, place) in ["pink-drawer", "blue-drawer"].into_iter().zip(drawers) {
        let mut drawer = thing::drawer(name, size, at(place.x, place.y, place.z), TRAVEL);
        // In the first scenario the blue drawer happens to be open.
        if name == "blue-drawer" && !blocked {
            drawer.start = TRAVEL * 0.95;
        }
        things.push(drawer);
    }
    for (name, place) in ["red-plate", "green-plate"].into_iter().zip(plates) {
        // Taken at the rim, from above.
        let grasp = at(0.0, -0.085, 0.005);
        things.push(thing::disc(
            name,
            "plate",
            (0.10, 0.02),
            0.25,
            at(place.x, place.y, place.z),
            grasp,
        ));
    }
    if blocked {
        things.push(thing::chair("chair1", turned(before, 0.0)));
        things.push(thing::chair("chair2", turned(away, 0.4)));
    } else {
        things.push(thing::chair("chair1", turned(away, 0.4)));
    }
    Layout {
        things,
        scenery: vec![
            Part { form: Form::Box(Vector3::new(8.0, 8.0, 0.2)), place: at(0.0, 0.0, -0.1) },
            Part { form: Form::Box(Vector3::new(1.6, 0.5, 0.04)), place: at(0.0, 0.55, 0.80) },
        ],
        types: vec![
            kind("item", None),
            kind("plate", Some("item")),
            kind("drawer", None),
            kind("table", None),
            kind("chair", None),
        ],
        agents: vec!["person".to_owned()],
        hands: two_hands(Vector3::new(0.0, -0.7, 1.0), 0.24),
        screw: None,
    }
}

pub(crate) fn script(
    task: Task,
    person: &Person,
    chance: &mut Chance,
    stage: &Stage,
    blocked: bool,
) -> Script {
    let named = |name: &str| stage.named(name).expect("the kitchen has it");
    let (drawer, plate) = (named("pink-drawer"), named("red-plate"));
    let hand = HandId(u32::from(person.hand == Side::Right));
    let mut skills = Vec::new();
    let mut goal = Vec::new();
    let other = named("green-plate");
    if blocked {
        let by = Vector3::new(chance.within((-0.12, 0.15)), chance.within((-0.62, -0.45)), 0.0);
        skills.push(Skill::Drag { thing: named("chair1"), by });
        goal.push(fact("unblocked", &["pink-drawer"]));
    }
    if !(blocked && task == Task::Guided) {
        let opening = chance.within((0.88, 0.97));
        skills.push(Skill::Slide { drawer, opening });
        goal.push(fact("open", &["pink-drawer"]));
    }
    if task == Task::Full {
        stray(person, chance, stage, hand, other, &mut skills);
        skills.push(Skill::Take { thing: plate, lift: chance.within((0.06, 0.12)) });
        skills.push(Skill::Insert { thing: plate, into: drawer });
        goal = vec![fact("inside", &["red-plate", "pink-drawer"])];
    }
    // Some open the drawer or move the chair with one hand and carry the plate with the other.
    let split = skills.len() - if task == Task::Full { 2 } else { 0 };
    let mut turns = vec![(hand, skills)];
    if task == Task::Full && chance.happens(0.25) {
        let rest = turns[0].1.split_off(split);
        turns.push((HandId(1 - hand.0), rest));
    }
    // The recording ends with the work, where the person then is.
    Script { hands: in_turn_from(turns, stage, chance, false), goal }
}
