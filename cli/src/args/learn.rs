//! The command line of `caveat learn` as data.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Which preconditions an operator gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RuleName {
    /// Only what the action changes; of logs, algorithm 4 of the thesis to the letter. Plans may fail.
    Changed,
    /// All that held whenever the action was taken. Plans do not fail.
    Safe,
    /// As `safe`, and what may not be needed is named with its evidence.
    Both,
}

/// Which deeds of two hands only go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SynergyName {
    /// Whatever happened at the same time while neither hand was idle.
    Thesis,
    /// Whatever happened while both hands were in teach mode.
    Flag,
    /// What one hand could not have done alone.
    Needed,
}

/// What happens at a line that cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BadLines {
    /// Nothing is learned.
    Stop,
    /// It is named and left out.
    Skip,
}

/// `caveat learn`.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
#[derive(Debug, Args)]
#[command(
    override_usage = "caveat learn [OPTIONS] LOG...",
    arg_required_else_help = true,
    after_help = "\
Examples:
  caveat learn -o learned.pddl --problem problem.pddl demo.jsonl
      a domain from a demonstration, and the problem that it began with
  caveat learn --extend domain.pddl --config kitchen.json -o taught.pddl opening.jsonl
      what is new in a demonstration, added to a domain in the words of that domain
  caveat learn --domain domain.pddl traces/*
      operators from traces of states and actions; of the domain only the names and types are used

Exit codes: 0 done, 1 nothing was learned or a line could not be read, 2 could not run."
)]
pub struct Learn {
    /// Logs of hands and objects (JSON Lines or CSV, see docs/logs.md), or traces of states and actions; `-` is the standard input.
    #[arg(required_unless_present = "print_config", value_name = "LOG")]
    pub files: Vec<PathBuf>,
    /// Where the domain is written, instead of the output. Way points go beside it, into a file that ends in .routines.json.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// What the domain is called.
    #[arg(long, value_name = "NAME", default_value = "learned")]
    pub name: String,
    /// Which preconditions operators get.
    #[arg(long, value_name = "RULE", default_value = "both")]
    pub rule: RuleName,
    /// Demand also that what never held before an action does not hold.
    #[arg(long)]
    pub negative: bool,
    /// The share of the examples of an action that may be outvoted by the others, as noise.
    #[arg(long, value_name = "SHARE", default_value = "0", value_parser = share)]
    pub tolerance: f64,
    /// A domain to which what is new is added, in its words.
    #[arg(long, value_name = "DOMAIN", conflicts_with_all = ["domain", "agents"])]
    pub extend: Option<PathBuf>,
    /// Of traces: a domain with the predicates, types and parameters; otherwise they are inferred.
    #[arg(long, value_name = "DOMAIN")]
    pub domain: Option<PathBuf>,
    /// Of traces: the problems that say which objects there are and of which types, one for each trace.
    #[arg(long, value_name = "PROBLEM", value_delimiter = ',', requires = "domain")]
    pub objects: Vec<PathBuf>,
    /// Of traces of joint actions: who acts, in the order of the parts of a step.
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "domain")]
    pub acting: Vec<String>,
    /// Who does what a hand did, by their names; hands that are not named are left out. By default each hand stays itself.
    #[arg(long, value_name = "HAND=NAME", value_delimiter = ',', value_parser = pair)]
    pub map: Vec<(String, String)>,
    /// Make those who act agents (MA-PDDL), with moves that keep shared places free.
    #[arg(long)]
    pub agents: bool,
    /// Which deeds of two hands only go together; with --agents.
    #[arg(long, value_name = "HOW", default_value = "needed")]
    pub synergy: SynergyName,
    /// Thresholds and words of observation, as --print-config prints them; what a file leaves out is as usual.
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// What the topics of a recording (*.mcap) or the columns of a table (*.parquet) are about; see docs/logs.md. Only in programs that were built with
    /// the features `mcap` and `lerobot`.
    #[arg(long, value_name = "FILE")]
    pub mapping: Option<PathBuf>,
    /// Print the thresholds and words of observation, and do nothing else.
    #[arg(long)]
    pub print_config: bool,
    /// Print what each hand does and when, instead of a domain.
    #[arg(long)]
    pub segments: bool,
    /// Write the same as a picture (SVG).
    #[arg(long, value_name = "FILE")]
    pub segments_svg: Option<PathBuf>,
    /// Annotated frames, one file for each log: learn the decision tree of activities from them, and print it.
    #[arg(long, value_name = "FILE", value_delimiter = ',')]
    pub truth: Vec<PathBuf>,
    /// Write the problem that the first demonstration began with.
    #[arg(long, value_name = "FILE")]
    pub problem: Option<PathBuf>,
    /// The goal of that problem; by default what the demonstration made true.
    #[arg(long, value_name = "CONDITION", requires = "problem")]
    pub goal: Option<String>,
    /// Write what was demonstrated as a plan in the words of the domain.
    #[arg(long, value_name = "FILE")]
    pub plan_file: Option<PathBuf>,
    /// Write the trace that the operators are learned from, in the form that `AMLGym` and SAM read.
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// What happens at a line that cannot be read.
    #[arg(long, value_name = "WHAT", default_value = "stop")]
    pub bad_lines: BadLines,
}

/// Reads `HAND=NAME`.
fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((hand, name)) if !hand.is_empty() && !name.is_empty() => {
            Ok((hand.to_owned(), name.to_owned()))
        }
        _ => Err("expected a hand and a name, such as `right-hand=robot`".to_owned()),
    }
}

/// Reads a share below one half.
fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..0.5).contains(&share) => Ok(share),
        _ => Err("expected a number from 0 to below 0.5".to_owned()),
    }
}
