//! [`Diagnostics`] go in; text for people comes out, and in the modules below text for programs.
//!
//! Lines and columns are made here and nowhere else: lines from 1, columns from 1 in Unicode scalar values.

mod json;
mod sarif;
mod github;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::source::{SourceId, Sources, Span};

pub use github::github;
pub use json::json;
pub use sarif::sarif;

/// Lines longer than this many bytes are cut around what is marked.
const LONG: usize = 110;

/// Of more diagnostics than this, only so many are shown in full: nobody reads them all.
const SHOWN: usize = 100;

/// Marked lines are shown in one piece if they lie within this many lines.
const NEAR: usize = 200;

/// One block for each, with the marked lines of the text; `color` adds escape sequences for a terminal.
pub fn full(diagnostics: &Diagnostics, sources: &Sources, color: bool) -> String {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut lines = Lines::default();
    let shown = diagnostics.list.iter().take(SHOWN);
    let mut blocks: Vec<String> =
        shown.map(|one| block(one, sources, &mut lines, &renderer)).collect();
    if diagnostics.list.len() > SHOWN {
        blocks.push(format!("… and {} more like these", diagnostics.list.len() - SHOWN));
    }
    let mut out = blocks.join("\n\n");
    if !out.is_empty() {
        out.push('\n');
    }
    out
}

/// One line for each: `path:line:column: error[E0101] unknown-predicate: message`.
pub fn concise(diagnostics: &Diagnostics, sources: &Sources) -> String {
    let mut lines = Lines::default();
    let mut out = String::new();
    for diagnostic in &diagnostics.list {
        let span = diagnostic.primary.span;
        let (line, column) = lines.position(sources, span.source, span.start);
        let path = &sources.get(span.source).name;
        let severity = word(diagnostic.severity);
        let (code, name, message) = (diagnostic.code, diagnostic.name, &diagnostic.message);
        writeln!(out, "{path}:{line}:{column}: {severity}[{code}] {name}: {message}")
            .expect("writing to a string cannot fail");
    }
    out
}

/// How many errors and warnings there are: `2 errors, 1 warning`; nothing if there are none.
pub fn summary(diagnostics: &Diagnostics) -> Option<String> {
    let count = |severity| {
        diagnostics.list.iter().filter(|diagnostic| diagnostic.severity == severity).count()
    };
    let named = |severity| match count(severity) {
        0 => None,
        1 => Some(format!("1 {}", word(severity))),
        several => Some(format!("{several} {}s", word(severity))),
    };
    let parts: Vec<String> =
        [Severity::Error, Severity::Warning].into_iter().filter_map(named).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

fn block(
    diagnostic: &Diagnostic,
    sources: &Sources,
    lines: &mut Lines,
    renderer: &Renderer,
) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = level
        .primary_title(&diagnostic.message)
        .id(diagnostic.code)
        .elements(Vec::<Origin<'_>>::new());
    let pieces = pieces(diagnostic, sources, lines);
    for piece in &pieces {
        let path = &sources.get(piece.source).name;
        if piece.shortened {
            // The renderer counts columns in what it is given, so where that is not the whole line, they are handed over.
            let origin = Origin::path(path).line(piece.position.0).char_column(piece.position.1);
            group = group.element(origin).element(piece.snippet());
        } else {
            group = group.element(piece.snippet().path(path));
        }
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    let report: [Group<'_>; 1] = [group];
    let text = renderer.render(&report);
    if !pieces.iter().any(|piece| piece.shortened) {
        return text;
    }
    // Between the place and the lines the renderer puts the header of a snippet without a path.
    text.split_inclusive('\n').filter(|line| without_escapes(line).trim() != ":::").collect()
}

/// A line without its colours.
fn without_escapes(line: &str) -> String {
    let mut pieces = line.split('\u{1b}');
    let first = pieces.next().unwrap_or("");
    let rest = pieces.map(|piece| piece.split_once('m').map_or("", |(_, text)| text));
    std::iter::once(first).chain(rest).collect()
}

/// A mark in a line.
struct Mark<'a> {
    /// Bytes of the source.
    range: Range<usize>,
    text: &'a str,
    primary: bool,
}

/// Some lines of a source that are shown together.
struct Piece<'a> {
    source: SourceId,
    /// Whether some line is not shown whole.
    shortened: bool,
    /// The line and column of what is marked first.
    position: (usize, usize),
    /// The number of the first line.
    line: usize,
    text: String,
    annotations: Vec<(Range<usize>, &'a str, bool)>,
}

impl<'a> Piece<'a> {
    fn snippet(&self) -> Snippet<'_, Annotation<'_>> {
        let annotations = self.annotations.iter().map(|(range, text, primary)| {
            let kind = if *primary { AnnotationKind::Primary } else { AnnotationKind::Context };
            let annotation = kind.span(range.clone());
            if text.is_empty() { annotation } else { annotation.label(*text) }
        });
        Snippet::source(self.text.as_str()).line_start(self.line).annotations(annotations)
    }

    /// Cuts the lines `first..=last` out of the source, long ones around their marks.
    fn cut(
        source: SourceId,
        rows: Range<usize>,
        marks: &[Mark<'a>],
        sources: &Sources,
        lines: &mut Lines,
    ) -> Self {
        let whole = &sources.get(source).text;
        let mut text = String::new();
        let mut annotations = Vec::new();
        let mut shortened = false;
        for row in rows.clone() {
            let line = lines.range(sources, source, row);
            let here: Vec<&Mark<'a>> = marks
                .iter()
                .filter(|mark| line.start <= mark.range.start && mark.range.start <= line.end)
                .collect();
            let shown = window(whole, &line, &here);
            shortened |= shown != line;
            if shown.start > line.start {
                text.push('…');
            }
            let offset = text.len();
            text.push_str(&whole[shown.clone()]);
            for mark in here {
                let place = |byte: usize| byte.clamp(shown.start, shown.end) - shown.start + offset;
                annotations.push((
                    place(mark.range.start)..place(mark.range.end),
                    mark.text,
                    mark.primary,
                ));
            }
            if shown.end < line.end {
                text.push('…');
            }
            text.push('\n');
        }
        let first = marks
            .iter()
            .find(|mark| mark.primary)
            .or(marks.first())
            .map_or(0, |mark| mark.range.start);
        let position = lines.position(sources, source, first as u32);
        Self { source, shortened, position, line: rows.start + 1, text, annotations }
    }
}

/// The part of a line that is shown.
fn window(text: &str, line: &Range<usize>, marks: &[&Mark<'_>]) -> Range<usize> {
    if line.len() <= LONG {
        return line.clone();
    }
    let first = marks.iter().map(|mark| mark.range.start).min().unwrap_or(line.start);
    let mut start = first.saturating_sub(LONG / 3).max(line.start);
    let mut end = (start + LONG).min(line.end);
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    while !text.is_char_boundary(end) {
        end += 1;
    }
    start..end
}

/// The lines that a diagnostic marks, the primary place first, each source and each distant place apart.
fn pieces<'a>(diagnostic: &'a Diagnostic, sources: &Sources, lines: &mut Lines) -> Vec<Piece<'a>> {
    let mut rows: BTreeMap<(bool, SourceId), BTreeMap<usize, Vec<Mark<'a>>>> = BTreeMap::new();
    let primary = diagnostic.primary.span.source;
    let labels = std::iter::once((&diagnostic.primary, true))
        .chain(diagnostic.secondary.iter().map(|label| (label, false)));
    for (label, is_primary) in labels {
        let Span { source, start, end } = label.span;
        let row = lines.row(sources, source, start);
        let line = lines.range(sources, source, row);
        let range = (start as usize).min(line.end)
            ..(end as usize).clamp((start as usize).min(line.end), line.end);
        let mark = Mark { range, text: &label.text, primary: is_primary };
        rows.entry((source != primary, source)).or_default().entry(row).or_default().push(mark);
    }
    let mut pieces = Vec::new();
    for ((_, source), rows) in rows {
        let mut runs: Vec<(Range<usize>, Vec<Mark<'a>>)> = Vec::new();
        for (row, marks) in rows {
            match runs.last_mut() {
                Some((range, gathered)) if row - range.start < NEAR => {
                    range.end = row + 1;
                    gathered.extend(marks);
                }
                _ => runs.push((row..row + 1, marks)),
            }
        }
        runs.sort_by_key(|(_, marks)| !marks.iter().any(|mark| mark.primary));
        pieces.extend(
            runs.into_iter().map(|(rows, marks)| Piece::cut(source, rows, &marks, sources, lines)),
        );
    }
    pieces
}

/// Where the lines of each source start, found when they are first asked for.
#[derive(Default)]
struct Lines {
    starts: BTreeMap<SourceId, Vec<u32>>,
    /// The last byte whose column was asked for, its line and the column: the next is mostly a little further on.
    last: (SourceId, usize, usize, usize),
}

impl Lines {
    fn of(&mut self, sources: &Sources, source: SourceId) -> &[u32] {
        self.starts.entry(source).or_insert_with(|| {
            let text = &sources.get(source).text;
            let ends = text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n');
            std::iter::once(0).chain(ends.map(|(at, _)| at as u32 + 1)).collect()
        })
    }

    /// The line, from 0, that contains the byte.
    fn row(&mut self, sources: &Sources, source: SourceId, byte: u32) -> usize {
        self.of(sources, source).partition_point(|&start| start <= byte) - 1
    }

    /// Line and column of the first byte and of the byte after the last.
    fn ends(&mut self, sources: &Sources, span: Span) -> [(usize, usize); 2] {
        [span.start, span.end].map(|byte| self.position(sources, span.source, byte))
    }

    /// The bytes of a line without its end.
    fn range(&mut self, sources: &Sources, source: SourceId, row: usize) -> Range<usize> {
        let text = &sources.get(source).text;
        let starts = self.of(sources, source);
        let start = starts[row] as usize;
        let end = starts.get(row + 1).map_or(text.len(), |&next| next as usize - 1);
        start..start + text[start..end].trim_end_matches('\r').len()
    }

    /// Line and column, both from 1, the column in Unicode scalar values.
    fn position(&mut self, sources: &Sources, source: SourceId, byte: u32) -> (usize, usize) {
        let row = self.row(sources, source, byte);
        let start = self.of(sources, source)[row] as usize;
        let text = &sources.get(source).text;
        let byte = byte as usize;
        let (from, before) = match self.last {
            (last, line, at, column)
                if last == source && line == row && start <= at && at <= byte =>
            {
                (at, column)
            }
            _ => (start, 0),
        };
        let between = text.get(from..byte).unwrap_or("");
        let column = before + between.chars().filter(|&character| character != '\u{feff}').count();
        self.last = (source, row, byte, column);
        (row + 1, column + 1)
    }
}
