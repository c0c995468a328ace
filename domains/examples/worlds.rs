//! Persons and seeds go in; how their demonstrations went comes out, a line for each world and task.
//!
//! `cargo run --release -p caveat-domains --example worlds -- [PERSONS] [FIRST]`, or for one of them `… -- WORLD [PERSON] [TASK] > picture.svg`

use domains::world::{Person, Scenario, Task, demonstrate};
use learner::truth::Activity;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Some(scenario) = words.first().and_then(|name| Scenario::named(name)) {
        // One demonstration: its picture to the output, its course to the error stream.
        let number = words.get(1).and_then(|word| word.parse().ok()).unwrap_or(7);
        let task = scenario.tasks()[words.get(2).and_then(|word| word.parse().ok()).unwrap_or(0)];
        let shown = demonstrate(scenario, task, &Person::draw(number, 1), u64::from(number));
        let mut before = Vec::new();
        for truth in &shown.truths {
            let facts: Vec<String> = truth
                .facts
                .iter()
                .map(|fact| format!("{} {}", fact.predicate, fact.arguments.join(" ")))
                .chain(truth.hands.iter().map(|(_, activity)| format!("{activity:?}")))
                .collect();
            let new: Vec<_> = facts.iter().filter(|fact| !before.contains(*fact)).collect();
            let gone: Vec<_> = before.iter().filter(|fact| !facts.contains(fact)).collect();
            if !new.is_empty() || !gone.is_empty() {
                eprintln!("{:6.2} + {new:?} - {gone:?}", truth.time);
            }
            before = facts;
        }
        eprintln!("goal {:?} reached {}", shown.goal, shown.reached);
        println!("{}", domains::world::draw(&shown.header, &shown.frames));
        return;
    }
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse::<u32>().ok());
    let (persons, first) = (numbers.next().unwrap_or(10), numbers.next().unwrap_or(0));
    for scenario in Scenario::ALL {
        for task in scenario.tasks().iter().copied().filter(|task| *task != Task::Nothing) {
            let (mut reached, mut seconds, mut frames) = (0, 0.0, 0);
            let mut share = [0_usize; 5];
            let mut failed = Vec::new();
            let clock = Instant::now();
            for number in first..first + persons {
                let shown =
                    demonstrate(scenario, task, &Person::draw(number, 1), u64::from(number));
                if shown.reached {
                    reached += 1;
                } else {
                    failed.push(number);
                }
                seconds += shown.frames.last().map_or(0.0, |frame| frame.time);
                frames += shown.frames.len();
                for truth in &shown.truths {
                    for (_, activity) in &truth.hands {
                        share[match activity {
                            Activity::Idle => 0,
                            Activity::Reach => 1,
                            Activity::Take => 2,
                            Activity::Put => 3,
                            Activity::Granular => 4,
                        }] += 1;
                    }
                }
            }
            let all: usize = share.iter().sum();
            let percent = share.map(|part| 100 * part / all.max(1));
            println!(
                "{:16} {task:?}: {reached}/{persons} reached, {:.1} s each, {frames} frames in {:.2} s; idle, reach, take, put, granular {percent:?} %; failed {failed:?}",
                scenario.name(),
                seconds / f64::from(persons),
                clock.elapsed().as_secs_f64(),
            );
        }
    }
}
