//! `caveat validate`: a domain, a problem and plans go in; VAL's lines and the story of each failure come out.

use std::path::{Path, PathBuf};

use lang::execute::Executor;
use lang::validate::{self, Verdict};

use crate::args::Validate;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::{self, Input, Reader};
use crate::terminal::Terminal;

/// Checks every plan, and ends with 1 if one of them is not valid.
pub fn run(arguments: &Validate, terminal: &mut Terminal) -> Exit {
    let mut reader = Reader::default();
    let (tasks, plans) = match split(&mut reader, &arguments.files) {
        Ok(parts) => parts,
        Err(complaint) => {
            terminal.say(complaint);
            return Exit::Failed;
        }
    };
    let Ok(mut input) = input::load(reader, "validate", &tasks, arguments.output_format, terminal)
    else {
        return Exit::Failed;
    };
    let mut failed = Vec::new();
    for plan in &plans {
        terminal.line(format_args!("Checking plan: {}", files::name(plan)));
        match one(&mut input, plan, arguments, terminal) {
            Ok(true) => {}
            Ok(false) => failed.push(files::name(plan)),
            Err(complaint) => {
                terminal.say(complaint);
                return Exit::Failed;
            }
        }
    }
    if failed.is_empty() {
        return Exit::Done;
    }
    terminal.line("Failed plans:");
    for name in failed {
        terminal.line(format_args!(" {name}"));
    }
    Exit::Findings
}

/// Tells the files of the task from the plans, which come after them.
fn split(
    reader: &mut Reader,
    files: &[PathBuf],
) -> Result<(Vec<PathBuf>, Vec<PathBuf>), Complaint> {
    let count = reader.leading(files)?;
    if files.len() <= count {
        return Err(Complaint::with_help(
            "there is no plan to check",
            format!("name one: caveat validate {} sas_plan", input::listed(files)),
        ));
    }
    Ok((files[..count].to_vec(), files[count..].to_vec()))
}

/// Checks one plan; whether it is valid.
fn one(
    input: &mut Input,
    plan: &Path,
    arguments: &Validate,
    terminal: &mut Terminal,
) -> Result<bool, Complaint> {
    let id = input.reader.take(plan)?;
    if input.reader.kind(plan)?.is_some() {
        return Err(Complaint::with_help(
            format!("`{}` is PDDL, not a plan", files::name(plan)),
            "the order is domain, problem, plans",
        ));
    }
    let (listing, mut diagnostics) =
        lang::plan::read(&input.reader.sources, id, &input.domain, &input.problem);
    input.reader.settle(&mut diagnostics);
    terminal.talk(input::rendered(
        &input.reader.sources,
        &diagnostics,
        arguments.output_format,
        terminal.colour,
    ));
    if diagnostics.has_errors() {
        terminal.line("Bad plan description!");
        return Ok(false);
    }
    let verdict = match Executor::new(&input.domain, &input.problem) {
        Ok(executor) => validate::judge(&executor, &listing.plan),
        Err(unstratified) => {
            let mut diagnostics = lang::diagnostic::Diagnostics::default();
            diagnostics.push(unstratified.diagnostic(&input.domain));
            terminal.talk(input::rendered(
                &input.reader.sources,
                &diagnostics,
                arguments.output_format,
                terminal.colour,
            ));
            return Err(Complaint::new("the derived predicates of this domain have no meaning"));
        }
    };
    terminal.data(validate::lines(&verdict));
    if let Verdict::Invalid(failure) = &verdict {
        terminal.data(validate::story(&verdict, &input.domain, &input.problem, &listing.plan));
        let mut diagnostics = lang::diagnostic::Diagnostics::default();
        diagnostics.push(failure.diagnostic(
            &input.domain,
            &input.problem,
            &listing.plan,
            &listing.spans,
        ));
        terminal.talk(input::rendered(
            &input.reader.sources,
            &diagnostics,
            arguments.output_format,
            terminal.colour,
        ));
        return Ok(false);
    }
    Ok(true)
}
