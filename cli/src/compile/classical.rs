//! A task of several agents goes in; a classical task whose plans are its joint plans comes out.

use crate::args::Compile;
use crate::exit::Exit;
use crate::files::Complaint;
use crate::input::Input;
use crate::terminal::Terminal;

/// Says that this form is not written yet.
pub(super) fn classical(_: &Input, _: &Compile, terminal: &mut Terminal) -> Exit {
    terminal.say(Complaint::with_help(
        "classical PDDL is not written yet",
        "--to unfactored and --to factored are; `caveat plan` plans for several agents",
    ));
    Exit::Failed
}
