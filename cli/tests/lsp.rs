//! The language server as an editor meets it: messages go in on its input, answers are read from its output.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

const DOMAIN: &str = "(define (domain kitchen)
  (:requirements :typing)
  (:types cup place)
  (:predicates
    (at ?c - cup ?p - place) ; where a cup stands
    (clean ?c - cup))
  (:action wash
    :parameters (?c - cup ?p - place)
    :precondition (at ?c ?p)
    :effect (clean ?c)))
";

const PROBLEM: &str = "(define (problem breakfast)
  (:domain kitchen)
  (:objects mug - cup shelf - place)
  (:init (at mug shelf))
  (:goal (clean mug)))
";

/// An editor with a folder of its own, and the server that it has started.
struct Editor {
    folder: TempDir,
    server: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    asked: i32,
    /// What was told without being asked for.
    told: Vec<Value>,
}

impl Editor {
    /// With a domain and a problem in its folder, neither of which is open.
    fn start() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        fs::write(folder.path().join("domain.pddl"), DOMAIN).expect("a file can be written");
        fs::write(folder.path().join("p01.pddl"), PROBLEM).expect("a file can be written");
        let mut server = Command::new(env!("CARGO_BIN_EXE_caveat"))
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program can be run");
        let input = server.stdin.take();
        let output = BufReader::new(server.stdout.take().expect("it is piped"));
        Self { folder, server, input, output, asked: 0, told: Vec::new() }
    }

    /// Started and greeted, with columns that count as one of these encodings.
    fn with(encodings: &[&str]) -> Self {
        let mut editor = Self::start();
        let answer = editor.ask(
            "initialize",
            json!({
                "processId": null,
                "rootUri": editor.uri(""),
                "capabilities": {
                    "general": { "positionEncodings": encodings },
                    "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } },
                },
            }),
        );
        let agreed = &answer["capabilities"]["positionEncoding"];
        assert_eq!(agreed, encodings.first().unwrap_or(&"utf-16"));
        editor.tell("initialized", json!({}));
        editor
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}", self.path(name).display())
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        let input = self.input.as_mut().expect("it has not been closed");
        write!(input, "Content-Length: {}\r\n\r\n{text}", text.len()).expect("the server reads");
        input.flush().expect("the server reads");
    }

    fn tell(&mut self, method: &str, parameters: impl Into<Value>) {
        let message = json!({ "jsonrpc": "2.0", "method": method, "params": parameters.into() });
        self.send(&message);
    }

    /// The next message of the server.
    fn read(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.output.read_line(&mut line).expect("the server writes text");
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().expect("a number"),
                Some(_) => {}
                None => break,
            }
        }
        assert_ne!(length, 0, "the server has ended");
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).expect("the server writes what it announces");
        serde_json::from_slice(&text).expect("messages are JSON")
    }

    /// The whole answer to a request.
    fn answer(&mut self, method: &str, parameters: impl Into<Value>) -> Value {
        self.asked += 1;
        let (id, parameters) = (self.asked, parameters.into());
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": parameters }));
        loop {
            let message = self.read();
            if message["id"] == id {
                return message;
            }
            self.told.push(message);
        }
    }

    /// What a request results in.
    fn ask(&mut self, method: &str, parameters: impl Into<Value>) -> Value {
        let answer = self.answer(method, parameters);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// What a request about a place results in.
    fn at(&mut self, method: &str, name: &str, line: u32, character: u32) -> Value {
        let parameters = self.place(name, line, character);
        self.ask(method, parameters)
    }

    fn place(&self, name: &str, line: u32, character: u32) -> Value {
        json!({
            "textDocument": { "uri": self.uri(name) },
            "position": { "line": line, "character": character },
        })
    }

    fn open(&mut self, name: &str) {
        let text = fs::read_to_string(self.path(name)).expect("the file is there");
        let document =
            json!({ "uri": self.uri(name), "languageId": "pddl", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Puts `text` in the place of a part of one line.
    fn change(&mut self, name: &str, version: i32, (line, from, to): (u32, u32, u32), text: &str) {
        let range = json!({
            "start": { "line": line, "character": from },
            "end": { "line": line, "character": to },
        });
        self.tell(
            "textDocument/didChange",
            json!({
                "textDocument": { "uri": self.uri(name), "version": version },
                "contentChanges": [{ "range": range, "text": text }],
            }),
        );
    }

    /// What is told of a version of a document.
    fn diagnostics(&mut self, name: &str, version: i32) -> Vec<Value> {
        let uri = self.uri(name);
        let about = |message: &Value| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri.as_str()
                && message["params"]["version"] == version
        };
        let message = match self.told.iter().position(about) {
            Some(at) => self.told.remove(at),
            None => loop {
                let message = self.read();
                if about(&message) {
                    break message;
                }
                self.told.push(message);
            },
        };
        message["params"]["diagnostics"].as_array().expect("a list").clone()
    }

    /// The exit code after the input has ended.
    fn code(mut self) -> Option<i32> {
        self.input = None;
        let mut rest = Vec::new();
        self.output.read_to_end(&mut rest).expect("the server writes until it ends");
        self.server.wait().expect("the server ends").code()
    }

    fn end(mut self) {
        assert_eq!(self.ask("shutdown", Value::Null), Value::Null);
        self.tell("exit", Value::Null);
        assert_eq!(self.code(), Some(0));
    }
}

fn codes(diagnostics: &[Value]) -> Vec<&str> {
    diagnostics.iter().filter_map(|one| one["code"].as_str()).collect()
}

/// A range as four numbers.
fn range(value: &Value) -> [u64; 4] {
    let number = |end: &str, part: &str| value[end][part].as_u64().expect("a number");
    [
        number("start", "line"),
        number("start", "character"),
        number("end", "line"),
        number("end", "character"),
    ]
}

#[test]
fn a_session() {
    let mut editor = Editor::with(&["utf-16"]);
    editor.open("domain.pddl");
    assert_eq!(editor.diagnostics("domain.pddl", 1), Vec::<Value>::new());

    // A comment of wide letters, and a mistake behind it on the same line as more letters.
    editor.change("domain.pddl", 2, (0, 0, 0), "; Küche 🍵\n");
    editor.change("domain.pddl", 3, (10, 12, 22), "#|🍵 ä|# (claen ?c)");
    let found = editor.diagnostics("domain.pddl", 3);
    let unknown = found.iter().find(|one| one["code"] == "E0101").expect("it is unknown");
    assert_eq!(range(&unknown["range"]), [10, 22, 10, 27]);
    editor.change("domain.pddl", 4, (10, 12, 21), "");
    let found = editor.diagnostics("domain.pddl", 4);
    assert_eq!(codes(&found), ["E0101"]);
    assert_eq!(range(&found[0]["range"]), [10, 13, 10, 18]);
    assert_eq!(found[0]["data"]["name"], "unknown-predicate");

    let actions = editor.ask(
        "textDocument/codeAction",
        json!({
            "textDocument": { "uri": editor.uri("domain.pddl") },
            "range": found[0]["range"],
            "context": { "diagnostics": found },
        }),
    );
    assert_eq!(actions[0]["title"], "replace with `clean`");
    let edit = &actions[0]["edit"]["changes"][editor.uri("domain.pddl")][0];
    assert_eq!((range(&edit["range"]), &edit["newText"]), ([10, 13, 10, 18], &json!("clean")));
    editor.change("domain.pddl", 5, (10, 13, 18), "clean");
    assert_eq!(editor.diagnostics("domain.pddl", 5), Vec::<Value>::new());

    let hover = editor.at("textDocument/hover", "domain.pddl", 9, 20);
    let text = hover["contents"]["value"].as_str().expect("Markdown");
    assert!(text.contains("(at ?c - cup ?p - place)"), "{text}");
    assert!(text.contains("where a cup stands") && text.contains("read by `wash`"), "{text}");

    // The problem is not open.
    let edit = editor.ask(
        "textDocument/rename",
        json!({
            "textDocument": { "uri": editor.uri("domain.pddl") },
            "position": { "line": 6, "character": 6 },
            "newName": "tidy",
        }),
    );
    let changes = edit["changes"].as_object().expect("edits by file");
    assert_eq!(changes[&editor.uri("domain.pddl")].as_array().map(Vec::len), Some(2));
    assert_eq!(range(&changes[&editor.uri("p01.pddl")][0]["range"]), [4, 10, 4, 15]);

    let refused = editor.answer(
        "textDocument/rename",
        json!({
            "textDocument": { "uri": editor.uri("domain.pddl") },
            "position": { "line": 6, "character": 6 },
            "newName": "at",
        }),
    );
    let message = refused["error"]["message"].as_str().expect("a reason");
    assert!(message.starts_with("there is another predicate `at`"), "{message}");

    editor.open("p01.pddl");
    assert_eq!(editor.diagnostics("p01.pddl", 1), Vec::<Value>::new());
    let found = editor.at("textDocument/definition", "p01.pddl", 4, 12);
    assert_eq!(found[0]["uri"], editor.uri("domain.pddl"));
    assert_eq!(range(&found[0]["range"]), [6, 5, 6, 10]);

    editor.change("p01.pddl", 2, (3, 13, 22), "mug ");
    let found = editor.at("textDocument/completion", "p01.pddl", 3, 17);
    assert_eq!(found["items"][0]["label"], "shelf");
    let found = editor.at("textDocument/signatureHelp", "p01.pddl", 3, 17);
    assert_eq!(
        (&found["activeParameter"], &found["signatures"][0]["label"]),
        (&json!(1), &json!("(at ?c - cup ?p - place)"))
    );

    editor.change("p01.pddl", 3, (1, 0, 2), "        ");
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let document = json!({ "uri": editor.uri("p01.pddl") });
    let edits = editor
        .ask("textDocument/formatting", json!({ "textDocument": document, "options": options }));
    assert_eq!(range(&edits[0]["range"]), [0, 27, 1, 8]);
    assert_eq!(edits[0]["newText"], "\n  ");
    editor.end();
}

#[test]
fn columns_may_count_bytes() {
    let mut editor = Editor::with(&["utf-8", "utf-16"]);
    editor.open("domain.pddl");
    editor.change("domain.pddl", 2, (9, 12, 22), "#|🍵 ä|# (clean ?c)");
    editor.change("domain.pddl", 3, (9, 25, 30), "clene");
    let found = editor.diagnostics("domain.pddl", 3);
    let unknown = found.iter().find(|one| one["code"] == "E0101").expect("it is unknown");
    assert_eq!(range(&unknown["range"]), [9, 25, 9, 30]);
    editor.end();
}

#[test]
fn a_domain_that_changes_changes_its_problems() {
    let mut editor = Editor::with(&[]);
    editor.open("p01.pddl");
    assert_eq!(editor.diagnostics("p01.pddl", 1), Vec::<Value>::new());
    editor.open("domain.pddl");
    editor.change("domain.pddl", 2, (5, 5, 10), "tidy");
    loop {
        // Of the first version more is told, as the domain changes.
        let found = editor.diagnostics("p01.pddl", 1);
        if codes(&found) == ["E0101"] {
            break;
        }
    }
    // On disk nothing has changed, and that counts when the domain is closed.
    let document = json!({ "uri": editor.uri("domain.pddl") });
    editor.tell("textDocument/didClose", json!({ "textDocument": document }));
    while !editor.diagnostics("p01.pddl", 1).is_empty() {}
    editor.end();
}

#[test]
fn plans_are_validated() {
    let mut editor = Editor::with(&[]);
    fs::write(editor.path("p01.plan"), "(wash mug shelf)\n").expect("a file can be written");
    editor.open("p01.plan");
    assert_eq!(editor.diagnostics("p01.plan", 1), Vec::<Value>::new());
    editor.change("p01.plan", 2, (0, 0, 16), "");
    assert_eq!(codes(&editor.diagnostics("p01.plan", 2)), ["E0721"]);
    editor.end();
}

#[test]
fn what_is_unknown_is_answered() {
    let mut editor = Editor::start();
    let early = editor.answer("textDocument/hover", json!({}));
    assert_eq!(early["error"]["code"], -32002);
    editor.ask("initialize", json!({ "processId": null, "rootUri": null, "capabilities": {} }));
    editor.tell("initialized", json!({}));
    let unknown = editor.answer("textDocument/fancy", json!({}));
    assert_eq!(unknown["error"]["code"], -32601);
    let wrong = editor.answer("textDocument/hover", json!({ "textDocument": 3 }));
    assert_eq!(wrong["error"]["code"], -32602);
    editor.tell("textDocument/fancied", json!({}));
    editor.tell("textDocument/didChange", json!({ "nothing": true }));
    for method in [
        "textDocument/hover",
        "textDocument/definition",
        "textDocument/completion",
        "textDocument/signatureHelp",
        "textDocument/prepareRename",
    ] {
        assert_eq!(editor.at(method, "nowhere.pddl", 3, 4), Value::Null, "{method}");
    }
    // Places that do not exist are the end of the line or of the text.
    editor.open("domain.pddl");
    editor.at("textDocument/hover", "domain.pddl", 999, 999);
    editor.change("domain.pddl", 2, (999, 0, 9), ")");
    assert_eq!(codes(&editor.diagnostics("domain.pddl", 2)), ["E0002"]);
    editor.end();
}

#[test]
fn it_ends_as_the_protocol_says() {
    let mut editor = Editor::with(&[]);
    editor.tell("exit", Value::Null);
    assert_eq!(editor.code(), Some(1));
    // An editor that is gone.
    let editor = Editor::with(&[]);
    assert_eq!(editor.code(), Some(1));
    let mut editor = Editor::with(&[]);
    editor.ask("shutdown", Value::Null);
    let late = editor.answer("textDocument/hover", json!({}));
    assert_eq!(late["error"]["code"], -32600);
    editor.tell("exit", Value::Null);
    assert_eq!(editor.code(), Some(0));
}

#[test]
fn every_prefix_of_a_text_can_be_asked_about() {
    let mut editor = Editor::with(&[]);
    editor.open("domain.pddl");
    let all = json!({ "textDocument": { "uri": editor.uri("domain.pddl") } });
    let whole = json!({
        "textDocument": { "uri": editor.uri("domain.pddl") },
        "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } },
        "context": { "diagnostics": [] },
    });
    for end in (0..DOMAIN.len()).step_by(7) {
        let text = &DOMAIN[..end];
        let (line, character) = (
            text.matches('\n').count() as u32,
            (end - text.rfind('\n').map_or(0, |at| at + 1)) as u32,
        );
        editor.tell(
            "textDocument/didChange",
            json!({
                "textDocument": { "uri": editor.uri("domain.pddl"), "version": end + 2 },
                "contentChanges": [{ "text": text }],
            }),
        );
        for method in ["completion", "hover", "signatureHelp", "documentHighlight", "definition"] {
            editor.at(&format!("textDocument/{method}"), "domain.pddl", line, character);
        }
        for method in ["documentSymbol", "semanticTokens/full", "foldingRange", "codeLens"] {
            editor.ask(&format!("textDocument/{method}"), all.clone());
        }
        for method in ["codeAction", "inlayHint"] {
            editor.ask(&format!("textDocument/{method}"), whole.clone());
        }
    }
    assert!(Path::new(&editor.path("domain.pddl")).is_file());
    editor.end();
}
