//! What `lang::ide` says goes in, what the protocol calls it comes out.

use std::collections::{BTreeMap, HashMap};

use gen_lsp_types::{
    BaseSymbolInformation, CallHierarchyItem, CodeLens, Command, CompletionItem,
    CompletionItemKind, CompletionList, DocumentChange, DocumentHighlightKind, DocumentSymbol,
    Edit, FoldingRange, FoldingRangeKind, InlayHint, InlayHintKind, InsertTextFormat, Location,
    OptionalVersionedTextDocumentIdentifier, ParameterInformation, Range, SelectionRange,
    SemanticToken, SemanticTokensLegend, SignatureHelp, SignatureInformation, SymbolInformation,
    SymbolKind, TextDocumentEdit, TextDocumentIdentifier, TextEdit, TypeHierarchyItem,
    WorkspaceEdit, WorkspaceSymbol,
};
use lang::ide::{
    Caller, Completions, Entry, Fold, FoldKind, Found, Hint, Item, Lens, Paint, Painted, Signature,
};
use lang::source::{SourceId, Span};
use lang::symbol::{Namespace, Role};

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

/// What the editor shows beside a declared name.
fn symbol_kind(namespace: Option<Namespace>) -> SymbolKind {
    match namespace {
        None => SymbolKind::Struct,
        Some(kind) => match kind {
            Namespace::Domain | Namespace::Problem => SymbolKind::Module,
            Namespace::Type => SymbolKind::Class,
            Namespace::Predicate | Namespace::Function => SymbolKind::Function,
            Namespace::Object => SymbolKind::EnumMember,
            Namespace::Action | Namespace::Task | Namespace::Method => SymbolKind::Method,
            Namespace::Variable => SymbolKind::Variable,
            Namespace::Subtask | Namespace::Preference | Namespace::Constraint => SymbolKind::Key,
        },
    }
}

/// The outline of a text; it is three levels deep.
pub fn symbols(folder: &Folder, entries: &[Entry]) -> Vec<DocumentSymbol> {
    let symbol = |entry: &Entry| {
        let children = symbols(folder, &entry.children);
        #[expect(deprecated, reason = "the field has to be given")]
        DocumentSymbol {
            name: entry.name.clone(),
            detail: (!entry.detail.is_empty()).then(|| entry.detail.clone()),
            kind: symbol_kind(entry.namespace),
            tags: None,
            deprecated: None,
            range: folder.range(entry.span),
            selection_range: folder.range(entry.name_span),
            children: (!children.is_empty()).then_some(children),
        }
    };
    entries.iter().map(symbol).collect()
}

/// The same as a list, for clients that know nothing else.
pub fn flat_symbols(folder: &Folder, entries: &[Entry]) -> Vec<SymbolInformation> {
    let mut found = Vec::new();
    let mut waiting: Vec<(&Entry, Option<&str>)> =
        entries.iter().rev().map(|entry| (entry, None)).collect();
    while let Some((entry, container)) = waiting.pop() {
        found.push(information(
            (&entry.name, container),
            symbol_kind(entry.namespace),
            location(folder, entry.span),
        ));
        let children = entry.children.iter().rev();
        waiting.extend(children.map(|child| (child, Some(entry.name.as_str()))));
    }
    found
}

fn information(
    (name, container): (&str, Option<&str>),
    kind: SymbolKind,
    location: Location,
) -> SymbolInformation {
    #[expect(deprecated, reason = "the field has to be given")]
    SymbolInformation {
        deprecated: None,
        location,
        base_symbol_information: base(name, kind, container),
    }
}

fn base(name: &str, kind: SymbolKind, container: Option<&str>) -> BaseSymbolInformation {
    BaseSymbolInformation {
        name: name.to_owned(),
        kind,
        tags: None,
        container_name: container.map(str::to_owned),
    }
}

/// A declared name somewhere in the folder.
pub fn workspace_symbol(folder: &Folder, found: &Found) -> WorkspaceSymbol {
    let kind = symbol_kind(Some(found.namespace));
    WorkspaceSymbol {
        location: location(folder, found.span).into(),
        data: None,
        base_symbol_information: base(&found.name, kind, Some(&found.container)),
    }
}

/// What is being applied at the cursor. `units` counts what the client counts in a piece of the label.
pub fn signature(found: Signature, units: impl Fn(&str) -> u32) -> SignatureHelp {
    let at = |byte: u32| units(&found.label[..byte as usize]);
    let parameters = found.parameters.iter().map(|&(start, end)| ParameterInformation {
        label: (at(start), at(end)).into(),
        documentation: None,
    });
    SignatureHelp {
        signatures: vec![SignatureInformation {
            parameters: Some(parameters.collect()),
            label: found.label,
            documentation: None,
            active_parameter: None,
        }],
        active_signature: Some(0),
        active_parameter: Some(found.active.into()),
    }
}

/// What may be written at the cursor, with places to fill in if the client knows them.
pub fn completions(folder: &Folder, found: Completions, snippets: bool) -> CompletionList {
    let range = folder.range(found.word);
    let items = found.list.into_iter().enumerate().map(|(at, one)| {
        let kind = match one.item {
            Item::Keyword => CompletionItemKind::Keyword,
            Item::Predicate | Item::Function => CompletionItemKind::Function,
            Item::Type => CompletionItemKind::Class,
            Item::Variable => CompletionItemKind::Variable,
            Item::Object => CompletionItemKind::EnumMember,
            Item::Action => CompletionItemKind::Method,
            Item::Domain => CompletionItemKind::Module,
        };
        let snippet = one.snippet.filter(|_| snippets);
        let format = snippet.is_some().then_some(InsertTextFormat::Snippet);
        CompletionItem {
            filter_text: (one.text != one.label).then(|| one.label.clone()),
            label: one.label,
            kind: Some(kind),
            detail: (!one.detail.is_empty()).then_some(one.detail),
            // They come in the order in which to show them.
            sort_text: Some(format!("{at:04}")),
            insert_text_format: format,
            text_edit: Some(TextEdit { range, new_text: snippet.unwrap_or(one.text) }.into()),
            ..CompletionItem::default()
        }
    });
    CompletionList {
        is_incomplete: found.more,
        items: items.collect(),
        ..CompletionList::default()
    }
}

/// The names of kinds of words, in the order of their numbers.
const KINDS: [&str; 10] = [
    "keyword",
    "type",
    "function",
    "variable",
    "parameter",
    "enumMember",
    "method",
    "namespace",
    "number",
    "operator",
];

/// The number of comments, which follows.
const COMMENT: u32 = KINDS.len() as u32;

/// What the numbers in [`tokens`] mean.
pub fn legend() -> SemanticTokensLegend {
    let kinds = KINDS.into_iter().chain(["comment"]);
    let modifiers = ["declaration", "modification"];
    SemanticTokensLegend {
        token_types: kinds.map(str::to_owned).collect(),
        token_modifiers: modifiers.map(str::to_owned).to_vec(),
    }
}

/// The words of a text as numbers, each relative to the one before.
pub fn tokens(folder: &Folder, words: &[Painted]) -> Vec<SemanticToken> {
    let (mut line, mut column) = (0, 0);
    let mut tokens = Vec::with_capacity(words.len());
    for word in words {
        let Range { start, end } = folder.range(word.span);
        // To a client a lone carriage return in a comment is a line end.
        if start.line != end.line {
            continue;
        }
        let kind = match word.paint {
            Paint::Keyword => 0,
            Paint::Type => 1,
            Paint::Predicate | Paint::Function => 2,
            Paint::Variable => 3,
            Paint::Parameter => 4,
            Paint::Object => 5,
            Paint::Action => 6,
            Paint::Name => 7,
            Paint::Number => 8,
            Paint::Operator => 9,
            Paint::Comment => COMMENT,
        };
        let before = if start.line == line { column } else { 0 };
        tokens.push(SemanticToken {
            delta_line: start.line - line,
            delta_start: start.character - before,
            length: end.character - start.character,
            token_type: kind,
            token_modifiers_bitset: u32::from(word.declares) | u32::from(word.changes) << 1,
        });
        (line, column) = (start.line, start.character);
    }
    tokens
}

/// What can be folded; of several that start on a line the largest.
pub fn folds(folder: &Folder, folds: &[Fold]) -> Vec<FoldingRange> {
    let mut found: BTreeMap<u32, FoldingRange> = BTreeMap::new();
    for fold in folds {
        let Range { start, end } = folder.range(fold.span);
        let kind = match fold.kind {
            FoldKind::List => None,
            FoldKind::Comment => Some(FoldingRangeKind::Comment),
            FoldKind::Region => Some(FoldingRangeKind::Region),
        };
        let range = FoldingRange {
            start_line: start.line,
            end_line: end.line,
            kind,
            ..FoldingRange::default()
        };
        let there = found.entry(start.line).or_insert_with(|| range.clone());
        if there.end_line < range.end_line {
            *there = range;
        }
    }
    found.into_values().collect()
}

/// So many levels are told of what encloses a place: more than that, and clients cannot read the answer.
const LEVELS: usize = 60;

/// What encloses a place, from the inside to the outside.
pub fn selection(folder: &Folder, spans: &[Span]) -> SelectionRange {
    let skipped = spans.len().saturating_sub(LEVELS).min(spans.len().saturating_sub(1));
    let kept = spans.len() - skipped - 1;
    let told = spans[..kept].iter().chain(spans.last());
    let mut outer: Option<Box<SelectionRange>> = None;
    for &span in told.rev() {
        outer = Some(Box::new(SelectionRange { range: folder.range(span), parent: outer }));
    }
    outer.map_or_else(SelectionRange::default, |range| *range)
}

/// Something small between the words.
pub fn hint(folder: &Folder, id: SourceId, hint: &Hint) -> InlayHint {
    let typed = hint.label.starts_with(' ');
    InlayHint {
        position: folder.position(id, hint.offset),
        label: hint.label.trim_start().to_owned().into(),
        kind: if hint.parameter {
            Some(InlayHintKind::Parameter)
        } else {
            typed.then_some(InlayHintKind::Type)
        },
        text_edits: None,
        tooltip: None,
        padding_left: (!hint.parameter).then_some(true),
        padding_right: hint.parameter.then_some(true),
        data: None,
    }
}

/// A line above a declaration, which does nothing when it is clicked.
pub fn lens(folder: &Folder, lens: &Lens) -> CodeLens {
    CodeLens {
        range: folder.range(lens.span),
        command: Some(Command { title: lens.title.clone(), ..Command::default() }),
        data: None,
    }
}

/// A predicate, an action or a rule in a chain of them.
pub fn caller(folder: &Folder, caller: &Caller) -> CallHierarchyItem {
    CallHierarchyItem {
        name: caller.name.clone(),
        kind: if caller.acts { SymbolKind::Method } else { SymbolKind::Function },
        tags: None,
        detail: Some(caller.kind.clone()),
        uri: folder.uri(caller.span.source),
        range: folder.range(caller.span),
        selection_range: folder.range(caller.place),
        data: None,
    }
}

/// A type among others.
pub fn type_item(folder: &Folder, span: Span) -> TypeHierarchyItem {
    let range = folder.range(span);
    TypeHierarchyItem {
        name: folder.workspace.sources().text(span).to_owned(),
        kind: SymbolKind::Class,
        tags: None,
        detail: None,
        uri: folder.uri(span.source),
        range,
        selection_range: range,
        data: None,
    }
}
