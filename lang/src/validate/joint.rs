//! A joint plan goes in; whether it is valid, and what stands against the joint step that fails, come out.

use rust_decimal::Decimal;

use super::Place;
use super::explain::{self, Part, Site};
use super::told::{self, Told};
use super::words::Words;
use crate::diagnostic::{Diagnostic, Label, plan_misses_goal, plan_step_fails};
use crate::execute::joint::{Acting, Clash, Concurrency, Crowd};
use crate::execute::{Change, Executor, State, Undefined, bind};
use crate::model::{Domain, Problem};
use crate::plan::{self, JointPlan, Step};
use crate::source::Span;

/// What there is to say about a joint plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Every joint step is applicable where it comes, and the goal holds in the end.
    Valid(Success),
    /// It fails.
    Invalid(Failure),
}

/// What a valid joint plan costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Success {
    /// How many joint steps it has.
    pub steps: usize,
    /// How many ground actions they have in all.
    pub actions: usize,
    /// With a metric the sum of all parts' costs, without one the number of joint steps.
    pub cost: Decimal,
    /// The metric's value in the end: the cost and the initial value of the metric's function.
    pub value: Decimal,
}

/// Why a joint plan fails at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cause {
    /// The parts of the joint step cannot be taken together; of a precondition, these parts are false.
    Clash(Clash, Vec<Part>),
    /// The cost of a part is not defined.
    Undefined(usize, Undefined),
    /// The goal does not hold in the end: these parts of it are false.
    Goal(Vec<Part>),
}

/// Why a joint plan is not valid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Where it fails.
    pub place: Place,
    /// Why.
    pub cause: Cause,
}

/// Executes `plan` joint step by joint step and then asks for the goal.
pub fn judge(executor: &Executor<'_>, plan: &JointPlan, concurrency: Concurrency) -> Verdict {
    let mut state = executor.initial();
    let mut history = Vec::new();
    let mut cost = Decimal::ZERO;
    for (at, parts) in plan.steps.iter().enumerate() {
        let place = Place::Step(at);
        if let Err(clash) = executor.join(&state, parts, concurrency) {
            let reasons = match clash {
                Clash::Precondition(part) => precondition(executor, &state, &history, parts, part),
                _ => Vec::new(),
            };
            return Verdict::Invalid(Failure { place, cause: Cause::Clash(clash, reasons) });
        }
        match executor.joint_cost(&state, parts) {
            Ok(price) => cost = cost.saturating_add(price),
            Err((part, undefined)) => {
                let cause = Cause::Undefined(part, undefined);
                return Verdict::Invalid(Failure { place, cause });
            }
        }
        history.push(executor.apply_joint(&mut state, parts));
    }
    if !executor.goal(&state) {
        let problem = executor.problem();
        let scope = &problem.goal_scope;
        let binding = vec![None; scope.variables.len()];
        let (state, history, formula) = (&state, history.as_slice(), &problem.goal);
        let site = Site { executor, state, history, scope, formula, binding, joint: None };
        let cause = Cause::Goal(explain::parts(&site));
        return Verdict::Invalid(Failure { place: Place::Goal, cause });
    }
    let steps = plan.steps.len();
    if executor.problem().metric.is_none() {
        cost = Decimal::from(steps);
    }
    let value = cost.saturating_add(executor.initial_value());
    Verdict::Valid(Success { steps, actions: plan.actions(), cost, value })
}

/// The false parts of the precondition of one part of a joint step.
fn precondition(
    executor: &Executor<'_>,
    state: &State,
    history: &[Change],
    parts: &[Step],
    part: usize,
) -> Vec<Part> {
    let (all, others) = (Crowd::new(parts, None), Crowd::new(parts, Some(part)));
    let action = &executor.domain().actions[parts[part].action.index()];
    let (scope, formula) = (&action.scope, &action.precondition);
    let binding = bind(scope, &parts[part]);
    let joint = Some(Acting { all: &all, others: &others });
    explain::parts(&Site { executor, state, history, scope, formula, binding, joint })
}

/// The lines by which VAL tells a verdict.
pub fn lines(verdict: &Verdict) -> String {
    told::lines(match verdict {
        Verdict::Valid(success) => Ok(success.value),
        Verdict::Invalid(failure) => Err(failure.place),
    })
}

/// What a person reads: the cost, or where the joint plan fails and why.
pub fn story(verdict: &Verdict, domain: &Domain, problem: &Problem, plan: &JointPlan) -> String {
    let failure = match verdict {
        Verdict::Valid(Success { steps, actions, cost, .. }) => {
            return format!(
                "The joint plan is valid: {}, {}, cost {}.\n",
                counted(*steps, "joint step"),
                counted(*actions, "action"),
                cost.normalize()
            );
        }
        Verdict::Invalid(failure) => failure,
    };
    let teller = Teller { words: Words { domain, problem }, plan };
    let mut text = format!("The joint plan fails {}.\n", teller.headline(failure));
    if let Cause::Clash(_, parts) | Cause::Goal(parts) = &failure.cause {
        teller.told(|told| told.list(&mut text, parts, 1));
    }
    text
}

/// `1 action`, `2 actions`.
fn counted(count: usize, word: &str) -> String {
    if count == 1 { format!("1 {word}") } else { format!("{count} {word}s") }
}

impl Failure {
    /// The failure as a diagnostic at the false condition, or at the action that cannot be joined.
    /// `spans` are those of the parts of each joint step, where they are known.
    pub fn diagnostic(
        &self,
        domain: &Domain,
        problem: &Problem,
        plan: &JointPlan,
        spans: &[Vec<Span>],
    ) -> Diagnostic {
        let teller = Teller { words: Words { domain, problem }, plan };
        let mut labels: Vec<Label> = Vec::new();
        if let Cause::Clash(_, parts) | Cause::Goal(parts) = &self.cause {
            labels.extend(parts.iter().map(|part| Label {
                span: part.span,
                text: teller.told(|told| told.part(part, false)),
            }));
        }
        let (rule, fallback) = match self.place {
            Place::Step(at) => {
                let action = |part: usize| {
                    let action = plan.steps[at][part].action;
                    domain.actions[action.index()].name.span
                };
                let involved = self.involved();
                if labels.is_empty() {
                    labels.extend(
                        involved
                            .iter()
                            .map(|&part| Label { span: action(part), text: String::new() }),
                    );
                }
                let named = spans
                    .get(at)
                    .into_iter()
                    .flat_map(|spans| involved.iter().filter_map(|&part| spans.get(part).copied()));
                let text = format!("joint step {}", at + 1);
                labels.extend(named.map(|span| Label { span, text: text.clone() }));
                (plan_step_fails::RULE, domain.name.span)
            }
            Place::Goal => (plan_misses_goal::RULE, problem.name.span),
        };
        let message = format!("the joint plan fails {}", teller.headline(self));
        if labels.is_empty() {
            labels.push(Label { span: fallback, text: String::new() });
        }
        let primary = labels.remove(0);
        let mut diagnostic = rule.at(primary.span, message, primary.text);
        labels.retain(|label| label.span != primary.span);
        diagnostic.secondary = labels;
        diagnostic
    }

    /// The parts of the joint step that the failure is about.
    fn involved(&self) -> Vec<usize> {
        match &self.cause {
            Cause::Goal(_) | Cause::Clash(Clash::Empty, _) => Vec::new(),
            Cause::Undefined(part, _)
            | Cause::Clash(Clash::Misfit(part, _) | Clash::Precondition(part), _) => vec![*part],
            Cause::Clash(Clash::Agent(_, parts), _) => parts.to_vec(),
            Cause::Clash(Clash::Conflict { adds, deletes, .. }, _) => vec![*adds, *deletes],
            Cause::Clash(Clash::Interference { part, by }, _) => {
                std::iter::once(*part).chain(*by).collect()
            }
        }
    }
}

struct Teller<'a> {
    words: Words<'a>,
    plan: &'a JointPlan,
}

impl Teller<'_> {
    fn line(&self, part: &Step) -> String {
        plan::line(part, self.words.domain, self.words.problem)
    }

    /// `joint step 3 {(lift a left), (lift b right)}`.
    fn step(&self, at: usize) -> String {
        let parts: Vec<_> = self.plan.steps[at].iter().map(|part| self.line(part)).collect();
        format!("joint step {} {{{}}}", at + 1, parts.join(", "))
    }

    fn told<T>(&self, tell: impl FnOnce(Told<'_>) -> T) -> T {
        tell(Told { words: self.words, step: &|at| self.step(at) })
    }

    /// Where the plan fails and of what.
    fn headline(&self, failure: &Failure) -> String {
        let Place::Step(at) = failure.place else {
            return "at the goal, which does not hold in the end".to_owned();
        };
        let parts = &self.plan.steps[at];
        let line = |part: usize| self.line(&parts[part]);
        let reason = match &failure.cause {
            Cause::Clash(Clash::Empty, _) => "nobody does anything in it".to_owned(),
            Cause::Clash(Clash::Misfit(part, misfit), _) => {
                format!("{}: {}", line(*part), self.words.misfit(&parts[*part], *misfit))
            }
            Cause::Clash(Clash::Agent(agent, [one, other]), _) => match agent {
                Some(agent) => format!(
                    "{} cannot do {} and {} at once",
                    self.words.object(*agent),
                    line(*one),
                    line(*other)
                ),
                None => format!(
                    "{} and {} have no agent, and only one such action fits into a joint step",
                    line(*one),
                    line(*other)
                ),
            },
            Cause::Clash(Clash::Precondition(part), _) => {
                format!("the precondition of {} does not hold", line(*part))
            }
            Cause::Clash(Clash::Conflict { fact, adds, deletes }, _) => format!(
                "{} adds {}, which {} deletes",
                line(*adds),
                self.words.fact(fact),
                line(*deletes)
            ),
            Cause::Clash(Clash::Interference { part, by }, _) => match by {
                Some(by) => format!("{} destroys the precondition of {}", line(*by), line(*part)),
                None => format!("the others destroy the precondition of {}", line(*part)),
            },
            Cause::Undefined(part, undefined) => {
                format!("{}: {}", line(*part), self.words.undefined(undefined))
            }
            Cause::Goal(_) => unreachable!("a goal is not at a step"),
        };
        format!("at {}: {reason}", self.step(at))
    }
}
