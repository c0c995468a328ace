//! A multi-agent domain and problem go in; a joint plan comes out: compiled, searched, decoded, merged, and validated under the joint semantics.
//!
//! Without a demand for optimality the small compilation comes first, which has shortcuts only; where it has no plan, or takes long,
//! the complete one takes turns with it, each time with a larger budget. The turns count states, not seconds, so runs are repeatable.

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::multiagent::{self, Compiled, Means, Objective, Options};
use lang::plan::{JointPlan, Plan};
use lang::validate::joint::{self as judge, Success, Verdict};
use planner::heuristics::Kind;
use planner::search::{Config, Status, Strategy};

use super::desk::Desk;
use crate::args::{self, ConcurrencyName, ObjectiveName};
use crate::exit::Exit;
use crate::input::{self, Input};
use crate::limits::Watch;
use crate::pipeline::{self, End, Obstacle, Ready};
use crate::progress::Progress;
use crate::terminal::Terminal;

/// How many states the first turn may expand, times the operators of the task, since that is what an expansion takes; each round has four times as many.
const FIRST_TURN: u64 = 20_000_000;

/// Plans for several agents.
pub(super) fn run(
    arguments: &args::Plan,
    strategy: Strategy,
    input: &Input,
    executor: &Executor<'_>,
    watch: &Watch,
    terminal: &mut Terminal,
) -> Exit {
    let mut desk = Desk::new(arguments, watch);
    if let Err(complaint) = desk.clear() {
        terminal.say(complaint);
        return Exit::Input;
    }
    let progress = Progress::start(terminal.watched);
    let mut planning = Planning {
        arguments,
        strategy,
        input,
        executor,
        watch,
        progress: &progress,
        concurrency: concurrency(arguments.concurrency, input),
        best: None,
    };
    let found = if arguments.optimal { planning.optimal() } else { planning.first() };
    let judge = Judge { input, executor, concurrency: planning.concurrency };
    drop(progress);
    let (plan, end) = match found {
        Ok(found) => found,
        Err(Failure::Obstacle(obstacle)) => {
            return super::explain(&obstacle, input, arguments, watch, terminal);
        }
        Err(Failure::Refused(refusal)) => {
            let unsupported =
                planner::normalize::Unsupported { message: refusal.message, span: refusal.span };
            input.report(input::unsupported(&unsupported), arguments.output_format, terminal);
            return Exit::Unsupported;
        }
    };
    if let Some(plan) = plan {
        judge.take(&plan, &mut desk, terminal);
    }
    let (written, failure) = (desk.written() > 0, desk.failure);
    failure.unwrap_or_else(|| super::conclude(&end, written, arguments.anytime, watch, terminal))
}

/// What the command line asks for, or else what the domain means.
pub(crate) fn concurrency(asked: Option<ConcurrencyName>, input: &Input) -> Concurrency {
    match asked {
        Some(ConcurrencyName::Liberal) => Concurrency::Liberal,
        Some(ConcurrencyName::Safe) => Concurrency::Safe,
        None => Concurrency::of(&input.domain),
    }
}

/// Why there was nothing to search.
enum Failure {
    Obstacle(Obstacle),
    Refused(multiagent::Refusal),
}

/// A compilation, ready to be searched.
struct Stage {
    compiled: Compiled,
    ready: Ready,
}

struct Planning<'a> {
    arguments: &'a args::Plan,
    strategy: Strategy,
    input: &'a Input,
    executor: &'a Executor<'a>,
    watch: &'a Watch,
    progress: &'a Progress,
    concurrency: Concurrency,
    best: Option<JointPlan>,
}

type Found = Result<(Option<JointPlan>, End), Failure>;

impl Planning<'_> {
    /// What is to be minimised.
    fn objective(&self) -> Objective {
        match self.arguments.objective {
            Some(ObjectiveName::Steps) => Objective::Steps,
            Some(ObjectiveName::Actions) => Objective::Actions,
            Some(ObjectiveName::Cost) => Objective::Cost,
            None if self.input.problem.metric.is_some() => Objective::Cost,
            None => Objective::Steps,
        }
    }

    fn compile(&self, means: Means, objective: Option<Objective>) -> Result<Compiled, Failure> {
        let size = self.arguments.joint_size.map(|size| size as usize);
        let options = Options { concurrency: self.concurrency, size, means, objective };
        multiagent::compile(&self.input.domain, &self.input.problem, &options)
            .map_err(Failure::Refused)
    }

    fn stage(&self, compiled: Compiled) -> Result<Stage, Failure> {
        self.progress.phase("grounding");
        let task = pipeline::ground(&compiled.domain, &compiled.problem, self.watch);
        let ready = task.map_err(Failure::Obstacle)?.ready();
        self.progress.phase("searching");
        Ok(Stage { compiled, ready })
    }

    fn search(&mut self, stage: &Stage, strategy: Strategy, budget: Option<u64>) -> End {
        let config = Config {
            strategy,
            anytime: false,
            budget,
            seed: self.arguments.seed,
            progress: Some(self.progress.counters()),
        };
        let mut last = None;
        let end = pipeline::search(&stage.ready, &config, self.watch, |plan: Plan| {
            last = Some(stage.compiled.decode(&plan));
        });
        self.best = last;
        if std::env::var_os("CAVEAT_TRACE").is_some() { eprintln!("trace: {:?} {:?} exp {} in {:?} at {:?}", stage.compiled.domain.actions.len(), end.status, end.statistics.expanded, end.time, crate::limits::cpu_time()); }
        end
    }

    /// A joint plan with as little as possible of what counts, proved to be one.
    fn optimal(&mut self) -> Found {
        let objective = self.objective();
        let (means, strategy) = match objective {
            Objective::Steps => (Means::Block, Strategy::AStar(Kind::Blind)),
            _ => (Means::Complete, self.strategy),
        };
        let compiled = self.compile(means, Some(objective))?;
        let complete = compiled.complete;
        let stage = self.stage(compiled)?;
        let end = self.search(&stage, strategy, None);
        // Merging changes neither the actions nor what they cost.
        Ok((self.plan(), End { optimal: end.optimal && complete, ..end }))
    }

    /// Some joint plan.
    fn first(&mut self) -> Found {
        let small = self.compile(Means::Shortcuts, None)?;
        let whole = small.complete;
        let mut stages: Vec<Option<Stage>> = Vec::new();
        match self.stage(small) {
            Ok(stage) => stages.push(Some(stage)),
            Err(Failure::Obstacle(Obstacle::Unreachable)) if !whole => stages.push(None),
            Err(failure) => return Err(failure),
        }
        if whole {
            let stage = stages[0].take().expect("it was put there");
            let end = self.search(&stage, self.strategy, None);
            return Ok((self.plan(), end));
        }
        let mut work = std::env::var("CF").map_or(FIRST_TURN, |t| t.parse().unwrap());
        loop {
            for turn in 0..2 {
                if turn == stages.len() {
                    let compiled = self.compile(Means::Complete, None)?;
                    stages.push(Some(self.stage(compiled)?));
                }
                let Some(stage) = stages[turn].take() else { continue };
                let share = if turn == 0 { work } else { work / 4 };
                let turn_budget = (share / stage.ready.operators().max(1)).max(1);
                let mut end = self.search(&stage, self.strategy, Some(turn_budget));
                match end.status {
                    Status::Spent => stages[turn] = Some(stage),
                    Status::Unsolvable if turn == 0 => {}
                    Status::Unsolvable if !stage.compiled.complete => {
                        end.status = Status::Incomplete;
                        return Ok((None, end));
                    }
                    _ => return Ok((self.plan(), end)),
                }
            }
            work = work.saturating_mul(4);
        }
    }

    /// The plan that the last search found, in as few joint steps as merging gives.
    fn plan(&mut self) -> Option<JointPlan> {
        let plan = self.best.take()?;
        let size = self.arguments.joint_size.map_or(usize::MAX, |size| size as usize);
        Some(multiagent::merge(self.executor, &plan, self.concurrency, size))
    }

}

/// Checks a joint plan before it is written.
struct Judge<'a> {
    input: &'a Input,
    executor: &'a Executor<'a>,
    concurrency: Concurrency,
}

impl Judge<'_> {
    /// Validates, writes and prints a joint plan.
    fn take(&self, plan: &JointPlan, desk: &mut Desk<'_>, terminal: &mut Terminal) {
        let (domain, problem) = (&self.input.domain, &self.input.problem);
        let success = match judge::judge(self.executor, plan, self.concurrency) {
            Verdict::Valid(success) => success,
            verdict @ Verdict::Invalid(_) => {
                desk.refuse(&judge::story(&verdict, domain, problem, plan), terminal);
                return;
            }
        };
        desk.save(&lang::plan::write_joint(plan, domain, problem, success.cost), terminal);
        self.print(plan, &success, terminal);
    }

    fn print(&self, plan: &JointPlan, success: &Success, terminal: &mut Terminal) {
        let (domain, problem) = (&self.input.domain, &self.input.problem);
        terminal.line("Solution found!");
        for (at, parts) in plan.steps.iter().enumerate() {
            let lines: Vec<String> =
                parts.iter().map(|part| lang::plan::line(part, domain, problem)).collect();
            terminal.line(format_args!("{at}: {}", lines.join(" ")));
        }
        terminal.line(format_args!(
            "Plan length: {} joint step(s), {} action(s).",
            success.steps, success.actions
        ));
        terminal.line(format_args!("Plan cost: {}", success.cost.normalize()));
        terminal.flush();
    }
}
