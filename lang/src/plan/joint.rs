//! Joint plans as plain data, and as text: one action a line, behind the number of the joint step that it belongs to.

use std::fmt::Write;

use rust_decimal::Decimal;

use super::{Step, line};
use crate::model::{Domain, Problem};

/// A sequence of joint actions, each a set of ground actions that are taken at the same time.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct JointPlan {
    /// The joint steps in order; the parts of each in the order of the text.
    pub steps: Vec<Vec<Step>>,
}

impl JointPlan {
    /// How many ground actions it has in all.
    pub fn actions(&self) -> usize {
        self.steps.iter().map(Vec::len).sum()
    }
}

/// The joint plan as a plan file: `0: (lift a1 left)`, parts of one joint step behind the same number, then the cost as a comment.
pub fn write_joint(plan: &JointPlan, domain: &Domain, problem: &Problem, cost: Decimal) -> String {
    let mut text = String::new();
    for (at, parts) in plan.steps.iter().enumerate() {
        for part in parts {
            writeln!(text, "{at}: {}", line(part, domain, problem))
                .expect("a string takes all that is written to it");
        }
    }
    let (steps, actions) = (plan.steps.len(), plan.actions());
    writeln!(text, "; joint steps = {steps}, actions = {actions}, cost = {}", cost.normalize())
        .expect("a string takes all that is written to it");
    text
}
