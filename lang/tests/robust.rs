//! No text makes the reader panic, overflow the stack or take long; and the tree keeps every byte.

use std::fmt::Write;
use std::fs;
use std::panic;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lang::diagnostic::Diagnostics;
use lang::model::{Domain, Problem};
use lang::source::{SourceId, Sources};
use lang::{lexer, render, tree};
use proptest::prelude::*;

#[path = "../../tests/fuzz/promises.rs"]
mod promises;

const DOMAIN: &str = include_str!("fixtures/domain.pddl");
const PROBLEM: &str = include_str!("fixtures/problem.pddl");

/// Reads both, renders what is said and returns the models.
fn read(domain: &str, problem: &str) -> (Domain, Problem, Diagnostics) {
    let mut sources = Sources::default();
    let domain = sources.add("domain.pddl", domain);
    let problem = sources.add("problem.pddl", problem);
    lang::detect(&sources, domain);
    lang::detect(&sources, problem);
    let (domain, mut diagnostics) = lang::read_domain(&sources, domain);
    let (problem, more) = lang::read_problem(&sources, problem, &domain);
    diagnostics.append(more);
    render::full(&diagnostics, &sources, true);
    render::concise(&diagnostics, &sources);
    (domain, problem, diagnostics)
}

/// Runs on a stack so small that recursion on the depth of the text could not go unnoticed.
fn on_small_stack(work: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new()
        .stack_size(512 * 1024)
        .spawn(work)
        .expect("a thread can be started");
    thread.join().expect("the work neither panics nor overflows its stack");
}

#[test]
fn the_fixtures_are_clean() {
    let (_, _, diagnostics) = read(DOMAIN, PROBLEM);
    assert_eq!(diagnostics.list, []);
}

#[test]
fn every_prefix_is_read() {
    for end in (0..=DOMAIN.len()).filter(|&end| DOMAIN.is_char_boundary(end)) {
        read(&DOMAIN[..end], PROBLEM);
    }
    for end in (0..=PROBLEM.len()).filter(|&end| PROBLEM.is_char_boundary(end)) {
        read(DOMAIN, &PROBLEM[..end]);
    }
}

/// All files of PDDL or HDDL in a folder and below it.
fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("the folder can be read");
    let mut entries: Vec<PathBuf> =
        entries.map(|entry| entry.expect("an entry can be read").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files_below(&path, found);
        } else if path.extension().is_some_and(|end| end == "pddl" || end == "hddl") {
            found.push(path);
        }
    }
}

/// Of each file this many bytes are read, in prefixes as far apart as that makes them.
const READ: usize = 6_000;

#[test]
fn prefixes_of_real_files_are_read() {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    if !root.join("corpus").is_dir() {
        eprintln!("SKIPPED: no shared material at {}; set CAVEAT_SHARED", root.display());
        return;
    }
    let mut files = Vec::new();
    for folder in ["bad-pddl", "valid-pddl", "mapddl"] {
        files_below(&root.join("corpus").join(folder), &mut files);
    }
    assert!(files.len() > 100, "only {} files were found", files.len());
    let mut prefixes = 0;
    for file in files {
        let text = fs::read_to_string(&file).expect("the file can be read");
        let mut ends: Vec<usize> =
            lexer::lex(&text).iter().map(|token| token.end as usize).collect();
        // Words are cut in the middle too.
        ends.extend((0..text.len()).step_by(17).filter(|&end| text.is_char_boundary(end)));
        ends.sort_unstable();
        let apart = (ends.iter().sum::<usize>() / READ).max(1);
        for &end in ends.iter().step_by(apart) {
            prefixes += 1;
            let prefix = &text[..end];
            let done = panic::catch_unwind(|| {
                promises::keep("tree", prefix.as_bytes());
                promises::keep("format", prefix.as_bytes());
                let mut sources = Sources::default();
                let id = sources.add("start", text.as_str());
                if matches!(lang::detect(&sources, id), Some(lang::Kind::Problem { .. })) {
                    promises::pair(DOMAIN, prefix);
                } else {
                    promises::keep("domain", prefix.as_bytes());
                }
            });
            assert!(done.is_ok(), "{}, {end} bytes", file.display());
        }
    }
    assert!(prefixes > 400, "only {prefixes} prefixes were read");
}

#[test]
fn every_missing_piece_is_read() {
    for (text, other, is_domain) in [(DOMAIN, PROBLEM, true), (PROBLEM, DOMAIN, false)] {
        for start in (0..text.len()).step_by(3) {
            for length in [1, 7] {
                let end = (start + length).min(text.len());
                if !text.is_char_boundary(start) || !text.is_char_boundary(end) {
                    continue;
                }
                let cut = format!("{}{}", &text[..start], &text[end..]);
                if is_domain {
                    read(&cut, other)
                } else {
                    read(other, &cut)
                };
            }
        }
    }
}

/// A domain whose one action has this precondition and this effect.
fn domain_with(precondition: &str, effect: &str) -> String {
    format!(
        "(define (domain deep) (:requirements :adl) (:predicates (p) (q ?x))\n(:action a :parameters () :precondition {precondition} :effect {effect}))"
    )
}

#[test]
fn deep_nesting_is_read_in_linear_time() {
    const DEPTH: usize = 100_000;
    on_small_stack(|| {
        let start = Instant::now();
        let nest =
            |open: &str, core: &str| format!("{}{core}{}", open.repeat(DEPTH), ")".repeat(DEPTH));
        for open in [
            "(and ",
            "(or ",
            "(not ",
            "(imply (p) ",
            "(forall (?x) ",
            "(exists (?x - object) ",
            "(when (p) ",
            "(",
            "(q ",
        ] {
            let (domain, _, _) = read(&domain_with(&nest(open, "(p)"), "(p)"), PROBLEM);
            assert_eq!(domain.actions.len(), 1, "{open}");
            let (domain, _, _) = read(&domain_with("(p)", &nest(open, "(p)")), PROBLEM);
            assert_eq!(domain.actions.len(), 1, "{open}");
            let problem = format!(
                "(define (problem x) (:domain deep) (:init {}) (:goal {}))",
                nest(open, "(p)"),
                nest(open, "(p)")
            );
            read(&domain_with("(p)", "(p)"), &problem);
        }
        read(&"(".repeat(DEPTH), &")".repeat(DEPTH));
        read(&"(define (domain d) (:action ".repeat(DEPTH / 10), &"(:init".repeat(DEPTH));
        let time = start.elapsed();
        assert!(time < Duration::from_mins(1), "it took {time:?}");
    });
}

#[test]
fn many_mistakes_take_linear_time() {
    let mut problem = "(define (problem many) (:domain kitchen) (:objects".to_owned();
    (0..4000).for_each(|n| write!(problem, " cup-number-{n} - cup").expect("a string takes all"));
    problem.push_str(") (:init");
    (0..4000)
        .for_each(|n| write!(problem, "\n(in kup-number-{n} table)").expect("a string takes all"));
    problem.push_str(") (:goal (and)))");
    let start = Instant::now();
    let (_, _, diagnostics) = read(DOMAIN, &problem);
    let time = start.elapsed();
    assert!(diagnostics.list.len() >= 4000, "each unknown object is a mistake of its own");
    assert!(time < Duration::from_secs(30), "it took {time:?}");
}

/// Text that looks like PDDL, or not at all.
fn any_text() -> impl Strategy<Value = String> {
    let pieces = prop_oneof![
        8 => prop::sample::select(vec![
            "(", ")", "(", ")", " ", "\n", "\r\n", "; a comment\n", ";@ (:causal)\n", "define", "domain", "problem", ":init", "(:goal", "(:action",
            "(:predicates", ":parameters", ":precondition", ":effect", "and", "not", "?x", "?", "-", "-t", "either", "=", "5", "1e3",
            "\u{feff}", "\u{a0}", "–", "é", "(:types", "(:objects", "(:private", "increase", "forall", "when", "at", "(:metric minimize",
        ]).prop_map(str::to_owned),
        1 => any::<String>(),
    ];
    prop::collection::vec(pieces, 0..60).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn the_tree_keeps_every_byte(text in any_text()) {
        let mut diagnostics = Diagnostics::default();
        let tree = tree::parse(SourceId(0), &text, &mut diagnostics);
        prop_assert_eq!(tree.text(), text);
    }

    #[test]
    fn any_text_is_read(start in 0..DOMAIN.len(), text in any_text(), swap: bool) {
        let spliced = |whole: &str| {
            let at = (0..=start.min(whole.len())).rev().find(|&at| whole.is_char_boundary(at)).unwrap_or(0);
            format!("{}{text}{}", &whole[..at], &whole[at..])
        };
        if swap { read(&text, &spliced(PROBLEM)) } else { read(&spliced(DOMAIN), &text) };
    }

    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let text = String::from_utf8_lossy(&bytes);
        read(&text, &text);
    }
}
