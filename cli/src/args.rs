//! The command line as data.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// A planning-language toolchain: a plan, with its caveats.
#[derive(Debug, Parser)]
#[command(name = "caveat", version, disable_help_subcommand = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Measure this planner and a peer on the same tasks.
    Bench(Bench),
}

/// Which tasks, and what to measure on them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, ValueEnum)]
pub enum List {
    /// Optimal plans: `plan --optimal` against A* with LM-cut.
    Opt,
    /// The first plan: `plan` against the peer's LAMA, first iteration.
    Sat,
    /// The ground task, written as a whole: `ground --format sas` against the peer's translator.
    Ground,
}

/// Whose rows to fill.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Only {
    /// Ours.
    Ours,
    /// The peer's.
    Peer,
    /// Both, task by task, taking turns in who goes first.
    Both,
}

/// `caveat bench`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat bench opt --subset --only ours
      twenty tasks, ours alone: for daily work
  caveat bench sat --full --peer ~/downward/fast-downward.py
      the whole list, both planners, each task once; stop it and start it again at will
  caveat bench ground --report
      what the rows measured so far say, as Markdown

Rows go to OUT/LIST-SIDE.tsv as they finish. A task is not run again while there is a row
of the same machine, program and limits.")]
pub struct Bench {
    /// Which tasks, and what to measure on them.
    pub list: List,
    /// Whose rows to fill [default: both where a peer is named, else ours].
    #[arg(long)]
    pub only: Option<Only>,
    /// The fixed subset of 40 tasks: 20 for `opt`, 20 for `sat`, all for `ground`.
    #[arg(long, conflicts_with_all = ["full", "tasks"])]
    pub subset: bool,
    /// The full list (the default).
    #[arg(long)]
    pub full: bool,
    /// The tasks of this file: domain and problem with a tab between, relative to the benchmark folder.
    #[arg(long, value_name = "FILE", conflicts_with = "full")]
    pub tasks: Option<PathBuf>,
    /// CPU time for each task, user and system, of all its processes [default: 30s, ground: 60s].
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub time_limit: Option<Duration>,
    /// Resident memory for each task.
    #[arg(long, value_name = "SIZE", value_parser = bytes, default_value = "6G")]
    pub memory_limit: u64,
    /// The program to measure as ours [default: this one].
    #[arg(long, value_name = "PROGRAM")]
    pub ours: Option<PathBuf>,
    /// The peer: Fast Downward's driver script.
    #[arg(long, value_name = "FAST-DOWNWARD.PY", env = "CAVEAT_PEER")]
    pub peer: Option<PathBuf>,
    /// The Python that runs the peer.
    #[arg(long, value_name = "PROGRAM", env = "CAVEAT_PEER_PYTHON", default_value = "python3")]
    pub python: PathBuf,
    /// End a task after this many times its CPU time on the clock; it is measured again the next time.
    #[arg(long, value_name = "FACTOR", default_value = "3")]
    pub wall_factor: u32,
    /// Keep the measured processes on this CPU.
    #[arg(long, value_name = "CPU")]
    pub pin: Option<usize>,
    /// Where rows and plans are kept.
    #[arg(long, value_name = "FOLDER", default_value = "target/bench")]
    pub out: PathBuf,
    /// Measure nothing; print what the rows say as Markdown.
    #[arg(long)]
    pub report: bool,
}

/// Reads `30`, `30s`, `1.5m` or `2h`.
pub fn duration(text: &str) -> Result<Duration, String> {
    let (number, unit) = split(text);
    let factor = match unit {
        "" | "s" => 1.0,
        "ms" => 0.001,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err(format!("`{unit}` is no unit of time; write 30s, 5m or 1h")),
    };
    match number.parse::<f64>() {
        Ok(number) if number > 0.0 && number * factor < 1e9 => {
            Ok(Duration::from_secs_f64(number * factor))
        }
        _ => Err("write a positive time such as 30s, 5m or 1h".to_string()),
    }
}

/// Reads `500M`, `6G` or `6GiB`; a bare number counts mebibytes, as in Fast Downward.
pub fn bytes(text: &str) -> Result<u64, String> {
    let (number, unit) = split(text);
    let unit = unit.to_ascii_lowercase();
    let factor = match unit.trim_end_matches("ib").trim_end_matches('b') {
        "k" => 1 << 10,
        "" | "m" => 1 << 20,
        "g" => 1 << 30,
        "t" => 1_u64 << 40,
        _ => return Err(format!("`{unit}` is no unit of memory; write 500M or 6G")),
    };
    match number.parse::<f64>() {
        Ok(number) if number > 0.0 && number < 1e9 => Ok((number * factor as f64) as u64),
        _ => Err("write a positive size such as 500M or 6G".to_string()),
    }
}

/// Splits a number from the unit behind it.
fn split(text: &str) -> (&str, &str) {
    let end =
        text.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(text.len());
    (&text[..end], text[end..].trim_start())
}

#[cfg(test)]
mod tests {
    use super::{bytes, duration};
    use std::time::Duration;

    #[test]
    fn times_are_read_with_and_without_a_unit() {
        assert_eq!(duration("30"), Ok(Duration::from_secs(30)));
        assert_eq!(duration("30s"), Ok(Duration::from_secs(30)));
        assert_eq!(duration("5m"), Ok(Duration::from_mins(5)));
        assert_eq!(duration("1.5h"), Ok(Duration::from_mins(90)));
        assert_eq!(duration("200ms"), Ok(Duration::from_millis(200)));
        for bad in ["", "s", "0", "-1s", "5 days", "1e400"] {
            assert!(duration(bad).is_err(), "{bad} is no time");
        }
    }

    #[test]
    fn sizes_are_read_with_and_without_a_unit() {
        assert_eq!(bytes("6G"), Ok(6 << 30));
        assert_eq!(bytes("6GiB"), Ok(6 << 30));
        assert_eq!(bytes("500m"), Ok(500 << 20));
        assert_eq!(bytes("64"), Ok(64 << 20));
        for bad in ["", "G", "0G", "6 pigs"] {
            assert!(bytes(bad).is_err(), "{bad} is no size");
        }
    }
}
