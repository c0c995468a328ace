//! `caveat validate`: a domain, a problem and plans go in; VAL's lines and the story of each failure come out.

use std::path::{Path, PathBuf};

use lang::diagnostic::Diagnostic;
use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::plan::Listing;
use lang::validate::{self, Verdict, joint};

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
    let executor = match Executor::new(&input.domain, &input.problem) {
        Ok(executor) => executor,
        Err(unstratified) => {
            let diagnostic = unstratified.diagnostic(&input.domain);
            input.report(diagnostic, arguments.output_format, terminal);
            return Err(Complaint::new("the derived predicates of this domain have no meaning"));
        }
    };
    let judged = if input.domain.is_multi_agent() {
        let concurrency = input::concurrency(arguments.concurrency, input);
        together(&executor, &listing, concurrency)
    } else {
        alone(&executor, &listing)
    };
    terminal.data(judged.lines);
    let Some((story, diagnostic)) = judged.failure else { return Ok(true) };
    terminal.data(story);
    input.report(diagnostic, arguments.output_format, terminal);
    Ok(false)
}

/// What there is to print about a plan.
struct Judged {
    /// VAL's lines.
    lines: String,
    /// The story of the failure, and the same as a diagnostic.
    failure: Option<(String, Diagnostic)>,
}

fn alone(executor: &Executor<'_>, listing: &Listing) -> Judged {
    let (domain, problem) = (executor.domain(), executor.problem());
    let verdict = validate::judge(executor, &listing.plan);
    let failure = match &verdict {
        Verdict::Valid(_) => None,
        Verdict::Invalid(failure) => Some((
            validate::story(&verdict, domain, problem, &listing.plan),
            failure.diagnostic(domain, problem, &listing.plan, &listing.spans),
        )),
    };
    Judged { lines: validate::lines(&verdict), failure }
}

fn together(executor: &Executor<'_>, listing: &Listing, concurrency: Concurrency) -> Judged {
    let (domain, problem) = (executor.domain(), executor.problem());
    let (plan, spans) = listing.joint();
    let verdict = joint::judge(executor, &plan, concurrency);
    let failure = match &verdict {
        joint::Verdict::Valid(_) => None,
        joint::Verdict::Invalid(failure) => Some((
            joint::story(&verdict, domain, problem, &plan),
            failure.diagnostic(domain, problem, &plan, &spans),
        )),
    };
    Judged { lines: joint::lines(&verdict), failure }
}
