//! `caveat completions`: a shell goes in, its completion script comes out.

use clap::CommandFactory;

use crate::args::{Arguments, Completions};
use crate::exit::Exit;
use crate::terminal::Terminal;

/// Prints the script.
pub fn run(arguments: &Completions, terminal: &mut Terminal) -> Exit {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "caveat", &mut script);
    terminal.data(String::from_utf8_lossy(&script));
    Exit::Done
}
