//! What a client can do goes in; what this server offers it comes out.

use gen_lsp_types::{
    ClientCapabilities, CodeActionKind, CodeActionOptions, CodeLensOptions, CompletionOptions,
    DiagnosticOptions, InitializeParams, RenameOptions, SemanticTokensOptions, ServerCapabilities,
    SignatureHelpOptions, TextDocumentSyncKind, TextDocumentSyncOptions,
    WorkspaceFoldersServerCapabilities, WorkspaceOptions,
};
use serde_json::Value;

use super::convert;
use super::position::Encoding;

/// What matters of what a client can do and wants.
#[derive(Debug, Clone, Copy, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is something that the client can do or cannot"
)]
pub struct Client {
    /// What columns count.
    pub encoding: Encoding,
    /// Whether edits may name the versions of documents.
    pub versions: bool,
    /// Whether it tells of files that change if it is asked to.
    pub watches: bool,
    /// Whether it asks for diagnostics instead of being told.
    pub pulls: bool,
    /// Whether completions may have places to fill in.
    pub snippets: bool,
    /// Whether symbols may have symbols in them.
    pub nested_symbols: bool,
    /// Whether every argument gets the name of its parameter as a hint.
    pub argument_hints: bool,
}

impl Client {
    /// Reads what the client says of itself. Diagnostics are told unasked, unless its options have `"diagnostics": "pull"`.
    pub fn new(parameters: &InitializeParams) -> Self {
        let can: &ClientCapabilities = &parameters.capabilities;
        let general = can.general.as_ref();
        let encodings = general.and_then(|general| general.position_encodings.as_deref());
        let workspace = can.workspace.as_ref();
        let text = can.text_document.as_ref();
        let edits = workspace.and_then(|workspace| workspace.workspace_edit.as_ref());
        let watching = workspace.and_then(|workspace| workspace.did_change_watched_files.as_ref());
        let completion = text.and_then(|text| text.completion.as_ref());
        let item = completion.and_then(|completion| completion.completion_item.as_ref());
        let symbol = text.and_then(|text| text.document_symbol.as_ref());
        let option = |name: &str| parameters.initialization_options.as_ref()?.get(name).cloned();
        Self {
            encoding: Encoding::negotiate(encodings.unwrap_or_default()),
            versions: edits.and_then(|edits| edits.document_changes).unwrap_or(false),
            watches: watching.and_then(|watching| watching.dynamic_registration).unwrap_or(false),
            pulls: option("diagnostics") == Some(Value::from("pull")),
            snippets: item.and_then(|item| item.snippet_support).unwrap_or(false),
            nested_symbols: symbol
                .and_then(|symbol| symbol.hierarchical_document_symbol_support)
                .unwrap_or(false),
            argument_hints: option("argumentHints") == Some(Value::from(true)),
        }
    }

    /// What the server can do for it.
    pub fn offer(self) -> ServerCapabilities {
        ServerCapabilities {
            position_encoding: Some(self.encoding.kind()),
            text_document_sync: Some(
                TextDocumentSyncOptions {
                    open_close: Some(true),
                    change: Some(TextDocumentSyncKind::Incremental),
                    save: Some(true.into()),
                    ..TextDocumentSyncOptions::default()
                }
                .into(),
            ),
            hover_provider: Some(true.into()),
            definition_provider: Some(true.into()),
            references_provider: Some(true.into()),
            document_highlight_provider: Some(true.into()),
            document_formatting_provider: Some(true.into()),
            document_range_formatting_provider: Some(true.into()),
            rename_provider: Some(
                RenameOptions { prepare_provider: Some(true), ..RenameOptions::default() }.into(),
            ),
            code_action_provider: Some(
                CodeActionOptions {
                    code_action_kinds: Some(vec![
                        CodeActionKind::QuickFix,
                        CodeActionKind::SourceFixAll,
                    ]),
                    ..CodeActionOptions::default()
                }
                .into(),
            ),
            declaration_provider: Some(true.into()),
            type_definition_provider: Some(true.into()),
            implementation_provider: Some(true.into()),
            completion_provider: Some(CompletionOptions {
                trigger_characters: Some(["(", "?", ":", " "].map(str::to_owned).to_vec()),
                ..CompletionOptions::default()
            }),
            signature_help_provider: Some(SignatureHelpOptions {
                trigger_characters: Some(["(", " "].map(str::to_owned).to_vec()),
                ..SignatureHelpOptions::default()
            }),
            document_symbol_provider: Some(true.into()),
            workspace_symbol_provider: Some(true.into()),
            folding_range_provider: Some(true.into()),
            selection_range_provider: Some(true.into()),
            inlay_hint_provider: Some(true.into()),
            call_hierarchy_provider: Some(true.into()),
            type_hierarchy_provider: Some(true.into()),
            code_lens_provider: Some(CodeLensOptions::default()),
            semantic_tokens_provider: Some(
                SemanticTokensOptions {
                    legend: convert::legend(),
                    full: Some(true.into()),
                    ..SemanticTokensOptions::default()
                }
                .into(),
            ),
            diagnostic_provider: self.pulls.then(|| {
                DiagnosticOptions {
                    identifier: Some("caveat".to_owned()),
                    inter_file_dependencies: true,
                    workspace_diagnostics: false,
                    ..DiagnosticOptions::default()
                }
                .into()
            }),
            workspace: Some(WorkspaceOptions {
                workspace_folders: Some(WorkspaceFoldersServerCapabilities {
                    supported: Some(true),
                    change_notifications: Some(true.into()),
                }),
                ..WorkspaceOptions::default()
            }),
            ..ServerCapabilities::default()
        }
    }
}
