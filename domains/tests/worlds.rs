//! Worlds and persons go in; demonstrations that physics carried out must come out, with the truth beside them.

use domains::world::{GREATEST_SPEED, Person, RATE, Scenario, Task, demonstrate, holds_at_start};
use learner::truth::Activity;
use std::collections::BTreeSet;

#[test]
fn every_world_can_be_shown_by_all_sorts_of_people() {
    for scenario in Scenario::ALL {
        for &task in scenario.tasks() {
            // The longest of all is shown once.
            let persons = [1, 2, 30];
            let shows = if scenario == Scenario::HanoiThree { 1 } else { persons.len() };
            for &number in &persons[..shows] {
                let (person, seed) = (Person::draw(number, 5), u64::from(number));
                let shown = demonstrate(scenario, task, &person, seed);
                let what = format!("{} {task:?} {number}", scenario.name());
                assert!(shown.reached, "{what}");
                assert_eq!(shown.frames.len(), shown.truths.len(), "{what}");
                for (at, frame) in shown.frames.iter().enumerate() {
                    assert!((frame.time - at as f64 / RATE).abs() < 1e-9);
                    assert_eq!(frame.objects.len(), shown.header.objects.len());
                    assert_eq!(frame.hands.len(), shown.header.hands.len());
                }
                // Nobody is given what they are to show.
                let given = holds_at_start(scenario, seed, &shown.goal);
                assert_eq!(given, task == Task::Nothing, "{what}");
            }
        }
    }
}

#[test]
fn the_same_demonstration_comes_out_each_time_and_another_for_another_seed() {
    let person = Person::draw(11, 2);
    let first = demonstrate(Scenario::KitchenBlocked, Task::Guided, &person, 4);
    assert_eq!(first, demonstrate(Scenario::KitchenBlocked, Task::Guided, &person, 4));
    let other = demonstrate(Scenario::KitchenBlocked, Task::Guided, &person, 5);
    assert_ne!(first.frames, other.frames);
}

#[test]
fn nothing_teleports() {
    for scenario in Scenario::ALL.into_iter().filter(|other| *other != Scenario::HanoiThree) {
        let shown = demonstrate(scenario, scenario.tasks()[0], &Person::ideal(), 8);
        for (at, pair) in shown.frames.windows(2).enumerate() {
            let hands = pair[0].hands.iter().flatten().zip(pair[1].hands.iter().flatten());
            for (before, after) in hands {
                let way = after.pose.translation.vector - before.pose.translation.vector;
                assert!(way.norm() * RATE <= GREATEST_SPEED, "{} {at}", scenario.name());
            }
            let things = pair[0].objects.iter().flatten().zip(pair[1].objects.iter().flatten());
            for (before, after) in things {
                let way = after.pose.translation.vector - before.pose.translation.vector;
                // Not even what falls by some millimetres gets faster than a hand.
                assert!(way.norm() * RATE < 1.5, "{} {at}: {way}", scenario.name());
            }
        }
    }
}

#[test]
fn the_truth_is_that_of_table_3_1_and_of_contacts() {
    let shown = demonstrate(Scenario::Cubes, Task::StackTwo, &Person::ideal(), 8);
    let mut seen = BTreeSet::new();
    for truth in &shown.truths {
        for (state, activity) in &truth.hands {
            seen.insert(*activity);
            let expected = match (state.moves, state.acted_on, state.in_hand) {
                (_, Some(_), None) => Activity::Reach,
                (_, Some(_), Some(_)) => Activity::Granular,
                (true, None, Some(_)) => Activity::Put,
                (false, None, Some(_)) => Activity::Take,
                (_, None, None) => Activity::Idle,
            };
            assert_eq!(*activity, expected);
        }
    }
    assert_eq!(seen.len(), 5, "{seen:?}");
    let last = &shown.truths.last().expect("there are frames").facts;
    for fact in &shown.goal {
        assert!(last.contains(fact));
    }
    // In the end each cube rests on exactly one thing.
    let resting = last.iter().filter(|fact| fact.predicate == "on-top").count();
    assert_eq!(resting, shown.header.objects.len() - 1);
}

#[test]
fn noise_gaps_and_slips_are_as_the_person_has_them() {
    let person = Person { noise: 0.002, lost: 0.3, lost_for: 0.5, drop: 1.0, ..Person::ideal() };
    let shown = demonstrate(Scenario::Cubes, Task::StackOne, &person, 8);
    let falls = shown
        .truths
        .windows(2)
        .filter(|pair| pair[0].hands.iter().any(|hand| hand.0.in_hand.is_some()))
        .filter(|pair| pair[1].hands.iter().all(|hand| hand.0.in_hand.is_none()))
        .count();
    assert!(falls >= 2, "{falls}");
    let lost =
        shown.frames.iter().filter(|frame| frame.objects.iter().any(Option::is_none)).count();
    assert!(lost > 20, "{lost}");
    assert!(shown.frames[0].objects.iter().all(Option::is_some));
    // A hand at rest is tracked with the noise of two millimetres, of which a part is slow.
    let still: Vec<f64> = shown
        .frames
        .iter()
        .take_while(|frame| frame.time < 0.35)
        .filter_map(|frame| frame.hands[0].as_ref())
        .map(|hand| hand.pose.translation.x)
        .collect();
    let mean = still.iter().sum::<f64>() / still.len() as f64;
    let spread = still.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / still.len() as f64;
    assert!((0.0012..0.003).contains(&spread.sqrt()), "{}", spread.sqrt());
}

#[test]
fn somebody_who_drops_things_now_and_then_takes_them_again() {
    let person = Person { drop: 0.5, ..Person::ideal() };
    for seed in 0..12 {
        let shown = demonstrate(Scenario::Cubes, Task::StackTwo, &person, seed);
        assert!(shown.reached, "seed {seed}");
    }
}

#[test]
fn guided_demonstrations_are_much_shorter() {
    for scenario in [Scenario::KitchenClosed, Scenario::KitchenBlocked] {
        let length = |task| {
            (0..4)
                .map(|number| demonstrate(scenario, task, &Person::draw(number, 1), 1).frames.len())
                .sum::<usize>()
        };
        let (guided, full) = (length(Task::Guided), length(Task::Full));
        assert!(guided * 2 < full, "{guided} of {full}");
    }
}
