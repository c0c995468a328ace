//! Nothing but a seed goes in; the towers of Hanoi with cubes come out, for two arms that share a tray (figure 3.4a to c of the thesis).
//!
//! The left arm reaches the left spot and the tray, the right arm the tray and the right spot, so every cube passes the tray.
//! Since no arm reaches both outer spots, the puzzle is the one in which discs move between neighbouring pegs only: 3ⁿ − 1 moves.

use super::cubes::in_turn;
use super::person::Person;
use super::scenario::{Goal, Layout, Script, fact, kind};
use super::skill::Skill;
use super::space::at;
use super::stage::Stage;
use super::thing;
use crate::chance::Chance;
use learner::log::{Hand, HandId, ObjectId, Reach};
use nalgebra::Vector3;

const TOP: f64 = 0.75;
/// The edges of the cubes, in metres.
const EDGES: [(&str, f64); 3] =
    [("large-cube", 0.07), ("middle-cube", 0.055), ("small-cube", 0.04)];
/// The spots from left to right, and where they are along x.
const SPOTS: [(&str, f64); 3] = [("left-spot", -0.38), ("tray", 0.0), ("right-spot", 0.38)];
/// The place of the first cube among the things: after the table and the spots.
const FIRST: u32 = 4;

pub(crate) fn goals(cubes: usize) -> Vec<Goal> {
    let chosen = chosen(cubes);
    let mut facts = vec![fact("at", &[chosen[0].0, "right-spot"])];
    for pair in chosen.windows(2) {
        facts.push(fact("on-top", &[pair[1].0, pair[0].0]));
    }
    vec![Goal { name: "tower-on-the-right", facts }]
}

/// The cubes from the largest on; of two, the largest and the smallest.
fn chosen(cubes: usize) -> Vec<(&'static str, f64)> {
    if cubes == 2 { vec![EDGES[0], EDGES[2]] } else { EDGES.to_vec() }
}

pub(crate) fn layout(chance: &mut Chance, cubes: usize) -> Layout {
    let size = Vector3::new(1.4, 0.7, 0.05);
    let mut things = vec![thing::table("table", size, at(0.0, 0.0, TOP - size.z / 2.0))];
    for (name, x) in SPOTS {
        things.push(thing::spot(name, Vector3::new(0.2, 0.2, 0.002), at(x, 0.0, TOP)));
    }
    let mut height = TOP;
    for (name, edge) in chosen(cubes) {
        let x = SPOTS[0].1 + chance.within((-0.004, 0.004));
        let y = chance.within((-0.004, 0.004));
        things.push(thing::cube(name, edge, at(x, y, height + edge / 2.0)));
        height += edge;
    }
    let hands = [("left-arm", -1.0), ("right-arm", 1.0)]
        .into_iter()
        .enumerate()
        .map(|(agent, (name, side))| {
            let centre = Vector3::new(side * 0.34, -0.45, TOP + 0.15);
            let reach = Some(Reach { centre, radius: 0.72 });
            let hand = Hand { name: name.to_owned(), agent: agent as u32, reach };
            (hand, at(side * 0.42, -0.26, TOP + 0.25))
        })
        .collect();
    Layout {
        things,
        scenery: Vec::new(),
        types: vec![kind("table", None), kind("spot", None), kind("cube", None)],
        agents: vec!["left-arm".to_owned(), "right-arm".to_owned()],
        hands,
        screw: None,
    }
}

/// The moves of the cubes above and with `least`, from one spot to another: cube, from, to.
///
/// A cube moves between neighbours; between the outer spots it goes by the tray, and what is on it goes away twice.
fn moves(cubes: u32, from: usize, to: usize, into: &mut Vec<(u32, usize, usize)>, least: u32) {
    if least == cubes {
        return;
    }
    if from.abs_diff(to) == 1 {
        let other = 3 - from - to;
        moves(cubes, from, other, into, least + 1);
        into.push((least, from, to));
        moves(cubes, other, to, into, least + 1);
    } else {
        moves(cubes, from, to, into, least + 1);
        into.push((least, from, 1));
        moves(cubes, to, from, into, least + 1);
        into.push((least, 1, to));
        moves(cubes, from, to, into, least + 1);
    }
}

pub(crate) fn script(_person: &Person, chance: &mut Chance, stage: &Stage, cubes: usize) -> Script {
    let table = ObjectId(0);
    let mut list = Vec::new();
    moves(cubes as u32, 0, 2, &mut list, 0);
    let mut piles: [Vec<u32>; 3] = [(0..cubes as u32).collect(), Vec::new(), Vec::new()];
    let mut turns: Vec<(HandId, Vec<Skill>)> = Vec::new();
    for (cube, from, to) in list {
        // The left arm moves between the left spot and the tray.
        let hand = HandId(u32::from(from.min(to) == 1));
        let thing = ObjectId(FIRST + cube);
        piles[from].pop();
        let put = if let Some(below) = piles[to].last() {
            Skill::Put { thing, on: ObjectId(FIRST + below), place: None }
        } else {
            let off = Vector3::new(SPOTS[to].1, 0.0, 0.0) + chance.normals() * 0.003;
            Skill::Put { thing, on: table, place: Some(Vector3::new(off.x, off.y, 0.0)) }
        };
        piles[to].push(cube);
        let home = Skill::Go(stage.hand(hand));
        let skills = vec![Skill::Take { thing, lift: chance.within((0.05, 0.09)) }, put, home];
        turns.push((hand, skills));
    }
    Script { hands: in_turn(turns, stage, chance), goal: goals(cubes).swap_remove(0).facts }
}

#[cfg(test)]
mod tests {
    use super::moves;

    #[test]
    fn the_puzzle_between_neighbours_takes_three_to_the_n_moves_less_one() {
        for (cubes, count) in [(1, 2), (2, 8), (3, 26)] {
            let mut list = Vec::new();
            moves(cubes, 0, 2, &mut list, 0);
            assert_eq!(list.len(), count);
            let mut piles: [Vec<u32>; 3] = [(0..cubes).collect(), Vec::new(), Vec::new()];
            for (cube, from, to) in list {
                assert_eq!(piles[from].pop(), Some(cube));
                assert!(piles[to].last().is_none_or(|below| *below < cube));
                assert_eq!(from.abs_diff(to), 1);
                piles[to].push(cube);
            }
            assert_eq!(piles[2], (0..cubes).collect::<Vec<u32>>());
        }
    }
}
