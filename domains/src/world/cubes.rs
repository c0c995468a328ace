//! A seed goes in; a table with four or five coloured cubes comes out, the four goals for them, and who stacks what.
//!
//! The goals follow figure 3.1 of the thesis as far as its text tells: two that are shown in demonstrations (one cube on another, a tower of three),
//! and two that never are (two towers side by side, a tower of four).

use super::person::{Person, Side};
use super::scenario::{Goal, Layout, Script, Task, fact, kind, two_hands};
use super::skill::Skill;
use super::space::{at, turned};
use super::stage::Stage;
use super::thing;
use crate::chance::Chance;
use learner::log::{HandId, ObjectId};
use nalgebra::{Isometry3, Translation3, Vector3};

/// The height of the table, in metres.
const TOP: f64 = 0.75;
/// The edge of a cube, in metres.
const EDGE: f64 = 0.05;
const COLOURS: [&str; 5] = ["red", "green", "blue", "yellow", "white"];

pub(crate) fn goals() -> Vec<Goal> {
    let on = |above: &str, below: &str| {
        fact("on-top", &[&format!("{above}-cube"), &format!("{below}-cube")])
    };
    vec![
        Goal { name: "one-on-another", facts: vec![on("red", "green")] },
        Goal { name: "tower-of-three", facts: vec![on("red", "green"), on("green", "blue")] },
        Goal { name: "two-towers", facts: vec![on("red", "green"), on("blue", "yellow")] },
        Goal {
            name: "tower-of-four",
            facts: vec![on("red", "green"), on("green", "blue"), on("blue", "yellow")],
        },
    ]
}

pub(crate) fn layout(chance: &mut Chance) -> Layout {
    let size = Vector3::new(1.2, 0.8, 0.05);
    let mut things = vec![thing::table("table", size, at(0.0, 0.0, TOP - size.z / 2.0))];
    let count = 4 + chance.below(2);
    let mut places: Vec<Vector3<f64>> = Vec::new();
    while places.len() < count {
        let place = Vector3::new(
            chance.within((-0.42, 0.42)),
            chance.within((-0.22, 0.25)),
            TOP + EDGE / 2.0,
        );
        if places.iter().all(|other| (other - place).norm() > 0.15) {
            let name = format!("{}-cube", COLOURS[places.len()]);
            let pose = turned(place, chance.within((-0.7, 0.7)));
            things.push(thing::cube(&name, EDGE, pose));
            places.push(place);
        }
    }
    Layout {
        things,
        scenery: Vec::new(),
        types: vec![kind("table", None), kind("cube", None)],
        agents: vec!["person".to_owned()],
        hands: two_hands(Vector3::new(0.0, -0.38, TOP + 0.18), 0.24),
        screw: None,
    }
}

pub(crate) fn script(task: Task, person: &Person, chance: &mut Chance, stage: &Stage) -> Script {
    let mut cubes: Vec<ObjectId> =
        stage.objects().filter(|object| stage.thing(*object).object.kind == "cube").collect();
    chance.shuffle(&mut cubes);
    let stacked = if task == Task::StackOne { 1 } else { 2 };
    let mut turns = Vec::new();
    let mut goal = Vec::new();
    for step in 0..stacked {
        let (below, above) = (cubes[step], cubes[step + 1]);
        // Most take the hand that they prefer; some the nearer one.
        let side = stage.pose(above).translation.x;
        let hand = if chance.happens(0.8) {
            u32::from(person.hand == Side::Right)
        } else {
            u32::from(side > 0.0)
        };
        let hand = HandId(hand);
        let mut skills = Vec::new();
        let other = cubes[(step + 2) % cubes.len()];
        stray(person, chance, stage, hand, other, &mut skills);
        skills.push(Skill::Take { thing: above, lift: chance.within((0.04, 0.10)) });
        skills.push(Skill::Put { thing: above, on: below, place: None });
        turns.push((hand, skills));
        let name = |object: ObjectId| stage.thing(object).object.name.clone();
        goal.push(fact("on-top", &[&name(above), &name(below)]));
    }
    Script { hands: in_turn(turns, stage, chance), goal }
}

/// Perhaps a start towards the wrong thing or a detour through the air before something is taken.
pub(crate) fn stray(
    person: &Person,
    chance: &mut Chance,
    stage: &Stage,
    hand: HandId,
    other: ObjectId,
    skills: &mut Vec<Skill>,
) {
    if !chance.happens(person.detour) {
        return;
    }
    if chance.happens(0.5) {
        skills.push(Skill::Falter(other));
    } else {
        let home = stage.hand(hand).translation.vector;
        let off = chance.normals().component_mul(&Vector3::new(0.1, 0.06, 0.03));
        let place = home + off + Vector3::new(0.0, 0.15, 0.06);
        skills.push(Skill::Go(Isometry3::from_parts(place.into(), stage.hand(hand).rotation)));
    }
}

/// Skills of hands one after another: a hand waits for the one before it, unless that is itself, and all go back to rest.
pub(crate) fn in_turn(
    turns: Vec<(HandId, Vec<Skill>)>,
    stage: &Stage,
    chance: &mut Chance,
) -> Vec<Vec<Skill>> {
    in_turn_from(turns, stage, chance, true)
}

/// The same; whether the last hand goes back to rest as well is given.
pub(crate) fn in_turn_from(
    turns: Vec<(HandId, Vec<Skill>)>,
    stage: &Stage,
    chance: &mut Chance,
    back: bool,
) -> Vec<Vec<Skill>> {
    let mut hands: Vec<Vec<Skill>> = stage
        .hands()
        .map(|hand| {
            let mut first = vec![Skill::Pause(chance.within((0.4, 0.9)))];
            if chance.happens(0.2) {
                // A hand that is not needed yet stirs, with nothing in mind.
                let off = chance.normals() * 0.04;
                let aside = Isometry3::from(Translation3::from(off)) * stage.hand(hand);
                first.extend([Skill::Go(aside), Skill::Pause(0.3), Skill::Go(stage.hand(hand))]);
            }
            first
        })
        .collect();
    let home = |hand: HandId| Skill::Go(stage.hand(hand));
    let mut before: Option<(HandId, usize)> = None;
    for (hand, skills) in turns {
        if let Some((other, done)) = before
            && other != hand
        {
            hands[other.index()].push(home(other));
            hands[hand.index()].push(Skill::Await { hand: other, skills: done });
        }
        hands[hand.index()].extend(skills);
        before = Some((hand, hands[hand.index()].len()));
    }
    if back && let Some((hand, _)) = before {
        hands[hand.index()].push(home(hand));
    }
    hands
}
