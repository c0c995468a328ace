//! A command line goes in; what the program prints and leaves in a folder of its own comes out.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use cli::exit::Exit;
use cli::terminal::Terminal;
use tempfile::TempDir;

/// A folder of its own. In a command line `domains/…` is what is shipped, and what is called like a file lies in the folder.
pub struct Desk {
    folder: TempDir,
}

/// What a run left.
pub struct Run {
    /// How it ended.
    pub exit: Exit,
    /// What was printed as data.
    pub data: String,
    /// What was said beside it.
    pub talk: String,
}

/// The endings of what lies in the folder.
const ENDINGS: [&str; 10] =
    [".pddl", ".plan", ".jsonl", ".json", ".csv", ".svg", ".trace", ".txt", ".bif", ".parquet"];

/// Folders within the folder.
const FOLDERS: [&str; 2] = ["lesson", "task"];

impl Desk {
    /// An empty folder.
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("there is room for a few files") }
    }

    /// A folder with these files.
    pub fn with(files: &[(&str, &str)]) -> Self {
        let desk = Self::new();
        for (name, text) in files {
            desk.write(name, text);
        }
        desk
    }

    /// Where a file of the folder lies.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The text of a file of the folder.
    #[track_caller]
    pub fn file(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Writes a file of the folder.
    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the folder can be written to");
    }

    /// Runs a command line in this process. Words in single quotes are one.
    pub fn run(&self, command: &str) -> Run {
        let root = domains::folder();
        let root = root.parent().expect("the domains lie in the repository");
        let place = |word: &str| -> String {
            let here = ENDINGS.iter().any(|end| word.ends_with(end)) || FOLDERS.contains(&word);
            match word {
                _ if word.starts_with("domains/") => root.join(word).display().to_string(),
                _ if here => self.path(word).display().to_string(),
                _ => word.to_owned(),
            }
        };
        let word = |word: &str| -> OsString {
            word.split(',').map(place).collect::<Vec<_>>().join(",").into()
        };
        let mut arguments: Vec<OsString> = Vec::new();
        for (number, part) in command.split('\'').enumerate() {
            if number % 2 == 1 {
                arguments.push(part.into());
            } else {
                arguments.extend(part.split_whitespace().map(word));
            }
        }
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let exit = cli::call(arguments, &mut Terminal::new(&mut out, &mut err));
        let text = |bytes: Vec<u8>| {
            let text = String::from_utf8(bytes).expect("the program prints UTF-8");
            let text = text.replace(&format!("{}/", self.folder.path().display()), "");
            untimed(&text.replace(&format!("{}/", root.display()), ""))
        };
        Run { exit, data: text(out), talk: text(err) }
    }

    /// What a run printed, if it ended so.
    #[track_caller]
    pub fn ends(&self, exit: Exit, command: &str) -> String {
        let run = self.run(command);
        assert_eq!(run.exit, exit, "{command}\n{}{}", run.data, run.talk);
        run.data + &run.talk
    }

    /// The same, with the command line above it.
    #[track_caller]
    pub fn shown(&self, exit: Exit, command: &str) -> String {
        let printed = self.ends(exit, command);
        format!("$ {command}\n{printed}[exit code {}]\n", exit.code())
    }

    /// What all these command lines print, whatever way they end, each below itself.
    pub fn told(&self, commands: impl IntoIterator<Item = String>) -> String {
        let one = |command: String| {
            let run = self.run(&command);
            format!("$ {command}\n{}{}[exit code {}]\n\n", run.data, run.talk, run.exit.code())
        };
        commands.into_iter().map(one).collect()
    }

    /// The three examples that the help of a verb ends with.
    #[track_caller]
    pub fn examples(&self, verb: &str) -> Vec<String> {
        let help = self.ends(Exit::Done, &format!("{verb} --help")).replace(" \\\n   ", "");
        let examples = help.lines().filter_map(|line| line.strip_prefix("  caveat "));
        let examples: Vec<String> = examples.map(|line| format!("caveat {line}")).collect();
        assert_eq!(examples.len(), 3, "{help}");
        examples
    }

    /// The JSON document that a run printed.
    #[track_caller]
    pub fn json(&self, command: &str) -> serde_json::Value {
        let run = self.run(command);
        serde_json::from_str(&run.data)
            .unwrap_or_else(|error| panic!("{command}: {error}\n{}{}", run.data, run.talk))
    }

    /// That a file is a domain or a problem of which nothing is to be said.
    #[track_caller]
    pub fn clean(&self, files: &str) {
        let said = self.ends(Exit::Done, &format!("caveat check {files}"));
        assert!(said.starts_with("Nothing wrong"), "{said}");
    }
}

/// A text without the time that a run took.
fn untimed(text: &str) -> String {
    let line = |line: &str| match line.split_once("\"seconds\": ") {
        Some((before, _)) => format!("{before}\"seconds\": 0.0,\n"),
        None => line.to_owned(),
    };
    text.split_inclusive('\n').map(line).collect()
}

/// The text of a file that is shipped.
pub fn shipped(path: &str) -> String {
    let root = domains::folder();
    let path: &Path = &root.join(path);
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
