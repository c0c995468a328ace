//! `caveat excuse`: a domain and a problem without a plan go in; the smallest changes with which it has one come out, and why.

mod words;
mod report;
mod beyond;
mod lesson;
mod variables;
mod export;

use std::path::Path;

use lang::group::{self, Group};
use lang::model::PredicateId;
use lang::write::{self, Style};
use planner::excuse::{self, Outcome, Policy, Question};

use crate::args::excuse::{AnswerFormat, Excuse};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::{self, Input, Reader};
use crate::limits::{Allowance, Watch, cpu_time};
use crate::terminal::Terminal;
use beyond::Beyond;
use report::Report;

/// Finds excuses, or does what else is asked for.
pub fn run(arguments: &Excuse, terminal: &mut Terminal) -> Exit {
    let format = arguments.output_format.of_diagnostics();
    let Ok(mut input) =
        input::load(Reader::default(), "excuse", &arguments.files, format, terminal)
    else {
        return Exit::Failed;
    };
    if input.domain.is_multi_agent() {
        terminal.say(Complaint::with_help(
            "excuses are for tasks without agents",
            "`caveat compile` makes one of a task of several agents",
        ));
        return Exit::Failed;
    }
    let question = match question(arguments, &mut input) {
        Ok(question) => question,
        Err(complaint) => {
            terminal.say(complaint);
            return Exit::Failed;
        }
    };
    let allowance = Allowance { time: arguments.time_limit, memory: arguments.memory_limit };
    let watch = Watch::start(allowance, false);
    if let Some(most) = arguments.variables {
        return variables::print(&input, &question.policy, most, &watch, format, terminal);
    }
    if let Some(folder) = &arguments.export {
        return export::write(&input, &question.policy, folder, &watch, format, terminal);
    }
    let start = cpu_time();
    let found = excuse::find(&input.domain, &input.problem, &question, &watch.limits);
    let seconds = (cpu_time().saturating_sub(start)).as_secs_f64();
    let (outcome, statistics) = match found {
        Ok(found) => found,
        Err(unsupported) => {
            input.report(input::unsupported(&unsupported), format, terminal);
            return Exit::Failed;
        }
    };
    if let (Some(path), Outcome::Excuses { list, .. }) = (&arguments.apply, &outcome)
        && let Err(complaint) = apply(&input, &list[0], path)
    {
        terminal.say(complaint);
        return Exit::Failed;
    }
    if arguments.check_demo.is_some() {
        return lesson::check(arguments, &input, &outcome, &watch, terminal);
    }
    let report = Report { input: &input, statistics, seconds };
    if let (Some(folder), Outcome::Excuses { missing, list, .. }) =
        (&arguments.demonstrate, &outcome)
        && let Err(complaint) = lesson::write(&report, missing, list, folder)
    {
        terminal.say(complaint);
        return Exit::Failed;
    }
    let beyond = Beyond::look(arguments, &input, &question, &outcome, &watch, terminal);
    match arguments.output_format {
        AnswerFormat::Full => {
            terminal.data(report.text(&outcome));
            terminal.data(beyond.text(&input));
        }
        AnswerFormat::Json => {
            let mut document = report.json(&outcome);
            beyond.add_to(&mut document, &input);
            terminal.line(serde_json::to_string_pretty(&document).expect("it is plain data"));
        }
    }
    match outcome {
        Outcome::Excuses { .. } => Exit::Done,
        Outcome::Solvable(_) => Exit::Unneeded,
        Outcome::None { .. } => Exit::Exhausted,
        Outcome::Unknown { .. } | Outcome::Undecided(_) => Exit::Incomplete,
    }
}

/// Writes the problem as an excuse changes it.
fn apply(input: &Input, excuse: &excuse::Excuse, path: &Path) -> Result<(), Complaint> {
    let head = "Changed by `caveat excuse` so that it has a plan.".to_owned();
    let style = Style { head, ..Style::default() };
    files::write(path, write::problem(&input.domain, &excuse.problem, &style).as_bytes())
}

/// What the command line asks for, in terms of the domain.
fn question(arguments: &Excuse, input: &mut Input) -> Result<Question, Complaint> {
    let mut policy = Policy {
        protected: predicates(&arguments.protect, "--protect", input)?,
        goal: arguments.edit_goal,
        objects: arguments.new_objects,
        object_cost: arguments.object_cost,
        declared: declared(arguments, input)?,
        presume: !arguments.presume_nothing,
        ..Policy::default()
    };
    if !arguments.only.is_empty() {
        policy.only = Some(predicates(&arguments.only, "--only", input)?);
    }
    for text in &arguments.cost {
        let parts = text.split_once('=').and_then(|(name, cost)| Some((name, cost.parse().ok()?)));
        let Some((name, cost)) = parts.filter(|&(_, cost): &(_, u32)| cost > 0) else {
            return Err(Complaint::with_help(
                format!("`{text}` is no cost of a predicate"),
                "write `--cost road=2`, with a whole number from 1 on",
            ));
        };
        policy.costs.push((predicate(name, "--cost", input)?, cost));
    }
    let mut question = Question { policy, ..Question::default() };
    question.most_edits = arguments.max_edits;
    question.most_excuses = if arguments.all { usize::MAX } else { arguments.limit.max(1) };
    Ok(question)
}

/// The predicates of these names.
fn predicates(
    names: &[String],
    option: &str,
    input: &Input,
) -> Result<Vec<PredicateId>, Complaint> {
    names.iter().map(|name| predicate(name, option, input)).collect()
}

fn predicate(name: &str, option: &str, input: &Input) -> Result<PredicateId, Complaint> {
    let all = &input.domain.predicates;
    let found = all.iter().position(|one| one.name.text.eq_ignore_ascii_case(name));
    let Some(number) = found else {
        let message = format!("`{option}` names a predicate that there is not: `{name}`");
        let known = all.iter().map(|one| one.name.text.as_str());
        return Err(Complaint::misspelt(message, name, known));
    };
    if all[number].derived {
        let message = format!("`{name}` is derived by axioms and cannot be changed itself");
        return Err(Complaint::with_help(message, format!("leave it out of `{option}`")));
    }
    Ok(PredicateId(number as u32))
}

/// The groups that the domain declares, and those of the file that is named.
fn declared(arguments: &Excuse, input: &mut Input) -> Result<Vec<Group>, Complaint> {
    let (sources, source) = (&input.reader.sources, input.domain.name.span.source);
    let (annotations, _) = lang::annotations(sources, source);
    let mut groups = group::groups(&annotations, &input.domain, Some(&input.problem));
    let Some(path) = &arguments.groups else { return Ok(groups) };
    let text = files::read(path)?.text;
    let lines: Vec<String> = text
        .lines()
        .map(|line| match line.trim_start() {
            line if line.starts_with(';') => line.to_owned(),
            line => format!(";@ {line}"),
        })
        .collect();
    let id = input.reader.sources.add(path.display().to_string(), lines.join("\n"));
    let (annotations, _) = lang::annotations(&input.reader.sources, id);
    let more = group::groups(&annotations, &input.domain, Some(&input.problem));
    if more.len() != annotations.len() || more.is_empty() {
        return Err(Complaint::with_help(
            format!(
                "`{}` has something else in it than groups of atoms of this domain",
                path.display()
            ),
            "write `(:exactly-one (open ?d) (closed ?d))` or `(:at-most-one …)`, one after another",
        ));
    }
    groups.extend(more);
    Ok(groups)
}
