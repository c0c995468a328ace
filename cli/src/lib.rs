//! Arguments go in; text on stdout and stderr, files and an exit code come out.
//!
//! This is the only crate that reads arguments, files, the environment and the clock, or prints.
//!
//! ```
//! let (mut out, mut err) = (Vec::new(), Vec::new());
//! let mut terminal = cli::terminal::Terminal::new(&mut out, &mut err);
//! let exit = cli::call(["caveat", "completions", "bash"].map(Into::into), &mut terminal);
//! assert_eq!(exit, cli::exit::Exit::Done);
//! assert!(!out.is_empty() && err.is_empty());
//! ```

use std::ffi::OsString;
use std::io::{self, BufWriter, IsTerminal};
use std::process::ExitCode;

use clap::Parser;

pub mod args;
pub mod exit;
pub mod terminal;
pub mod files;
pub mod limits;
pub mod fault;
pub mod input;
pub mod pipeline;
pub mod progress;
pub mod check;
pub mod fmt;
pub mod plan;
pub mod validate;
pub mod compile;
pub mod ground;
pub mod excuse;
pub mod learn;
pub mod simulate;
pub mod causal;
pub mod bench;
pub mod explain;
pub mod lsp;
pub mod completions;

use args::{Arguments, Verb};
use exit::Exit;
use terminal::Terminal;

/// The stack of the thread that works: nothing recurses on the depth of the input, but joins and searches nest deeper than most.
/// Only what is touched becomes memory.
const STACK: usize = 512 << 20;

/// Runs the command line `arguments`, of which the first is the program's name, on the streams of this process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let mut out = BufWriter::with_capacity(1 << 16, io::stdout());
    let mut err = io::stderr();
    let mut terminal = Terminal::new(&mut out, &mut err);
    terminal.watched = io::stderr().is_terminal();
    terminal.colour =
        terminal.watched && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    call(arguments, &mut terminal).into()
}

/// The same on any streams. No panic gets out: one is reported and ends in [`Exit::Bug`].
pub fn call(arguments: impl IntoIterator<Item = OsString>, terminal: &mut Terminal) -> Exit {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let exit = match fault::contain(STACK, || dispatch(&arguments, terminal)) {
        Ok(exit) => exit,
        Err(fault) => {
            terminal.say(fault);
            Exit::Bug
        }
    };
    match terminal.finish() {
        Ok(()) => exit,
        Err(error) => {
            terminal.say(format_args!("error: the output cannot be written: {error}"));
            if exit == Exit::Done { failed(&arguments) } else { exit }
        }
    }
}

/// Reads the arguments and does what they say.
fn dispatch(arguments: &[OsString], terminal: &mut Terminal) -> Exit {
    let parsed = match Arguments::try_parse_from(arguments) {
        Ok(parsed) => parsed,
        Err(error) => return refuse(arguments, &error, terminal),
    };
    match parsed.verb {
        Verb::Check(arguments) => check::run(&arguments, terminal),
        Verb::Fmt(arguments) => fmt::run(&arguments, terminal),
        Verb::Plan(arguments) => plan::run(&arguments, terminal),
        Verb::Validate(arguments) => validate::run(&arguments, terminal),
        Verb::Compile(arguments) => compile::run(&arguments, terminal),
        Verb::Ground(arguments) => ground::run(&arguments, terminal),
        Verb::Excuse(arguments) => excuse::run(&arguments, terminal),
        Verb::Learn(arguments) => learn::run(&arguments, terminal),
        Verb::Simulate(arguments) => simulate::run(&arguments, terminal),
        Verb::Causal(arguments) => causal::run(&arguments, terminal),
        Verb::Explain(arguments) => explain::run(&arguments, terminal),
        Verb::Bench(arguments) => bench::run(&arguments, terminal),
        Verb::Lsp(arguments) => lsp::run(&arguments, terminal),
        Verb::Completions(arguments) => completions::run(&arguments, terminal),
    }
}

/// Prints what clap has to say: help that was asked for is data, everything else is talk.
fn refuse(arguments: &[OsString], error: &clap::Error, terminal: &mut Terminal) -> Exit {
    let text = error.render();
    let text = if terminal.colour { text.ansi().to_string() } else { text.to_string() };
    if !error.use_stderr() {
        terminal.data(text);
        return Exit::Done;
    }
    terminal.say(text.trim_end());
    usage(arguments)
}

/// The verb that a command line names, well formed or not.
fn is_plan(arguments: &[OsString]) -> bool {
    arguments
        .iter()
        .skip(1)
        .find(|argument| !argument.as_encoded_bytes().starts_with(b"-"))
        .is_some_and(|verb| verb == "plan")
}

/// How a wrong command line ends.
fn usage(arguments: &[OsString]) -> Exit {
    if is_plan(arguments) { Exit::Usage } else { Exit::Failed }
}

/// How a run ends that could not do its work.
fn failed(arguments: &[OsString]) -> Exit {
    if is_plan(arguments) { Exit::Input } else { Exit::Failed }
}
