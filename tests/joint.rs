//! Small multi-agent problems and how many joint steps they need go in; every difference from what trying all joint actions finds comes out.

use std::fs;
use std::path::{Path, PathBuf};

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::model::{Domain, Problem};
use lang::render;
use lang::source::{SourceId, Sources};
use lang::validate::joint::{Success, Verdict, judge};

use crate::brute::{self, Objective};

/// More states than any of these problems has.
const LIMIT: usize = 20_000;

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

/// Both models of a task.
fn read(domain: &Path, problem: &Path) -> (Domain, Problem) {
    let mut sources = Sources::default();
    let mut add = |path: &Path| -> SourceId {
        let text =
            fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        sources.add(path.display().to_string(), text)
    };
    let (first, second) = (add(domain), add(problem));
    let (domain, mut diagnostics) = lang::read_domain(&sources, first);
    let (problem, more) = lang::read_problem(&sources, second, &domain);
    diagnostics.append(more);
    assert!(!diagnostics.has_errors(), "{}", render::concise(&diagnostics, &sources));
    (domain, problem)
}

/// What the best joint plan of a task comes to, by what counts; nothing if there is no joint plan.
/// What was found is valid, as the validator has it.
fn needs(domain: &Path, problem: &Path, objective: Objective) -> Option<Success> {
    let shown = problem.display();
    let (domain, problem) = read(domain, problem);
    assert!(domain.is_multi_agent(), "{shown}");
    let executor = Executor::new(&domain, &problem).expect("no axiom denies itself");
    let concurrency = Concurrency::of(&domain);
    let plan = match objective {
        Objective::Steps => brute::shortest(&executor, concurrency, LIMIT),
        objective => brute::best(&executor, concurrency, objective, LIMIT),
    };
    let plan = plan.unwrap_or_else(|_| panic!("{shown} has more than {LIMIT} states"))?;
    match judge(&executor, &plan, concurrency) {
        Verdict::Valid(success) => Some(success),
        Verdict::Invalid(failure) => panic!("{shown}: {failure:?}"),
    }
}

#[test]
fn problems_of_the_reference_domains_need_as_many_joint_steps_as_they_state() {
    let mut wrong = Vec::new();
    for (file, text) in problems() {
        let domain = file.with_file_name("domain.pddl");
        let steps = needs(&domain, &file, Objective::Steps).map(|best| best.steps);
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
        let cost = needs(&file.with_file_name("domain.pddl"), &file, Objective::Cost);
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
    let (steps, actions) = (best(Objective::Steps), best(Objective::Actions));
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
        let found = needs(&corpus.join(domain), &corpus.join(problem), Objective::Steps);
        let found = found.map_or(-1, |best| best.steps as i64);
        if found != expected {
            wrong.push(format!("{problem}: {found}, and not {expected}"));
        }
    }
    assert_eq!(wrong, [""; 0]);
}
