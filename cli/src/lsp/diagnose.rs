//! The texts that are open go in; what is wrong with them comes out, for each document.

use std::collections::BTreeMap;

use gen_lsp_types::{
    Code, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag,
};
use lang::Kind;
use lang::diagnostic::{self, Applicability, Severity};
use lang::source::{SourceId, Span};
use serde_json::{Value, json};

use super::convert;
use super::folder::Folder;

/// What is wrong with the open texts. A problem may have something to say of its domain, whether that is open or not.
pub fn all(folder: &Folder) -> BTreeMap<SourceId, Vec<Diagnostic>> {
    let mut found: BTreeMap<SourceId, Vec<&diagnostic::Diagnostic>> = BTreeMap::new();
    let opened = folder.opened();
    for &id in &opened {
        found.entry(id).or_default();
        for one in &folder.workspace.analysis(id).diagnostics.list {
            let list = found.entry(one.primary.span.source).or_default();
            // Two problems may say the same of their domain.
            if one.primary.span.source == id || !list.contains(&one) {
                list.push(one);
            }
        }
    }
    found
        .into_iter()
        .filter(|(id, _)| folder.is_known(Span::new(*id, 0, 0)))
        .map(|(id, list)| {
            let mut list: Vec<Diagnostic> =
                list.into_iter().map(|one| diagnostic(folder, one)).collect();
            list.extend(opened.contains(&id).then(|| alone(folder, id)).flatten());
            (id, list)
        })
        .collect()
}

/// What is wrong with one text.
pub fn one(folder: &Folder, id: SourceId) -> Vec<Diagnostic> {
    all(folder).remove(&id).unwrap_or_default()
}

/// A note where nothing is checked, since nobody knows what the names mean.
fn alone(folder: &Folder, id: SourceId) -> Option<Diagnostic> {
    if folder.workspace.partner(id).is_some() {
        return None;
    }
    let text = folder.workspace.text(id);
    let (span, message) = match folder.workspace.kind(id) {
        Some(Kind::Problem { domain: Some(domain), .. }) => {
            let start = text.find(domain.as_str())? as u32;
            let span = Span::new(id, start, start + domain.len() as u32);
            (
                span,
                format!(
                    "no file in this folder or above defines the domain `{domain}`, so names are not checked"
                ),
            )
        }
        None if folder.workspace.is_plan(id) => {
            let end = text.find('\n').unwrap_or(text.len()) as u32;
            let message = "no problem in this folder fits this plan, so it is not checked";
            (Span::new(id, 0, end), message.to_owned())
        }
        _ => return None,
    };
    Some(Diagnostic {
        range: folder.range(span),
        severity: Some(DiagnosticSeverity::Information),
        source: Some(SOURCE.to_owned()),
        message: message.into(),
        ..Diagnostic::default()
    })
}

/// Who says it.
const SOURCE: &str = "caveat";

fn diagnostic(folder: &Folder, one: &diagnostic::Diagnostic) -> Diagnostic {
    let related = one.secondary.iter().filter(|label| folder.is_known(label.span));
    let related: Vec<_> = related
        .map(|label| DiagnosticRelatedInformation {
            location: convert::location(folder, label.span),
            message: if label.text.is_empty() { "here".to_owned() } else { label.text.clone() },
        })
        .collect();
    let message = match &one.help {
        Some(help) => format!("{}\nhelp: {help}", one.message),
        None => one.message.clone(),
    };
    let unused = one.name.starts_with("unused-").then(|| vec![DiagnosticTag::Unnecessary]);
    Diagnostic {
        range: folder.range(one.primary.span),
        severity: Some(match one.severity {
            Severity::Error => DiagnosticSeverity::Error,
            Severity::Warning => DiagnosticSeverity::Warning,
        }),
        code: Some(Code::String(one.code.to_owned())),
        source: Some(SOURCE.to_owned()),
        message: message.into(),
        tags: unused,
        related_information: (!related.is_empty()).then_some(related),
        data: Some(data(folder, one)),
        ..Diagnostic::default()
    }
}

/// The name of the kind, and the fixes, for whoever reads them without asking again.
fn data(folder: &Folder, one: &diagnostic::Diagnostic) -> Value {
    let fixes = one.fixes.iter().map(|fix| {
        let edits = fix.edits.iter().map(|(span, new)| {
            let location = convert::location(folder, *span);
            json!({ "uri": location.uri, "range": location.range, "newText": new })
        });
        json!({
            "title": fix.title,
            "safe": fix.applicability == Applicability::Safe,
            "edits": edits.collect::<Vec<_>>(),
        })
    });
    json!({ "name": one.name, "fixes": fixes.collect::<Vec<_>>() })
}
