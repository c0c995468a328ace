//! The command line of `caveat simulate` as data.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `caveat simulate`.
#[derive(Debug, Args)]
#[command(
    arg_required_else_help = true,
    after_help = "\
Examples:
  caveat simulate demo kitchen --person 7 --seed 1 -o demo.jsonl
      person 7 shows how a plate gets into a closed drawer; what really happened goes to demo.truth.jsonl
  caveat simulate demo kitchen --task guided -o opening.jsonl
      the same person shows only how the drawer is opened
  caveat simulate run kitchen sas_plan --routines learned.routines.json
      carry a plan out with the way points of a demonstration, and say whether the goal is reached

Exit codes: 0 done and the goal was reached, 1 it was not, 2 could not run."
)]
pub struct Simulate {
    /// What to do.
    #[command(subcommand)]
    pub what: What,
}

/// What to do in a world.
#[derive(Debug, Subcommand)]
pub enum What {
    /// Let somebody demonstrate something, and log it.
    Demo(Demo),
    /// Carry a plan out, and say whether the goal is reached.
    Run(Run),
    /// Put cubes onto each other, again and again: trials for `caveat causal`.
    Stack(StackTrials),
    /// List the worlds, with what can be shown in them and asked for.
    List,
}

/// How many trials, and where to.
#[derive(Debug, Args)]
pub struct TrialFile {
    /// How many trials.
    #[arg(long, value_name = "N", default_value = "1000")]
    pub samples: u64,
    /// What is set and what chance does.
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
    /// Where they are written: CSV, or Parquet (.parquet). What they are goes beside it, into a file that ends in .sheet.json.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// `caveat simulate stack`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat simulate stack --samples 3000 -o trials.csv
      one cube is let go over another, 3000 times
  caveat simulate stack --cubes 3 --samples 500 --seed 2 -o towers.parquet
      towers of three cubes on a first one
  caveat simulate stack --world domains/worlds/stack-real.json --friction 0.2 -o slippery.csv
      another world: other measures, and less friction still")]
pub struct StackTrials {
    /// How many cubes are put onto the first one.
    #[arg(long, value_name = "N", default_value = "1")]
    pub cubes: usize,
    /// The measures of the world (JSON); by default those of domains/worlds/stack.json.
    #[arg(long, value_name = "FILE")]
    pub world: Option<PathBuf>,
    /// The edge of the cubes, in cm.
    #[arg(long, value_name = "CM", allow_negative_numbers = true)]
    pub size: Option<f64>,
    /// How much of its speed a cube keeps when it bounces, from 0 to 1.
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub restitution: Option<f64>,
    /// Coulomb's coefficient.
    #[arg(long, value_name = "COEFFICIENT", allow_negative_numbers = true)]
    pub friction: Option<f64>,
    /// How many times as much the gripper errs.
    #[arg(long, value_name = "FACTOR", default_value = "1", allow_negative_numbers = true)]
    pub noise: f64,
    /// The trials.
    #[command(flatten)]
    pub trials: TrialFile,
}

/// What a demonstrator shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TaskName {
    /// Everything that the world is about.
    Full,
    /// Only what the robot cannot do.
    Guided,
    /// One cube on another.
    StackOne,
    /// A tower of three cubes.
    StackTwo,
    /// Nothing: hands at rest.
    Nothing,
}

/// `caveat simulate demo`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat simulate demo kitchen -o demo.jsonl
      a whole demonstration
  caveat simulate demo bottle --person 3 --csv -o demo.csv
      by somebody else, as CSV
  caveat simulate demo cubes --task stack-one --seed 5 --svg demo.svg -o demo.jsonl
      with a picture of some frames")]
pub struct Demo {
    /// The world.
    #[arg(value_name = "WORLD")]
    pub world: String,
    /// What is shown; by default the first that `list` names.
    #[arg(long, value_name = "TASK")]
    pub task: Option<TaskName>,
    /// Who shows it: how fast, how surely, and how well tracked. Persons from 1000 on are drawn from wider ranges.
    #[arg(long, value_name = "N", default_value = "1")]
    pub person: u32,
    /// Where things stand, and what chance does.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// Where the log is written. What really happened goes beside it, into a file that ends in .truth.jsonl.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Write CSV instead of JSON Lines.
    #[arg(long)]
    pub csv: bool,
    /// Draw some frames (SVG).
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
}

/// `caveat simulate run`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat simulate run kitchen sas_plan --routines learned.routines.json
      a plan, with the way points that `caveat learn -o learned.pddl` wrote
  caveat simulate run cubes --seed 5 --goal two-towers sas_plan --routines learned.routines.json
      towards another goal than the first one
  caveat simulate run bottle sas_plan --routines learned.routines.json --svg run.svg
      with a picture of some frames")]
pub struct Run {
    /// The world.
    #[arg(value_name = "WORLD")]
    pub world: String,
    /// The plan, of which steps with the same number before them are taken together; `-` is the standard input.
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// The way points of the actions.
    #[arg(long, value_name = "FILE")]
    pub routines: PathBuf,
    /// Where things stand.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// The goal; by default the first that `list` names.
    #[arg(long, value_name = "NAME")]
    pub goal: Option<String>,
    /// Log what happens.
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// Draw some frames (SVG).
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
}
