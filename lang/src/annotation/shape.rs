//! One annotation of a known kind goes in; what is wrong with its form comes out.

use rust_decimal::Decimal;

use super::expression::{Expression, ItemId, Value};
use super::{Annotation, Models};
use crate::diagnostic::{Diagnostics, malformed_annotation};
use crate::group;
use crate::near::nearest;

/// The fields of `:causal`.
const CAUSAL: [&str; 3] = [":outcome", ":at-least", ":bind"];

/// `(:causal "FILE" :outcome (= VARIABLE VALUE) :at-least PROBABILITY :bind ((VARIABLE TERM …) …))`
pub(super) fn causal(annotation: &Annotation, _: Models<'_>, diagnostics: &mut Diagnostics) {
    let expression = &annotation.expression;
    let mut wrong = |id, expected: &str, example: &str| {
        wrong(annotation, id, expected, example, diagnostics);
    };
    let mut parts = expression.children(Expression::ROOT).skip(1).peekable();
    if parts.next_if(|&part| matches!(expression.item(part).value, Value::Text(_))).is_none() {
        return wrong(parts.peek().copied(), "the file of its model", "\"stack.cbn.json\"");
    }
    let mut seen: Vec<&str> = Vec::new();
    while let Some(part) = parts.next() {
        let word = expression.word(part).unwrap_or_default();
        let Some(&field) = CAUSAL.iter().find(|field| field.eq_ignore_ascii_case(word)) else {
            if word.is_empty() {
                return wrong(Some(part), "the keyword of a field", ":at-least");
            }
            let (span, near) = (expression.span(part), nearest(word, CAUSAL));
            let unknown = malformed_annotation::unknown_field(":causal", word, span, near);
            return diagnostics.push(unknown);
        };
        if seen.contains(&field) {
            let again = malformed_annotation::repeated(field, expression.span(part));
            return diagnostics.push(again);
        }
        seen.push(field);
        let value = parts.next();
        if !value.is_some_and(|value| causal_field(expression, field, value)) {
            let (expected, example) = match field {
                ":outcome" => OUTCOME,
                ":at-least" => ("a probability from 0 to 1", ":at-least 0.9"),
                _ => ("a list of variables with their terms", ":bind ((xOff (x-offset ?a ?b)))"),
            };
            return wrong(value.or(Some(part)), expected, example);
        }
    }
    if !seen.contains(&":outcome") {
        wrong(None, OUTCOME.0, OUTCOME.1);
    }
}

/// What `:outcome` is.
const OUTCOME: (&str, &str) = ("an outcome", ":outcome (= onTop 1)");

/// Whether a field of `:causal` has the value that it should have.
fn causal_field(expression: &Expression, field: &str, value: ItemId) -> bool {
    match field {
        ":outcome" => equation(expression, value, |_| true),
        ":at-least" => number(expression, value)
            .is_some_and(|number| number >= Decimal::ZERO && number <= Decimal::ONE),
        _ => {
            expression.is_list(value)
                && expression.children(value).all(|one| expression.head(one).is_some())
        }
    }
}

/// `(:measured (FUNCTION ?x - type …) …)`
pub(super) fn measured(annotation: &Annotation, _: Models<'_>, diagnostics: &mut Diagnostics) {
    let named = |part| is_atom(&annotation.expression, part);
    each(annotation, "functions with their parameters", "(weight ?c - cube)", named, diagnostics);
}

/// `(:observed (= (FUNCTION object …) NUMBER) …)`
pub(super) fn observed(annotation: &Annotation, _: Models<'_>, diagnostics: &mut Diagnostics) {
    let expression = &annotation.expression;
    let value = |part| {
        equation(expression, part, |function| is_atom(expression, function))
            && expression.children(part).nth(2).is_some_and(|id| number(expression, id).is_some())
    };
    each(annotation, "values", "(= (weight box) 2.5)", value, diagnostics);
}

/// `(:exactly-one (PREDICATE …) …)`
pub(super) fn group(annotation: &Annotation, models: Models<'_>, diagnostics: &mut Diagnostics) {
    let before = diagnostics.list.len();
    let atom = |part| is_atom(&annotation.expression, part);
    each(annotation, "atoms", "(holding ?x)", atom, diagnostics);
    if let (true, Some(domain)) = (diagnostics.list.len() == before, models.domain) {
        diagnostics.list.extend(group::wrong(annotation, domain, models.problem));
    }
}

/// `(:seen …)`: what is said is for whoever learns.
pub(super) fn seen(_: &Annotation, _: Models<'_>, _: &mut Diagnostics) {}

/// Wants at least one part, and every part to be `right`.
fn each(
    annotation: &Annotation,
    expected: &str,
    example: &str,
    right: impl Fn(ItemId) -> bool,
    diagnostics: &mut Diagnostics,
) {
    let mut parts = annotation.expression.children(Expression::ROOT).skip(1).peekable();
    let empty = parts.peek().is_none();
    let odd = parts.find(|&part| !right(part));
    if empty || odd.is_some() {
        wrong(annotation, odd, expected, example, diagnostics);
    }
}

/// Whether the item is a list that begins with a name.
fn is_atom(expression: &Expression, id: ItemId) -> bool {
    expression.head(id).is_some_and(|head| !head.starts_with([':', '?']))
}

/// Whether the item is `(= LEFT RIGHT)`.
fn equation(expression: &Expression, id: ItemId, left: impl Fn(ItemId) -> bool) -> bool {
    let parts: Vec<ItemId> = expression.children(id).take(4).collect();
    match parts.as_slice() {
        [equals, first, _] => expression.word(*equals) == Some("=") && left(*first),
        _ => false,
    }
}

fn number(expression: &Expression, id: ItemId) -> Option<Decimal> {
    expression.word(id)?.parse().ok()
}

/// Something else than `expected` stands at `id`, or nothing does.
fn wrong(
    annotation: &Annotation,
    id: Option<ItemId>,
    expected: &str,
    example: &str,
    diagnostics: &mut Diagnostics,
) {
    let kind = annotation.kind.map_or("", |kind| kind.name);
    let span = id.map(|id| annotation.expression.span(id));
    diagnostics.push(malformed_annotation::needs(
        kind,
        annotation.kind_span(),
        span,
        expected,
        example,
    ));
}
