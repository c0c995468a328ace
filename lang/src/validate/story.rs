//! A verdict goes in; what a person, or a program that knows VAL, reads comes out.

use std::fmt::Write;

use super::told::{self, Told};
use super::words::Words;
use super::{Cause, Failure, Place, Repair, Success, Verdict};
use crate::diagnostic::{Diagnostic, Label, plan_misses_goal, plan_step_fails};
use crate::model::{Domain, Problem};
use crate::plan::{self, Plan};
use crate::source::Span;

/// The lines by which VAL tells a verdict.
pub fn lines(verdict: &Verdict) -> String {
    told::lines(match verdict {
        Verdict::Valid(success) => Ok(success.value),
        Verdict::Invalid(failure) => Err(failure.place),
    })
}

/// What a person reads: the cost, or where the plan fails, why, since when, and what would mend it.
pub fn story(verdict: &Verdict, domain: &Domain, problem: &Problem, plan: &Plan) -> String {
    let teller = Teller { words: Words { domain, problem }, plan };
    match verdict {
        Verdict::Valid(Success { steps, cost, .. }) => {
            let steps = if *steps == 1 { "1 step".to_owned() } else { format!("{steps} steps") };
            format!("The plan is valid: {steps}, cost {}.\n", cost.normalize())
        }
        Verdict::Invalid(failure) => {
            let mut text = format!("The plan fails {}.\n", teller.headline(failure));
            if let Cause::False(parts) = &failure.cause {
                teller.told(|told| told.list(&mut text, parts, 1));
            }
            if let Some(repair) = teller.repair(failure) {
                writeln!(text, "Repair: {repair}.")
                    .expect("a string takes all that is written to it");
            }
            text
        }
    }
}

impl Failure {
    /// The failure as a diagnostic at the false condition. `spans` are those of the plan's steps, where they are known.
    pub fn diagnostic(
        &self,
        domain: &Domain,
        problem: &Problem,
        plan: &Plan,
        spans: &[Span],
    ) -> Diagnostic {
        let teller = Teller { words: Words { domain, problem }, plan };
        let mut labels = match &self.cause {
            Cause::False(parts) => parts
                .iter()
                .map(|part| Label {
                    span: part.span,
                    text: teller.told(|told| told.part(part, false)),
                })
                .collect(),
            Cause::Misfit(_) | Cause::Undefined(_) => {
                vec![Label { span: self.span, text: String::new() }]
            }
        };
        let primary = labels.remove(0);
        let rule = match self.place {
            Place::Step(at) => {
                if let Some(&span) = spans.get(at) {
                    labels.push(Label { span, text: format!("step {}", at + 1) });
                }
                plan_step_fails::RULE
            }
            Place::Goal => plan_misses_goal::RULE,
        };
        let message = format!("the plan fails {}", teller.headline(self));
        let mut diagnostic = rule.at(primary.span, message, primary.text);
        diagnostic.secondary = labels;
        diagnostic.help = teller.repair(self);
        diagnostic
    }
}

struct Teller<'a> {
    words: Words<'a>,
    plan: &'a Plan,
}

impl Teller<'_> {
    /// `step 3 (stack a b)`.
    fn step(&self, at: usize) -> String {
        let step = &self.plan.steps[at];
        format!("step {} {}", at + 1, plan::line(step, self.words.domain, self.words.problem))
    }

    /// Tells false parts with the steps of this plan.
    fn told<T>(&self, tell: impl FnOnce(Told<'_>) -> T) -> T {
        tell(Told { words: self.words, step: &|at| self.step(at) })
    }

    /// Where the plan fails and of what.
    fn headline(&self, failure: &Failure) -> String {
        let Place::Step(at) = failure.place else {
            return "at the goal, which does not hold in the end".to_owned();
        };
        let step = self.step(at);
        let reason = match &failure.cause {
            Cause::False(_) => "its precondition does not hold".to_owned(),
            Cause::Misfit(misfit) => self.words.misfit(&self.plan.steps[at], *misfit),
            Cause::Undefined(undefined) => self.words.undefined(undefined),
        };
        format!("at {step}: {reason}")
    }

    fn repair(&self, failure: &Failure) -> Option<String> {
        let before = |at: usize| match self.plan.steps.get(at) {
            Some(_) => format!("before {}", self.step(at)),
            None => "at the end".to_owned(),
        };
        match &failure.repair {
            Repair::Move { step, before: at } if at > step && *at < self.plan.steps.len() => {
                Some(format!(
                    "the plan is valid with {} moved behind {}",
                    self.step(*step),
                    self.step(at - 1)
                ))
            }
            Repair::Move { step, before: at } => {
                let place =
                    if *at < self.plan.steps.len() { before(*at) } else { "to the end".to_owned() };
                Some(format!("the plan is valid with {} moved {place}", self.step(*step)))
            }
            Repair::Insert { step, before: at } => {
                let line = plan::line(step, self.words.domain, self.words.problem);
                Some(format!("the plan is valid with {line} inserted {}", before(*at)))
            }
            Repair::Set(facts) => {
                let each: Vec<_> = facts
                    .iter()
                    .map(|(fact, value)| format!("set {} to {value}", self.words.fact(fact)))
                    .collect();
                Some(format!("no one step was found that mends the plan; {}", each.join(", and ")))
            }
            Repair::None => None,
        }
    }
}
