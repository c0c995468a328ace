//! What `lang::ide` says goes in, what the protocol calls it comes out.

use std::collections::{BTreeMap, HashMap};

use gen_lsp_types::{
    DocumentChange, DocumentHighlightKind, Edit, Location, OptionalVersionedTextDocumentIdentifier,
    TextDocumentEdit, TextDocumentIdentifier, TextEdit, WorkspaceEdit,
};
use lang::source::{SourceId, Span};
use lang::symbol::Role;

use super::folder::Folder;

/// A place in some text.
pub fn location(folder: &Folder, span: Span) -> Location {
    Location { uri: folder.uri(span.source), range: folder.range(span) }
}

/// A range and what to put there.
pub fn edit(folder: &Folder, (span, new): &(Span, String)) -> TextEdit {
    TextEdit { range: folder.range(*span), new_text: new.clone() }
}

/// Edits in any texts; with the versions of those that are open, if the client knows what that means.
pub fn workspace_edit(folder: &Folder, edits: &[(Span, String)], versions: bool) -> WorkspaceEdit {
    let mut texts: BTreeMap<SourceId, Vec<TextEdit>> = BTreeMap::new();
    for one in edits {
        texts.entry(one.0.source).or_default().push(edit(folder, one));
    }
    if versions {
        let changes = texts.into_iter().map(|(id, edits)| {
            let text_document = OptionalVersionedTextDocumentIdentifier {
                text_document_identifier: TextDocumentIdentifier { uri: folder.uri(id) },
                version: folder.version(id),
            };
            let edits = edits.into_iter().map(Edit::from).collect();
            DocumentChange::from(TextDocumentEdit { text_document, edits })
        });
        return WorkspaceEdit {
            document_changes: Some(changes.collect()),
            ..WorkspaceEdit::default()
        };
    }
    let changes: HashMap<_, _> =
        texts.into_iter().map(|(id, edits)| (folder.uri(id), edits)).collect();
    WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }
}

/// Whether a name is read or written.
pub fn highlight(role: Role) -> DocumentHighlightKind {
    match role {
        Role::Read => DocumentHighlightKind::Read,
        Role::Declare => DocumentHighlightKind::Text,
        Role::Add | Role::Delete | Role::Write | Role::Initial => DocumentHighlightKind::Write,
    }
}
