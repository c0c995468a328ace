//! A plan goes in; the text of its file comes out.

use std::fmt::Write;

use rust_decimal::Decimal;

use super::{Plan, Step};
use crate::model::{Domain, Problem};

/// The step as plan files write it: `(stack a b)`, in lower case.
pub fn line(step: &Step, domain: &Domain, problem: &Problem) -> String {
    let mut line = format!("({}", domain.actions[step.action.index()].name.text);
    for object in &step.arguments {
        line.push(' ');
        line.push_str(&problem.objects[object.index()].name.text);
    }
    line.push(')');
    line.to_lowercase()
}

/// The plan as Fast Downward writes it: one step a line, then the cost as a comment.
pub fn write(
    plan: &Plan,
    domain: &Domain,
    problem: &Problem,
    cost: Decimal,
    unit_cost: bool,
) -> String {
    let mut text = String::new();
    for step in &plan.steps {
        text.push_str(&line(step, domain, problem));
        text.push('\n');
    }
    let kind = if unit_cost { "unit cost" } else { "general cost" };
    writeln!(text, "; cost = {} ({kind})", cost.normalize())
        .expect("a string takes all that is written to it");
    text
}
