//! Arguments go in; text on stdout and stderr, files and an exit code come out.

use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the command line `arguments`, of which the first is the program's name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let _ = arguments.into_iter().count();
    ExitCode::from(36)
}
