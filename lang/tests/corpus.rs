//! Competition files and tricky valid files are read without an error, and bad files with the one that is wanted.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lang::diagnostic::{Diagnostics, Severity};
use lang::lint;
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

/// Reads a task and returns what is said about it.
fn read(domain: &Path, problem: &Path) -> (Diagnostics, Sources) {
    let mut sources = Sources::default();
    let mut add = |path: &Path| {
        let text =
            fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        sources.add(path.display().to_string(), text)
    };
    let ids = [add(domain), add(problem)];
    let (model, mut diagnostics) = lang::read_domain(&sources, ids[0]);
    let (problem, more) = lang::read_problem(&sources, ids[1], &model);
    diagnostics.append(more);
    if !diagnostics.has_errors() {
        diagnostics.append(lint::domain(&model));
        diagnostics.append(lint::problem(&model, &problem));
        for id in ids {
            diagnostics.append(lint::text(&sources, id, &model));
        }
        lint::tell_factors(&mut diagnostics, &model, &problem);
    }
    (diagnostics, sources)
}

/// Reads a task and returns its errors as text.
fn errors(domain: &Path, problem: &Path) -> String {
    let (diagnostics, sources) = read(domain, problem);
    let errors =
        diagnostics.list.into_iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
    render::concise(&Diagnostics { list: errors.collect() }, &sources)
}

/// A list of cases in JSON.
fn cases(path: &Path) -> Vec<serde_json::Value> {
    let text = fs::read_to_string(path).expect("the list of cases stands beside them");
    serde_json::from_str(&text).expect("the list of cases is JSON")
}

/// The domain and the problem of a case, of which one is the file itself and the other its pair.
fn pair(case: &serde_json::Value, folder: &Path, good: &Path) -> (PathBuf, PathBuf) {
    let path = |key: &str| case[key].as_str().expect("a case names its file and its pair");
    let (file, other) = (folder.join(path("file")), good.join(path("pair")));
    if case["role"] == "domain" { (file, other) } else { (other, file) }
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

#[test]
fn tricky_valid_files_have_no_messages() {
    let Some(corpus) = shared().map(|root| root.join("corpus")) else { return };
    let (folder, good) = (corpus.join("valid-pddl"), corpus.join("bad-pddl"));
    for case in cases(&folder.join("valid.json")) {
        let (domain, problem) = pair(&case, &folder, &good);
        let (mut diagnostics, sources) = read(&domain, &problem);
        // One of them has types and no `:requirements` at all, and is told so.
        diagnostics.list.retain(|one| one.name != "missing-requirement");
        let said = render::concise(&diagnostics, &sources);
        assert_eq!(said, "", "{}", case["why"]);
    }
}

/// All files of PDDL or HDDL in a folder and below it.
fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder can be read")
        .map(|entry| entry.expect("an entry can be read").path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files_below(&path, found);
        } else if path.extension().is_some_and(|end| end == "pddl" || end == "hddl") {
            found.push(path);
        }
    }
}

#[test]
fn multi_agent_domains_have_no_errors() {
    let Some(folder) = shared().map(|root| root.join("corpus/mapddl")) else { return };
    let mut files = Vec::new();
    files_below(&folder, &mut files);
    let (mut domains, mut wrong) = (0, Vec::new());
    for file in &files {
        let mut sources = Sources::default();
        let text = fs::read_to_string(file).expect("the file can be read");
        let id = sources.add(file.display().to_string(), text);
        if let Some(lang::Kind::Domain { .. }) = lang::detect(&sources, id) {
            domains += 1;
            let (_, mut diagnostics) = lang::read_domain(&sources, id);
            diagnostics.list.retain(|one| one.severity == Severity::Error);
            let ill_formed = ILL_FORMED.iter().any(|ending| file.ends_with(ending));
            assert!(!ill_formed || diagnostics.has_errors(), "{} is all right", file.display());
            diagnostics.list.retain(|one| !ill_formed || one.code != "E0801");
            wrong.push(render::concise(&diagnostics, &sources));
        }
    }
    assert!(domains > 20, "only {domains} domains were read");
    assert_eq!(wrong.concat(), "");
}

/// Domains that name actions with too few arguments, as the corpus says itself.
const ILL_FORMED: [&str; 2] = ["boxpushing/domain_v2.pddl", "notation/t15_arity.pddl"];

#[test]
fn bad_files_have_the_one_message_that_is_wanted() {
    let Some(folder) = shared().map(|root| root.join("corpus/bad-pddl")) else { return };
    let mut wrong = Vec::new();
    let mut checked = 0;
    for case in cases(&folder.join("expectations.json")) {
        let code = case["code"].as_str().expect("a case has a code");
        checked += 1;
        let (domain, problem) = pair(&case, &folder, &folder);
        let (diagnostics, sources) = read(&domain, &problem);
        let wanted = format!(
            "{}:{}:{}: ",
            folder.join(case["file"].as_str().expect("a file")).display(),
            case["line"],
            case["col"]
        );
        let said = render::concise(&diagnostics, &sources);
        // All marked places of the corpus lie within a line of ASCII.
        let columns =
            case["end_col"].as_u64().zip(case["col"].as_u64()).map(|(end, start)| end - start);
        let meets = match diagnostics.list.as_slice() {
            [one] => {
                one.code == code
                    && columns == Some(u64::from(one.primary.span.end - one.primary.span.start))
            }
            _ => false,
        };
        if !meets || !said.starts_with(&wanted) {
            wrong.push(format!(
                "{wanted}{code} is wanted once, with {columns:?} columns, but there is:\n{said}"
            ));
        }
    }
    assert!(checked > 20, "only {checked} cases were checked");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
