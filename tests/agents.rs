//! The public domains in which agents act go in, each with its problems; all that `caveat check` says of them is kept in snapshots,
//! so that a reader can judge each line as the author of the domain would.
//!
//! The files lie beside the project in the shared material and not in it; without them the test says so and passes.

use std::fs;
use std::path::{Path, PathBuf};

use cli::input::Reader;
use lang::diagnostic::Diagnostics;
use lang::render;

/// The folders of well-formed and ill-formed domains in all notations but the factored one.
const FOLDERS: [&str; 5] = ["cn", "codmap-unfactored", "concurrency", "micro", "notation"];

/// The shared material, if it is there.
fn shared() -> Option<PathBuf> {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    let root = root.join("corpus/mapddl");
    if !root.is_dir() {
        eprintln!("SKIPPED: no domains of agents at {}; set CAVEAT_SHARED", root.display());
        return None;
    }
    Some(root)
}

#[test]
fn what_is_said_of_public_domains() {
    let Some(root) = shared() else { return };
    for folder in FOLDERS {
        let (mut text, mut domains) = (String::new(), 0);
        for list in folders(&root.join(folder)) {
            let (problems, found): (Vec<PathBuf>, Vec<PathBuf>) =
                list.into_iter().partition(|path| is_problem(path));
            for domain in found {
                domains += 1;
                text.push_str(&said(&root, &domain, &problems));
            }
        }
        assert!(domains > 3, "there are only {domains} domains in {folder}");
        insta::assert_snapshot!(folder, text);
    }
}

/// What is said of a domain, and then what is said beside that of each of its problems, with paths from `root`.
fn said(root: &Path, domain: &Path, problems: &[PathBuf]) -> String {
    let (of_domain, sources) = check(&[domain.to_owned()]);
    let shown = domain.strip_prefix(root).expect("it lies there").display();
    let mut text = format!("# {shown}\n{}", render::concise(&of_domain, &sources));
    for problem in problems.iter().filter(|problem| belongs(problem, domain)) {
        let (found, sources) = check(&[domain.to_owned(), problem.clone()]);
        let own = |one: &lang::diagnostic::Diagnostic| {
            Path::new(&sources.get(one.primary.span.source).name) == problem.as_path()
        };
        let list = found.list.into_iter().filter(own).collect();
        text.push_str(&render::concise(&Diagnostics { list }, &sources));
    }
    text.replace(&format!("{}/", root.display()), "") + "\n"
}

/// Whether a problem is one of a domain: of one name, and where several domains have it, of one number.
fn belongs(problem: &Path, domain: &Path) -> bool {
    let name = |path: &Path, keyword: &str| {
        let text = fs::read_to_string(path).expect("the file is UTF-8").to_lowercase();
        let after = text.split(keyword).nth(1).expect("it says so").trim_start().to_owned();
        after.split([')', ' ', '\n', '\r']).next().unwrap_or_default().to_owned()
    };
    let number = |path: &Path| -> String {
        let stem = path.file_stem().expect("it is a file").to_string_lossy().into_owned();
        stem.rsplit('_').next().unwrap_or_default().chars().filter(char::is_ascii_digit).collect()
    };
    let tables = domain.to_string_lossy().contains("tablemover");
    let constructs = domain.to_string_lossy().contains("notation");
    let [stem, other] = [domain, problem].map(|path| path.file_stem().unwrap_or_default());
    let fits = if tables {
        number(problem) == number(domain)
    } else if constructs {
        let numbered = |digits: &str| stem.to_string_lossy().starts_with(&format!("t{digits}"));
        match other.to_string_lossy().trim_start_matches('p') {
            "" => !numbered("13") && !numbered("19"),
            digits => numbered(digits),
        }
    } else {
        true
    };
    fits && name(problem, "(:domain") == name(domain, "(domain")
}

fn is_problem(path: &Path) -> bool {
    fs::read_to_string(path).expect("the file is UTF-8").to_lowercase().contains("(problem")
}

/// The files of a folder and of each folder in it, sorted.
fn folders(folder: &Path) -> Vec<Vec<PathBuf>> {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry can be read").path())
        .collect();
    entries.sort();
    let (inner, files): (Vec<PathBuf>, Vec<PathBuf>) =
        entries.into_iter().partition(|path| path.is_dir());
    let is_text = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "pddl");
    let own = files.into_iter().filter(is_text).collect();
    std::iter::once(own).chain(inner.iter().flat_map(|inner| folders(inner))).collect()
}

/// What `caveat check` finds in some files.
fn check(files: &[PathBuf]) -> (Diagnostics, lang::source::Sources) {
    let mut reader = Reader::default();
    let found = reader.check(files);
    let found = found.unwrap_or_else(|complaint| panic!("{complaint}"));
    (found, reader.sources)
}
