//! Traces as text go in; operators come out.

use std::path::Path;

use lang::diagnostic::Diagnostics;
use lang::model::{Domain, Object};
use learner::rule;
use learner::trace::{self, Reading, Trace, vocabulary};

use super::{Failure, deliver, groups, options, report, text};
use crate::args::learn::{BadLines, Learn};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::Reader;
use crate::terminal::Terminal;

/// Learns from traces.
pub fn learn(arguments: &Learn, terminal: &mut Terminal) -> Result<Exit, Failure> {
    let skip = arguments.bad_lines == BadLines::Skip;
    let texts: Vec<String> = arguments
        .files
        .iter()
        .map(|path| Ok(files::read(path)?.text))
        .collect::<Result<_, Complaint>>()?;
    let given = arguments.domain.as_deref().or(arguments.extend.as_deref());
    let mut faulty = 0;
    let mut known: Option<Domain> = None;
    let mut source = String::new();
    let mut objects: Vec<Vec<Object>> = Vec::new();
    let domain = if let Some(path) = given {
        let (domain, text, found) = read(path, &arguments.objects, terminal)?;
        source = text;
        objects = found;
        known = Some(domain.clone());
        vocabulary::of(&domain)
    } else {
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let (domain, faults) = trace::infer(&arguments.name, &texts);
        for (path, faults) in arguments.files.iter().zip(&faults) {
            faulty += tell(path, faults, terminal);
        }
        if faulty > 0 && !skip {
            return Err(None);
        }
        domain
    };
    if !objects.is_empty() && objects.len() != texts.len() {
        return Err(Some(Complaint::new(format!(
            "{} traces need as many problems, and --objects names {}",
            texts.len(),
            objects.len()
        ))));
    }
    let agents: Vec<&str> = arguments.acting.iter().map(String::as_str).collect();
    let mut traces: Vec<Trace> = Vec::new();
    for (number, (path, text)) in arguments.files.iter().zip(&texts).enumerate() {
        let name = path
            .file_name()
            .map_or_else(|| files::name(path), |name| name.to_string_lossy().into_owned());
        let objects = objects.get(number).map(Vec::as_slice);
        let reading = Reading { name: &name, objects, agents: &agents, skip };
        let (trace, faults) = trace::read(text, &domain, &reading);
        let count = tell(path, &faults, terminal);
        if count > 0 && !skip {
            return Err(None);
        }
        faulty += count;
        let steps = trace.steps.len();
        if steps == 0 {
            terminal.say(format_args!("{}: nothing is done in it", path.display()));
        }
        traces.push(trace);
    }
    let learned = rule::learn(&domain, &traces, &options(arguments));
    report(&learned, terminal);
    let result = if arguments.extend.is_some() {
        let known = known.expect("a domain that is extended was read");
        super::extend::merged(&source, &known, &learned, terminal).text
    } else {
        text(&learned, &groups(&learned.domain, &traces), |_, _| {})
    };
    deliver(arguments.output.as_deref(), &result, terminal)?;
    Ok(if learned.actions.is_empty() || faulty > 0 { Exit::Findings } else { Exit::Done })
}

/// Says what is wrong with a trace; gives back how much.
fn tell(path: &Path, faults: &[trace::Fault], terminal: &mut Terminal) -> usize {
    for fault in faults {
        terminal.say(format_args!("error: {}:{fault}", path.display()));
    }
    faults.len()
}

/// Says what is wrong with a file, and that it is of no use like that.
fn unfit(path: &Path, reader: &Reader, found: Diagnostics, terminal: &mut Terminal) -> Complaint {
    super::extend::refuse(reader, found, terminal);
    Complaint::new(format!("`{}` has to be mended first", files::name(path)))
}

/// A domain and the objects of problems of it.
pub fn read(
    path: &Path,
    problems: &[std::path::PathBuf],
    terminal: &mut Terminal,
) -> Result<(Domain, String, Vec<Vec<Object>>), Failure> {
    let mut reader = Reader::default();
    let id = reader.take(path)?;
    let (domain, diagnostics) = lang::read_domain(&reader.sources, id);
    let text = reader.sources.get(id).text.clone();
    if diagnostics.has_errors() {
        return Err(Some(unfit(path, &reader, diagnostics, terminal)));
    }
    let mut objects = Vec::new();
    for problem in problems {
        let id = reader.take(problem)?;
        let path = problem;
        let (problem, diagnostics) = lang::read_problem(&reader.sources, id, &domain);
        if diagnostics.has_errors() {
            return Err(Some(unfit(path, &reader, diagnostics, terminal)));
        }
        objects.push(problem.objects);
    }
    Ok((domain, text, objects))
}
