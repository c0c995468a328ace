//! `caveat plan`: a domain and a problem go in; a plan file, Fast Downward's lines and its exit code come out.

mod desk;
mod turns;
mod joint;
mod better;

use std::str::FromStr;

use lang::execute::Executor;
use lang::plan::{self, Plan};
use lang::validate::{self, Success, Verdict};
use planner::heuristics::Kind;
use planner::limits::Stop;
use planner::search::{self, Config, Status, Strategy};
use planner::solve::Obstacle;

use crate::args;
use crate::exit::Exit;
use crate::files::Complaint;
use crate::input::{self, Input, Reader};
use crate::limits::{Allowance, Watch, cpu_time, peak_memory};
use crate::pipeline::{self, End};
use crate::progress::Progress;
use crate::terminal::Terminal;
use desk::Desk;

/// Plans, or lists what it can plan with.
pub fn run(arguments: &args::Plan, terminal: &mut Terminal) -> Exit {
    if arguments.list {
        list(terminal);
        return Exit::Done;
    }
    let strategy = match strategy(arguments) {
        Ok(strategy) => strategy,
        Err(complaint) => {
            terminal.say(complaint);
            return Exit::Usage;
        }
    };
    let input = match input::load(
        Reader::default(),
        "plan",
        &arguments.files,
        arguments.output_format,
        terminal,
    ) {
        Ok(input) => input,
        Err(refusal) => return refusal.of_plan(),
    };
    let executor = match Executor::new(&input.domain, &input.problem) {
        Ok(executor) => executor,
        Err(unstratified) => {
            input.report(unstratified.diagnostic(&input.domain), arguments.output_format, terminal);
            return Exit::Input;
        }
    };
    let allowance = Allowance { time: arguments.time_limit, memory: arguments.memory_limit };
    let watch = Watch::start(allowance, true);
    if input.domain.is_multi_agent() {
        return joint::run(arguments, strategy, &input, &executor, &watch, terminal);
    }
    let progress = Progress::start(terminal.watched);
    progress.phase("grounding");
    let task = match pipeline::ground(&input.domain, &input.problem, &watch) {
        Ok(task) => task,
        Err(obstacle) => {
            drop(progress);
            return explain(&obstacle, &input, arguments, &watch, terminal);
        }
    };
    let config = Config {
        strategy,
        anytime: arguments.anytime,
        seed: arguments.seed,
        progress: Some(progress.counters()),
    };
    let unit_cost = task.encoded.task.operators.iter().all(|operator| operator.cost == 1);
    let mut desk = Desk::new(arguments, &watch);
    if let Err(complaint) = desk.clear() {
        drop(progress);
        terminal.say(complaint);
        return Exit::Input;
    }
    let mut judge = Judge { input: &input, executor, unit_cost };
    progress.phase("searching");
    let end = pipeline::search(&task.ready(), &config, &watch, |plan| {
        progress.suspend(|| judge.take(&plan, &mut desk, terminal));
    });
    drop(progress);
    let (written, failure) = (desk.written() > 0, desk.failure);
    failure.unwrap_or_else(|| conclude(&end, written, arguments.anytime, &watch, terminal))
}

/// The search that the command line asks for.
fn strategy(arguments: &args::Plan) -> Result<Strategy, Complaint> {
    let name = match (&arguments.search, &arguments.heuristic, arguments.optimal) {
        (None, None, true) => return Ok(Strategy::Optimal),
        (None, None, false) => return Ok(Strategy::First),
        (Some(search), Some(heuristic), _) => format!("{search}({heuristic})"),
        (Some(search), None, _) => search.clone(),
        (None, Some(heuristic), true) => format!("astar({heuristic})"),
        (None, Some(heuristic), false) => format!("lazy({heuristic})"),
    };
    Strategy::from_str(&name).map_err(|message| {
        Complaint::with_help(message, "`caveat plan --list` prints what there is")
    })
}

/// Prints all searches and heuristics, with what is known of each.
fn list(terminal: &mut Terminal) {
    terminal.line("Searches:");
    for profile in search::list() {
        let optimal = if profile.optimal { " [optimal with an admissible heuristic]" } else { "" };
        terminal.line(format_args!(
            "  {:<10} {}{optimal}\n{:13}{}",
            profile.name, profile.summary, "", profile.source
        ));
    }
    terminal.line("\nHeuristics:");
    for kind in Kind::ALL {
        let profile = kind.profile();
        let promises = [
            (profile.admissible, "admissible"),
            (profile.consistent, "consistent"),
            (profile.safe, "safe"),
            (profile.conditional_effects, "conditional effects"),
            (profile.axioms, "axioms"),
            (profile.preferred, "preferred operators"),
        ];
        let promises: Vec<&str> =
            promises.into_iter().filter(|(holds, _)| *holds).map(|(_, word)| word).collect();
        terminal.line(format_args!("  {:<10} {}", profile.name, profile.summary));
        terminal.line(format_args!(
            "{:13}{}\n{:13}{}",
            "",
            promises.join(", "),
            "",
            profile.source
        ));
    }
}

/// Says why there is no task to search.
fn explain(
    obstacle: &Obstacle,
    input: &Input,
    arguments: &args::Plan,
    watch: &Watch,
    terminal: &mut Terminal,
) -> Exit {
    match obstacle {
        Obstacle::Unsupported(unsupported) => {
            input.report(input::unsupported(unsupported), arguments.output_format, terminal);
            Exit::Unsupported
        }
        Obstacle::Unreachable => {
            terminal.line(
                "There is no plan: the goal cannot be reached, even if nothing were ever deleted.",
            );
            Exit::Unreachable
        }
        Obstacle::Stopped(stop, phase) => {
            terminal.say(stopped(*stop, phase));
            watch.exit(*stop)
        }
    }
}

/// Why a run was ended, and where.
fn stopped(stop: Stop, phase: &str) -> String {
    match stop {
        Stop::Time => format!("The time limit is reached while {phase}."),
        Stop::Memory => format!("The memory limit is reached while {phase}."),
        Stop::Signal => format!("Asked to stop while {phase}."),
    }
}

/// Fast Downward's lines about a search, and how it ends.
fn conclude(end: &End, found: bool, anytime: bool, watch: &Watch, terminal: &mut Terminal) -> Exit {
    let statistics = &end.statistics;
    if let Some(estimate) = statistics.initial_h {
        terminal.line(format_args!("Initial heuristic value: {estimate}"));
    }
    let counts = [
        ("Expanded", statistics.expanded),
        ("Reopened", statistics.reopened),
        ("Evaluated", statistics.evaluated),
        ("Generated", statistics.generated),
    ];
    for (word, count) in counts {
        terminal.line(format_args!("{word} {count} state(s)."));
    }
    terminal.line(format_args!("Dead ends: {} state(s).", statistics.dead_ends));
    terminal.line(format_args!("Number of registered states: {}", statistics.registered));
    terminal.line(format_args!("Search time: {:.6}s", end.time.as_secs_f64()));
    terminal.line(format_args!("Total time: {:.6}s", cpu_time().as_secs_f64()));
    terminal.line(format_args!("Peak memory: {} KB", peak_memory()));
    match end.status {
        Status::Solved | Status::Stopped(_) if found => {
            terminal.line("Solution found.");
            if end.optimal {
                terminal.say("The last plan is proved to be optimal.");
            }
            match watch.limits.stopped().filter(|_| anytime && !end.optimal) {
                Some(stop) => {
                    terminal.say(stopped(stop, "looking for better plans"));
                    watch.exit(stop)
                }
                None => Exit::Done,
            }
        }
        Status::Solved => Exit::Bug,
        Status::Stopped(stop) => {
            terminal.say(stopped(stop, "searching"));
            watch.exit(stop)
        }
        Status::Unsolvable => {
            terminal.line("There is no plan: all reachable states were looked at.");
            Exit::Exhausted
        }
        Status::Incomplete | Status::Spent => {
            terminal.line("No plan was found, which does not prove that there is none.");
            Exit::Incomplete
        }
    }
}

/// Checks every plan before it is written.
struct Judge<'a> {
    input: &'a Input,
    executor: Executor<'a>,
    /// Whether every operator costs 1.
    unit_cost: bool,
}

impl Judge<'_> {
    /// Validates, writes and prints a plan.
    fn take(&mut self, plan: &Plan, desk: &mut Desk<'_>, terminal: &mut Terminal) {
        let (domain, problem) = (&self.input.domain, &self.input.problem);
        let success = match validate::judge(&self.executor, plan) {
            Verdict::Valid(success) => success,
            verdict @ Verdict::Invalid(_) => {
                desk.refuse(&validate::story(&verdict, domain, problem, plan), terminal);
                return;
            }
        };
        let text = plan::write(plan, domain, problem, success.cost, self.unit_cost);
        desk.save(&text, terminal);
        self.print(plan, &success, terminal);
    }

    /// Fast Downward's lines about a plan.
    fn print(&self, plan: &Plan, success: &Success, terminal: &mut Terminal) {
        let (domain, problem) = (&self.input.domain, &self.input.problem);
        terminal.line("Solution found!");
        let mut state = self.executor.initial();
        for step in &plan.steps {
            let cost =
                self.executor.cost(&state, step).expect("a valid plan has a cost at each step");
            self.executor.apply(&mut state, step);
            let line = plan::line(step, domain, problem);
            terminal.line(format_args!("{} ({})", line.trim_matches(['(', ')']), cost.normalize()));
        }
        terminal.line(format_args!("Plan length: {} step(s).", success.steps));
        terminal.line(format_args!("Plan cost: {}", success.cost.normalize()));
        terminal.flush();
    }
}
