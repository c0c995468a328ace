//! `caveat fmt`: files go in; the same files come out, laid out evenly.

use std::fs;
use std::path::{Path, PathBuf};

use lang::format::format;

use crate::args::Fmt;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Formats every file in place; the standard input goes to the output; with `--check` nothing is written.
pub fn run(arguments: &Fmt, terminal: &mut Terminal) -> Exit {
    let standard_input = arguments.stdin.then(|| PathBuf::from("-"));
    let named = arguments.files.iter().cloned().chain(standard_input);
    let mut paths = Vec::new();
    for path in named {
        if let Err(complaint) = gather(&path, &mut paths) {
            terminal.say(complaint);
            return Exit::Failed;
        }
    }
    let mut changed = 0;
    for path in &paths {
        match one(path, arguments.check, terminal) {
            Ok(differs) => changed += usize::from(differs),
            Err(complaint) => {
                terminal.say(complaint);
                return Exit::Failed;
            }
        }
    }
    let files = |count: usize| format!("{count} file{}", if count == 1 { "" } else { "s" });
    if arguments.check {
        terminal.say(format!("{changed} of {} would change.", files(paths.len())));
        return if changed == 0 { Exit::Done } else { Exit::Findings };
    }
    if paths.iter().any(|path| !files::is_stdin(path)) {
        terminal.say(format!("{changed} of {} changed.", files(paths.len())));
    }
    Exit::Done
}

/// Formats one file, and says whether that changes it.
fn one(path: &Path, check: bool, terminal: &mut Terminal) -> Result<bool, Complaint> {
    let text = files::read(path)?;
    if let Some(bad) = text.bad {
        let message = format!("`{}` is not UTF-8 from byte {bad} on", files::name(path));
        return Err(Complaint::with_help(message, "nothing was written to it"));
    }
    let Some(formatted) = format(&text.text) else {
        terminal.say(format!(
            "`{}` stays as it is, since its parentheses do not match; `caveat check` says where.",
            files::name(path)
        ));
        if files::is_stdin(path) && !check {
            terminal.data(text.text);
        }
        return Ok(false);
    };
    let differs = formatted != text.text;
    if check {
        if differs {
            terminal.line(files::name(path));
        }
    } else if files::is_stdin(path) {
        terminal.data(formatted);
    } else if differs {
        files::write(path, formatted.as_bytes())?;
    }
    Ok(differs)
}

/// Adds a file, or all files of PDDL and HDDL in a folder and below it, in the order of their names.
fn gather(path: &Path, found: &mut Vec<PathBuf>) -> Result<(), Complaint> {
    let mut waiting = vec![path.to_path_buf()];
    while let Some(path) = waiting.pop() {
        if !path.is_dir() {
            found.push(path);
            continue;
        }
        let entries = fs::read_dir(&path).map_err(|error| {
            Complaint::new(format!("the folder `{}` cannot be read: {error}", path.display()))
        })?;
        let mut inside: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        // A link to a folder may lead back to where it is.
        inside.retain(|path| if path.is_dir() { !path.is_symlink() } else { files::is_pddl(path) });
        inside.sort();
        waiting.extend(inside.into_iter().rev());
    }
    Ok(())
}
