//! `caveat simulate`: the name of a world goes in; the log of a demonstration in it comes out, or whether a plan reaches its goal there.

mod trials;

use std::collections::BTreeMap;
use std::path::Path;

use domains::world::{self, Goal, Person, PlanStep, Scenario, Task};
use learner::log::{Fact, Frame, Header, csv, json};
use learner::truth;
use learner::waypoints::Routine;

use crate::args::simulate::{Demo, Run, Simulate, TaskName, What};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Simulate, terminal: &mut Terminal) -> Exit {
    let done = match &arguments.what {
        What::Demo(arguments) => demo(arguments, terminal),
        What::Run(arguments) => carry_out(arguments, terminal),
        What::Stack(arguments) => trials::stack(arguments, terminal),
        What::List => {
            list(terminal);
            Ok(Exit::Done)
        }
    };
    done.unwrap_or_else(|complaint| {
        terminal.say(complaint);
        Exit::Failed
    })
}

const TASKS: [(TaskName, Task, &str); 5] = [
    (TaskName::Full, Task::Full, "full"),
    (TaskName::Guided, Task::Guided, "guided"),
    (TaskName::StackOne, Task::StackOne, "stack-one"),
    (TaskName::StackTwo, Task::StackTwo, "stack-two"),
    (TaskName::Nothing, Task::Nothing, "nothing"),
];

fn list(terminal: &mut Terminal) {
    for scenario in Scenario::ALL {
        let tasks: Vec<&str> = scenario
            .tasks()
            .iter()
            .filter_map(|task| TASKS.iter().find(|(_, one, _)| one == task))
            .map(|(_, _, name)| *name)
            .collect();
        terminal.line(format_args!("{}: shows {}", scenario.name(), tasks.join(", ")));
        for goal in scenario.goals() {
            terminal.line(format_args!("  {}: {}", goal.name, condition(&goal.facts)));
        }
    }
}

/// Facts as a condition.
fn condition(facts: &[Fact]) -> String {
    let atoms: Vec<String> = facts
        .iter()
        .map(|fact| {
            let words: Vec<&str> = std::iter::once(&fact.predicate)
                .chain(&fact.arguments)
                .map(String::as_str)
                .collect();
            format!("({})", words.join(" "))
        })
        .collect();
    match atoms.as_slice() {
        [one] => one.clone(),
        several => format!("(and {})", several.join(" ")),
    }
}

/// The world of a name.
fn scenario(name: &str) -> Result<Scenario, Complaint> {
    Scenario::named(name).ok_or_else(|| {
        let names: Vec<&str> = Scenario::ALL.iter().map(|one| one.name()).collect();
        let help = lang::nearest(name, names.iter().copied()).map_or_else(
            || format!("there are {}", names.join(", ")),
            |near| format!("did you mean `{near}`?"),
        );
        Complaint::with_help(format!("there is no world `{name}`"), help)
    })
}

fn demo(arguments: &Demo, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let scenario = scenario(&arguments.world)?;
    let task = match arguments.task {
        None => scenario.tasks()[0],
        Some(name) => {
            let (_, task, _) =
                TASKS.iter().find(|(one, _, _)| *one == name).expect("every name has its task");
            *task
        }
    };
    if !scenario.tasks().contains(&task) {
        return Err(Complaint::with_help(
            format!("`{}` is not shown in the world `{}`", task.name(), scenario.name()),
            "`caveat simulate list` says what is",
        ));
    }
    let person = Person::draw(arguments.person, arguments.seed);
    let shown = world::demonstrate(scenario, task, &person, arguments.seed);
    write_log(&arguments.output, &shown.header, &shown.frames, arguments.csv)?;
    let beside = arguments.output.with_extension("truth.jsonl");
    files::write_with(&beside, |out| {
        let mut writer = truth::Writer::new(std::io::BufWriter::new(out), &shown.header)?;
        for truth in &shown.truths {
            writer.write(truth)?;
        }
        std::io::Write::flush(&mut writer.finish()?)
    })?;
    if let Some(path) = &arguments.svg {
        files::write(path, world::draw(&shown.header, &shown.frames).as_bytes())?;
    }
    let length = shown.frames.len() as f64 / world::RATE;
    terminal.say(format_args!("{} frames, {length:.1} s", shown.frames.len()));
    if !shown.goal.is_empty() {
        terminal.line(condition(&shown.goal));
    }
    if shown.reached {
        return Ok(Exit::Done);
    }
    terminal.say("The demonstrator did not reach the goal.");
    Ok(Exit::Findings)
}

fn write_log(
    path: &Path,
    header: &Header,
    frames: &[Frame],
    as_csv: bool,
) -> Result<(), Complaint> {
    files::write_with(path, |out| {
        let out = std::io::BufWriter::new(out);
        if as_csv {
            let mut writer = csv::Writer::new(out, header)?;
            for frame in frames {
                writer.write(frame)?;
            }
            return std::io::Write::flush(&mut writer.finish()?);
        }
        let mut writer = json::Writer::new(out, header)?;
        for frame in frames {
            writer.write(frame)?;
        }
        std::io::Write::flush(&mut writer.finish()?)
    })
}

fn carry_out(arguments: &Run, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let scenario = scenario(&arguments.world)?;
    let goals = scenario.goals();
    let goal: &Goal = match &arguments.goal {
        None => &goals[0],
        Some(name) => goals.iter().find(|goal| goal.name == name).ok_or_else(|| {
            let names: Vec<&str> = goals.iter().map(|goal| goal.name).collect();
            Complaint::with_help(
                format!("the world `{}` has no goal `{name}`", scenario.name()),
                format!("it has {}", names.join(", ")),
            )
        })?,
    };
    let plan = steps(&arguments.plan)?;
    let text = files::read(&arguments.routines)?.text;
    let routines: Vec<Routine> = serde_json::from_str(&text).map_err(|error| {
        let name = files::name(&arguments.routines);
        Complaint::new(format!("`{name}` has no way points: {error}"))
    })?;
    let outcome = world::execute(scenario, arguments.seed, &plan, &routines, &goal.facts);
    let header = scenario.header(arguments.seed);
    if let Some(path) = &arguments.log {
        write_log(path, &header, &outcome.frames, false)?;
    }
    if let Some(path) = &arguments.svg {
        files::write(path, world::draw(&header, &outcome.frames).as_bytes())?;
    }
    for sentence in &outcome.story {
        terminal.line(sentence);
    }
    let length = outcome.frames.len() as f64 / world::RATE;
    let said = if outcome.reached { "is reached" } else { "is not reached" };
    let steps = match plan.len() {
        1 => "one step".to_owned(),
        count => format!("{count} steps"),
    };
    terminal.line(format_args!(
        "The goal {} {said} after {steps} and {length:.1} s.",
        condition(&goal.facts)
    ));
    Ok(if outcome.reached { Exit::Done } else { Exit::Findings })
}

/// The steps of a plan file: those with the same number before them are taken together, those without one alone.
fn steps(path: &Path) -> Result<Vec<Vec<PlanStep>>, Complaint> {
    let text = files::read(path)?.text;
    let mut alone = Vec::new();
    let mut joint: BTreeMap<u32, Vec<PlanStep>> = BTreeMap::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split(';').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let wrong = || {
            let place = format!("{}:{}", files::name(path), number + 1);
            Complaint::new(format!("{place}: `{line}` is no step of a plan"))
        };
        let (time, rest) = match line.split_once(':') {
            Some((time, rest)) => (Some(time.trim().parse().map_err(|_| wrong())?), rest.trim()),
            None => (None, line),
        };
        let inner =
            rest.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')).ok_or_else(wrong)?;
        let mut words = inner.split_whitespace().map(str::to_owned);
        let step = PlanStep { name: words.next().ok_or_else(wrong)?, arguments: words.collect() };
        match time {
            Some(time) => joint.entry(time).or_default().push(step),
            None => alone.push(vec![step]),
        }
    }
    alone.extend(joint.into_values());
    Ok(alone)
}
