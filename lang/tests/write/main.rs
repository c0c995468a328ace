//! A model that is written reads as the same model again, and without a word about it.

mod factored;
mod same;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use lang::model::{ActionId, Domain, PredicateId, Problem};
use lang::source::Sources;
use lang::write::{self, Style};
use lang::{lint, render};

/// What a domain and some of its problems say, if nothing is wrong with them and the model holds all of it.
struct Task {
    domain: Domain,
    problem: Problem,
    /// The mistakes and what the lints say, each with its name.
    said: Vec<(&'static str, String)>,
    wrong: bool,
}

fn read(domain: &str, problem: &str) -> Task {
    let mut sources = Sources::default();
    let ids = [sources.add("domain.pddl", domain), sources.add("problem.pddl", problem)];
    let (domain, mut diagnostics) = lang::read_domain(&sources, ids[0]);
    let (problem, more) = lang::read_problem(&sources, ids[1], &domain);
    diagnostics.append(more);
    let wrong = diagnostics.has_errors();
    for id in ids {
        diagnostics.append(lint::text(&sources, id, &domain));
    }
    let said = diagnostics.list.into_iter().map(|one| {
        let name = one.name;
        (name, render::concise(&lang::diagnostic::Diagnostics { list: vec![one] }, &sources))
    });
    let said = said.collect();
    let wrong = wrong || !domain.uses.is_empty() || !problem.uses.is_empty();
    Task { domain, problem, said, wrong }
}

/// What is never said of a text that was written, because it is about how it is written.
const ABOUT_WRITING: [&str; 7] = [
    "missing-requirement",
    "unused-requirement",
    "repeated-requirement",
    "shadowed-variable",
    "duplicate-parameter",
    "untyped-tail",
    "suspicious-type-list",
];

/// Reads, writes and reads again; returns what went wrong, or nothing at all where the texts are wrong themselves.
fn round(domain: &str, problem: &str) -> Option<Result<(), String>> {
    let first = read(domain, problem);
    if first.wrong {
        return None;
    }
    let texts = [
        write::domain(&first.domain, &Style::default()),
        write::problem(&first.domain, &first.problem, &Style::default()),
    ];
    let again = read(&texts[0], &texts[1]);
    let said = again.said.iter().filter(|(name, _)| again.wrong || ABOUT_WRITING.contains(name));
    let said: Vec<&str> = said.map(|(_, text)| text.as_str()).collect();
    let pairs = [
        (same::domain(&first.domain), same::domain(&again.domain)),
        (
            same::problem(&first.domain, &first.problem),
            same::problem(&again.domain, &again.problem),
        ),
    ];
    let mut out = said.concat();
    for (before, after) in &pairs {
        let differing = before.lines().zip(after.lines()).find(|(one, other)| one != other);
        if let Some((one, other)) = differing {
            out.extend([one, "\nbecomes\n", other, "\n"]);
        } else if before != after {
            out.push_str("something is written that was not there, or left out\n");
        }
    }
    Some(if out.is_empty() { Ok(()) } else { Err(format!("{out}{}{}", texts[0], texts[1])) })
}

fn text(path: &Path) -> String {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Takes every pair through the round, and returns how many there were without mistakes of their own.
fn rounds(pairs: &[(PathBuf, PathBuf)]) -> usize {
    let mut done = 0;
    for (domain, problem) in pairs {
        match round(&text(domain), &text(problem)) {
            Some(Err(wrong)) => panic!("{} {}:\n{wrong}", domain.display(), problem.display()),
            Some(Ok(())) => done += 1,
            None => {}
        }
    }
    done
}

/// The files of a folder, by name.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder can be read");
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.expect("an entry can be read").path()).collect();
    files.sort();
    files
}

/// Every domain with every problem that stands in its folder; those that do not belong together have errors.
fn pairs(folder: &Path) -> Vec<(PathBuf, PathBuf)> {
    let files = files(folder);
    let (domains, problems): (Vec<_>, Vec<_>) = files
        .into_iter()
        .filter(|file| file.extension().is_some_and(|extension| extension == "pddl"))
        .partition(|file| text(file).to_ascii_lowercase().contains("(domain "));
    let of = |domain: &PathBuf| problems.iter().map(|one| (domain.clone(), one.clone())).collect();
    domains.iter().flat_map(|domain| -> Vec<_> { of(domain) }).collect()
}

/// The shared material, if it is there.
fn shared() -> Option<PathBuf> {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    if !root.join("corpus/mapddl").is_dir() {
        eprintln!("SKIPPED: no shared material at {}; set CAVEAT_SHARED", root.display());
        return None;
    }
    Some(root)
}

#[test]
fn the_domains_are_written_as_they_are() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains");
    let folders = files(&root).into_iter().filter(|path| path.join("domain.pddl").is_file());
    let pairs: Vec<_> = folders.flat_map(|folder| pairs(&folder)).collect();
    assert_eq!(rounds(&pairs), pairs.len());
    assert!(pairs.len() >= 40, "only {} problems", pairs.len());
}

/// The tasks are other people's and stand outside of the project.
#[test]
fn competition_tasks_are_written_as_they_are() {
    let Some(root) = shared().map(|root| root.join("benchmarks")) else { return };
    let list = text(&root.join("opt.txt"));
    let pair = |line: &str| {
        let (domain, problem) = line.split_once('\t').expect("a domain, a tab and a problem");
        (root.join("ipc").join(domain), root.join("ipc").join(problem))
    };
    let pairs: Vec<_> = list.lines().map(pair).collect();
    assert_eq!(rounds(&pairs), pairs.len());
    assert!(pairs.len() >= 100, "only {} tasks", pairs.len());
}

/// The tasks are other people's and stand outside of the project.
#[test]
fn multi_agent_tasks_are_written_as_they_are() {
    let Some(root) = shared().map(|root| root.join("corpus/mapddl")) else { return };
    let groups = ["concurrency", "codmap-unfactored", "codmap-factored", "micro"];
    let mut all = pairs(&root.join("notation"));
    all.extend(pairs(&root.join("cn")));
    for folder in groups.iter().flat_map(|group| files(&root.join(group))) {
        all.extend(pairs(&folder));
    }
    let done = rounds(&all);
    assert!(done >= 100, "only {done} of {} pairs have no errors", all.len());
}

/// Names that a text could not refer to, or would refer to something else by, become names of their own.
#[test]
fn variables_keep_apart() {
    let domain = "(define (domain d) (:requirements :adl :multi-agent :unfactored-privacy)
        (:types robot)
        (:predicates (near ?x ?x - robot) (:private ?a - robot (tired ?b ?a - robot ?A2 - robot)))
        (:action rest :agent robot :parameters (?agent ?Agent2 - robot)
         :precondition (forall (?x - robot) (or (near ?x ?agent) (exists (?X - robot) (near ?x ?agent2))))
         :effect (and (forall (?agent - robot) (when (near ?agent ?agent2) (near ?agent2 ?agent)))
                      (forall (?x - robot) (near ?x ?x)))))";
    let problem = "(define (problem p) (:domain d) (:objects r - robot)
        (:goal (forall (?x - robot) (exists (?x - robot) (near ?x ?x)))))";
    let first = read(domain, problem);
    assert!(!first.wrong, "{:?}", first.said);
    assert_eq!(round(domain, problem), Some(Ok(())));
    insta::assert_snapshot!(write::domain(&first.domain, &Style::default()));
}

#[test]
fn depth_needs_no_stack() {
    let work = || {
        let deep = 2000;
        let goal = format!("{}(p){}", "(not ".repeat(deep), ")".repeat(deep));
        let domain = "(define (domain d) (:predicates (p)))";
        let problem = format!("(define (problem p) (:domain d) (:goal {goal}))");
        let task = read(domain, &problem);
        let written = write::problem(&task.domain, &task.problem, &Style::default());
        assert_eq!(written.matches("(not").count(), deep);
    };
    let thread = std::thread::Builder::new().stack_size(128 * 1024).spawn(work);
    thread.expect("a thread can be started").join().expect("the stack is enough");
}

const ROVERS: &str = "(define (domain rovers)
  (:requirements :typing :multi-agent :unfactored-privacy :action-costs)
  (:types rover site - object base - site)
  (:constants home - base)
  (:predicates (at ?r - rover ?s - site) (carried ?o - (either site rover))
   (:private ?r - rover (charged ?r - rover) (driver ?x - object)))
  (:functions (total-cost) - number (distance ?a ?b - site) - number)
  (:action drive :agent ?r - rover :parameters (?from ?to - site)
    :precondition (and (at ?r ?from) (charged ?r) (forall (?other - rover) (not (drive ?other ?to ?from))))
    :effect (and (at ?r ?to) (not (at ?r ?from)) (increase (total-cost) (distance ?from ?to))))
  (:action wait :agent ?r - rover :parameters () :effect (charged ?r)))";

#[test]
fn a_multi_agent_domain_with_comments() {
    let problem = "(define (problem two) (:domain rovers) (:objects r1 r2 - rover s - site)
        (:init (at r1 home) (at r2 s) (= (distance home s) 4.5) (= (total-cost) 0))
        (:goal (and (at r1 s) (not (at r2 s)))) (:metric minimize (total-cost)))";
    let task = read(ROVERS, problem);
    assert!(!task.wrong, "{:?}", task.said);
    let style = Style {
        head: "Two rovers on one road.\n\nThey must not meet.".to_owned(),
        actions: BTreeMap::from([(ActionId(1), "Stands still.\nAnd charges.".to_owned())]),
        predicates: BTreeMap::from([(PredicateId(2), "Enough for one drive.".to_owned())]),
        groups: "(:at-most-one (at ?r ?site))".to_owned(),
        annotations: BTreeMap::from([(ActionId(1), "(:seen 2 \"monday\")".to_owned())]),
    };
    insta::assert_snapshot!(write::domain(&task.domain, &style));
    let head = Style { head: "The smallest problem.".to_owned(), ..Style::default() };
    insta::assert_snapshot!(write::problem(&task.domain, &task.problem, &head));
    assert_eq!(round(ROVERS, problem), Some(Ok(())));
}

#[test]
fn a_classical_domain() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains/kitchen");
    let task = read(&text(&root.join("domain.pddl")), &text(&root.join("p01.pddl")));
    insta::assert_snapshot!(write::domain(&task.domain, &Style::default()));
}
