//! Expressions: what has a number or an object as value.

use super::record::Reading;
use super::requirement::Need;
use super::scope::{self, Bindings, Callee};
use super::{Report, World};
use crate::ast::{Feature, Formula, Name, Node, NodeKind as Ast, Operator};
use crate::diagnostic::{unexpected_item, wrong_operand_count, wrong_value};
use crate::model::{Expression, FunctionId, Term, TypeId};
use crate::source::Span;

/// What an expression stands for.
pub(super) enum Value {
    /// A number, with its expression if it is a literal or the value of a function.
    Number(Option<Expression>),
    /// An object, with its term if it is not the value of a function.
    Object(Vec<TypeId>, Option<Term>),
    /// Something that has been reported.
    Unknown,
}

impl Value {
    /// Whether it is no object, so far as is known.
    pub(super) fn may_be_number(&self) -> bool {
        !matches!(self, Self::Object(..))
    }
}

/// A node whose operands are being checked.
struct Frame<'a> {
    kind: Kind<'a>,
    values: Vec<(Value, Span)>,
    end: u32,
    span: Span,
}

enum Kind<'a> {
    Operator(Operator),
    /// A function with values of functions among its arguments.
    Function(Name<'a>),
}

/// The value of the node `root` of `formula`.
pub(super) fn check<'a>(
    formula: &Formula<'a>,
    root: usize,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Value {
    let end = formula.nodes[root].next;
    let mut open: Vec<Frame<'a>> = Vec::new();
    let mut at = root as u32;
    let mut result = Value::Unknown;
    loop {
        while let Some(frame) = open.pop_if(|frame| frame.end == at) {
            let span = frame.span;
            let value = finish(frame, world, report);
            match open.last_mut() {
                Some(parent) => parent.values.push((value, span)),
                None => result = value,
            }
        }
        if at >= end {
            return result;
        }
        let node = &formula.nodes[at as usize];
        let span = node.place.0;
        let kind = match &node.kind {
            Ast::Operator(operator) if operator.computes() => Kind::Operator(*operator),
            Ast::Nested(name) => Kind::Function(*name),
            _ => {
                let value = leaf(node, formula, bindings, world, report);
                at = node.next;
                match open.last_mut() {
                    Some(parent) => parent.values.push((value, span)),
                    None => result = value,
                }
                continue;
            }
        };
        open.push(Frame { kind, values: Vec::new(), end: node.next, span });
        at += 1;
    }
}

/// The value of something without operands.
fn leaf<'a>(
    node: &Node<'a>,
    formula: &Formula<'a>,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Value {
    let span = node.place.0;
    match &node.kind {
        Ast::Word(name) => word(*name, bindings, world, report),
        Ast::Apply(application) => {
            let arguments = formula.arguments(application);
            if report.metric && application.name.is("is-violated") {
                for &preference in arguments {
                    report.violated(preference);
                }
                return Value::Number(None);
            }
            if report.metric && application.name.is("total-time") && arguments.is_empty() {
                return Value::Number(None);
            }
            match bindings.function(application.name, arguments, span, world, report) {
                Some((function, terms)) => of(function, Some(terms), span, world, report),
                None => Value::Unknown,
            }
        }
        _ => {
            bindings.unsure = true;
            if node.kind != Ast::Connective(crate::ast::Connective::And) {
                report.push(unexpected_item::unexpected_item("a number or an object", span));
            }
            Value::Unknown
        }
    }
}

/// The value of a function.
fn of(
    function: FunctionId,
    terms: Option<Vec<Term>>,
    span: Span,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) -> Value {
    report.reads(function, span);
    match &world.domain.functions[function.index()].values {
        None => Value::Number(terms.map(|terms| Expression::Function(function, terms))),
        Some(types) => {
            report.uses(Feature::ObjectFluents, span);
            Value::Object(types.clone(), None)
        }
    }
}

/// The value of a word.
fn word<'a>(
    name: Name<'a>,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Value {
    if crate::syntax::is_number(name.text) {
        if let Some(number) = super::problem::number(name.text) {
            return Value::Number(Some(Expression::Number(number)));
        }
        report.push(unexpected_item::unexpected_item("a number", name.span));
        return Value::Unknown;
    }
    if name.is("#t") {
        if !bindings.continuous {
            report.push(unexpected_item::unexpected_item(
                "a number; `#t` stands in effects of durative actions and processes",
                name.span,
            ));
            return Value::Unknown;
        }
        report.need(Need::ContinuousEffect, name.span);
        return Value::Number(None);
    }
    if name.is("?duration") && bindings.durative && !bindings.binds(name) {
        return Value::Number(None);
    }
    if report.metric && name.is("total-time") && world.names.functions.find(name.text).is_none() {
        return Value::Number(None);
    }
    let functional = !name.is_variable() && world.names.objects.find(name.text).is_none();
    if functional && name.is("undefined") {
        return Value::Unknown;
    }
    if functional && world.names.functions.find(name.text).is_some() {
        return match bindings.function(name, &[], name.span, world, report) {
            Some((function, terms)) => of(function, Some(terms), name.span, world, report),
            None => Value::Unknown,
        };
    }
    if report.metric && functional {
        // A metric has no objects in it.
        scope::function(name, world, report);
        return Value::Unknown;
    }
    match bindings.term(name, world, report) {
        Some(term) => Value::Object(bindings.types(term, world).0.to_vec(), Some(term)),
        None => Value::Unknown,
    }
}

/// Puts a node together from its operands.
fn finish(frame: Frame<'_>, world: &World<'_, '_>, report: &mut Report<'_>) -> Value {
    let Frame { kind, values, span, .. } = frame;
    match kind {
        Kind::Operator(operator) => {
            let given = values.len();
            let right = match operator {
                Operator::Subtract => (1..=2).contains(&given),
                Operator::Divide => given == 2,
                _ => given >= 2,
            };
            if !right {
                report.push(wrong_operand_count::wrong_operand_count(
                    operator.word(),
                    2,
                    given,
                    span,
                ));
            }
            for (value, place) in &values {
                number(value, *place, &format!("`{}`", operator.word()), world, report);
            }
            Value::Number(None)
        }
        Kind::Function(name) => match scope::function(name, world, report) {
            Some(function) => {
                arguments(&Callee::function(function, world), &values, span, world, report);
                of(function, None, span, world, report)
            }
            None => Value::Unknown,
        },
    }
}

/// Reports a value that is no number where one is needed.
pub(super) fn number(
    value: &Value,
    span: Span,
    wanted: &str,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) {
    if let Value::Object(types, _) = value {
        let found = world.describe_types(types);
        report.push(wrong_value::object(&found, wanted, span));
    }
}

/// Checks values as the arguments of a predicate, a function or an action.
pub(super) fn arguments(
    callee: &Callee<'_>,
    values: &[(Value, Span)],
    span: Span,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) {
    if values.len() != callee.parameters.len() {
        callee.report_arity(&[], values.len(), span, world, report);
        return;
    }
    for ((value, place), parameter) in values.iter().zip(callee.parameters) {
        match value {
            Value::Number(_) => {
                report.push(wrong_value::number(&callee.describe(), *place));
                return;
            }
            // A constant has all of its types, a variable one of them.
            Value::Object(types, term)
                if !world.fits(types, matches!(term, Some(Term::Object(_))), &parameter.types) =>
            {
                let found = world.describe_types(types);
                let spelling = Name { text: "", span: *place };
                callee.report_type(spelling, &found, &parameter.types, world, report);
                return;
            }
            _ => {}
        }
    }
}

/// The values of all operands of the node `at`.
pub(super) fn operands<'a>(
    formula: &Formula<'a>,
    at: usize,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Vec<(Value, Span)> {
    let mut values = Vec::new();
    for operand in formula.operands(at) {
        let value = check(formula, operand, bindings, world, report);
        values.push((value, formula.nodes[operand].place.0));
    }
    values
}

/// What `(= LEFT RIGHT)` and the other comparisons say; two terms if it is about objects alone.
pub(super) fn comparison<'a>(
    operator: Operator,
    formula: &Formula<'a>,
    at: usize,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<(Term, Term)> {
    let node = &formula.nodes[at];
    let (keyword, span) = (node.keyword.0, node.place.0);
    report.reading = Reading::Asked;
    let values = operands(formula, at, bindings, world, report);
    report.reading = Reading::Beside;
    if values.len() != 2 {
        let word = operator.word();
        report.push(wrong_operand_count::wrong_operand_count(word, 2, values.len(), span));
        return None;
    }
    let [(left, left_place), (right, right_place)] = values.try_into().ok()?;
    let equality = operator == Operator::Equal;
    match (&left, &right) {
        (Value::Object(_, first), Value::Object(_, second)) if equality => {
            if let (Some(first), Some(second)) = (first, second) {
                report.need(Need::Equality, keyword);
                return Some((*first, *second));
            }
            report.need(Need::ObjectFluent, keyword);
        }
        (Value::Number(_), Value::Object(types, _)) if equality => {
            let found = world.describe_types(types);
            report.push(wrong_value::mixed(&found, right_place, left_place));
        }
        (Value::Object(types, _), Value::Number(_)) if equality => {
            let found = world.describe_types(types);
            report.push(wrong_value::mixed(&found, left_place, right_place));
        }
        (Value::Unknown, Value::Unknown) => {}
        _ => {
            let wanted = format!("`{}`", operator.word());
            if !equality {
                number(&left, left_place, &wanted, world, report);
                number(&right, right_place, &wanted, world, report);
            }
            if left.may_be_number() && right.may_be_number() {
                report.need(Need::NumericCondition, keyword);
                report.uses(Feature::NumericConditions, keyword);
            }
        }
    }
    None
}
