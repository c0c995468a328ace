//! A scratch.
use domains::world::{Person, Scenario, Task, demonstrate};
use learner::observe::{Config, Vocabulary, observe};
use learner::operators::record::Recorder;
use learner::operators::words::Words;
use learner::operators::{Options, learn};

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scenario = Scenario::named(&args[1]).unwrap();
    let task = match args[2].as_str() {
        "full" => Task::Full,
        "guided" => Task::Guided,
        "one" => Task::StackOne,
        "two" => Task::StackTwo,
        _ => Task::Nothing,
    };
    let person: u32 = args[3].parse().unwrap();
    let seed: u64 = args[4].parse().unwrap();
    let shown = demonstrate(scenario, task, &Person::draw(person, seed), seed);
    println!("; reached {} frames {}", shown.reached, shown.frames.len());
    let config = Config::default();
    let start = std::time::Instant::now();
    let observations = observe(&shown.header, &config, &shown.frames);
    println!("; observed in {:?}", start.elapsed());
    let mut recorder = Recorder::new(format!("{}-{person}", args[1]), &shown.header);
    for one in &observations {
        recorder.push(one);
    }
    let record = recorder.finish();
    if args.len() > 5 {
        for told in &record.initial {
            println!("; init {:?}", told.fact);
        }
        for turn in &record.changes {
            println!(
                "; {:.2} {} {:?} {:?} credits {:?}",
                turn.time,
                if turn.holds { "+" } else { "-" },
                turn.told.fact.predicate,
                turn.told.fact.arguments,
                turn.credits
                    .iter()
                    .map(|c| (c.hand.0, c.distance, c.holds, c.touches, c.acts))
                    .collect::<Vec<_>>()
            );
        }
        for (h, runs) in record.hands.iter().enumerate() {
            for run in runs {
                println!("; hand {h} {:.2}-{:.2} {:?}", run.from, run.to, run.state);
            }
        }
    }
    let words = Words::of(&shown.header, Vocabulary::default());
    let agents = args.iter().any(|a| a == "agents");
    let taught = learn(
        &[(record, words)],
        None,
        &Options { title: args[1].clone(), agents, ..Options::default() },
    );
    for (deeds, line) in &taught.lines {
        for instance in &line.instances {
            let deed = &deeds.deeds[instance.deed];
            let names: Vec<_> = instance
                .arguments
                .iter()
                .map(|id| line.trace.objects[id.index()].name.text.clone())
                .collect();
            println!(
                "; {:.2}..{:.2} @{:.2} ({} {}) with {:?}",
                deed.from,
                deed.to,
                deed.at,
                taught.learned.domain.actions[instance.action.index()].name.text,
                names.join(" "),
                deed.with
            );
        }
        println!(
            "; mute {:?} strays {:?}",
            line.mute,
            deeds.strays.iter().map(|t| (t.time, t.holds, &t.told.fact)).collect::<Vec<_>>()
        );
        for invariant in learner::invariant::invariants(
            &taught.learned.domain,
            std::slice::from_ref(&line.trace),
        ) {
            println!("; {}", learner::invariant::annotation(&taught.learned.domain, &invariant));
        }
    }
    println!("{}", learner::write::text(&taught.learned));
}
