//! `caveat bench`: lists of tasks go in; one measured row per task and program comes out, and tables made of the rows.
//!
//! Ours and the peer get the same files, the same limits and the same meter. A row is appended as soon as its task is done, and a task
//! that has a row of the same machine, program and limits is not run again, so that a run can be stopped at any time.

mod tasks;
mod side;
mod meter;
mod row;
mod judge;
mod report;

use std::fs;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::args::{self, List, Only};
use crate::exit::Exit;
use crate::files::Complaint;
use crate::terminal::Terminal;
use meter::{Allowance, Meter};
use row::{Row, Rows};
use side::Side;

/// Measures or reports, as asked.
pub fn run(arguments: &args::Bench, terminal: &mut Terminal) -> Exit {
    match measure(arguments, terminal) {
        Ok(exit) => exit,
        Err(error) => {
            terminal.say(Complaint::new(error.to_string()));
            Exit::Failed
        }
    }
}

/// Runs every task that has no row yet.
fn measure(arguments: &args::Bench, terminal: &mut Terminal) -> io::Result<Exit> {
    let shared = tasks::shared()?;
    let tasks = tasks::chosen(arguments, &shared)?;
    let allowance = Allowance {
        cpu: arguments.time_limit.unwrap_or(default_time(arguments.list)),
        memory: arguments.memory_limit,
    };
    if arguments.report {
        let text = report::report(arguments, &tasks, &shared, allowance.cpu.as_secs_f64())?;
        terminal.data(text);
        return Ok(Exit::Done);
    }
    let sides = sides(arguments)?;
    fs::create_dir_all(&arguments.out)?;
    let machine = row::machine();
    let mut rows = Vec::new();
    for side in &sides {
        rows.push(Rows::open(&arguments.out, arguments.list, side.name())?);
    }
    let interrupted = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        signal_hook::flag::register(signal, Arc::clone(&interrupted))?;
    }
    let meter = Meter {
        allowance,
        wall: allowance.cpu * arguments.wall_factor,
        pin: arguments.pin,
        interrupted: Arc::clone(&interrupted),
    };
    let bar = progress(tasks.len() * sides.len(), terminal);
    for (number, task) in tasks.iter().enumerate() {
        for turn in 0..sides.len() {
            // Turns are taken in the order ABBA, so that neither side always finds the files in the cache.
            let turn = if number % 2 == 0 { turn } else { sides.len() - 1 - turn };
            let (side, rows) = (&sides[turn], &mut rows[turn]);
            bar.set_message(format!("{} {}", side.name(), task.problem));
            let key = row::Key {
                domain: task.domain.clone(),
                problem: task.problem.clone(),
                machine: machine.clone(),
                program: side.hash().to_string(),
                seconds: allowance.cpu.as_secs_f64(),
                mebibytes: allowance.memory >> 20,
            };
            if !rows.contains(&key, arguments.again) {
                let row = one(side, arguments, task, &shared, &meter, key)?;
                if interrupted.load(Ordering::Relaxed) {
                    bar.finish_and_clear();
                    terminal.say("stopped; the rows so far are kept");
                    return Ok(Exit::Failed);
                }
                rows.append(row)?;
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(Exit::Done)
}

/// Runs one task on one side in a folder of its own.
fn one(
    side: &Side,
    arguments: &args::Bench,
    task: &tasks::Task,
    shared: &Path,
    meter: &Meter,
    key: row::Key,
) -> io::Result<Row> {
    let folder = tempfile::Builder::new().prefix("caveat-bench-").tempdir()?;
    let ipc = shared.join("benchmarks/ipc");
    let command = side.command(
        arguments.list,
        &ipc.join(&task.domain),
        &ipc.join(&task.problem),
        &meter.allowance,
    );
    let mut measured = meter.run(command, folder.path())?;
    measured.code = side.code(arguments.list, measured.code);
    let plan = folder.path().join("sas_plan");
    if plan.is_file() {
        let kept = row::plan_file(&arguments.out, arguments.list, side.name(), &key.problem);
        fs::create_dir_all(kept.parent().expect("plan files lie in a folder"))?;
        fs::copy(&plan, kept)?;
    }
    let row = Row::new(key, &measured, &meter.allowance, side.commit());
    if matches!(row.verdict, row::Verdict::Fault | row::Verdict::Input) {
        let kept = row::log_file(&arguments.out, arguments.list, side.name(), &row.key.problem);
        fs::create_dir_all(kept.parent().expect("log files lie in a folder"))?;
        fs::write(kept, format!("{}\n{}", measured.stdout, measured.stderr))?;
    }
    Ok(row)
}

/// The programs to measure.
fn sides(arguments: &args::Bench) -> io::Result<Vec<Side>> {
    let only =
        arguments.only.unwrap_or(if arguments.peer.is_some() { Only::Both } else { Only::Ours });
    let mut sides = Vec::new();
    if only != Only::Peer {
        sides.push(Side::ours(arguments.ours.as_deref())?);
    }
    if only != Only::Ours {
        let Some(peer) = &arguments.peer else {
            return Err(io::Error::other(
                "name the peer: `--peer PATH/fast-downward.py`, or CAVEAT_PEER",
            ));
        };
        sides.push(Side::peer(peer, &arguments.python)?);
    }
    Ok(sides)
}

/// The CPU time that a task of `list` gets where nothing else is said.
fn default_time(list: List) -> Duration {
    match list {
        List::Opt | List::Sat => Duration::from_secs(30),
        List::Ground => Duration::from_mins(1),
    }
}

/// A bar on a terminal, nothing elsewhere.
fn progress(length: usize, terminal: &Terminal) -> ProgressBar {
    if !terminal.watched {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {elapsed} {wide_msg}");
    ProgressBar::new(length as u64).with_style(style.expect("the template is well formed"))
}
