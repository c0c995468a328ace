//! Files with one mistake each go in; the one diagnostic that each announces in its first line comes out, at exactly that place.
//!
//! `; expect: E0201 at 12:18-12:27` says the code and where it starts and ends, in lines and columns, the end exclusive;
//! `; with: good/problem.pddl` in the next line names the sound file that is checked with it.
//! What is said in full is kept in snapshots, one for each block of codes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use cli::input::Reader;
use lang::diagnostic::Diagnostics;
use lang::render;
use lang::source::{Sources, Span};

/// Files that are not understood as they should be yet, each with the reason. What is mended must leave the list.
const WAITING: &[(&str, &str)] = &[];

/// How many files there are at least.
const LEAST: usize = 100;

/// A file with a mistake, as its first lines describe it.
struct Case {
    name: String,
    expected: String,
    files: Vec<PathBuf>,
}

#[test]
fn each_bad_file_has_its_one_diagnostic() {
    let mut wrong = Vec::new();
    let mut blocks: BTreeMap<String, String> = BTreeMap::new();
    let cases = cases();
    assert!(cases.len() >= LEAST, "there are only {} files", cases.len());
    for case in &cases {
        let (found, sources) = check(&case.files);
        let said: Vec<String> = found
            .list
            .iter()
            .map(|one| format!("{} at {}", one.code, place(one.primary.span, &sources)))
            .collect();
        let bad = said != [format!("{} in {}", case.expected, case.files[0].display())];
        let waits = WAITING.iter().find(|(name, _)| *name == case.name);
        match (bad, waits) {
            (false, Some((name, reason))) => {
                wrong.push(format!("{name} waits no longer, though {reason}"));
            }
            (true, None) => wrong.push(format!(
                "{}: {} is expected, and there is {said:?}",
                case.name, case.expected
            )),
            _ => {}
        }
        if waits.is_none() {
            let block = blocks.entry(case.expected[..3].to_owned()).or_default();
            block.push_str(&render::full(&found, &sources, false));
            block.push('\n');
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let waiting = WAITING.iter().filter(|(name, _)| cases.iter().all(|case| case.name != *name));
    assert_eq!(waiting.count(), 0, "a file that waits is gone");
    for (block, text) in blocks {
        insta::assert_snapshot!(block, text);
    }
}

#[test]
fn the_good_files_are_silent() {
    let mut pairs = 0;
    for domain in entries("bad/good").iter().filter(|path| file_name(path).contains("domain")) {
        let problem = domain.with_file_name(file_name(domain).replace("domain", "problem"));
        let (found, sources) = check(&[domain.clone(), problem]);
        assert_eq!(render::concise(&found, &sources), "");
        pairs += 1;
    }
    assert!(pairs >= 6, "only {pairs} pairs were found");
}

/// What `caveat check` finds in some files.
fn check(files: &[PathBuf]) -> (Diagnostics, Sources) {
    let mut reader = Reader::default();
    let found = reader.check(files);
    let found = found.unwrap_or_else(|complaint| panic!("{complaint}"));
    (found, reader.sources)
}

/// All files that lie in `bad`, in the order of their names.
fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> =
        entries("bad").iter().filter(|path| path.is_file()).map(case).collect();
    cases.sort_by_key(|case| {
        let number = case.name.split('-').next().and_then(|number| number.parse::<u32>().ok());
        number.unwrap_or_else(|| panic!("{} does not start with a number", case.name))
    });
    cases
}

fn case(path: &PathBuf) -> Case {
    let text = fs::read_to_string(path).expect("the file is UTF-8");
    let mut lines = text.lines();
    let expected = lines.next().and_then(|line| line.strip_prefix("; expect: "));
    let expected = expected.unwrap_or_else(|| panic!("{} expects nothing", path.display()));
    let mut files = vec![path.clone()];
    if let Some(with) = lines.next().and_then(|line| line.strip_prefix("; with: ")) {
        files.push(Path::new("bad").join(with));
    }
    Case { name: file_name(path), expected: expected.to_owned(), files }
}

/// The files and folders in a folder, sorted.
fn entries(folder: &str) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("an entry can be read").path())
        .collect();
    entries.sort();
    entries
}

fn file_name(path: &Path) -> String {
    path.file_name().expect("it is a file").to_string_lossy().into_owned()
}

/// `LINE:COLUMN-LINE:COLUMN in FILE`
fn place(span: Span, sources: &Sources) -> String {
    let source = sources.get(span.source);
    let at = |offset: u32| {
        let before = &source.text[..offset as usize];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        format!("{line}:{column}")
    };
    format!("{}-{} in {}", at(span.start), at(span.end), source.name)
}
