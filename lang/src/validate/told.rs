//! How a plan ended and the false parts of a condition go in; the lines that tell them come out.

use std::fmt::Write;

use rust_decimal::Decimal;

use super::explain::MOST;
use super::words::Words;
use super::{Part, Place, What};
use crate::plan;

/// The lines by which VAL tells that a plan is valid, with the final value, or where it fails.
pub(super) fn lines(end: Result<Decimal, Place>) -> String {
    match end {
        Ok(value) => format!(
            "Plan executed successfully - checking goal\nPlan valid\nFinal value: {}\n",
            value.normalize()
        ),
        Err(Place::Step(_)) => "Plan failed to execute\nPlan invalid\n".to_owned(),
        Err(Place::Goal) => {
            "Plan executed successfully - checking goal\nGoal not satisfied\nPlan invalid\n"
                .to_owned()
        }
    }
}

/// Tells false parts.
pub(super) struct Told<'a> {
    pub(super) words: Words<'a>,
    /// How a step of the plan is called.
    pub(super) step: &'a dyn Fn(usize) -> String,
}

impl Told<'_> {
    pub(super) fn list(&self, text: &mut String, parts: &[Part], depth: usize) {
        for part in parts {
            let line = self.part(part, depth > 1);
            writeln!(text, "{:indent$}{line}", "", indent = depth * 2)
                .expect("a string takes all that is written to it");
            if let What::Unmet { parts, .. } = &part.what {
                self.list(text, parts, depth + 1);
            }
        }
        if parts.len() == MOST {
            writeln!(text, "{:indent$}…", "", indent = depth * 2)
                .expect("a string takes all that is written to it");
        }
    }

    /// A false part in words; as one of several alternatives it is not said what it must be.
    pub(super) fn part(&self, part: &Part, alternative: bool) -> String {
        match &part.what {
            What::Missing { fact, since } => {
                let derived = self.words.domain.predicates[fact.predicate.index()].derived;
                let cause = match since {
                    Some(at) if derived => format!("no rule derives it since {}", (self.step)(*at)),
                    Some(at) => format!("{} deleted it", (self.step)(*at)),
                    None if derived => "no rule derives it".to_owned(),
                    None => "it was never true".to_owned(),
                };
                format!("{} is false: {cause}", self.words.fact(fact))
            }
            What::Forbidden { fact, since } => {
                let derived = self.words.domain.predicates[fact.predicate.index()].derived;
                let cause = match since {
                    Some(at) if derived => format!("a rule derives it since {}", (self.step)(*at)),
                    Some(at) => format!("{} added it", (self.step)(*at)),
                    None if derived => "a rule derives it".to_owned(),
                    None => "it held from the beginning".to_owned(),
                };
                let must = if alternative { "" } else { " and must be false" };
                format!("{} is true{must}: {cause}", self.words.fact(fact))
            }
            What::Action { step, wanted } => {
                let line = plan::line(step, self.words.domain, self.words.problem);
                if *wanted {
                    format!("{line} must be done in the same joint step, and is not")
                } else if alternative {
                    format!("{line} is done in the same joint step")
                } else {
                    format!("{line} is done in the same joint step, and must not be")
                }
            }
            What::Different { text, objects: [left, right] } => {
                let (left, right) = (self.words.object(*left), self.words.object(*right));
                format!("{text} is false: {left} and {right} are two objects")
            }
            What::Same { text, object } => {
                format!("{text} is false: both are {}", self.words.object(*object))
            }
            What::Unmet { text, .. } => format!("{text} does not hold"),
        }
    }
}
