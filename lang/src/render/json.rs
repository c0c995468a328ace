//! Diagnostics go in; one JSON document comes out, as `docs/diagnostics.schema.json` describes it.

use serde_json::{Value, json};

use super::{Lines, word};
use crate::diagnostic::{Applicability, Diagnostic, Diagnostics, Fix, Label};
use crate::source::{Sources, Span};

/// The version of the layout; it grows when a field goes or changes its meaning.
const VERSION: u32 = 1;

/// All diagnostics with their places, labels and fixes.
pub fn json(diagnostics: &Diagnostics, sources: &Sources) -> String {
    let mut lines = Lines::default();
    let list: Vec<Value> =
        diagnostics.list.iter().map(|one| diagnostic(one, sources, &mut lines)).collect();
    let document = json!({ "version": VERSION, "diagnostics": list });
    let mut text = serde_json::to_string_pretty(&document).expect("a value can be written");
    text.push('\n');
    text
}

fn diagnostic(one: &Diagnostic, sources: &Sources, lines: &mut Lines) -> Value {
    let labels: Vec<Value> =
        one.secondary.iter().map(|other| label(other, sources, lines)).collect();
    let fixes: Vec<Value> = one.fixes.iter().map(|each| fix(each, sources, lines)).collect();
    json!({
        "code": one.code,
        "name": one.name,
        "severity": word(one.severity),
        "message": one.message,
        "span": span(one.primary.span, sources, lines),
        "label": one.primary.text,
        "labels": labels,
        "help": one.help,
        "fixes": fixes,
    })
}

fn label(label: &Label, sources: &Sources, lines: &mut Lines) -> Value {
    json!({ "span": span(label.span, sources, lines), "text": label.text })
}

fn fix(fix: &Fix, sources: &Sources, lines: &mut Lines) -> Value {
    let edits: Vec<Value> = fix
        .edits
        .iter()
        .map(|(place, text)| json!({ "span": span(*place, sources, lines), "text": text }))
        .collect();
    let applicability = match fix.applicability {
        Applicability::Safe => "safe",
        Applicability::Suggested => "suggested",
    };
    json!({ "title": fix.title, "applicability": applicability, "edits": edits })
}

fn span(span: Span, sources: &Sources, lines: &mut Lines) -> Value {
    let [start, end] = lines.ends(sources, span);
    let point =
        |at: (usize, usize), byte: u32| json!({ "line": at.0, "column": at.1, "byte": byte });
    json!({
        "file": sources.get(span.source).name,
        "start": point(start, span.start),
        "end": point(end, span.end),
    })
}
