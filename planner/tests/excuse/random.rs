//! A number goes in; a tiny random domain and problem come out as text.

use std::fmt::Write;

/// A small generator of numbers (`SplitMix64`).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) as usize % below
    }

    fn chance(&mut self, percent: usize) -> bool {
        self.next(100) < percent
    }
}

/// The predicates: things are in places, places are linked, lamps are on, and there is power; of each what its arguments are.
const PREDICATES: [(&str, &[char]); 6] = [
    ("at", &['t', 'p']),
    ("link", &['p', 'p']),
    ("lit", &['p']),
    ("held", &['t']),
    ("free", &[]),
    ("power", &[]),
];

/// An atom over variables `?t0 ?p0 ?p1` or objects.
fn atom(numbers: &mut Numbers, of: usize, ground: bool) -> String {
    let (name, arguments) = PREDICATES[of];
    let mut text = format!("({name}");
    for &argument in arguments {
        let number = numbers.next(2);
        match (ground, argument) {
            (true, letter) => write!(text, " {letter}{number}"),
            (false, 't') => write!(text, " ?t0"),
            (false, letter) => write!(text, " ?{letter}{number}"),
        }
        .expect("a string takes everything");
    }
    text.push(')');
    text
}

fn literal(numbers: &mut Numbers, of: usize, negative: usize, ground: bool) -> String {
    let atom = atom(numbers, of, ground);
    if numbers.chance(negative) { format!("(not {atom})") } else { atom }
}

/// Moves a thing from one predicate to another, so that there are groups to be found.
fn transition(numbers: &mut Numbers) -> (String, String) {
    let pick = [
        ("(at ?t0 ?p0)", "(and (not (at ?t0 ?p0)) (at ?t0 ?p1))"),
        ("(and (at ?t0 ?p0) (free))", "(and (not (at ?t0 ?p0)) (not (free)) (held ?t0))"),
        ("(held ?t0)", "(and (not (held ?t0)) (free) (at ?t0 ?p1))"),
        ("(and (lit ?p0) (at ?t0 ?p0))", "(and (not (lit ?p0)) (lit ?p1))"),
    ];
    let (before, after) = pick[numbers.next(pick.len())];
    (before.to_owned(), after.to_owned())
}

/// The world of a seed.
pub fn world(seed: u64) -> (String, String) {
    let mut numbers = Numbers(seed);
    let mut domain = String::from(
        "(define (domain tiny) (:requirements :adl :derived-predicates) (:types t p)
  (:predicates (at ?t - t ?p - p) (link ?a ?b - p) (lit ?p - p) (held ?t - t) (free) (power) (glow ?p - p))\n",
    );
    if numbers.chance(25) {
        domain.push_str(
            "  (:derived (glow ?p - p) (or (and (lit ?p) (power)) (exists (?q - p) (and (link ?q ?p) (lit ?q)))))\n",
        );
    } else {
        domain.push_str("  (:derived (glow ?p - p) (lit ?p))\n");
    }
    for number in 0..=numbers.next(3) {
        let (mut before, mut after) = (String::new(), String::new());
        if numbers.chance(60) {
            (before, after) = transition(&mut numbers);
        }
        for _ in 0..numbers.next(3) {
            let of = numbers.next(PREDICATES.len());
            before = format!("{before} {}", literal(&mut numbers, of, 20, false));
        }
        if numbers.chance(15) {
            before.push_str(" (glow ?p0)");
        }
        if after.is_empty() || numbers.chance(20) {
            let of = [0, 2, 3, 4, 5][numbers.next(5)];
            after = format!("{after} {}", literal(&mut numbers, of, 35, false));
        }
        if numbers.chance(15) {
            let of = [2, 3, 4][numbers.next(3)];
            let when = numbers.next(PREDICATES.len());
            let (when, then) =
                (literal(&mut numbers, when, 30, false), literal(&mut numbers, of, 40, false));
            after = format!("{after} (when {when} {then})");
        }
        let _ = writeln!(
            domain,
            "  (:action a{number} :parameters (?t0 - t ?p0 ?p1 - p) :precondition (and {before}) :effect (and {after}))"
        );
    }
    domain.push_str(")\n");
    let mut facts = std::collections::BTreeSet::new();
    for thing in 0..2 {
        if numbers.chance(75) {
            facts.insert(format!("(at t{thing} p{})", numbers.next(2)));
        }
    }
    for _ in 0..numbers.next(4) {
        let of = 1 + numbers.next(PREDICATES.len() - 1);
        facts.insert(atom(&mut numbers, of, true));
    }
    let mut goal = String::new();
    for _ in 0..=numbers.next(2) {
        let of = [0, 2, 3, 5][numbers.next(4)];
        goal = format!("{goal} {}", literal(&mut numbers, of, 15, true));
    }
    if numbers.chance(10) {
        goal.push_str(" (glow p0)");
    }
    let facts: Vec<String> = facts.into_iter().collect();
    let problem = format!(
        "(define (problem one) (:domain tiny) (:objects t0 t1 - t p0 p1 - p)\n  (:init {})\n  (:goal (and {goal})))\n",
        facts.join(" ")
    );
    (domain, problem)
}
