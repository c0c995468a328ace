//! A request goes in; its answer comes out, made of what `lang::ide` says.

use gen_lsp_types::{
    CallHierarchyIncomingCall, CallHierarchyIncomingCallsRequest, CallHierarchyOutgoingCall,
    CallHierarchyOutgoingCallsRequest, CallHierarchyPrepareRequest, CodeAction, CodeActionKind,
    CodeActionRequest, CodeActionResponse, CodeLensRequest, CompletionRequest, DeclarationRequest,
    Definition, DefinitionRequest, DocumentDiagnosticReport, DocumentDiagnosticRequest,
    DocumentFormattingRequest, DocumentHighlight, DocumentHighlightRequest,
    DocumentRangeFormattingRequest, DocumentSymbolRequest, FoldingRangeRequest,
    FullDocumentDiagnosticReport, Hover, HoverRequest, ImplementationRequest, InlayHintRequest,
    Location, MarkupContent, MarkupKind, Position, PrepareRenameRequest, ReferencesRequest,
    RelatedFullDocumentDiagnosticReport, RenameRequest, Request as Protocol, SelectionRangeRequest,
    SemanticTokens, SemanticTokensRequest, SignatureHelpRequest, TextDocumentPositionParams,
    TextEdit, TypeDefinitionRequest, TypeHierarchyItem, TypeHierarchyPrepareRequest,
    TypeHierarchySubtypesRequest, TypeHierarchySupertypesRequest, Uri, WorkspaceEdit,
    WorkspaceSymbolRequest,
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
    let part = method.split_once('/').map_or("", |(part, _)| part);
    let found = match part {
        "textDocument" => match about_name(server, &method, &params) {
            None => about_text(server, &method, params),
            found => found,
        },
        _ => about_others(server, &method, params),
    };
    let unknown = || Err((ErrorCode::MethodNotFound, format!("there is no method `{method}`")));
    found.unwrap_or_else(unknown)
}

type Answer = Option<Result<Value, Trouble>>;

/// Requests about what stands at a place.
fn about_name(server: &mut Server, method: &str, params: &Value) -> Answer {
    let params = || params.clone();
    Some(match method {
        "textDocument/hover" => with::<HoverRequest>(server, params(), |server, asked| {
            Ok(hover(server, &asked.text_document_position_params))
        }),
        "textDocument/definition" => {
            with::<DefinitionRequest>(server, params(), |server, asked| {
                let found = places(server, &asked.text_document_position_params, ide::definition);
                Ok(found.map(|found| Definition::LocationList(found).into()))
            })
        }
        "textDocument/declaration" => {
            with::<DeclarationRequest>(server, params(), |server, asked| {
                let found = places(server, &asked.text_document_position_params, ide::definition);
                Ok(found.map(|found| gen_lsp_types::Declaration::LocationList(found).into()))
            })
        }
        "textDocument/typeDefinition" => {
            with::<TypeDefinitionRequest>(server, params(), |server, asked| {
                let found = places(server, &asked.text_document_position_params, ide::typed_as);
                Ok(found.map(|found| Definition::LocationList(found).into()))
            })
        }
        "textDocument/implementation" => {
            with::<ImplementationRequest>(server, params(), |server, asked| {
                let found = places(server, &asked.text_document_position_params, ide::achievers);
                Ok(found.map(|found| Definition::LocationList(found).into()))
            })
        }
        "textDocument/references" => {
            with::<ReferencesRequest>(server, params(), |server, asked| {
                let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                    return Ok(None);
                };
                server.folder.load_all(id);
                let declaration = asked.context.include_declaration;
                let found = ide::references(&server.folder.workspace, id, at, declaration);
                Ok(Some(locations(server, found)))
            })
        }
        "textDocument/documentHighlight" => {
            with::<DocumentHighlightRequest>(server, params(), |server, asked| {
                Ok(highlights(server, &asked.text_document_position_params))
            })
        }
        "textDocument/prepareRename" => {
            with::<PrepareRenameRequest>(server, params(), |server, asked| {
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
        "textDocument/rename" => with::<RenameRequest>(server, params(), |server, asked| {
            let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                return Ok(None);
            };
            server.folder.load_all(id);
            let edits = ide::rename(&server.folder.workspace, id, at, &asked.new_name);
            Ok(Some(edit(server, &edits.map_err(refused)?)))
        }),
        "textDocument/completion" => {
            with::<CompletionRequest>(server, params(), |server, asked| {
                let found = place(server, &asked.text_document_position_params);
                Ok(found.map(|(id, at)| {
                    let found = ide::complete(&server.folder.workspace, id, at);
                    convert::completions(&server.folder, found, server.client.snippets).into()
                }))
            })
        }
        "textDocument/signatureHelp" => {
            with::<SignatureHelpRequest>(server, params(), |server, asked| {
                let found = place(server, &asked.text_document_position_params);
                let found =
                    found.and_then(|(id, at)| ide::signature(&server.folder.workspace, id, at));
                let encoding = server.client.encoding;
                Ok(found.map(|found| convert::signature(found, |text| encoding.units(text))))
            })
        }
        "textDocument/prepareCallHierarchy" => {
            with::<CallHierarchyPrepareRequest>(server, params(), |server, asked| {
                let found = place(server, &asked.text_document_position_params);
                let found =
                    found.and_then(|(id, at)| ide::caller(&server.folder.workspace, id, at));
                Ok(found.map(|found| vec![convert::caller(&server.folder, &found)]))
            })
        }
        "textDocument/prepareTypeHierarchy" => {
            with::<TypeHierarchyPrepareRequest>(server, params(), |server, asked| {
                let Some((id, at)) = place(server, &asked.text_document_position_params) else {
                    return Ok(None);
                };
                let found = ide::type_at(&server.folder.workspace, id, at);
                Ok(found.map(|span| vec![convert::type_item(&server.folder, span)]))
            })
        }
        _ => return None,
    })
}

/// Requests about a whole text or a part of it.
fn about_text(server: &mut Server, method: &str, params: Value) -> Answer {
    Some(match method {
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
        "textDocument/documentSymbol" => {
            with::<DocumentSymbolRequest>(server, params, |server, asked| {
                let Some(id) = server.folder.id(&asked.text_document.uri) else { return Ok(None) };
                let found = ide::outline(&server.folder.workspace, id);
                Ok(Some(if server.client.nested_symbols {
                    convert::symbols(&server.folder, &found).into()
                } else {
                    convert::flat_symbols(&server.folder, &found).into()
                }))
            })
        }
        "textDocument/semanticTokens/full" => {
            with::<SemanticTokensRequest>(server, params, |server, asked| {
                let id = server.folder.id(&asked.text_document.uri);
                Ok(id.map(|id| {
                    let words = ide::paint(&server.folder.workspace, id);
                    let data = convert::tokens(&server.folder, &words);
                    SemanticTokens { result_id: None, data }
                }))
            })
        }
        "textDocument/foldingRange" => {
            with::<FoldingRangeRequest>(server, params, |server, asked| {
                let id = server.folder.id(&asked.text_document.uri);
                let found = id.map(|id| ide::folds(&server.folder.workspace, id));
                Ok(found.map(|found| convert::folds(&server.folder, &found)))
            })
        }
        "textDocument/selectionRange" => {
            with::<SelectionRangeRequest>(server, params, |server, asked| {
                let Some(id) = server.folder.id(&asked.text_document.uri) else { return Ok(None) };
                let around = |position: Position| {
                    let at = server.folder.offset(id, position);
                    let found = ide::selections(&server.folder.workspace, id, at);
                    convert::selection(&server.folder, &found)
                };
                Ok(Some(asked.positions.into_iter().map(around).collect()))
            })
        }
        "textDocument/inlayHint" => with::<InlayHintRequest>(server, params, |server, asked| {
            let Some(id) = server.folder.id(&asked.text_document.uri) else { return Ok(None) };
            let within = server.folder.span(id, asked.range);
            let arguments = server.client.argument_hints;
            let found = ide::hints(&server.folder.workspace, within, arguments).into_iter();
            Ok(Some(found.map(|hint| convert::hint(&server.folder, id, &hint)).collect()))
        }),
        "textDocument/codeLens" => with::<CodeLensRequest>(server, params, |server, asked| {
            let Some(id) = server.folder.id(&asked.text_document.uri) else { return Ok(None) };
            let found = ide::lenses(&server.folder.workspace, id);
            Ok(Some(found.iter().map(|lens| convert::lens(&server.folder, lens)).collect()))
        }),
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
        _ => return None,
    })
}

/// Requests about the folder, and about what an answer named before.
fn about_others(server: &mut Server, method: &str, params: Value) -> Answer {
    Some(match method {
        "workspace/symbol" => with::<WorkspaceSymbolRequest>(server, params, |server, asked| {
            server.folder.load_roots();
            let found = ide::search(&server.folder.workspace, &asked.query);
            let folder = &server.folder;
            let shown = found.iter().map(|one| convert::workspace_symbol(folder, one));
            Ok(Some(shown.collect::<Vec<_>>().into()))
        }),
        "callHierarchy/incomingCalls" => {
            with::<CallHierarchyIncomingCallsRequest>(server, params, |server, asked| {
                let item = &asked.item;
                let found = calls(server, &item.uri, item.selection_range.start, ide::incoming);
                let call = |(from, from_ranges)| CallHierarchyIncomingCall { from, from_ranges };
                Ok(found.map(|found| found.into_iter().map(call).collect()))
            })
        }
        "callHierarchy/outgoingCalls" => {
            with::<CallHierarchyOutgoingCallsRequest>(server, params, |server, asked| {
                let item = &asked.item;
                let found = calls(server, &item.uri, item.selection_range.start, ide::outgoing);
                let call = |(to, from_ranges)| CallHierarchyOutgoingCall { to, from_ranges };
                Ok(found.map(|found| found.into_iter().map(call).collect()))
            })
        }
        "typeHierarchy/supertypes" => {
            with::<TypeHierarchySupertypesRequest>(server, params, |server, asked| {
                Ok(types(server, &asked.item, ide::above))
            })
        }
        "typeHierarchy/subtypes" => {
            with::<TypeHierarchySubtypesRequest>(server, params, |server, asked| {
                Ok(types(server, &asked.item, ide::below))
            })
        }
        _ => return None,
    })
}

/// Where something is that is connected with the name at a place.
fn places(
    server: &Server,
    asked: &TextDocumentPositionParams,
    find: impl Fn(&ide::Workspace, SourceId, u32) -> Vec<Span>,
) -> Option<Vec<Location>> {
    let (id, at) = place(server, asked)?;
    Some(locations(server, find(&server.folder.workspace, id, at)))
}

/// What is connected with an item of an earlier answer, and where.
fn calls(
    server: &Server,
    uri: &Uri,
    position: Position,
    find: impl Fn(&ide::Workspace, &ide::Caller) -> Vec<ide::Call>,
) -> Option<Vec<(gen_lsp_types::CallHierarchyItem, Vec<gen_lsp_types::Range>)>> {
    let folder = &server.folder;
    let id = folder.id(uri)?;
    let of = ide::caller(&folder.workspace, id, folder.offset(id, position))?;
    let shown = find(&folder.workspace, &of).into_iter().map(|call| {
        let ranges = call.places.iter().map(|&span| folder.range(span)).collect();
        (convert::caller(folder, &call.other), ranges)
    });
    Some(shown.collect())
}

/// The types around an item of an earlier answer.
fn types(
    server: &Server,
    item: &TypeHierarchyItem,
    find: impl Fn(&ide::Workspace, SourceId, u32) -> Vec<Span>,
) -> Option<Vec<TypeHierarchyItem>> {
    let folder = &server.folder;
    let id = folder.id(&item.uri)?;
    let found = find(&folder.workspace, id, folder.offset(id, item.selection_range.start));
    Some(found.into_iter().map(|span| convert::type_item(folder, span)).collect())
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
