//! The domains whose problems have no plan: they check without a word, have none, and have one with each excuse that `excuses.tsv` states.

use std::fs;
use std::path::{Path, PathBuf};

use cli::exit::Exit;
use domains::kitchen::{Kitchen, Scenario};
use lang::render;
use lang::source::Sources;

use crate::domains::caveat;

#[test]
fn all_files_check_without_a_word_and_are_formatted() {
    for name in domains::UNSOLVABLE {
        for file in files(name, "pddl") {
            let (exit, said) = caveat("check", &[], &[&file]);
            assert_eq!((exit, said.as_str()), (Exit::Done, "Nothing wrong in 1 file.\n"), "{name}");
            let text = read(&file);
            assert_eq!(lang::format::format(&text).as_deref(), Some(&*text), "{}", file.display());
        }
    }
}

#[test]
fn no_problem_has_a_plan_and_each_has_excuses() {
    for name in domains::UNSOLVABLE {
        let excuses = excuses(name);
        let problems = problems(name);
        assert!(!problems.is_empty(), "{name} has no problems");
        let excused = excuses.iter().all(|excuse| problems.contains(&excuse.problem));
        assert!(excused, "{name} excuses problems that it does not have");
        for problem in problems {
            assert!(excuses.iter().any(|excuse| excuse.problem == problem), "{name}: {problem}");
            let path = folder(name).join(&problem).with_extension("pddl");
            let (exit, said) = plan(&[&path]);
            assert!(matches!(exit, Exit::Unreachable | Exit::Exhausted), "{name}: {said}");
        }
    }
}

#[test]
fn every_excuse_gives_a_plan() {
    let scratch = tempfile::tempdir().expect("there is room for a problem");
    let changed = scratch.path().join("changed.pddl");
    for name in domains::UNSOLVABLE {
        let domain = folder(name).join("domain.pddl");
        for excuse in excuses(name) {
            let path = folder(name).join(&excuse.problem).with_extension("pddl");
            let mut text = read(&path);
            let edits = excuse.changes.split(", ").map(|change| edit(&mut text, change));
            let cost: u32 = edits.sum();
            assert_eq!(cost, excuse.cost, "{name}: {}", excuse.changes);
            fs::write(&changed, text).expect("there is room for a problem");
            let (exit, said) = plan(&[&domain, &changed]);
            assert_eq!(exit, Exit::Done, "{name}: {}: {said}", excuse.changes);
        }
    }
}

#[test]
fn the_operator_that_was_missing_gives_plans() {
    let mut taught = 0;
    for name in domains::UNSOLVABLE {
        let domain = folder(name).join("taught.pddl");
        if domain.exists() {
            taught += 1;
            for problem in problems(name) {
                let path = folder(name).join(&problem).with_extension("pddl");
                let (exit, said) = plan(&[&domain, &path]);
                assert_eq!(exit, Exit::Done, "{name}: {problem}: {said}");
            }
        }
    }
    assert_eq!(taught, 3);
}

#[test]
fn demonstrations_reach_the_deepest_excuse() {
    let scratch = tempfile::tempdir().expect("there is room for a problem");
    let reached = scratch.path().join("reached.pddl");
    for name in [Scenario::Closed.name(), Scenario::Blocked.name()] {
        let excuses = excuses(name);
        let (_, after) = excuses[0].changes.split_once(" -> ").expect("it is one edit");
        let text = read(&folder(name).join("plate.pddl"));
        let (start, _) = text.split_once("(:goal").expect("there is a goal");
        fs::write(&reached, format!("{start}(:goal {after}))\n")).expect("there is room");
        let taught = folder(name).join("taught.pddl");
        let demonstration = folder(name).join("demonstration.plan");
        let (exit, said) = caveat("validate", &[], &[&taught, &reached, &demonstration]);
        assert_eq!(exit, Exit::Done, "{name}: {said}");
    }
}

#[test]
fn kitchens_of_all_sizes_check_without_errors_and_are_formatted() {
    for scenario in [Scenario::Closed, Scenario::Blocked] {
        for size in 1..=40_u32 {
            let goals = size.div_ceil(2);
            let kitchen = Kitchen::new(size, scenario, goals).expect("it is large enough");
            let mut sources = Sources::default();
            let domain = sources.add("domain.pddl".to_string(), scenario.domain().to_string());
            let problem = sources.add("problem.pddl".to_string(), kitchen.problem());
            let (domain, mut found) = lang::read_domain(&sources, domain);
            let (model, more) = lang::read_problem(&sources, problem, &domain);
            found.append(more);
            assert!(!found.has_errors(), "{}", render::concise(&found, &sources));
            assert_eq!(model.objects.len(), 4 * size as usize);
            let text = kitchen.problem();
            assert_eq!(lang::format::format(&text).as_deref(), Some(&*text));
        }
    }
}

#[test]
fn kitchens_have_no_plan_until_every_drawer_is_mended() {
    let scratch = tempfile::tempdir().expect("there is room for a kitchen");
    let (domain, problem) =
        (scratch.path().join("domain.pddl"), scratch.path().join("problem.pddl"));
    let blocked = |number: u32| format!("(blocks chair{number} drawer{number})");
    let clear = |number: u32| format!("(clear drawer{number})");
    let closed = |number: u32| format!("(closed drawer{number})");
    let open = |number: u32| format!("(open drawer{number})");
    let ways: [(Scenario, &Fact, &Fact); 3] = [
        (Scenario::Closed, &closed, &open),
        (Scenario::Blocked, &blocked, &clear),
        (Scenario::Blocked, &closed, &open),
    ];
    for (scenario, before, after) in ways {
        let kitchen = Kitchen::new(4, scenario, 3).expect("it is large enough");
        let mut text = kitchen.problem();
        fs::write(&domain, scenario.domain()).expect("there is room");
        for number in 1..=3 {
            fs::write(&problem, &text).expect("there is room");
            assert_eq!(plan(&[&domain, &problem]).0, Exit::Unreachable, "{text}");
            text = text.replace(&before(number), &after(number));
        }
        fs::write(&problem, &text).expect("there is room");
        assert_eq!(plan(&[&domain, &problem]).0, Exit::Done, "{text}");
    }
}

#[test]
fn kitchens_store_no_more_plates_than_they_have() {
    assert_eq!(Kitchen::new(3, Scenario::Closed, 4), None);
    assert_eq!(Kitchen::new(3, Scenario::Closed, 0), None);
    assert_eq!(Scenario::of("III"), None);
}

/// A fact about the drawer of some number.
type Fact = dyn Fn(u32) -> String;

/// A line of `excuses.tsv`.
pub struct Excuse {
    pub problem: String,
    pub cost: u32,
    pub changes: String,
}

/// What `excuses.tsv` of the domain `name` says.
pub fn excuses(name: &str) -> Vec<Excuse> {
    let text = read(&folder(name).join("excuses.tsv"));
    text.lines()
        .map(|line| {
            let [problem, cost, changes] = line.split('\t').collect::<Vec<_>>()[..] else {
                panic!("{name}: `{line}` has not three fields");
            };
            Excuse {
                problem: problem.to_string(),
                cost: cost.parse().unwrap_or_else(|_| panic!("{name}: `{cost}` is no cost")),
                changes: changes.to_string(),
            }
        })
        .collect()
}

/// Makes one change in the initial state or the objects of a problem; says what it costs.
pub fn edit(text: &mut String, change: &str) -> u32 {
    let Some((before, after)) = change.split_once(" -> ") else {
        *text = text.replacen("(:objects", &format!("(:objects {change}"), 1);
        return 5;
    };
    if before == "none" {
        *text = text.replacen("(:init", &format!("(:init {after}"), 1);
    } else {
        assert!(text.contains(before), "`{before}` does not hold");
        *text = text.replacen(before, after, 1);
    }
    if after.starts_with("(stands") { 3 } else { 1 }
}

/// Looks for a plan; what was said comes back as well.
fn plan(files: &[&Path]) -> (Exit, String) {
    let scratch = tempfile::tempdir().expect("there is room for a plan");
    let file = scratch.path().join("plan");
    caveat("plan", &["--plan-file", file.to_str().expect("the name is ours")], files)
}

/// The problems of a domain by their names.
pub fn problems(name: &str) -> Vec<String> {
    files(name, "pddl")
        .iter()
        .map(|file| file.file_stem().expect("it has an ending").to_string_lossy().into_owned())
        .filter(|stem| stem != "domain" && stem != "taught")
        .collect()
}

/// The files of a domain that end so, in the order of their names.
fn files(name: &str, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("the folder stays as it is").path())
        .filter(|file| file.extension() == Some(ending.as_ref()))
        .collect();
    files.sort();
    files
}

pub fn folder(name: &str) -> PathBuf {
    domains::folder().join(name)
}

pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
