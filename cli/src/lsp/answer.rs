//! A request goes in; its answer comes out, made of what `lang::ide` says.

use gen_lsp_types::{
    CodeAction, CodeActionKind, CodeActionRequest, CodeActionResponse, DefinitionRequest,
    DocumentDiagnosticReport, DocumentDiagnosticRequest, DocumentFormattingRequest,
    DocumentHighlight, DocumentHighlightRequest, DocumentRangeFormattingRequest,
    FullDocumentDiagnosticReport, Hover, HoverRequest, Location, MarkupContent, MarkupKind,
    PrepareRenameRequest, ReferencesRequest, RelatedFullDocumentDiagnosticReport, RenameRequest,
    Request as Protocol, TextDocumentPositionParams, TextEdit, Uri, WorkspaceEdit,
};
use lang::ide;
use lang::source::{SourceId, Span};
use lsp_server::{ErrorCode, Request};
use serde_json::{Value, json};

use super::serve::Server;
use super::{convert, diagnose};

/// Why there is no answer.
pub type Trouble = (ErrorCode, String);

/// Answers a request.
pub fn answer(server: &mut Server, request: Request) -> Result<Value, Trouble> {
    let Request { method, params, .. } = request;
    match method.as_str() {
        "textDocument/hover" => with::<HoverRequest>(server, params, |server, asked| {
            Ok(hover(server, &asked.text_document_position_params))
        }),
        "textDocument/definition" => with::<DefinitionRequest>(server, params, |server, asked| {
            let found = place(server, &asked.text_document_position_params).map(|(id, at)| {
                locations(server, ide::definition(&server.folder.workspace, id, at))
            });
            Ok(found.map(|found| gen_lsp_types::Definition::LocationList(found).into()))
        }),
        "textDocument/references" => with::<ReferencesRequest>(server, params, |server, asked| {
            let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                return Ok(None);
            };
            server.folder.load_all(id);
            let declaration = asked.context.include_declaration;
            let found = ide::references(&server.folder.workspace, id, at, declaration);
            Ok(Some(locations(server, found)))
        }),
        "textDocument/documentHighlight" => {
            with::<DocumentHighlightRequest>(server, params, |server, asked| {
                Ok(highlights(server, &asked.text_document_position_params))
            })
        }
        "textDocument/prepareRename" => {
            with::<PrepareRenameRequest>(server, params, |server, asked| {
                let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                    return Ok(None);
                };
                let workspace = &server.folder.workspace;
                if workspace.at(id, at).is_none() {
                    return Ok(None);
                }
                let span = ide::prepare_rename(workspace, id, at).map_err(refused)?;
                Ok(Some(server.folder.range(span).into()))
            })
        }
        "textDocument/rename" => with::<RenameRequest>(server, params, |server, asked| {
            let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                return Ok(None);
            };
            server.folder.load_all(id);
            let edits = ide::rename(&server.folder.workspace, id, at, &asked.new_name);
            Ok(Some(edit(server, &edits.map_err(refused)?)))
        }),
        "textDocument/codeAction" => with::<CodeActionRequest>(server, params, |server, asked| {
            let Some(id) = server.folder.id(&asked.text_document.uri) else { return Ok(None) };
            let span = server.folder.span(id, asked.range);
            Ok(Some(actions(server, id, span, &asked.context)))
        }),
        "textDocument/formatting" => {
            with::<DocumentFormattingRequest>(server, params, |server, asked| {
                Ok(format(server, &asked.text_document.uri, |_, _| true))
            })
        }
        "textDocument/rangeFormatting" => {
            with::<DocumentRangeFormattingRequest>(server, params, |server, asked| {
                Ok(format(server, &asked.text_document.uri, |server, span| {
                    let wanted = server.folder.span(span.source, asked.range);
                    wanted.start <= span.start && span.end <= wanted.end
                }))
            })
        }
        "textDocument/diagnostic" => {
            with::<DocumentDiagnosticRequest>(server, params, |server, asked| {
                let id = server.folder.id(&asked.text_document.uri);
                let items = id.map(|id| diagnose::one(&server.folder, id)).unwrap_or_default();
                let report = FullDocumentDiagnosticReport { items, ..Default::default() };
                Ok(DocumentDiagnosticReport::from(RelatedFullDocumentDiagnosticReport {
                    full_document_diagnostic_report: report,
                    ..Default::default()
                }))
            })
        }
        _ => Err((ErrorCode::MethodNotFound, format!("there is no method `{method}`"))),
    }
}

/// Reads the parameters of a request, and writes its answer.
fn with<R: Protocol>(
    server: &mut Server,
    parameters: Value,
    work: impl FnOnce(&mut Server, R::Params) -> Result<R::Result, Trouble>,
) -> Result<Value, Trouble> {
    let parameters = serde_json::from_value(parameters)
        .map_err(|error| (ErrorCode::InvalidParams, error.to_string()))?;
    work(server, parameters).map(|result| json!(result))
}

/// The text and the byte that a request asks about; none if the text is not known.
fn place(server: &Server, asked: &TextDocumentPositionParams) -> Option<(SourceId, u32)> {
    let id = server.folder.id(&asked.text_document.uri)?;
    Some((id, server.folder.offset(id, asked.position)))
}

fn locations(server: &Server, spans: Vec<Span>) -> Vec<Location> {
    spans.into_iter().map(|span| convert::location(&server.folder, span)).collect()
}

fn edit(server: &Server, edits: &[(Span, String)]) -> WorkspaceEdit {
    convert::workspace_edit(&server.folder, edits, server.client.versions)
}

fn refused(refusal: ide::Refusal) -> Trouble {
    (ErrorCode::RequestFailed, refusal.0)
}

fn hover(server: &Server, asked: &TextDocumentPositionParams) -> Option<Hover> {
    let (id, at) = place(server, asked)?;
    let (span, value) = ide::hover(&server.folder.workspace, id, at)?;
    Some(Hover {
        contents: MarkupContent { kind: MarkupKind::Markdown, value }.into(),
        range: Some(server.folder.range(span)),
    })
}

fn highlights(
    server: &Server,
    asked: &TextDocumentPositionParams,
) -> Option<Vec<DocumentHighlight>> {
    let (id, at) = place(server, asked)?;
    let found = ide::highlights(&server.folder.workspace, id, at).into_iter();
    let shown = found.map(|(span, role)| DocumentHighlight {
        range: server.folder.range(span),
        kind: Some(convert::highlight(role)),
    });
    Some(shown.collect())
}

fn format(
    server: &Server,
    uri: &Uri,
    wanted: impl Fn(&Server, Span) -> bool,
) -> Option<Vec<TextEdit>> {
    let id = server.folder.id(uri)?;
    if server.folder.workspace.is_plan(id) {
        return None;
    }
    let edits = ide::format(&server.folder.workspace, id)?;
    let edits = edits.iter().filter(|(span, _)| wanted(server, *span));
    Some(edits.map(|one| convert::edit(&server.folder, one)).collect())
}

/// What can be done about the mistakes in a span, and the safe fixes of the whole text.
fn actions(
    server: &Server,
    id: SourceId,
    span: Span,
    context: &gen_lsp_types::CodeActionContext,
) -> Vec<CodeActionResponse> {
    let workspace = &server.folder.workspace;
    let wanted = |kind: &CodeActionKind| {
        let below = |only: &CodeActionKind| {
            let (only, kind) = (json!(only), json!(kind));
            let (only, kind) = (only.as_str().unwrap_or(""), kind.as_str().unwrap_or(""));
            kind == only || kind.starts_with(&format!("{only}."))
        };
        context.only.as_ref().is_none_or(|only| only.is_empty() || only.iter().any(below))
    };
    let mut actions: Vec<CodeActionResponse> = Vec::new();
    if wanted(&CodeActionKind::QuickFix) {
        for remedy in ide::remedies(workspace, id, span.start, span.end) {
            let (code, at) = remedy.about;
            let range = server.folder.range(at);
            let same = |one: &&gen_lsp_types::Diagnostic| {
                one.range == range && one.code == Some(code.to_owned().into())
            };
            let about: Vec<_> = context.diagnostics.iter().filter(same).cloned().collect();
            let action = CodeAction {
                title: remedy.title,
                kind: Some(CodeActionKind::QuickFix),
                diagnostics: (!about.is_empty()).then_some(about),
                is_preferred: remedy.safe.then_some(true),
                edit: Some(edit(server, &remedy.edits)),
                ..CodeAction::default()
            };
            actions.push(action.into());
        }
    }
    if wanted(&CodeActionKind::SourceFixAll)
        && let Some(all) = ide::fix_all(workspace, id)
    {
        let action = CodeAction {
            title: "apply all safe fixes".to_owned(),
            kind: Some(CodeActionKind::SourceFixAll),
            edit: Some(edit(server, &[all])),
            ..CodeAction::default()
        };
        actions.push(action.into());
    }
    actions
}
