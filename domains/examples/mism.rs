//! scratch
use domains::world::{Person, Scenario, Task, demonstrate};
use learner::observe::{self, observe};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scenario = Scenario::ALL.into_iter().find(|s| s.name() == args[1]).unwrap();
    let number: u32 = args[2].parse().unwrap();
    let person = Person::draw(number, 1);
    let shown = demonstrate(scenario, Task::Full, &person, u64::from(number));
    let config = observe::Config::default();
    let obs = observe(&shown.header, &config, &shown.frames);
    let name = |o: Option<learner::log::ObjectId>| {
        o.map_or("-".to_string(), |o| shown.header.objects[o.index()].name.clone())
    };
    println!(
        "grip {} noise {} objects {:?}",
        person.measures_grip,
        person.noise,
        shown
            .header
            .objects
            .iter()
            .map(|o| (&o.name, o.size.as_slice().to_vec(), o.fixed, o.hollow))
            .collect::<Vec<_>>()
    );
    for hand in 0..shown.header.hands.len() {
        let mut start = 0;
        let key = |i: usize| {
            let t = &shown.truths[i].hands[hand].0;
            let f = &obs[i].hands[hand];
            (
                t.moves,
                t.acted_on,
                t.in_hand,
                if (f.moves) != t.moves { f.moves } else { t.moves },
                f.acted_on,
                f.in_hand,
            )
        };
        for i in 1..=obs.len() {
            if i == obs.len() || key(i) != key(start) {
                let k = key(start);
                let same =
                    (k.1.is_some(), k.2.is_some(), k.0) == (k.4.is_some(), k.5.is_some(), k.3);
                if i - start > 6 {
                    println!(
                        "{} {} {:6.2}-{:6.2} true {} {} {} found {} {} {} {:?}",
                        if same { " " } else { "*" },
                        shown.header.hands[hand].name,
                        obs[start].time,
                        obs[i - 1].time,
                        k.0,
                        name(k.1),
                        name(k.2),
                        k.3,
                        name(k.4),
                        name(k.5),
                        shown.frames[start].hands[hand].as_ref().map(|h| h
                            .pose
                            .translation
                            .vector
                            .map(|x| (x * 100.0).round() / 100.0)
                            .as_slice()
                            .to_vec())
                    );
                }
                start = i;
            }
        }
    }
}
