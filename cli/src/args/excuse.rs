//! The command line of `caveat excuse` as data.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};

use super::{OutputFormat, bytes, duration};

/// How the answer of `excuse` is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AnswerFormat {
    /// In words.
    Full,
    /// As one JSON document.
    Json,
}

impl AnswerFormat {
    /// How diagnostics look beside it.
    pub fn of_diagnostics(self) -> OutputFormat {
        match self {
            Self::Full => OutputFormat::Full,
            Self::Json => OutputFormat::Json,
        }
    }
}

/// `caveat excuse`.
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
#[derive(Debug, Args)]
#[command(
    override_usage = "caveat excuse [OPTIONS] [DOMAIN] PROBLEM",
    after_help = "\
Examples:
  caveat excuse problem.pddl
      why there is no plan, and the smallest changes with which there is one; the domain is found beside the problem
  caveat excuse --cost road=2 --protect weight --apply mended.pddl domain.pddl problem.pddl
      roads are cheaper to change than usual, weights must stay; the changed problem goes to a file
  caveat excuse --demonstrate lesson problem.pddl
      what a human should show the robot

Exit codes: 0 an excuse was found, 10 the problem has a plan as it is, 11 there is none, 12 not known within the limits, 2 could not run."
)]
pub struct Excuse {
    /// The problem, or the domain and the problem; `-` is the standard input.
    #[arg(required = true, num_args = 1..=2, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Change at most so many things at once.
    #[arg(long, value_name = "N", default_value = "64")]
    pub max_edits: usize,
    /// Show so many excuses at most.
    #[arg(long, value_name = "N", default_value = "10", conflicts_with = "all")]
    pub limit: usize,
    /// Show all excuses that cost as little as the cheapest.
    #[arg(long)]
    pub all: bool,
    /// What it costs to change a fact of a predicate. By default 1, 3 for what no action changes and relates several objects, and 10 for what stands
    /// for a type in a domain without types.
    #[arg(long, value_name = "PREDICATE=N", value_delimiter = ',')]
    pub cost: Vec<String>,
    /// Leave the facts of these predicates as they are.
    #[arg(long, value_name = "PREDICATE", value_delimiter = ',')]
    pub protect: Vec<String>,
    /// Make true only facts of these predicates.
    #[arg(long, value_name = "PREDICATE", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Let the goal itself be changed, too.
    #[arg(long)]
    pub edit_goal: bool,
    /// How many new objects of each type there may be.
    #[arg(long, value_name = "N", default_value = "1")]
    pub new_objects: u32,
    /// What a new object costs, without its facts.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..))]
    pub object_cost: u32,
    /// Take nothing for granted that only the initial state suggests, such as that a thing is in one place.
    #[arg(long)]
    pub presume_nothing: bool,
    /// More groups of atoms that exclude each other, written like annotations: (:exactly-one (open ?d) (closed ?d)).
    #[arg(long, value_name = "FILE")]
    pub groups: Option<PathBuf>,
    /// Write the problem as the first excuse changes it.
    #[arg(long, value_name = "FILE")]
    pub apply: Option<PathBuf>,
    /// Search nothing; write a domain and a problem in which the changes are actions with costs, for any planner that minimises cost.
    /// New objects are not among them, and their number is not limited.
    #[arg(long, value_name = "FOLDER")]
    pub export: Option<PathBuf>,
    /// Search nothing; print what may be changed at a cost of at most N, as JSON.
    #[arg(long, value_name = "N")]
    pub variables: Option<u32>,
    /// Say which parts of the goal cannot be had together.
    #[arg(long)]
    pub goals: bool,
    /// Say which missing operators would be enough.
    #[arg(long)]
    pub operators: bool,
    /// Write what a human should demonstrate: the state to begin with and the state to reach, in words and as a problem.
    #[arg(long, value_name = "FOLDER")]
    pub demonstrate: Option<PathBuf>,
    /// The domain as it was extended after a demonstration: say whether the demonstration reaches an excuse and the problem now has a plan.
    #[arg(long, value_name = "DOMAIN", requires = "demonstration")]
    pub check_demo: Option<PathBuf>,
    /// The demonstration: a plan in the actions of the extended domain.
    #[arg(long, value_name = "PLAN", requires = "check_demo")]
    pub demonstration: Option<PathBuf>,
    /// CPU time to use at most, such as 30s, 5m or 1h.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub time_limit: Option<Duration>,
    /// Resident memory to use at most, such as 500M or 6G.
    #[arg(long, value_name = "SIZE", value_parser = bytes)]
    pub memory_limit: Option<u64>,
    /// How the answer looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: AnswerFormat,
}
