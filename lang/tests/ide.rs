//! What an editor may ask, asked everywhere: in unfinished texts, in deep ones, and of every name of every dialect.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use lang::ide::{self, Workspace};
use lang::source::{SourceId, Span};

const DOMAIN: &str = include_str!("fixtures/domain.pddl");
const PROBLEM: &str = include_str!("fixtures/problem.pddl");

/// A domain and a problem of it.
fn pair(domain: &str, problem: &str) -> (Workspace, SourceId, SourceId) {
    let mut workspace = Workspace::default();
    let domain = workspace.add("domain.pddl", domain, false);
    let problem = workspace.add("problem.pddl", problem, false);
    workspace.pair(problem, Some(domain));
    (workspace, domain, problem)
}

/// Asks everything about a text and a place in it.
fn ask(workspace: &Workspace, id: SourceId, offset: u32) {
    let end = workspace.text(id).len() as u32;
    ide::hover(workspace, id, offset);
    ide::definition(workspace, id, offset);
    ide::typed_as(workspace, id, offset);
    ide::achievers(workspace, id, offset);
    ide::references(workspace, id, offset, true);
    ide::highlights(workspace, id, offset);
    let _ = ide::prepare_rename(workspace, id, offset);
    let _ = ide::rename(workspace, id, offset, "other");
    ide::complete(workspace, id, offset);
    ide::signature(workspace, id, offset);
    ide::selections(workspace, id, offset);
    ide::above(workspace, id, offset);
    ide::below(workspace, id, offset);
    if let Some(caller) = ide::caller(workspace, id, offset) {
        ide::incoming(workspace, &caller);
        ide::outgoing(workspace, &caller);
    }
    ide::remedies(workspace, id, 0, end);
    ide::fix_all(workspace, id);
    ide::format(workspace, id);
    ide::outline(workspace, id);
    ide::paint(workspace, id);
    ide::folds(workspace, id);
    ide::hints(workspace, Span::new(id, 0, end), true);
    ide::lenses(workspace, id);
    ide::search(workspace, "a");
}

#[test]
fn unfinished_texts_can_be_asked_about() {
    for end in (0..DOMAIN.len()).step_by(11) {
        let (workspace, domain, problem) = pair(&DOMAIN[..end], PROBLEM);
        ask(&workspace, domain, end as u32);
        ask(&workspace, problem, PROBLEM.len() as u32 / 2);
    }
    for end in (0..PROBLEM.len()).step_by(5) {
        let (workspace, _, problem) = pair(DOMAIN, &PROBLEM[..end]);
        ask(&workspace, problem, end as u32);
    }
}

#[test]
fn texts_with_a_hole_can_be_asked_about() {
    for start in (0..DOMAIN.len() - 4).step_by(13) {
        let text = format!("{}{}", &DOMAIN[..start], &DOMAIN[start + 4..]);
        let (workspace, domain, _) = pair(&text, PROBLEM);
        ask(&workspace, domain, start as u32);
    }
}

#[test]
fn texts_that_are_no_pddl_can_be_asked_about() {
    for text in
        ["", ")", "(", "((", "?", "- -", "(define", "; é", "é(ü)", "(:init (at 5 (p)))", "(a) (b)"]
    {
        let (mut workspace, domain, problem) = pair(text, text);
        let plan = workspace.add("a.plan", text, true);
        workspace.pair(plan, Some(problem));
        for id in [domain, problem, plan] {
            ask(&workspace, id, 0);
            ask(&workspace, id, text.len() as u32);
        }
    }
}

#[test]
fn depth_costs_no_stack() {
    let work = || {
        let depth = 3_000;
        let inside = format!("{}(p){}", "(and ".repeat(depth), ")".repeat(depth));
        let text = format!("(define (domain d) (:predicates (p)) (:action a :effect {inside}))");
        let (workspace, domain, _) =
            pair(&text, &format!("(define (problem x) (:domain d) (:goal {inside}))"));
        ask(&workspace, domain, (text.len() / 2) as u32);
        let (workspace, domain, _) = pair(&text[..text.len() / 2], "");
        ask(&workspace, domain, (text.len() / 2) as u32);
    };
    let thread = std::thread::Builder::new().stack_size(512 * 1024).spawn(work);
    let thread = thread.expect("a thread can be started");
    thread.join().expect("nothing panics or overflows its stack");
}

/// All pairs of the dialects.
fn dialects() -> Vec<(String, String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dialects");
    let mut pairs = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("the folder stays as it is").path();
        let name = path.file_name().expect("it came from a folder").to_string_lossy().into_owned();
        if let Some((dialect, ending)) = name.split_once("-domain.") {
            let read = |path: &Path| fs::read_to_string(path).expect("the file is there");
            let problem = path.with_file_name(format!("{dialect}-problem.{ending}"));
            pairs.push((dialect.to_owned(), read(&path), read(&problem)));
        }
    }
    pairs.push(("fixture".to_owned(), DOMAIN.to_owned(), PROBLEM.to_owned()));
    assert!(pairs.len() > 8, "where are the dialects?");
    pairs.sort();
    pairs
}

/// How often each message is given about both texts.
fn said(workspace: &Workspace, ids: [SourceId; 2]) -> Vec<&'static str> {
    let lists = ids.map(|id| &workspace.analysis(id).diagnostics.list);
    lists.into_iter().flatten().map(|one| one.code).collect()
}

/// Whatever is renamed, everywhere it stands, leaves two texts of which the same is to be said as before.
#[test]
fn every_name_of_every_dialect_can_be_renamed() {
    let mut renamed = 0;
    for (dialect, domain_text, problem_text) in dialects() {
        let (workspace, domain, problem) = pair(&domain_text, &problem_text);
        let before = said(&workspace, [domain, problem]);
        let mut seen = BTreeSet::new();
        for id in [domain, problem] {
            for one in &workspace.analysis(id).occurrences.list {
                let Some(target) = workspace.target(id, one.symbol) else { continue };
                let name = workspace.sources().text(one.span);
                let edits = match ide::rename(&workspace, id, one.span.start, "new-name") {
                    Ok(edits) => edits,
                    Err(refusal) => {
                        assert!(
                            refusal.0.contains("part of the language"),
                            "{dialect}: {name}: {}",
                            refusal.0
                        );
                        continue;
                    }
                };
                assert!(edits.iter().any(|(span, _)| *span == one.span), "{dialect}: {name} stays");
                if !seen.insert(target) {
                    continue;
                }
                let mut texts = [domain_text.clone(), problem_text.clone()];
                let mut sorted = edits.clone();
                sorted.sort_by_key(|(span, _)| *span);
                for (span, new) in sorted.iter().rev() {
                    let text = &mut texts[usize::from(span.source == problem)];
                    text.replace_range(span.start as usize..span.end as usize, new);
                }
                let (other, domain, problem) = pair(&texts[0], &texts[1]);
                assert_eq!(
                    said(&other, [domain, problem]),
                    before,
                    "{dialect}: {name} in\n{}\n{}",
                    texts[0],
                    texts[1]
                );
                renamed += 1;
            }
        }
    }
    assert!(renamed > 250, "only {renamed} names were renamed");
}

/// Every name leads to a declaration, and there is something to say of it.
#[test]
fn every_name_of_every_dialect_is_explained() {
    for (dialect, domain, problem) in dialects() {
        let (workspace, domain, problem) = pair(&domain, &problem);
        for id in [domain, problem] {
            for one in &workspace.analysis(id).occurrences.list {
                let name = workspace.sources().text(one.span);
                let at = one.span.start;
                assert!(workspace.target(id, one.symbol).is_some(), "{dialect}: {name} is unknown");
                assert!(ide::hover(&workspace, id, at).is_some(), "{dialect}: {name} has no hover");
                let known = !ide::definition(&workspace, id, at).is_empty();
                assert!(
                    known || name.eq_ignore_ascii_case("object"),
                    "{dialect}: {name} is declared nowhere"
                );
            }
        }
    }
}

/// Whatever was written can be proposed where it stands.
#[test]
fn every_name_of_every_dialect_is_completed() {
    let (mut offered, mut all) = (0, 0);
    let mut missing = Vec::new();
    for (dialect, domain, problem) in dialects() {
        let (workspace, domain, problem) = pair(&domain, &problem);
        for id in [domain, problem] {
            for one in &workspace.analysis(id).occurrences.list {
                if one.role == lang::symbol::Role::Declare {
                    continue;
                }
                let name = workspace.sources().text(one.span);
                let found = ide::complete(&workspace, id, one.span.start + 1).list;
                all += 1;
                if found.iter().any(|item| item.label.eq_ignore_ascii_case(name)) {
                    offered += 1;
                } else {
                    let before = &workspace.text(id)[..one.span.start as usize];
                    let line = before.rsplit('\n').next().unwrap_or("").trim_start().to_owned();
                    missing.push(format!("{dialect}: {line}|{name}"));
                }
            }
        }
    }
    assert!(offered * 100 >= all * 97, "{offered} of {all}:\n{}", missing.join("\n"));
}
