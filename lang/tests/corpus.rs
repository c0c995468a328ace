//! Competition files and tricky valid files are read without an error.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lang::diagnostic::{Diagnostics, Severity};
use lang::render;
use lang::source::Sources;

/// The shared material, if it is there.
fn shared() -> Option<PathBuf> {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    if !root.join("benchmarks").is_dir() {
        eprintln!("SKIPPED: no shared material at {}; set CAVEAT_SHARED", root.display());
        return None;
    }
    Some(root)
}

/// Reads a task and returns its errors as text.
fn errors(domain: &Path, problem: &Path) -> String {
    let mut sources = Sources::default();
    let mut add = |path: &Path| {
        let text =
            fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        sources.add(path.display().to_string(), text)
    };
    let (domain, problem) = (add(domain), add(problem));
    let (model, mut diagnostics) = lang::read_domain(&sources, domain);
    let (_, more) = lang::read_problem(&sources, problem, &model);
    diagnostics.append(more);
    let list = diagnostics
        .list
        .into_iter()
        .filter(|diagnostic| diagnostic.severity == Severity::Error)
        .collect();
    render::concise(&Diagnostics { list }, &sources)
}

#[test]
fn competition_tasks_have_no_errors() {
    let Some(root) = shared().map(|root| root.join("benchmarks")) else { return };
    let mut tasks = BTreeSet::new();
    for (list, folder) in
        [("opt", "ipc"), ("sat", "ipc"), ("ground", "ipc"), ("unsolvable", "unsolvable")]
    {
        let text = fs::read_to_string(root.join(format!("{list}.txt")))
            .expect("the list stands beside the tasks");
        for line in text.lines() {
            let (domain, problem) =
                line.split_once('\t').expect("a line is a domain, a tab and a problem");
            tasks.insert((root.join(folder).join(domain), root.join(folder).join(problem)));
        }
    }
    assert!(tasks.len() >= 339, "only {} tasks are listed", tasks.len());
    let wrong: Vec<String> = tasks
        .iter()
        .map(|(domain, problem)| errors(domain, problem))
        .filter(|text| !text.is_empty())
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {} tasks have errors:\n{}",
        wrong.len(),
        tasks.len(),
        wrong.join("\n")
    );
}
