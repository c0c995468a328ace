//! A multi-agent domain and problem go in; a joint plan comes out: compiled, searched, decoded, merged, and validated under the joint semantics.
//!
//! Without a demand for optimality the small compilation, which has shortcuts only, and the complete one are searched in turns.

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::model::ObjectId;
use lang::multiagent::{self, Compiled, Means, Objective, Options};
use lang::plan::{JointPlan, Plan, Step};
use lang::validate::joint::{self as judge, Success, Verdict};
use planner::heuristics::Kind;
use planner::search::{Config, Strategy};
use planner::solve::Obstacle;
use serde_json::json;

use super::better::Effort;
use super::desk::Desk;
use super::turns::{self, Turn, Way};
use crate::args::{self, JointFormat, ObjectiveName};
use crate::exit::Exit;
use crate::input::{self, Input};
use crate::limits::Watch;
use crate::pipeline::{self, End, Ready};
use crate::progress::Progress;
use crate::terminal::Terminal;

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
    let planning = Planning {
        arguments,
        strategy,
        input,
        executor,
        watch,
        progress: &progress,
        concurrency: input::concurrency(arguments.concurrency, input),
    };
    let format = arguments.joint_format;
    let judge = Judge { input, executor, concurrency: planning.concurrency, format };
    let found = if arguments.optimal {
        planning.optimal()
    } else {
        let mut take =
            |plan: &JointPlan| progress.suspend(|| judge.take(plan, &mut desk, terminal));
        planning.satisficing(&mut take)
    };
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
    if written && failure.is_none() && format == JointFormat::Json {
        // The output is one document.
        return Exit::Done;
    }
    failure.unwrap_or_else(|| super::conclude(&end, written, arguments.anytime, watch, terminal))
}

/// The tasks that are searched in turns.
const SMALL: usize = 0;
const COMPLETE: usize = 1;

/// Why there was nothing to search.
pub(super) enum Failure {
    Obstacle(Obstacle),
    Refused(multiagent::Refusal),
}

/// A compilation, ready to be searched.
pub(super) struct Stage {
    pub(super) compiled: Compiled,
    pub(super) ready: Ready,
}

/// What a planning run knows.
pub(super) struct Planning<'a> {
    arguments: &'a args::Plan,
    strategy: Strategy,
    input: &'a Input,
    pub(super) executor: &'a Executor<'a>,
    pub(super) watch: &'a Watch,
    progress: &'a Progress,
    pub(super) concurrency: Concurrency,
}

type Found = Result<(Option<JointPlan>, End), Failure>;

impl Planning<'_> {
    /// What is to be minimised.
    pub(super) fn objective(&self) -> Objective {
        // Without a metric a joint step costs 1.
        let metric = self.input.problem.metric.is_some();
        match self.arguments.objective {
            Some(ObjectiveName::Actions) => Objective::Actions,
            Some(ObjectiveName::Cost) | None if metric => Objective::Cost,
            _ => Objective::Steps,
        }
    }

    pub(super) fn compile(
        &self,
        means: Means,
        objective: Option<Objective>,
    ) -> Result<Compiled, Failure> {
        let size = self.arguments.joint_size.map(|size| size as usize);
        let options = Options { concurrency: self.concurrency, size, means, objective };
        multiagent::compile(&self.input.domain, &self.input.problem, &options)
            .map_err(Failure::Refused)
    }

    pub(super) fn stage(&self, compiled: Compiled) -> Result<Stage, Failure> {
        self.ground(compiled).map_err(Failure::Obstacle)
    }

    fn ground(&self, compiled: Compiled) -> Result<Stage, Obstacle> {
        self.progress.phase("grounding");
        let task = pipeline::ground(&compiled.domain, &compiled.problem, self.watch);
        let ready = task?.ready();
        self.progress.phase("searching");
        Ok(Stage { compiled, ready })
    }

    pub(super) fn config(&self, strategy: Strategy) -> Config {
        Config {
            strategy,
            anytime: false,
            seed: self.arguments.seed,
            progress: Some(self.progress.counters()),
        }
    }

    /// A joint plan with as little as possible of what counts, proved to be one.
    fn optimal(&self) -> Found {
        let objective = self.objective();
        let (means, strategy) = match objective {
            Objective::Steps => (Means::Block, Strategy::AStar(Self::bound(objective))),
            _ => (Means::Complete, self.strategy),
        };
        let compiled = self.compile(means, Some(objective))?;
        let complete = compiled.complete;
        let stage = match self.ground(compiled) {
            Err(Obstacle::Unreachable) if !complete => {
                return Ok((None, End::unreachable().of_part()));
            }
            stage => stage.map_err(Failure::Obstacle)?,
        };
        let mut plan = None;
        let end = pipeline::search(&stage.ready, &self.config(strategy), self.watch, |found| {
            plan = Some(stage.compiled.decode(&found));
        });
        // Merging changes neither the actions nor what they cost.
        let plan = plan.map(|plan| self.merged(&plan));
        Ok((plan, if complete { end } else { end.of_part() }))
    }

    /// What bounds the distance from below when plans are to be optimal: that a block has begun is all that other heuristics see of joint steps.
    pub(super) fn bound(objective: Objective) -> Kind {
        if objective == Objective::Steps { Kind::Blind } else { Kind::LmCut }
    }

    /// A joint plan, and better ones as far as is asked. Those that come before the last one of an anytime run go to `take`.
    fn satisficing(&self, take: &mut dyn FnMut(&JointPlan)) -> Found {
        let mut small = None;
        let (plan, end) = self.first(&mut small)?;
        let Some(plan) = plan else { return Ok((None, end)) };
        let anytime = self.arguments.anytime;
        // A small task is solved for good in no time; more is done for whoever asks for it.
        let effort = match (anytime, self.arguments.objective) {
            (true, _) => Effort { others: Some(64_000_000), optimal: None, operators: u64::MAX },
            (false, Some(_)) => {
                Effort { others: Some(64_000_000), optimal: Some(64_000_000), operators: 20_000 }
            }
            (false, None) if self.strategy == Strategy::First => {
                Effort { others: None, optimal: Some(2_000_000), operators: 500 }
            }
            (false, None) => return Ok((Some(plan), end)),
        };
        let mut best = plan.clone();
        if anytime {
            take(&plan);
        }
        let optimal = self.improve(&plan, small.as_ref(), effort, &mut |better| {
            if anytime {
                take(better);
            }
            best.clone_from(better);
        });
        Ok(((!anytime).then_some(best), End { optimal, ..end }))
    }

    /// Some joint plan.
    fn first(&self, small: &mut Option<Stage>) -> Found {
        let compiled = self.compile(Means::Shortcuts, None)?;
        let whole = compiled.complete;
        *small = match self.stage(compiled) {
            Ok(stage) => Some(stage),
            Err(Failure::Obstacle(Obstacle::Unreachable)) if !whole => None,
            Err(failure) => return Err(failure),
        };
        let small = small.as_ref();
        let search = |way: &Way, turn: &mut Turn<'_>| match (way.task, small) {
            (SMALL, Some(stage)) => Ok(self.turn(stage, way.strategy, turn)),
            _ => self.complete(way.strategy, turn),
        };
        let ways = self.ways(small.is_some(), whole);
        let outcome = turns::take(&ways, search, |way| whole || way.task == COMPLETE);
        let (end, plan) = outcome.expect("there is a way, and it ends")?;
        Ok((plan.map(|plan| self.merged(&plan)), end))
    }

    /// Searches the complete compilation, in turns with others.
    fn complete(
        &self,
        strategy: Strategy,
        turn: &mut Turn<'_>,
    ) -> Result<(End, Option<JointPlan>), Failure> {
        let compiled = self.compile(Means::Complete, None)?;
        let complete = compiled.complete;
        let stage = match self.ground(compiled) {
            Err(Obstacle::Unreachable) if !complete => {
                return Ok((End::unreachable().of_part(), None));
            }
            stage => stage.map_err(Failure::Obstacle)?,
        };
        let (end, plan) = self.turn(&stage, strategy, turn);
        Ok((if complete { end } else { end.of_part() }, plan))
    }

    /// What takes turns. What the command line asks for goes alone.
    fn ways(&self, small: bool, whole: bool) -> Vec<Way> {
        let strategy = self.strategy;
        let mut ways = Vec::new();
        if small {
            ways.push(Way { task: SMALL, strategy, head_start: 64_000_000, share: 4 });
            if strategy == Strategy::First {
                ways.push(Way {
                    task: SMALL,
                    strategy: Strategy::Novelty,
                    head_start: 0,
                    share: 16,
                });
            }
        }
        if !whole {
            ways.push(Way { task: COMPLETE, strategy, head_start: 0, share: 2 });
        }
        ways
    }

    /// Searches a task, in turns with others.
    fn turn(
        &self,
        stage: &Stage,
        strategy: Strategy,
        turn: &mut Turn<'_>,
    ) -> (End, Option<JointPlan>) {
        let mut plan = None;
        let found = |plain: Plan| plan = Some(stage.compiled.decode(&plain));
        let (config, work) = (self.config(strategy), turn.work);
        let more = || (turn.next)();
        let end = pipeline::search_in_turns(&stage.ready, &config, self.watch, found, work, more);
        (end, plan)
    }

    /// The same plan in as few joint steps as merging gives.
    pub(super) fn merged(&self, plan: &JointPlan) -> JointPlan {
        let size = self.arguments.joint_size.map_or(usize::MAX, |size| size as usize);
        multiagent::merge(self.executor, plan, self.concurrency, size)
    }
}

/// Checks a joint plan before it is written.
struct Judge<'a> {
    input: &'a Input,
    executor: &'a Executor<'a>,
    concurrency: Concurrency,
    format: JointFormat,
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
        if self.format == JointFormat::Json {
            let document = self.document(plan, success);
            terminal.line(serde_json::to_string_pretty(&document).expect("it is plain data"));
            terminal.flush();
            return;
        }
        terminal.line("Solution found!");
        if self.format == JointFormat::Gantt {
            terminal.data(lang::plan::gantt(plan, domain, problem));
        } else {
            for (at, parts) in plan.steps.iter().enumerate() {
                let lines: Vec<String> =
                    parts.iter().map(|part| lang::plan::line(part, domain, problem)).collect();
                terminal.line(format_args!("{at}: {}", lines.join(" ")));
            }
        }
        terminal.line(format_args!(
            "Plan length: {} joint step(s), {} action(s).",
            success.steps, success.actions
        ));
        terminal.line(format_args!("Plan cost: {}", success.cost.normalize()));
        terminal.flush();
    }

    /// The joint plan as data.
    fn document(&self, plan: &JointPlan, success: &Success) -> serde_json::Value {
        let (domain, problem) = (&self.input.domain, &self.input.problem);
        let name = |object: ObjectId| problem.objects[object.index()].name.text.clone();
        let part = |part: &Step| {
            json!({
                "agent": self.executor.agent(part).map(name),
                "action": domain.actions[part.action.index()].name.text,
                "arguments": part.arguments.iter().map(|&object| name(object)).collect::<Vec<_>>(),
            })
        };
        let steps: Vec<Vec<_>> =
            plan.steps.iter().map(|parts| parts.iter().map(part).collect()).collect();
        json!({
            "domain": domain.name.text,
            "problem": problem.name.text,
            "steps": steps,
            "joint_steps": success.steps,
            "actions": success.actions,
            "cost": success.cost.normalize().to_string(),
        })
    }
}
