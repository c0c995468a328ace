//! Texts with caret comments go in; nothing comes out if the reader says exactly what they announce.
//!
//! A comment `;   ^^^^ E0101: message` marks the bytes of the line before it that are above the carets.

use std::fmt::Write;

use crate::diagnostic::Diagnostics;
use crate::portability::Tool;
use crate::source::{SourceId, Sources};

/// Checks a domain, or a domain and a problem.
#[track_caller]
pub(crate) fn check(texts: &[&str]) {
    said(texts, Also::Nothing);
}

/// Checks them as someone does who wants to run them.
#[track_caller]
pub(crate) fn run(texts: &[&str]) {
    said(texts, Also::Refusals);
}

/// Checks them with all lints.
#[track_caller]
pub(crate) fn lint(texts: &[&str]) {
    said(texts, Also::Lints);
}

/// Checks them for programs that are to read them.
#[track_caller]
pub(crate) fn port(tools: &'static [Tool], texts: &[&str]) {
    said(texts, Also::Portability(tools));
}

/// What is said beside the mistakes.
#[derive(Clone, Copy)]
enum Also {
    Portability(&'static [Tool]),
    Nothing,
    Refusals,
    Lints,
}

#[track_caller]
fn said(texts: &[&str], also: Also) {
    let mut sources = Sources::default();
    let ids: Vec<SourceId> = texts.iter().map(|text| sources.add("fixture", bare(text))).collect();
    let (domain, mut diagnostics) = crate::read_domain(&sources, ids[0]);
    let problem = ids.get(1).map(|&problem| {
        let (problem, more) = crate::read_problem(&sources, problem, &domain);
        diagnostics.append(more);
        problem
    });
    match also {
        Also::Nothing => {}
        Also::Portability(tools) => {
            for &id in &ids {
                diagnostics.append(crate::portability::check(&sources, id, tools));
            }
        }
        Also::Refusals => {
            let more = problem.iter().flat_map(|problem| &problem.uses);
            diagnostics.append(crate::refusals(domain.uses.iter().chain(more)));
        }
        Also::Lints => {
            diagnostics.append(crate::lint::domain(&domain));
            for &id in &ids {
                diagnostics.append(crate::lint::text(&sources, id, &domain));
            }
            diagnostics.append(
                problem.map_or_else(Default::default, |problem| {
                    crate::lint::problem(&domain, &problem)
                }),
            );
        }
    }
    for (&text, &id) in texts.iter().zip(&ids) {
        let said = annotate(id, &sources, &diagnostics);
        assert!(said == text, "what is said differs from the fixture; it is:\n{said}");
    }
}

/// Whether a line is a caret comment.
fn is_mark(line: &str) -> bool {
    line.strip_prefix(';').is_some_and(|rest| rest.trim_start().starts_with('^'))
}

/// The text without its caret comments.
fn bare(text: &str) -> String {
    text.split_inclusive('\n').filter(|line| !is_mark(line)).collect()
}

/// The text with what is said about it.
fn annotate(source: SourceId, sources: &Sources, diagnostics: &Diagnostics) -> String {
    let mut out = String::new();
    let mut start = 0;
    for line in sources.get(source).text.split_inclusive('\n') {
        out.push_str(line);
        let end = start + line.len();
        for diagnostic in &diagnostics.list {
            let span = diagnostic.primary.span;
            if span.source != source || !(start..end).contains(&(span.start as usize)) {
                continue;
            }
            let before = span.start as usize - start;
            let length =
                (span.end as usize).min(start + line.trim_end().len()) - span.start as usize;
            let blanks = " ".repeat(before.saturating_sub(1));
            let carets = "^".repeat(length.max(1));
            writeln!(out, ";{blanks}{carets} {}: {}", diagnostic.code, diagnostic.message)
                .expect("a string takes all");
        }
        start = end;
    }
    out
}
