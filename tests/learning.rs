//! `caveat simulate` and `caveat learn` from the command line to what a person reads: demonstrations in worlds go in; domains, plans that are carried out, and clear refusals come out.

mod answers;
mod lesson;
mod shown;
mod worlds;
mod wrong;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use cli::exit::Exit;
use cli::terminal::Terminal;
use tempfile::TempDir;

/// A folder of its own. In a command line `domains/…` is what is shipped, and files with an ending lie in the folder.
struct Desk {
    folder: TempDir,
}

/// What a run left.
struct Run {
    exit: Exit,
    /// What was printed as data.
    data: String,
    /// What was said beside it.
    talk: String,
}

/// The endings of files that lie in the folder.
const ENDINGS: [&str; 8] = [".pddl", ".plan", ".jsonl", ".json", ".csv", ".svg", ".trace", ".txt"];

impl Desk {
    /// An empty folder.
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("there is room for a few files") }
    }

    /// A folder with the log of a demonstration in it, called `demo.jsonl`.
    #[track_caller]
    fn demo(what: &str) -> Self {
        let desk = Self::new();
        desk.ends(Exit::Done, &format!("caveat simulate demo {what} -o demo.jsonl"));
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    #[track_caller]
    fn file(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the folder can be written to");
    }

    /// Runs a command line in this process. Words in single quotes are one.
    fn run(&self, command: &str) -> Run {
        let root = domains::folder();
        let root = root.parent().expect("the domains lie in the repository");
        let place = |word: &str| -> String {
            let here = ENDINGS.iter().any(|end| word.ends_with(end));
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
            text.replace(&format!("{}/", root.display()), "")
        };
        Run { exit, data: text(out), talk: text(err) }
    }

    /// What a run printed, if it ended so.
    #[track_caller]
    fn ends(&self, exit: Exit, command: &str) -> String {
        let run = self.run(command);
        assert_eq!(run.exit, exit, "{command}\n{}{}", run.data, run.talk);
        run.data + &run.talk
    }

    /// The same, with the command line above it.
    #[track_caller]
    fn shown(&self, exit: Exit, command: &str) -> String {
        let printed = self.ends(exit, command);
        format!("$ {command}\n{printed}[exit code {}]\n", exit.code())
    }

    /// That a file is a domain or a problem of which nothing is to be said.
    #[track_caller]
    fn clean(&self, files: &str) {
        let said = self.ends(Exit::Done, &format!("caveat check {files}"));
        assert!(said.starts_with("Nothing wrong"), "{said}");
    }
}

/// Keeps what commands print.
fn keep(name: &str, commands: &str, printed: &str) {
    insta::with_settings!({ description => commands, omit_expression => true }, {
        insta::assert_snapshot!(name, printed);
    });
}

/// The text of a file that is shipped.
fn shipped(path: &str) -> String {
    let root = domains::folder();
    let path: &Path = &root.join(path);
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
