//! Messages go in, one after the other; each is answered, or changes what the server knows.

use std::collections::BTreeMap;
use std::path::PathBuf;

use gen_lsp_types::{
    Diagnostic, DidChangeTextDocumentParams, DidChangeWatchedFilesParams,
    DidChangeWorkspaceFoldersParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams,
    DidSaveTextDocumentParams, InitializeParams, InitializeResult, PublishDiagnosticsParams,
    ServerInfo, TextDocumentContentChangeEvent, Uri, VersionedTextDocumentIdentifier,
    WorkspaceFolders,
};
use lang::source::SourceId;
use lsp_server::{ErrorCode, Message, Notification, Request, Response};
use serde_json::{Value, json};

use super::capabilities::Client;
use super::folder::Folder;
use super::{address, answer, diagnose};
use crate::exit::Exit;
use crate::fault;

/// The stack of the thread on which a message is dealt with.
const STACK: usize = 64 << 20;

/// Everything the server knows.
pub struct Server {
    /// Sends a message to the client.
    out: Box<dyn Fn(Message) + Send>,
    phase: Phase,
    /// The texts.
    pub folder: Folder,
    /// Whom it serves.
    pub client: Client,
    /// What was said last of each document.
    said: BTreeMap<SourceId, Vec<Diagnostic>>,
    /// Whether something has changed since.
    stale: bool,
}

/// How far the conversation has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// The client has not said what it can do.
    Fresh,
    /// Documents come and go.
    Running,
    /// The client has asked for the end.
    Over,
}

impl Server {
    /// A server that knows nothing yet.
    pub fn new(out: impl Fn(Message) + Send + 'static) -> Self {
        Self {
            out: Box::new(out),
            phase: Phase::Fresh,
            folder: Folder::default(),
            client: Client::default(),
            said: BTreeMap::new(),
            stale: false,
        }
    }

    /// Sends a message.
    pub fn send(&self, message: impl Into<Message>) {
        (self.out)(message.into());
    }

    /// How the program ends if it ends now.
    pub fn exit(&self) -> Exit {
        if self.phase == Phase::Over { Exit::Done } else { Exit::Findings }
    }

    /// Deals with one message. A bug is told to the client, and the server goes on.
    pub fn take(&mut self, message: Message) {
        match message {
            Message::Request(request) => {
                let id = request.id.clone();
                let answer = fault::contain(STACK, || self.request(request));
                let answer = answer
                    .unwrap_or_else(|fault| Err((ErrorCode::InternalError, fault.to_string())));
                self.send(match answer {
                    Ok(value) => Response::new_ok(id, value),
                    Err((code, message)) => Response::new_err(id, code as i32, message),
                });
            }
            Message::Notification(notification) => {
                let done = fault::contain(STACK, || self.notification(notification));
                self.complain(done);
            }
            // The server asks only to be told of changes, and whether it is makes no difference here.
            Message::Response(_) => {}
        }
    }

    fn complain(&self, done: Result<(), fault::Fault>) {
        if let Err(fault) = done {
            let parameters = json!({ "type": 1, "message": fault.to_string() });
            self.send(Notification::new("window/logMessage".to_owned(), parameters));
        }
    }

    fn request(&mut self, request: Request) -> Result<Value, (ErrorCode, String)> {
        match (self.phase, request.method.as_str()) {
            (Phase::Fresh, "initialize") => {
                let parameters = serde_json::from_value(request.params)
                    .map_err(|error| (ErrorCode::InvalidParams, error.to_string()))?;
                Ok(self.initialize(&parameters))
            }
            (Phase::Fresh, _) => {
                let message = "`initialize` comes first".to_owned();
                Err((ErrorCode::ServerNotInitialized, message))
            }
            (Phase::Running, "initialize") => {
                let message = "`initialize` comes once".to_owned();
                Err((ErrorCode::InvalidRequest, message))
            }
            (Phase::Running, "shutdown") => {
                self.phase = Phase::Over;
                Ok(Value::Null)
            }
            (Phase::Running, _) => answer::answer(self, request),
            (Phase::Over, _) => {
                let message = "the server has been shut down".to_owned();
                Err((ErrorCode::InvalidRequest, message))
            }
        }
    }

    #[expect(deprecated, reason = "older clients name one folder only")]
    fn initialize(&mut self, parameters: &InitializeParams) -> Value {
        self.client = Client::new(parameters);
        self.folder.encoding = self.client.encoding;
        let folders = &parameters.workspace_folders_initialize_params.workspace_folders;
        let named: Vec<Uri> = match folders {
            Some(WorkspaceFolders::WorkspaceFolderList(folders)) => {
                folders.iter().map(|folder| folder.uri.clone()).collect()
            }
            _ => parameters.root_uri.iter().cloned().collect(),
        };
        self.folder.roots = roots(&named);
        self.phase = Phase::Running;
        let result = InitializeResult {
            capabilities: self.client.offer(),
            server_info: Some(ServerInfo {
                name: "caveat".to_owned(),
                version: Some(env!("CARGO_PKG_VERSION").to_owned()),
            }),
        };
        json!(result)
    }

    fn notification(&mut self, notification: Notification) {
        if self.phase != Phase::Running {
            return;
        }
        let Notification { method, params } = notification;
        match method.as_str() {
            "initialized" => self.watch(),
            "textDocument/didOpen" => {
                if let Some(DidOpenTextDocumentParams { text_document: one }) = read(params) {
                    self.folder.open(one.uri, one.version, one.text);
                }
            }
            "textDocument/didChange" => {
                if let Some(parameters) = read(params) {
                    self.change(parameters);
                }
            }
            "textDocument/didClose" => {
                let id = read(params).and_then(|parameters: DidCloseTextDocumentParams| {
                    self.folder.id(&parameters.text_document.uri)
                });
                if let Some(id) = id {
                    self.folder.close(id);
                }
            }
            "textDocument/didSave" => {
                if let Some(DidSaveTextDocumentParams { text_document, .. }) = read(params) {
                    self.folder.refresh(&[address::path(&text_document.uri)]);
                }
            }
            "workspace/didChangeWatchedFiles" => {
                if let Some(DidChangeWatchedFilesParams { changes }) = read(params) {
                    let paths: Vec<PathBuf> =
                        changes.iter().map(|change| address::path(&change.uri)).collect();
                    self.folder.refresh(&paths);
                }
            }
            "workspace/didChangeWorkspaceFolders" => {
                if let Some(DidChangeWorkspaceFoldersParams { event }) = read(params) {
                    let removed: Vec<Uri> = event.removed.into_iter().map(|one| one.uri).collect();
                    let added: Vec<Uri> = event.added.into_iter().map(|one| one.uri).collect();
                    let removed = roots(&removed);
                    self.folder.roots.retain(|root| !removed.contains(root));
                    self.folder.roots.extend(roots(&added));
                }
            }
            _ => return,
        }
        self.stale = true;
    }

    fn change(&mut self, parameters: DidChangeTextDocumentParams) {
        let VersionedTextDocumentIdentifier { version, text_document_identifier } =
            parameters.text_document;
        let Some(id) = self.folder.id(&text_document_identifier.uri) else { return };
        for change in parameters.content_changes {
            let (range, text) = match change {
                TextDocumentContentChangeEvent::TextDocumentContentChangePartial(part) => {
                    (Some(part.range), part.text)
                }
                TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(whole) => {
                    (None, whole.text)
                }
            };
            self.folder.change(id, version, range, text);
        }
    }

    /// Asks to be told of files that change outside the editor.
    fn watch(&mut self) {
        if !self.client.watches {
            return;
        }
        let watchers: Vec<Value> = ["**/*.{pddl,hddl,plan}", "**/sas_plan*"]
            .iter()
            .map(|pattern| json!({ "globPattern": pattern }))
            .collect();
        let registration = json!({
            "id": "files",
            "method": "workspace/didChangeWatchedFiles",
            "registerOptions": { "watchers": watchers },
        });
        let parameters = json!({ "registrations": [registration] });
        let id = "watch".to_owned().into();
        self.send(Request::new(id, "client/registerCapability".to_owned(), parameters));
    }

    /// Whether there may be something new to say.
    pub fn has_to_look(&self) -> bool {
        self.stale
    }

    /// Looks at the open texts, and says what has changed.
    pub fn look(&mut self) {
        self.stale = false;
        if self.client.pulls {
            return;
        }
        let folder = &mut self.folder;
        let look = move || {
            folder.refresh_partners();
            diagnose::all(folder)
        };
        match fault::contain(STACK, look) {
            Ok(found) => self.publish(found),
            Err(fault) => self.complain(Err(fault)),
        }
    }

    fn publish(&mut self, found: BTreeMap<SourceId, Vec<Diagnostic>>) {
        let mut before = std::mem::take(&mut self.said);
        for (id, diagnostics) in found {
            let uri = self.folder.uri(id);
            let version = self.folder.version(id);
            // An open document is told of every version that was looked at.
            if before.remove(&id).as_ref() != Some(&diagnostics) || version.is_some() {
                self.tell(&uri, version, diagnostics.clone());
            }
            self.said.insert(id, diagnostics);
        }
        for (id, diagnostics) in before {
            if !diagnostics.is_empty() {
                self.tell(&self.folder.uri(id), None, Vec::new());
            }
        }
    }

    fn tell(&self, uri: &Uri, version: Option<i32>, diagnostics: Vec<Diagnostic>) {
        let parameters = PublishDiagnosticsParams { uri: uri.clone(), version, diagnostics };
        let method = "textDocument/publishDiagnostics".to_owned();
        self.send(Notification::new(method, parameters));
    }
}

/// The folders at these addresses.
fn roots(uris: &[Uri]) -> Vec<PathBuf> {
    uris.iter().map(address::path).filter(|path| address::is_file(path)).collect()
}

/// The parameters of a notification; what cannot be read is left alone, since nobody waits for an answer.
fn read<T: serde::de::DeserializeOwned>(parameters: Value) -> Option<T> {
    serde_json::from_value(parameters).ok()
}
