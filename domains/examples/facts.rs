//! Persons and seeds go in; for each predicate comes out for how many frames it was rightly seen, missed, and wrongly seen in all worlds.
//!
//! `cargo run --release -p caveat-domains --example facts -- [PERSONS] [FIRST] [WORLD]`

use std::collections::{BTreeMap, BTreeSet};

use domains::world::{Person, Scenario, Task, demonstrate};
use learner::log::Fact;
use learner::observe::{self, observe};

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse::<u32>().ok());
    let (persons, first) = (numbers.next().unwrap_or(5), numbers.next().unwrap_or(0));
    let only = std::env::args().nth(3);
    let mut counts: BTreeMap<String, [u64; 3]> = BTreeMap::new();
    let mut examples: BTreeMap<(bool, Fact), u64> = BTreeMap::new();
    for scenario in Scenario::ALL {
        if only.as_ref().is_some_and(|only| scenario.name() != only) {
            continue;
        }
        for task in scenario.tasks().iter().copied().filter(|task| *task != Task::Nothing) {
            for number in first..first + persons {
                let person = Person::draw(number, 1);
                let shown = demonstrate(scenario, task, &person, u64::from(number));
                // The worlds go by contacts, which things in hands have too.
                let config =
                    observe::Config { held_things_rest: true, ..observe::Config::default() };
                let mut seen: BTreeSet<Fact> = BTreeSet::new();
                for (observation, truth) in
                    observe(&shown.header, &config, &shown.frames).iter().zip(&shown.truths)
                {
                    for change in &observation.changes {
                        if change.holds {
                            seen.insert(change.fact.clone());
                        } else {
                            seen.remove(&change.fact);
                        }
                    }
                    let really: BTreeSet<Fact> = truth.facts.iter().cloned().collect();
                    for fact in seen.union(&really) {
                        let place = match (really.contains(fact), seen.contains(fact)) {
                            (true, true) => 0,
                            (true, false) => 1,
                            _ => 2,
                        };
                        counts.entry(fact.predicate.clone()).or_default()[place] += 1;
                        if place > 0 {
                            *examples.entry((place == 1, fact.clone())).or_default() += 1;
                        }
                    }
                }
            }
        }
    }
    println!("{:12} {:>10} {:>10} {:>10}", "predicate", "right", "missed", "wrong");
    for (predicate, [right, missed, wrong]) in &counts {
        println!("{predicate:12} {right:>10} {missed:>10} {wrong:>10}");
    }
    let mut examples: Vec<_> = examples.into_iter().collect();
    examples.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    for ((missed, fact), count) in examples.into_iter().take(15) {
        let what = if missed { "missed" } else { "wrong" };
        println!("{count:>8} frames {what}: ({} {})", fact.predicate, fact.arguments.join(" "));
    }
}
