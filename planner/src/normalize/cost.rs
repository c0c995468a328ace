//! What actions cost: decimals of the metric function, scaled to integers by one power of ten for the whole problem.

use lang::model::{Action, Domain, Expression, FunctionId, Problem};
use lang::source::Span;
use rust_decimal::Decimal;
use rust_decimal::prelude::ToPrimitive;

use super::{Unsupported, formula};
use crate::normal::Cost;

/// The metric of a problem, and the scale of its numbers.
pub struct Costs {
    metric: Option<FunctionId>,
    /// Costs are multiplied by `10^scale`.
    pub scale: u32,
}

impl Costs {
    /// Finds the smallest scale that makes every number an integer, and checks that actions do not change what costs depend on.
    pub fn new(domain: &Domain, problem: &Problem) -> Result<Self, Unsupported> {
        let metric = problem.metric.as_ref().map(|metric| metric.function);
        let mut scale = 0;
        let mut used = vec![false; domain.functions.len()];
        for increase in domain.actions.iter().flat_map(|action| &action.increases) {
            if Some(increase.function) != metric {
                continue;
            }
            match &increase.value {
                Expression::Number(number) => scale = scale.max(number.normalize().scale()),
                Expression::Function(function, _) => used[function.index()] = true,
            }
        }
        for increase in domain.actions.iter().flat_map(|action| &action.increases) {
            if used[increase.function.index()] {
                return Err(unsupported(
                    "a cost that depends on a function which actions change",
                    increase.span,
                ));
            }
        }
        for value in problem.values.iter().filter(|value| used[value.function.index()]) {
            scale = scale.max(value.value.normalize().scale());
        }
        for value in problem.values.iter().filter(|value| used[value.function.index()]) {
            scaled(value.value, scale, value.span)?;
        }
        Ok(Self { metric, scale })
    }

    /// The parts of the cost of `action`; empty without a metric.
    pub fn of(&self, action: &Action) -> Result<Vec<Cost>, Unsupported> {
        let mut costs = Vec::new();
        for increase in
            action.increases.iter().filter(|increase| Some(increase.function) == self.metric)
        {
            if !increase.condition.is_truth() || !increase.variables.is_empty() {
                return Err(unsupported(
                    "a cost that depends on the state (`increase` inside `when` or `forall`)",
                    increase.span,
                ));
            }
            costs.push(match &increase.value {
                Expression::Number(number) => {
                    Cost::Constant(scaled(*number, self.scale, increase.span)?)
                }
                Expression::Function(function, arguments) => Cost::Function(
                    *function,
                    arguments.iter().copied().map(formula::term).collect(),
                ),
            });
        }
        Ok(costs)
    }
}

/// `number · 10^scale` as an integer.
pub fn scaled(number: Decimal, scale: u32, span: Span) -> Result<u32, Unsupported> {
    if number.is_sign_negative() && !number.is_zero() {
        return Err(unsupported("a negative cost", span));
    }
    10_u64
        .checked_pow(scale)
        .and_then(|factor| number.checked_mul(Decimal::from(factor)))
        .and_then(|number| number.to_u32())
        .filter(|&number| number < 1 << 30)
        .ok_or_else(|| {
            unsupported(
                "a cost too large for the planner (2^30 after scaling decimals to integers)",
                span,
            )
        })
}

fn unsupported(message: &str, span: Span) -> Unsupported {
    Unsupported { message: message.to_owned(), span }
}
