//! The reference domains go through the whole program: they check without a word, and plans have the known costs.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use cli::exit::Exit;
use cli::terminal::Terminal;
use lang::render;
use lang::source::{SourceId, Sources};

use crate::costs::{self, Known};

#[test]
fn every_domain_and_problem_checks_without_a_word() {
    for name in domains::NAMES {
        let mut sources = Sources::default();
        let id = add(&mut sources, &domains::folder().join(name).join("domain.pddl"));
        let (domain, diagnostics) = lang::read_domain(&sources, id);
        assert_eq!(render::concise(&diagnostics, &sources), "");
        for (problem, known) in problems(name) {
            let id = add(&mut sources, &problem);
            let (_, diagnostics) = lang::read_problem(&sources, id, &domain);
            let said = render::concise(&diagnostics, &sources);
            // That a goal is out of reach is worth a warning where it is so.
            let expected = |line: &&str| known != Known::Unsolvable || !line.contains("W0701");
            assert_eq!(said.lines().filter(expected).collect::<Vec<_>>(), [""; 0]);
        }
    }
}

#[test]
fn domains_for_several_agents_and_their_problems_check_without_a_word_and_are_formatted() {
    for name in domains::MULTI_AGENT {
        let entries = fs::read_dir(domains::folder().join(name)).expect("it has its folder");
        let files = entries.map(|entry| entry.expect("the folder stays as it is").path());
        for file in files.filter(|file| file.extension() == Some("pddl".as_ref())) {
            let (exit, said) = caveat("check", &[], &[&file]);
            assert_eq!((exit, said.as_str()), (Exit::Done, "Nothing wrong in 1 file.\n"), "{name}");
            let text = fs::read_to_string(&file).expect("it was just read");
            assert_eq!(lang::format::format(&text).as_deref(), Some(&*text), "{}", file.display());
        }
    }
}

/// Reads a file into `sources`.
fn add(sources: &mut Sources, path: &Path) -> SourceId {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    sources.add(path.display().to_string(), text)
}

/// Plans every problem of a domain, optimally and as fast as possible, and compares with what is known.
fn plan(name: &str) {
    let folder = tempfile::tempdir().expect("there is room for a plan");
    let file = folder.path().join("plan");
    for (problem, known) in problems(name) {
        let optimal = cost(&problem, &file, true);
        let first = cost(&problem, &file, false);
        match (known, optimal, first) {
            (Known::Unsolvable, None, None) => {}
            (Known::Open, Some(optimal), Some(first)) => assert!(optimal <= first, "{name}"),
            (Known::Cost(known), Some(optimal), Some(first)) => {
                assert_eq!(optimal, known, "{}", problem.display());
                assert!(
                    first >= known,
                    "{}: a plan of cost {first} beats the proof",
                    problem.display()
                );
            }
            unexpected => panic!("{}: known, optimal, first: {unexpected:?}", problem.display()),
        }
    }
}

/// The cost of the plan that the program finds and its own validator accepts; `None` where there is no plan.
fn cost(problem: &Path, file: &Path, optimal: bool) -> Option<u64> {
    let file_name = file.to_str().expect("the name is ours");
    let options: &[&str] = &["--plan-file", file_name, "--optimal"];
    let (exit, said) = caveat("plan", &options[..if optimal { 3 } else { 2 }], &[problem]);
    match exit {
        Exit::Done => {}
        Exit::Unreachable | Exit::Exhausted => return None,
        other => panic!("{}: {other:?}\n{said}", problem.display()),
    }
    let (exit, said) = caveat("validate", &[], &[problem, file]);
    assert_eq!(exit, Exit::Done, "{}: {said}", problem.display());
    let plan = fs::read_to_string(file).expect("the plan was written");
    let cost = plan
        .lines()
        .find_map(|line| line.strip_prefix("; cost = "))
        .and_then(|rest| rest.split(' ').next())
        .unwrap_or_else(|| panic!("{}: the plan file states no cost:\n{plan}", problem.display()));
    Some(cost.parse().expect("costs are integers"))
}

macro_rules! known_costs {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            super::plan(stringify!($name));
        }
    )*
        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

mod plans_have_the_known_cost {
    known_costs! { stacking hanoi keys delivery kitchen drawers circuits museum }

    #[test]
    fn in_every_domain() {
        assert_eq!(NAMES, domains::NAMES);
    }
}

/// The problems of a domain, with what is known of each.
fn problems(name: &str) -> impl Iterator<Item = (PathBuf, Known)> {
    let folder = domains::folder().join(name);
    costs::read(name)
        .into_iter()
        .map(move |(problem, known)| (folder.join(problem).with_extension("pddl"), known))
}

/// Runs one verb in this process; what it printed and said comes back as one text.
pub fn caveat(verb: &str, options: &[&str], files: &[&Path]) -> (Exit, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut terminal = Terminal::new(&mut out, &mut err);
    let arguments = ["caveat", verb, "--output-format", "concise"]
        .into_iter()
        .chain(options.iter().copied())
        .map(OsString::from)
        .chain(files.iter().map(|file| file.as_os_str().to_owned()));
    let exit = cli::call(arguments, &mut terminal);
    out.extend(err);
    (exit, String::from_utf8(out).expect("the program prints UTF-8"))
}
