//! `caveat check`: files go in; what is wrong with each of them comes out.

use crate::args::Check;
use crate::exit::Exit;
use crate::input::{self, Reader};
use crate::terminal::Terminal;

/// Checks every file: domains alone, problems with the domain that is among the files or else lies beside them.
pub fn run(arguments: &Check, terminal: &mut Terminal) -> Exit {
    if arguments.support {
        terminal.data(lang::support::table());
        return Exit::Done;
    }
    let mut reader = Reader::of(&arguments.tools);
    let files = match reader.expand(&arguments.files) {
        Ok(files) => files,
        Err(complaint) => {
            terminal.say(complaint);
            return Exit::Failed;
        }
    };
    let checked = if arguments.fix {
        Reader::fix(&files, &arguments.tools)
    } else {
        reader.check(&files).map(|found| (reader, found, 0))
    };
    match checked {
        Ok((reader, found, fixed)) => {
            terminal.data(input::rendered(
                &reader.sources,
                &found,
                arguments.output_format,
                terminal.data_colour,
            ));
            if arguments.fix {
                terminal.say(format!("{fixed} fixed."));
            }
            terminal.say(summary(&found, files.len()));
            if found.list.is_empty() { Exit::Done } else { Exit::Findings }
        }
        Err(complaint) => {
            terminal.say(complaint);
            Exit::Failed
        }
    }
}

/// How many mistakes there are, in words.
fn summary(found: &lang::diagnostic::Diagnostics, files: usize) -> String {
    let errors =
        found.list.iter().filter(|one| one.severity == lang::diagnostic::Severity::Error).count();
    let warnings = found.list.len() - errors;
    let count = |number: usize, word: &str| {
        format!("{number} {word}{}", if number == 1 { "" } else { "s" })
    };
    match (errors, warnings) {
        (0, 0) => format!("Nothing wrong in {}.", count(files, "file")),
        (errors, 0) => format!("{}.", count(errors, "error")),
        (0, warnings) => format!("{}.", count(warnings, "warning")),
        (errors, warnings) => {
            format!("{}, {}.", count(errors, "error"), count(warnings, "warning"))
        }
    }
}
