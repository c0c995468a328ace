//! Diagnostics go in; a log in the Static Analysis Results Interchange Format comes out (SARIF 2.1.0, OASIS 2020).

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Lines, word};
use crate::diagnostic::{Diagnostic, Diagnostics, Fix, Label, RULES};
use crate::source::{Sources, Span};

/// One run with all kinds as its rules.
pub fn sarif(diagnostics: &Diagnostics, sources: &Sources) -> String {
    let mut lines = Lines::default();
    let rules: Vec<Value> = RULES
        .iter()
        .map(|rule| {
            json!({
                "id": rule.code,
                "name": rule.name,
                "shortDescription": { "text": summary(rule.page) },
                "help": { "text": rule.page, "markdown": rule.page },
                "defaultConfiguration": { "level": word(rule.severity) },
            })
        })
        .collect();
    let results: Vec<Value> =
        diagnostics.list.iter().map(|one| result(one, sources, &mut lines)).collect();
    let document = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "caveat",
                "version": env!("CARGO_PKG_VERSION"),
                "informationUri": env!("CARGO_PKG_REPOSITORY"),
                "rules": rules,
            } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    let mut text = serde_json::to_string_pretty(&document).expect("a value can be written");
    text.push('\n');
    text
}

/// The first sentence of a page, after its title.
fn summary(page: &str) -> &str {
    page.lines().skip(1).find(|line| !line.is_empty()).unwrap_or("")
}

fn result(one: &Diagnostic, sources: &Sources, lines: &mut Lines) -> Value {
    let related: Vec<Value> =
        one.secondary.iter().map(|label| location(label, sources, lines)).collect();
    let fixes: Vec<Value> = one.fixes.iter().map(|each| fix(each, sources, lines)).collect();
    let message = match &one.help {
        Some(help) => format!("{}; help: {help}", one.message),
        None => one.message.clone(),
    };
    json!({
        "ruleId": one.code,
        "ruleIndex": RULES.iter().position(|rule| rule.code == one.code),
        "level": word(one.severity),
        "message": { "text": message },
        "locations": [location(&one.primary, sources, lines)],
        "relatedLocations": related,
        "fixes": fixes,
    })
}

fn location(label: &Label, sources: &Sources, lines: &mut Lines) -> Value {
    let mut value = json!({ "physicalLocation": {
        "artifactLocation": { "uri": uri(&sources.get(label.span.source).name) },
        "region": region(label.span, sources, lines),
    } });
    if !label.text.is_empty() {
        value["message"] = json!({ "text": label.text });
    }
    value
}

fn fix(fix: &Fix, sources: &Sources, lines: &mut Lines) -> Value {
    let change = |(span, text): &(Span, String)| {
        json!({
            "artifactLocation": { "uri": uri(&sources.get(span.source).name) },
            "replacements": [{
                "deletedRegion": region(*span, sources, lines),
                "insertedContent": { "text": text },
            }],
        })
    };
    let changes: Vec<Value> = fix.edits.iter().map(change).collect();
    json!({ "description": { "text": fix.title }, "artifactChanges": changes })
}

fn region(span: Span, sources: &Sources, lines: &mut Lines) -> Value {
    let [start, end] = lines.ends(sources, span);
    json!({ "startLine": start.0, "startColumn": start.1, "endLine": end.0, "endColumn": end.1 })
}

/// A path as the reference of a URI: whatever is not plain is written in percents.
fn uri(path: &str) -> String {
    let mut out = String::new();
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                out.push(char::from(byte));
            }
            _ => write!(out, "%{byte:02X}").expect("writing to a string cannot fail"),
        }
    }
    out
}
