//! Arguments go in; text on stdout and stderr, files and an exit code come out.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

pub mod args;
pub mod exit;
pub mod bench;

use args::{Arguments, Verb};
use exit::Exit;

/// Runs the command line `arguments`, of which the first is the program's name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            let _ = error.print();
            return if error.use_stderr() { Exit::Usage.into() } else { Exit::Done.into() };
        }
    };
    match arguments.verb {
        Verb::Bench(arguments) => bench::run(&arguments).into(),
    }
}
