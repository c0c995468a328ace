//! The command line as data.

pub mod causal;
pub mod excuse;
pub mod learn;
pub mod simulate;

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgAction, Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use lang::portability::Tool;

use crate::exit::Exit;

/// A planning-language toolchain: a plan, with its caveats.
///
/// It reads PDDL, says what is wrong with it, plans, and checks plans.
#[derive(Debug, Parser)]
#[command(
    name = "caveat",
    version,
    disable_help_subcommand = true,
    disable_help_flag = true,
    arg_required_else_help = true
)]
#[command(
    max_term_width = 100,
    after_help = "\
Examples:
  caveat plan domains/stacking/p01.pddl
      plan a problem; its domain is found beside it
  caveat check domain.pddl problem.pddl
      say what is wrong with two files
  caveat validate domain.pddl problem.pddl sas_plan
      check a plan, step by step"
)]
pub struct Arguments {
    /// Print help.
    // The short layout, whichever way it is asked for: one screen.
    #[arg(short, long, global = true, action = ArgAction::HelpShort)]
    help: Option<bool>,
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Say what is wrong with PDDL files.
    Check(Check),
    /// Lay PDDL files out evenly.
    Fmt(Fmt),
    /// Find a plan.
    Plan(Plan),
    /// Check plans step by step.
    Validate(Validate),
    /// Write a task of several agents in another form.
    Compile(Compile),
    /// Write out the ground task.
    Ground(Ground),
    /// Say why there is no plan, and what would have to be different.
    Excuse(excuse::Excuse),
    /// Learn operators from demonstrations.
    Learn(Box<learn::Learn>),
    /// Let somebody demonstrate in a physical world, or carry a plan out there.
    Simulate(simulate::Simulate),
    /// Learn from trials what causes success and failure, and ask what was learned.
    Causal(Box<causal::Causal>),
    /// Measure this planner and a peer on the same tasks.
    Bench(Bench),
    /// Explain a diagnostic code.
    Explain(Explain),
    /// Serve an editor: diagnostics, completion, renaming and more, as PDDL is typed.
    Lsp(Lsp),
    /// Print a completion script for a shell.
    Completions(Completions),
}

/// How diagnostics look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum OutputFormat {
    /// With the lines of the file, for reading.
    Full,
    /// One line each, for editors and scripts.
    Concise,
    /// One JSON document, as docs/diagnostics.schema.json describes it.
    Json,
    /// SARIF 2.1.0, for tools that gather findings.
    Sarif,
    /// Commands that mark lines in a GitHub workflow.
    Github,
}

/// `caveat check`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat check domain.pddl p01.pddl p02.pddl
      a domain and problems of it
  caveat check --for fast-downward,val problem.pddl
      a problem, with the domain that lies beside it, and what these two programs would refuse
  caveat check --fix domain.pddl
      mend what can only have been meant in one way

Exit codes: 0 nothing wrong, 1 something is wrong (warnings count), 2 a file could not be read.")]
pub struct Check {
    /// Domains and problems, folders of them, and lists of agents (*.addl); `-` is the standard input.
    #[arg(required_unless_present = "support", value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Say what is supported of each requirement, and by which planners it is planned; as a table in Markdown.
    #[arg(long, conflicts_with_all = ["files", "fix"])]
    pub support: bool,
    /// How diagnostics look.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: OutputFormat,
    /// Apply the safe fixes to the files, then say what is left.
    #[arg(long)]
    pub fix: bool,
    /// Warn of what these programs refuse or misread, too.
    #[arg(long = "for", value_name = "TOOL", value_delimiter = ',', value_parser = tools())]
    pub tools: Vec<Tool>,
}

/// Reads the name of a program; LAMA reads files with Fast Downward's translator.
fn tools() -> impl TypedValueParser<Value = Tool> {
    let possible = |tool: Tool| match tool {
        Tool::FastDownward => PossibleValue::new(tool.name()).alias("lama"),
        _ => PossibleValue::new(tool.name()),
    };
    PossibleValuesParser::new(Tool::ALL.map(possible)).map(|name| {
        let name = if name == "lama" { Tool::FastDownward.name() } else { &name };
        Tool::named(name).expect("only the names of tools are possible")
    })
}

/// `caveat fmt`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat fmt domain.pddl p01.pddl
      lay two files out, comments and names as they are
  caveat fmt --check domains
      list the files in a folder and below it that would change
  caveat fmt --stdin < domain.pddl
      print the result, as editors want it

A file whose parentheses do not match stays as it is; `caveat check` says where.

Exit codes: 0 done, 1 with --check if some file would change, 2 a file could not be read or written.")]
pub struct Fmt {
    /// Files, and folders whose *.pddl and *.hddl are meant; `-` is the standard input.
    #[arg(required_unless_present = "stdin", value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write nothing; list the files that would change.
    #[arg(long)]
    pub check: bool,
    /// Read the standard input and print the result.
    #[arg(long)]
    pub stdin: bool,
}

/// What a good joint plan has little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ObjectiveName {
    /// Joint steps.
    Steps,
    /// Actions, of all agents.
    Actions,
    /// What the metric counts, summed over all actions.
    Cost,
}

/// How much the parts of a joint step may have to do with one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ConcurrencyName {
    /// What action atoms do not forbid is allowed.
    Liberal,
    /// No part may destroy the precondition of another.
    Safe,
}

/// How a joint plan is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum JointFormat {
    /// One joint step a line.
    Steps,
    /// A picture: one row for each agent, one column for each joint step.
    Gantt,
    /// One JSON document.
    Json,
}

/// `caveat plan`.
#[derive(Debug, Args)]
#[command(override_usage = "caveat plan [OPTIONS] [DOMAIN] PROBLEM", arg_required_else_help = true, after_help = plan_help())]
pub struct Plan {
    /// The problem, or the domain and the problem; `-` is the standard input. A domain that is left out is looked for beside
    /// the problem. Of a task in the factored form: the files of all agents, their folder, or their list (*.addl).
    #[arg(required_unless_present = "list", value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Find a plan of least cost.
    #[arg(long, conflicts_with = "anytime")]
    pub optimal: bool,
    /// After the first plan go on for better ones until a limit is reached.
    #[arg(long)]
    pub anytime: bool,
    /// Search like this instead of the usual choice; see --list.
    #[arg(long, value_name = "NAME")]
    pub search: Option<String>,
    /// Search with this heuristic; see --list.
    #[arg(long, value_name = "NAME")]
    pub heuristic: Option<String>,
    /// Several agents: what a good joint plan has little of. By default what the metric counts, and without one joint steps.
    #[arg(long, value_name = "WHAT")]
    pub objective: Option<ObjectiveName>,
    /// Several agents: whether a part of a joint step may destroy the precondition of another. By default only where action atoms
    /// say what excludes what.
    #[arg(long, value_name = "MODE")]
    pub concurrency: Option<ConcurrencyName>,
    /// Several agents: how many actions a joint step has at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub joint_size: Option<u32>,
    /// Several agents: how the joint plan is printed.
    #[arg(long, value_name = "FORMAT", default_value = "steps")]
    pub joint_format: JointFormat,
    /// CPU time to use at most, such as 30s, 5m or 1h.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub time_limit: Option<Duration>,
    /// Resident memory to use at most, such as 500M or 6G.
    #[arg(long, value_name = "SIZE", value_parser = bytes)]
    pub memory_limit: Option<u64>,
    /// The seed of whatever is left to chance.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// Where the plan is written; with --anytime FILE.1, FILE.2 and so on.
    #[arg(long, value_name = "FILE", default_value = "sas_plan")]
    pub plan_file: PathBuf,
    /// How diagnostics look.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: OutputFormat,
    /// Plan nothing; print the searches and heuristics, with what is known of each.
    #[arg(long)]
    pub list: bool,
}

/// The examples of `plan` and its exit codes.
fn plan_help() -> String {
    let examples = "\
Examples:
  caveat plan problem.pddl
      the first plan, to the output and to the file sas_plan; the domain is found beside the problem
  caveat plan --optimal --time-limit 5m --memory-limit 6G domain.pddl problem.pddl
      a plan of least cost, within limits
  caveat plan --anytime --time-limit 30s --plan-file plans/mine domain.pddl problem.pddl
      better and better plans: plans/mine.1, plans/mine.2 and so on";
    format!("{examples}\n\n{}", Exit::plan_table().trim_end())
}

/// `caveat validate`.
#[derive(Debug, Args)]
#[command(
    override_usage = "caveat validate [OPTIONS] [DOMAIN] PROBLEM PLAN...",
    after_help = "\
Examples:
  caveat validate domain.pddl problem.pddl sas_plan
      one plan
  caveat validate problem.pddl sas_plan.1 sas_plan.2
      several plans; the domain is found beside the problem
  caveat plan problem.pddl > /dev/null && caveat validate problem.pddl - < sas_plan
      a plan from the standard input

Exit codes: 0 all plans are valid, 1 one is not, 2 a file could not be read or is not PDDL."
)]
pub struct Validate {
    /// The domain, unless it lies beside the problem, the problem, and plans; `-` is the standard input. Of a task in the factored
    /// form: the files of all agents, their folder, or their list (*.addl), and plans.
    #[arg(required = true, num_args = 2.., value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Several agents: whether a part of a joint step may destroy the precondition of another. By default only where action atoms
    /// say what excludes what.
    #[arg(long, value_name = "MODE")]
    pub concurrency: Option<ConcurrencyName>,
    /// How diagnostics look.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: OutputFormat,
}

/// How a task of several agents is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// As a task without agents, which any planner reads.
    Classical,
    /// As one domain and one problem that say what is private to whom.
    Unfactored,
    /// As one domain and one problem for each agent, and a list of the agents.
    Factored,
}

/// `caveat compile`.
#[derive(Debug, Args)]
#[command(
    override_usage = "caveat compile [OPTIONS] -o FOLDER [DOMAIN] PROBLEM",
    after_help = "\
Examples:
  caveat compile -o classical domain.pddl problem.pddl
      a domain and a problem for planners that know nothing of agents
  caveat compile --to unfactored -o whole domain-a.pddl problem-a.pddl domain-b.pddl problem-b.pddl
      the files of two agents as one domain and one problem
  caveat compile --to factored -o parts problem.pddl
      the files of each agent; the domain is found beside the problem

The names of the files that were written go to the output.

Exit codes: 0 done, 1 the task cannot be written in this form, 2 could not run."
)]
pub struct Compile {
    /// The problem, or the domain and the problem; `-` is the standard input. Of a task in the factored form: the files of all
    /// agents, their folder, or their list (*.addl).
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// The folder to write into; it is made if it is not there.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: PathBuf,
    /// How the task is written.
    #[arg(long, value_name = "FORM", default_value = "classical")]
    pub to: Form,
    /// Whether a part of a joint step may destroy the precondition of another. By default only where action atoms say what excludes what.
    #[arg(long, value_name = "MODE")]
    pub concurrency: Option<ConcurrencyName>,
    /// How many actions a joint step has at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub joint_size: Option<u32>,
    /// Say what these programs refuse or misread in what was written.
    #[arg(long = "for", value_name = "TOOL", value_delimiter = ',', value_parser = tools())]
    pub tools: Vec<Tool>,
    /// How diagnostics look.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: OutputFormat,
}

/// What `ground` writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum GroundFormat {
    /// How many facts, operators and axioms there are.
    Summary,
    /// The task as Fast Downward's translator would write it.
    Sas,
}

/// `caveat ground`.
#[derive(Debug, Args)]
#[command(
    override_usage = "caveat ground [OPTIONS] [DOMAIN] PROBLEM",
    after_help = "\
Examples:
  caveat ground problem.pddl
      how large the ground task is; the domain is found beside the problem
  caveat ground --format sas domain.pddl problem.pddl > output.sas
      the task for another program's search
  caveat ground --format sas -o output.sas domain.pddl problem.pddl
      the same, with the counts on the output

Exit codes: 0 done, 1 the goal is out of reach, 2 could not run."
)]
pub struct Ground {
    /// The problem, or the domain and the problem; `-` is the standard input.
    #[arg(required = true, num_args = 1..=2, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// What to write.
    #[arg(long, value_name = "FORMAT", default_value = "summary")]
    pub format: GroundFormat,
    /// Where to write the task [default: the output].
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// CPU time to use at most.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub time_limit: Option<Duration>,
    /// Resident memory to use at most.
    #[arg(long, value_name = "SIZE", value_parser = bytes)]
    pub memory_limit: Option<u64>,
    /// How diagnostics look.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: OutputFormat,
}

/// `caveat explain`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat explain E0101
      the page of a code
  caveat explain unknown-predicate
      the same by its name
  caveat explain
      all codes with their names

Exit codes: 0 explained, 2 there is no such code.")]
pub struct Explain {
    /// The code or the name of a diagnostic.
    #[arg(value_name = "CODE")]
    pub code: Option<String>,
}

/// `caveat lsp`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat lsp
      what an editor starts; it speaks the language server protocol on its standard streams
  vim.lsp.start_client { cmd = { 'caveat', 'lsp' }, root_dir = vim.fn.getcwd() }
      in neovim; docs/editors.md has the configuration of others
  (add-to-list 'eglot-server-programs '(pddl-mode \"caveat\" \"lsp\"))
      in Emacs

Exit codes: 0 ended as the editor asked, 1 ended without being asked, 2 the editor does not speak the protocol.")]
pub struct Lsp {
    /// Use the standard streams, which is the only way; editors pass this.
    #[arg(long)]
    pub stdio: bool,
}

/// `caveat completions`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat completions bash > ~/.local/share/bash-completion/completions/caveat
  caveat completions zsh > ~/.zfunc/_caveat
  caveat completions fish > ~/.config/fish/completions/caveat.fish")]
pub struct Completions {
    /// Which shell.
    pub shell: Shell,
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
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
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
    /// Measure again what was measured while the machine had other work (load above 1.5); reports take the better row.
    #[arg(long)]
    pub again: bool,
    /// The program to measure as ours [default: this one].
    #[arg(long, value_name = "PROGRAM")]
    pub ours: Option<PathBuf>,
    /// The peer: Fast Downward's driver script.
    #[arg(long, value_name = "FAST-DOWNWARD.PY", env = "CAVEAT_PEER", hide_env_values = true)]
    pub peer: Option<PathBuf>,
    /// The Python that runs the peer.
    #[arg(
        long,
        value_name = "PROGRAM",
        env = "CAVEAT_PEER_PYTHON",
        hide_env_values = true,
        default_value = "python3"
    )]
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
