//! `caveat ground`: a domain and a problem go in; the ground task comes out, as counts or as the file that Fast Downward's search reads.

use std::io::Write;

use planner::limits::Stop;
use planner::sas;
use planner::solve::Obstacle;

use crate::args::{Ground, GroundFormat};
use crate::exit::Exit;
use crate::files;
use crate::input::{self, Reader};
use crate::limits::{Allowance, Watch, peak_memory};
use crate::pipeline;
use crate::terminal::Terminal;

/// Grounds and writes.
pub fn run(arguments: &Ground, terminal: &mut Terminal) -> Exit {
    let Ok(input) = input::load(
        Reader::default(),
        "ground",
        &arguments.files,
        arguments.output_format,
        terminal,
    ) else {
        return Exit::Failed;
    };
    let allowance = Allowance { time: arguments.time_limit, memory: arguments.memory_limit };
    let watch = Watch::start(allowance, false);
    let task = match pipeline::ground(&input.domain, &input.problem, &watch) {
        Ok(task) => task,
        Err(Obstacle::Unsupported(unsupported)) => {
            input.report(input::unsupported(&unsupported), arguments.output_format, terminal);
            return Exit::Failed;
        }
        Err(Obstacle::Unreachable) => {
            terminal.line(
                "There is no plan: the goal cannot be reached, even if nothing were ever deleted.",
            );
            return Exit::Findings;
        }
        Err(Obstacle::Stopped(stop, phase)) => {
            let what = if stop == Stop::Signal { "asked to stop" } else { "a limit is reached" };
            terminal.say(format_args!("error: {what} while {phase}"));
            return Exit::Failed;
        }
    };
    let counts = format!(
        "{}Translator peak memory: {} KB\n",
        sas::write::summary(&task.encoded),
        peak_memory()
    );
    if arguments.format == GroundFormat::Summary {
        terminal.data(counts);
        return Exit::Done;
    }
    let write = |mut out: &mut dyn Write| {
        sas::write::write(&task.encoded, &task.grounded, &task.names, &mut out)
    };
    match &arguments.output {
        Some(path) if !files::is_stdin(path) => {
            if let Err(complaint) = files::write_with(path, write) {
                terminal.say(complaint);
                return Exit::Failed;
            }
            terminal.data(counts);
        }
        _ => {
            terminal.write_with(write);
            terminal.say(counts.trim_end());
        }
    }
    Exit::Done
}
