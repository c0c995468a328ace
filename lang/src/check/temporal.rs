//! How long durative actions take.

use super::record::Reading;
use super::requirement::Need;
use super::scope::Bindings;
use super::{Report, World, value};
use crate::ast::{Connective, Formula, NodeKind as Ast, Operator};
use crate::diagnostic::invalid_duration;

/// Checks a `:duration`: `(= ?duration VALUE)`, bounds with `<=` and `>=`, several with `and`, each perhaps at a point in time.
pub(super) fn duration<'a>(
    formula: &Formula<'a>,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) {
    let mut at = 0;
    while at < formula.nodes.len() {
        let node = &formula.nodes[at];
        match &node.kind {
            Ast::Connective(Connective::And) | Ast::Timed(_) => {
                at += 1;
                continue;
            }
            Ast::Operator(operator) if operator.compares() => {
                bound(*operator, formula, at, bindings, world, report);
            }
            _ => {
                bindings.unsure = true;
                report.push(invalid_duration::invalid_duration(node.place.0));
            }
        }
        at = node.next as usize;
    }
}

/// One comparison with `?duration`.
fn bound<'a>(
    operator: Operator,
    formula: &Formula<'a>,
    at: usize,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) {
    let node = &formula.nodes[at];
    let operands: Vec<usize> = formula.operands(at).collect();
    let known = match operands.first().map(|&first| &formula.nodes[first].kind) {
        Some(Ast::Word(word)) => word.is("?duration"),
        _ => false,
    };
    let bounds = matches!(operator, Operator::LessEqual | Operator::GreaterEqual);
    if operator != Operator::Equal && bounds {
        report.need(Need::DurationInequality, node.keyword.0);
    }
    if !known || operands.len() != 2 || operator != Operator::Equal && !bounds {
        bindings.unsure = true;
        return report.push(invalid_duration::invalid_duration(node.place.0));
    }
    report.reading = Reading::Asked;
    let amount = value::check(formula, operands[1], bindings, world, report);
    report.reading = Reading::Beside;
    let place = formula.nodes[operands[1]].place.0;
    value::number(&amount, place, "`?duration`", world, report);
}
