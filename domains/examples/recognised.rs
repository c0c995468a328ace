//! Persons and seeds go in; how well observation and segmentation recognise what their hands really do comes out, a table for each world and one for all.
//!
//! `cargo run --release -p caveat-domains --example recognised -- [PERSONS] [FIRST]`

use domains::world::{Person, Scenario, Task, demonstrate};
use learner::observe::{self, observe};
use learner::segment::{self, Induction, Samples, Score, Tree, induce, score};

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse::<u32>().ok());
    let (persons, first) = (numbers.next().unwrap_or(10), numbers.next().unwrap_or(0));
    let (mut all, mut with_grip, mut without) =
        (Score::default(), Score::default(), Score::default());
    let mut worst: Vec<(f64, String)> = Vec::new();
    let mut samples = Samples::default();
    for scenario in Scenario::ALL {
        if std::env::args().nth(3).is_some_and(|only| !scenario.name().contains(&only)) {
            continue;
        }
        let mut one = Score::default();
        for task in scenario.tasks().iter().copied().filter(|task| *task != Task::Nothing) {
            for number in first..first + persons {
                let person = Person::draw(number, 1);
                let shown = demonstrate(scenario, task, &person, u64::from(number));
                let config = observe::Config::default();
                let observations = observe(&shown.header, &config, &shown.frames);
                let found = score(
                    &Tree::published(),
                    &segment::Config::default(),
                    &observations,
                    &shown.truths,
                );
                worst.push((
                    found.accuracy(),
                    format!("{} {task:?} {number}, grip {}", scenario.name(), person.measures_grip),
                ));
                one.add(&found);
                for (state, activity) in shown.truths.iter().flat_map(|truth| &truth.hands) {
                    samples.add(state, *activity);
                }
                if person.measures_grip { with_grip.add(&found) } else { without.add(&found) }
            }
        }
        println!("{}\n{one}", scenario.name());
        all.add(&one);
    }
    println!("all\n{all}\nwith a measured grip\n{with_grip}\nwithout\n{without}");
    if let Some(tree) = induce(&samples, &Induction::default()) {
        println!("the tree that is learned from what really happened\n{tree}");
    }
    worst.sort_by(|one, other| one.0.total_cmp(&other.0));
    for (accuracy, what) in worst.iter().take(12) {
        println!("{:.2} %  {what}", accuracy * 100.0);
    }
}
