//! The question for the smallest excuse as a planning task, for any planner that minimises cost: a domain and a problem in a folder.

use std::fs;
use std::path::Path;

use planner::excuse::{self, CatalogueError, Policy};

use crate::args::OutputFormat;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::{self, Input};
use crate::limits::Watch;
use crate::terminal::Terminal;

/// Writes the task in which changes are actions, whatever they cost, and prints the names of the files.
pub fn write(
    input: &Input,
    policy: &Policy,
    folder: &Path,
    watch: &Watch,
    format: OutputFormat,
    terminal: &mut Terminal,
) -> Exit {
    let (domain, problem) = (&input.domain, &input.problem);
    let task = match excuse::export(domain, problem, policy, u32::MAX, &watch.limits) {
        Ok(task) => task,
        Err(CatalogueError::Unsupported(unsupported)) => {
            input.report(input::unsupported(&unsupported), format, terminal);
            return Exit::Failed;
        }
        Err(CatalogueError::Unfinished(_)) => {
            terminal.say("A limit was reached before it was known what may be changed.");
            return Exit::Incomplete;
        }
    };
    let names = [&domain.name.text, &problem.name.text];
    let made = format!(
        "Made by `caveat excuse --export` from the domain `{}` and the problem `{}`.",
        names[0], names[1]
    );
    let texts =
        [("domain.pddl", task.domain_text(&made)), ("problem.pddl", task.problem_text(&made))];
    match save(input, folder, &texts, terminal) {
        Ok(()) => Exit::Done,
        Err(complaint) => {
            terminal.say(complaint);
            Exit::Failed
        }
    }
}

fn save(
    input: &Input,
    folder: &Path,
    texts: &[(&str, String)],
    terminal: &mut Terminal,
) -> Result<(), Complaint> {
    let paths = texts.iter().map(|(name, _)| folder.join(name));
    if let Some(path) = paths.clone().find(|path| input.reader.has_read(path)) {
        return Err(Complaint::with_help(
            format!("`{}` would be written over, and was read", path.display()),
            "name another folder",
        ));
    }
    fs::create_dir_all(folder).map_err(|error| {
        Complaint::new(format!("the folder `{}` cannot be made: {error}", folder.display()))
    })?;
    for (path, (_, text)) in paths.zip(texts) {
        files::write(&path, text.as_bytes())?;
        terminal.line(path.display());
    }
    Ok(())
}
