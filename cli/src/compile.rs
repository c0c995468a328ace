//! `caveat compile`: a task of several agents goes in; the same task in another form comes out, as files in a folder.

mod classical;

use std::fs;
use std::path::{Path, PathBuf};

use lang::diagnostic::Diagnostics;
use lang::factored;
use lang::model::Requirement;
use lang::portability;
use lang::source::Sources;
use lang::write::{self, Style};

use crate::args::{Compile, Form};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::{self, Input, Reader};
use crate::terminal::Terminal;

/// Writes the task in the form that is asked for, and prints the names of the files.
pub fn run(arguments: &Compile, terminal: &mut Terminal) -> Exit {
    let Ok(input) = input::load(
        Reader::default(),
        "compile",
        &arguments.files,
        arguments.output_format,
        terminal,
    ) else {
        return Exit::Failed;
    };
    match arguments.to {
        Form::Classical => classical::classical(&input, arguments, terminal),
        Form::Unfactored => unfactored(&input, arguments, terminal),
        Form::Factored => factored(&input, arguments, terminal),
    }
}

/// One domain and one problem of all agents.
fn unfactored(input: &Input, arguments: &Compile, terminal: &mut Terminal) -> Exit {
    if input.domain.requirements.contains(&Requirement::FactoredPrivacy) {
        terminal.say(Complaint::with_help(
            "these are the files of one agent, and what the others can do is not known",
            "name the files of all agents, or the folder that they are in",
        ));
        return Exit::Failed;
    }
    let style = Style { head: head(arguments), ..Style::default() };
    let domain = write::domain(&input.domain, &style);
    let problem = write::problem(&input.domain, &input.problem, &style);
    let texts = [("domain.pddl".to_owned(), domain), ("problem.pddl".to_owned(), problem)];
    save(input, arguments, &texts, terminal)
}

/// A domain and a problem of each agent, and the list of the agents.
fn factored(input: &Input, arguments: &Compile, terminal: &mut Terminal) -> Exit {
    let parts = match factored::split(&input.domain, &input.problem) {
        Ok(parts) => parts,
        Err(found) => {
            let (sources, format) = (&input.reader.sources, arguments.output_format);
            terminal.talk(input::rendered(sources, &found, format, terminal.colour));
            return Exit::Findings;
        }
    };
    let style = Style { head: head(arguments), ..Style::default() };
    let mut texts = Vec::new();
    for part in &parts {
        // The name of an object may be any word, and so a path out of the folder.
        if part.agent.contains(['/', '\\']) {
            let message = format!("no file can be called after the agent `{}`", part.agent);
            terminal.say(Complaint::new(message));
            return Exit::Findings;
        }
        let domain = write::domain(&part.domain, &style);
        let problem = write::problem(&part.domain, &part.problem, &style);
        texts.push((format!("domain-{}.pddl", part.agent), domain));
        texts.push((format!("problem-{}.pddl", part.agent), problem));
    }
    texts.push(("agents.addl".to_owned(), factored::write_list(&parts)));
    save(input, arguments, &texts, terminal)
}

/// What stands at the head of every file.
fn head(arguments: &Compile) -> String {
    let name = |path: &PathBuf| {
        path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
    };
    let names: Vec<String> = arguments.files.iter().map(name).collect();
    format!("Made by `caveat compile` from {}.", names.join(", "))
}

/// Writes texts under these names into the folder that is asked for.
fn save(
    input: &Input,
    arguments: &Compile,
    texts: &[(String, String)],
    terminal: &mut Terminal,
) -> Exit {
    match write_all(&input.reader, &arguments.output, texts) {
        Ok(paths) => {
            for path in paths {
                terminal.line(path.display());
            }
            portable(arguments, texts, terminal)
        }
        Err(complaint) => {
            terminal.say(complaint);
            Exit::Failed
        }
    }
}

/// Says what the programs that are asked about refuse or misread.
fn portable(arguments: &Compile, texts: &[(String, String)], terminal: &mut Terminal) -> Exit {
    let mut sources = Sources::default();
    let mut found = Diagnostics::default();
    for (name, text) in
        texts.iter().filter(|(name, _)| Path::new(name).extension() == Some("pddl".as_ref()))
    {
        let id = sources.add(name.clone(), text.clone());
        found.append(portability::check(&sources, id, &arguments.tools));
    }
    let format = arguments.output_format;
    terminal.talk(input::rendered(&sources, &found, format, terminal.colour));
    if found.list.is_empty() { Exit::Done } else { Exit::Findings }
}

fn write_all(
    reader: &Reader,
    folder: &Path,
    texts: &[(String, String)],
) -> Result<Vec<PathBuf>, Complaint> {
    let paths: Vec<PathBuf> = texts.iter().map(|(name, _)| folder.join(name)).collect();
    if let Some(path) = paths.iter().find(|path| reader.has_read(path)) {
        return Err(Complaint::with_help(
            format!("`{}` would be written over, and was read", path.display()),
            "name another folder with -o",
        ));
    }
    fs::create_dir_all(folder).map_err(|error| {
        Complaint::new(format!("the folder `{}` cannot be made: {error}", folder.display()))
    })?;
    for (path, (_, text)) in paths.iter().zip(texts) {
        files::write(path, text.as_bytes())?;
    }
    Ok(paths)
}
