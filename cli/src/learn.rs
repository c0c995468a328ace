//! `caveat learn`: logs or traces go in; a domain comes out, or a domain that was there with what is new in it.

mod open;
mod logs;
mod traces;
mod extend;
mod verify;

use std::io::Write as _;
use std::path::Path;

use learner::invariant::{annotation, invariants};
use learner::rule::{self, Learned, Rule};
use learner::write;

use crate::args::learn::{Learn, RuleName};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Why nothing came of it: with a complaint, or after everything was said already.
type Failure = Option<Complaint>;

/// Runs the verb.
pub fn run(arguments: &Learn, terminal: &mut Terminal) -> Exit {
    match work(arguments, terminal) {
        Ok(exit) => exit,
        Err(Some(complaint)) => {
            terminal.say(complaint);
            Exit::Failed
        }
        Err(None) => Exit::Findings,
    }
}

fn work(arguments: &Learn, terminal: &mut Terminal) -> Result<Exit, Failure> {
    let config = logs::config(arguments)?;
    if arguments.print_config {
        let text = serde_json::to_string_pretty(&config).expect("thresholds are plain data");
        terminal.line(text);
        return Ok(Exit::Done);
    }
    let kinds: Vec<Kind> =
        arguments.files.iter().map(|path| kind(path)).collect::<Result<_, Complaint>>()?;
    if kinds.iter().all(|kind| *kind == Kind::Trace) {
        return traces::learn(arguments, terminal);
    }
    if kinds.contains(&Kind::Trace) {
        return Err(Some(Complaint::with_help(
            "some of the files are logs and some are traces",
            "learn from the one, and then with --extend from the other",
        )));
    }
    logs::learn(arguments, &config, &kinds, terminal)
}

/// What is in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A log as JSON Lines.
    Json,
    /// A log as CSV.
    Csv,
    /// A recording of ROS 2.
    Mcap,
    /// A table of a data set of `LeRobot`.
    Parquet,
    /// States and actions.
    Trace,
}

/// What is in a file, told by its name or by how it begins. The standard input is a log of JSON Lines.
fn kind(path: &Path) -> Result<Kind, Complaint> {
    if files::is_stdin(path) {
        return Ok(Kind::Json);
    }
    let end = path.extension().and_then(|end| end.to_str()).unwrap_or_default();
    for (name, kind) in [("csv", Kind::Csv), ("mcap", Kind::Mcap), ("parquet", Kind::Parquet)] {
        if end.eq_ignore_ascii_case(name) {
            return Ok(kind);
        }
    }
    let first = files::first_byte(path)?;
    Ok(match first {
        Some(b'(' | b';') => Kind::Trace,
        Some(b'#') => Kind::Csv,
        _ => Kind::Json,
    })
}

/// The options of the rules.
fn options(arguments: &Learn) -> rule::Options {
    let rule = match arguments.rule {
        RuleName::Changed => Rule::Changed,
        RuleName::Safe => Rule::Safe,
        RuleName::Both => Rule::Both,
    };
    rule::Options {
        rule,
        negative: arguments.negative,
        tolerance: arguments.tolerance,
        joint: rule::Company::Together,
        hand: Vec::new(),
    }
}

/// Writes a text where it is wanted: to a file, or to the output.
fn deliver(output: Option<&Path>, text: &str, terminal: &mut Terminal) -> Result<(), Complaint> {
    if let Some(path) = output {
        return files::write(path, text.as_bytes());
    }
    terminal.data(text);
    Ok(())
}

/// Says what was learned and what was not.
fn report(learned: &Learned, terminal: &mut Terminal) {
    let mut list = learned.actions.iter().map(|action| {
        let name = &learned.domain.actions[action.action.index()].name.text;
        format!("{name} ({})", times(action.count))
    });
    let names: Vec<String> = list.by_ref().collect();
    match names.len() {
        0 => terminal.say("No operators were learned."),
        1 => terminal.say(format_args!("Learned one operator: {}.", names[0])),
        count => terminal.say(format_args!("Learned {count} operators: {}.", names.join(", "))),
    }
    for refusal in &learned.refused {
        terminal.say(format_args!("Left out: {}.", refusal.describe(&learned.domain)));
    }
}

/// How often something was seen.
fn times(count: u32) -> String {
    if count == 1 { "seen once".to_owned() } else { format!("seen {count} times") }
}

/// The text of a learned domain, with the groups of facts that exclude each other.
fn text(
    learned: &Learned,
    groups: &[String],
    change: impl FnOnce(&mut lang::model::Domain, &mut lang::write::Style),
) -> String {
    let (mut domain, mut style) = write::domain(learned, learned.rule);
    style.groups = groups.join("\n");
    change(&mut domain, &mut style);
    lang::write::domain(&domain, &style)
}

/// The groups that exclude each other in traces, as annotations.
fn groups(domain: &lang::model::Domain, traces: &[learner::trace::Trace]) -> Vec<String> {
    invariants(domain, traces).iter().map(|one| annotation(domain, one)).collect()
}

/// Writes whatever `work` writes into a file.
fn write_with(
    path: &Path,
    work: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
) -> Result<(), Complaint> {
    files::write_with(path, |out| {
        let mut out = std::io::BufWriter::new(out);
        work(&mut out)?;
        out.flush()
    })
}
