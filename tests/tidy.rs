//! The repository goes in; every departure from the rules of the house comes out.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::costs;

/// The crates, each with those of the others that it may use; ARCHITECTURE.md says why.
const MAY_USE: [(&str, &[&str]); 7] = [
    ("lang", &[]),
    ("planner", &["lang"]),
    ("learner", &["lang"]),
    ("causal", &["lang"]),
    ("domains", &["learner", "causal"]),
    ("cli", &["lang", "planner", "learner", "causal", "domains"]),
    ("tests", &["lang", "planner", "learner", "causal", "domains", "cli"]),
];

/// The longest a source file may grow, in lines.
const LONGEST: usize = 600;

#[test]
fn dependencies_between_crates_go_one_way() {
    let known: BTreeSet<&str> = MAY_USE.iter().map(|(name, _)| *name).collect();
    let manifest = read("Cargo.toml");
    for (name, _) in MAY_USE {
        assert!(manifest.contains(&format!("\"{name}\"")), "{name} is no member of the workspace");
    }
    let mut wrong = Vec::new();
    for (name, allowed) in MAY_USE {
        for dependency in dependencies(&read(&format!("{name}/Cargo.toml"))) {
            if known.contains(dependency.as_str()) && !allowed.contains(&dependency.as_str()) {
                wrong.push(format!("{name} uses {dependency}"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn dependencies_are_read_from_every_dependency_section() {
    let manifest = "[package]\nname = \"x\"\n[dependencies]\nlang.workspace = true\n\
                    serde = \"1\" # cli\n[dev-dependencies]\ncli = { path = \"../cli\" }\n[lints]\nplanner = true\n\
                    [target.'cfg(unix)'.dependencies]\nlibc.workspace = true\n";
    assert_eq!(dependencies(manifest), ["lang", "serde", "cli", "libc"]);
}

#[test]
fn pages_name_only_paths_that_exist() {
    let mut wrong = Vec::new();
    for page in ["README.md", "ARCHITECTURE.md", "domains/README.md"] {
        let text = read(page);
        let named = paths(&text);
        assert!(!named.is_empty(), "{page} names no path: has its form changed?");
        let beside = Path::new(page).parent().expect("a page lies in a folder");
        for path in named {
            if !root().join(&path).exists() && !root().join(beside).join(&path).exists() {
                wrong.push(format!("{page} names {path}"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn paths_are_told_from_other_words_in_backticks() {
    let text = "See `lang/src/tree.rs`, [that](cli/tests) and `Cargo.toml`, not `lang::execute`, `--optimal`, \
                `target/bench/x.tsv`, `../shared`, `and/or?`, [this](https://example.org/x) `lib.rs` or `sas_plan`.";
    assert_eq!(paths(text), ["lang/src/tree.rs", "Cargo.toml", "cli/tests"]);
}

#[test]
fn source_files_are_short_and_open_with_what_goes_in_and_out() {
    let mut wrong = Vec::new();
    let mut seen = 0;
    for (name, _) in MAY_USE {
        for file in rust_files(&root().join(name)) {
            seen += 1;
            let shown =
                file.strip_prefix(root()).expect("the file lies in the repository").display();
            let text = fs::read_to_string(&file).expect("source files are UTF-8");
            if text.lines().count() > LONGEST {
                wrong.push(format!("{shown} has more than {LONGEST} lines"));
            }
            // A kind of diagnostic opens with its page, which is a file beside it.
            if !text.starts_with("//! ") && !text.starts_with("#![doc = include_str!(") {
                wrong.push(format!("{shown} does not open with a `//!` sentence"));
            }
            let stem = file.file_stem().and_then(|stem| stem.to_str()).expect("names are UTF-8");
            if ["mod", "utils", "util", "helpers", "common"].contains(&stem) {
                wrong.push(format!("{shown} is not named after what it holds"));
            }
        }
    }
    assert!(seen > 20, "only {seen} source files were found");
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn only_the_command_line_meets_the_world() {
    let world =
        ["std::fs", "std::env", "io::std", "std::time", "std::process", "print!(", "println!("];
    let mut wrong = Vec::new();
    for name in ["lang", "planner", "learner", "causal"] {
        for file in rust_files(&root().join(name).join("src")) {
            let shown = file.strip_prefix(root()).expect("the file lies in the repository");
            if shown
                .components()
                .any(|part| part.as_os_str().to_string_lossy().starts_with("tests"))
            {
                continue;
            }
            let text = fs::read_to_string(&file).expect("source files are UTF-8");
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
                for thing in world.iter().filter(|thing| line.contains(**thing)) {
                    wrong.push(format!("{} uses {thing}", shown.display()));
                }
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn each_domain_has_its_page() {
    let folders: BTreeSet<String> = entries(&domains::folder())
        .into_iter()
        .filter(|path| path.join("domain.pddl").is_file())
        .map(|path| name(&path))
        .collect();
    let names = domains::NAMES.into_iter().chain(domains::MULTI_AGENT).chain(domains::UNSOLVABLE);
    let names: BTreeSet<String> = names.map(String::from).collect();
    assert_eq!(folders, names);
    let index = read("domains/README.md");
    for name in names {
        let folder = domains::folder().join(&name);
        assert!(folder.join("README.md").is_file(), "{name} has no README.md");
        assert!(
            index.contains(&format!("({name}/README.md)")),
            "domains/README.md leaves out {name}"
        );
    }
}

#[test]
fn the_cost_of_every_problem_of_a_reference_domain_is_known() {
    for name in domains::NAMES {
        let folder = domains::folder().join(name);
        let problems: Vec<String> = entries(&folder)
            .into_iter()
            .filter(|path| path.extension().is_some_and(|ending| ending == "pddl"))
            .map(|path| path.file_stem().expect("it has an ending").to_string_lossy().into_owned())
            .filter(|stem| stem != "domain")
            .collect();
        let known: Vec<String> = costs::read(name).into_keys().collect();
        assert_eq!(problems, known, "the problems of {name} and its costs.tsv");
    }
}

#[test]
fn costs_are_read_in_all_their_forms() {
    let drawers = costs::read("drawers");
    assert_eq!(drawers["p01"], costs::Known::Cost(3));
    assert_eq!(drawers["unsolvable"], costs::Known::Unsolvable);
}

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the crate lies in the workspace")
        .to_path_buf()
}

/// The text of a file of the repository.
fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What lies in a folder, in the order of the names.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.expect("the folder stays as it is").path())
        .collect();
    entries.sort();
    entries
}

/// The last part of a path.
fn name(path: &Path) -> String {
    path.file_name().expect("it came from a folder").to_string_lossy().into_owned()
}

/// The Rust files below a folder, build products left out.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in entries(&folder) {
            if entry.is_dir() && name(&entry) != "target" {
                folders.push(entry);
            } else if entry.extension().is_some_and(|ending| ending == "rs") {
                files.push(entry);
            }
        }
    }
    files
}

/// The names of the dependencies in a manifest, those of tests and builds included.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[') {
            inside = section.trim_end_matches(']').ends_with("dependencies");
        } else if inside && !line.is_empty() && !line.starts_with('#') {
            let end = line.find(['.', ' ', '=']).unwrap_or(line.len());
            names.push(line[..end].to_string());
        }
    }
    names
}

/// The paths that a page names in backticks or links to: first those in backticks.
///
/// A path has a slash, or is a page at the root, which has a capital; what leads out of the repository or into build products is left out.
fn paths(page: &str) -> Vec<String> {
    let mut fenced = false;
    let mut prose = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            prose.push_str(line);
            prose.push('\n');
        }
    }
    let quoted = prose.split('`').skip(1).step_by(2);
    let linked = prose.split("](").skip(1).map(|rest| rest.split(')').next().unwrap_or(rest));
    quoted.chain(linked).filter(|word| is_path(word)).map(String::from).collect()
}

/// Whether a word is a path within the repository.
fn is_path(word: &str) -> bool {
    let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c));
    let at_root = word.starts_with(|c: char| c.is_ascii_uppercase())
        && [".md", ".toml", ".cff"].iter().any(|ending| word.ends_with(ending));
    plain
        && (word.contains('/') || at_root)
        && !word.starts_with("../")
        && !word.starts_with("target/")
}
