//! Small multi-agent problems and how many joint steps they need go in, as trying all joint actions has told; every optimal plan of another length comes out.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use cli::exit::Exit;
use cli::terminal::Terminal;
use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::source::Sources;
use lang::validate::joint::{Success, Verdict, judge};

/// The problems of the multi-agent domains, each with its text.
fn problems() -> Vec<(PathBuf, String)> {
    let mut problems = Vec::new();
    for name in domains::MULTI_AGENT {
        let folder = domains::folder().join(name);
        let entries = fs::read_dir(&folder).expect("each domain has its folder");
        let files = entries.map(|entry| entry.expect("the folder stays as it is").path());
        let mut files: Vec<_> =
            files.filter(|it| it.extension() == Some("pddl".as_ref())).collect();
        files.retain(|file| !file.ends_with("domain.pddl"));
        assert!(!files.is_empty(), "{name} has no problem");
        files.sort();
        problems.extend(files.into_iter().map(|file| {
            let text = fs::read_to_string(&file).expect("the file was listed");
            (file, text)
        }));
    }
    problems
}

/// The number behind `words` in the comments of a problem.
fn stated(text: &str, words: &str) -> Option<usize> {
    let comments = text.lines().take_while(|line| line.starts_with(';'));
    let mut rest =
        comments.filter_map(|line| line.trim_start_matches([';', ' ']).strip_prefix(words));
    rest.next()?.split_whitespace().next()?.parse().ok()
}

/// What the best joint plan of a task comes to, by what counts; nothing if there is no joint plan.
/// The program proves it optimal, and the plan that it writes is read again and judged.
fn needs(domain: &Path, problem: &Path, objective: &str) -> Option<Success> {
    let shown = problem.display();
    let folder = tempfile::tempdir().expect("there is room for a plan");
    let file = folder.path().join("plan");
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let arguments = ["caveat", "plan", "--optimal", "--objective", objective, "--plan-file"];
    let arguments = arguments.map(OsString::from).into_iter();
    let files = [&file, domain, problem].map(|path: &Path| path.as_os_str().to_owned());
    let exit = cli::call(arguments.chain(files), &mut Terminal::new(&mut out, &mut err));
    let said = String::from_utf8_lossy(&err);
    match exit {
        Exit::Done => assert!(said.contains("proved to be optimal"), "{shown}: {said}"),
        Exit::Unreachable | Exit::Exhausted => return None,
        other => panic!("{shown}: {other:?}: {said}"),
    }
    let mut sources = Sources::default();
    let ids = [domain, problem, &file].map(|path| {
        let text = fs::read_to_string(path).expect("it was read or written just now");
        sources.add(path.display().to_string(), text)
    });
    let (domain, _) = lang::read_domain(&sources, ids[0]);
    let (problem, _) = lang::read_problem(&sources, ids[1], &domain);
    let (listing, found) = lang::plan::read(&sources, ids[2], &domain, &problem);
    assert_eq!(found.list, [], "{shown}");
    let executor = Executor::new(&domain, &problem).expect("it has been planned");
    match judge(&executor, &listing.joint().0, Concurrency::of(&domain)) {
        Verdict::Valid(success) => Some(success),
        Verdict::Invalid(failure) => panic!("{shown}: {failure:?}"),
    }
}

#[test]
fn problems_of_the_reference_domains_need_as_many_joint_steps_as_they_state() {
    let mut wrong = Vec::new();
    for (file, text) in problems() {
        let domain = file.with_file_name("domain.pddl");
        let steps = needs(&domain, &file, "steps").map(|best| best.steps);
        if steps != stated(&text, "shortest joint plan: ") || steps.is_none() {
            wrong.push(format!("{}: {steps:?} joint steps", file.display()));
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn problems_with_a_metric_cost_as_much_as_they_state() {
    let mut seen = 0;
    for (file, text) in problems() {
        let Some(stated) = stated(&text, "cheapest joint plan: ") else {
            assert!(!text.contains("(:metric"), "{} states no cost", file.display());
            continue;
        };
        seen += 1;
        let cost = needs(&file.with_file_name("domain.pddl"), &file, "cost");
        assert_eq!(cost.map(|best| best.cost), Some(stated.into()), "{}", file.display());
    }
    assert!(seen > 0, "no problem has a metric");
}

#[test]
fn what_counts_decides_which_joint_plan_is_best() {
    let folder = domains::folder().join("warehouse");
    let best = |objective| {
        let (domain, problem) = (folder.join("domain.pddl"), folder.join("two-carts.pddl"));
        needs(&domain, &problem, objective).expect("it has a joint plan")
    };
    let (steps, actions) = (best("steps"), best("actions"));
    // One cart brings both crates; with two carts there is one drive more.
    assert_eq!((steps.steps, actions.actions), (6, 9));
    assert!(steps.actions > actions.actions && steps.steps < actions.steps);
}

#[test]
fn a_second_arm_saves_steps_on_the_same_towers() {
    let of = |name: &str| {
        let all = problems();
        let (_, text) = all.iter().find(|(file, _)| file.ends_with(name)).expect("it is shipped");
        let towers = text.split("(at tiny first)").nth(1).expect("it begins there").to_owned();
        (stated(text, "shortest joint plan: "), towers.replace(" (free right)", ""))
    };
    let (one, two) = (of("hanoi-arms/one-arm.pddl"), of("hanoi-arms/two-arms.pddl"));
    assert_eq!(one.1, two.1, "the towers differ");
    assert!(two.0 < one.0, "{:?} and {:?}", two.0, one.0);
}

/// The cases come from others, and stay where they are.
#[test]
fn cases_of_the_corpus_need_exactly_as_many_joint_steps() {
    let shared = std::env::var_os("CAVEAT_SHARED").map(PathBuf::from);
    let shared =
        shared.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"));
    let corpus = shared.join("corpus/mapddl");
    let Ok(text) = fs::read_to_string(corpus.join("expected.json")) else {
        eprintln!("SKIPPED: no cases at {}; set CAVEAT_SHARED", corpus.display());
        return;
    };
    let cases: serde_json::Value = serde_json::from_str(&text).expect("the cases are JSON");
    let cases = cases["expected"].as_object().expect("each case has a name");
    assert!(!cases.is_empty());
    let mut wrong = Vec::new();
    for (problem, case) in cases {
        let domain = case["domain"].as_str().expect("each case has a domain");
        let expected = case["opt_joint_steps"].as_i64().expect("each case has a length");
        let found = needs(&corpus.join(domain), &corpus.join(problem), "steps");
        let found = found.map_or(-1, |best| best.steps as i64);
        if found != expected {
            wrong.push(format!("{problem}: {found}, and not {expected}"));
        }
    }
    assert_eq!(wrong, [""; 0]);
}
