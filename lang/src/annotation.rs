//! A [`Tree`] goes in; its [`Annotation`]s come out: what its comments that begin with `;@` say to Caveat.
//!
//! To every other PDDL tool they are comments. Adjacent lines form one run of one or more s-expressions,
//! which belong to the list that encloses the run. `docs/annotations.md` is the page for users.

mod expression;
mod run;
mod place;
mod kind;
mod shape;

use crate::diagnostic::{Diagnostics, misplaced_annotation, unknown_annotation};
use crate::model;
use crate::near::nearest;
use crate::source::{SourceId, Sources, Span};
use crate::tree::{self, NodeId, Tree};

pub use expression::{Children, Expression, Item, ItemId, Value};
pub use kind::{KINDS, Kind, Stand, find};
pub use place::Place;
pub use run::words;
pub(crate) use run::{OPENING, Run, content, runs};

/// One s-expression of a run.
#[derive(Debug, Clone)]
pub struct Annotation {
    /// Its kind; none if there is no kind that its keyword names or nearly names.
    pub kind: Option<&'static Kind>,
    /// The whole of it, kind included.
    pub expression: Expression,
    /// What encloses it.
    pub place: Place,
    /// The list that encloses it, or the whole text outside of all lists.
    pub enclosing: Span,
}

impl Annotation {
    /// Where its keyword stands, or its parenthesis if it has none.
    pub fn kind_span(&self) -> Span {
        let first = self.expression.children(Expression::ROOT).next();
        let whole = self.expression.span(Expression::ROOT);
        match first.filter(|&first| self.expression.word(first).is_some()) {
            Some(first) => self.expression.span(first),
            None => Span { end: whole.start + 1, ..whole },
        }
    }
}

/// What has been read of the task that the annotations are about, for the checks that look at it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Models<'m> {
    /// The domain.
    pub domain: Option<&'m model::Domain>,
    /// The problem.
    pub problem: Option<&'m model::Problem>,
}

/// The annotations of a text, in its order, and what is wrong with them as far as no model is needed to say it.
pub fn annotations(sources: &Sources, id: SourceId) -> (Vec<Annotation>, Diagnostics) {
    let tree = tree::parse(id, &sources.get(id).text, &mut Diagnostics::default());
    read(&tree, Models::default())
}

/// The annotations of a tree, and what is wrong with them.
pub fn read(tree: &Tree<'_>, models: Models<'_>) -> (Vec<Annotation>, Diagnostics) {
    let mut annotations = Vec::new();
    let mut diagnostics = Diagnostics::default();
    if !tree.input().contains(OPENING) {
        return (annotations, diagnostics);
    }
    for run in runs(tree) {
        let content = content(tree, &run);
        // Where parentheses do not match, what else looks wrong may follow from that.
        let sound = content.fault.is_none();
        diagnostics.list.extend(content.fault.or(content.loose));
        if content.expressions.is_empty() {
            continue;
        }
        let place = Place::of(tree, &run);
        let enclosing = enclosing(tree, run.enclosing);
        for expression in content.expressions {
            let kind = expression.head(Expression::ROOT).and_then(find);
            let mut annotation = Annotation { kind, expression, place: place.clone(), enclosing };
            if sound {
                check(&mut annotation, models, &mut diagnostics);
            }
            annotations.push(annotation);
        }
    }
    diagnostics.list.sort_by_key(|one| one.primary.span.start);
    (annotations, diagnostics)
}

fn enclosing(tree: &Tree<'_>, list: Option<NodeId>) -> Span {
    let whole = Span::new(tree.source, 0, tree.input().len() as u32);
    list.map_or(whole, |list| tree.span(list))
}

/// Says what is wrong with an annotation: with its kind, or else with its place and its form.
///
/// A misspelt kind becomes the one that was probably meant.
fn check(annotation: &mut Annotation, models: Models<'_>, diagnostics: &mut Diagnostics) {
    let Some(kind) = annotation.kind else {
        let word = annotation.expression.head(Expression::ROOT).unwrap_or_default();
        let near = nearest(word, KINDS.iter().map(|kind| kind.name));
        let span = annotation.kind_span();
        diagnostics.push(unknown_annotation::unknown_annotation(word, span, near));
        annotation.kind = near.and_then(find);
        return;
    };
    if !kind.stands.iter().any(|stand| stand.admits(&annotation.place)) {
        let stands: Vec<String> = kind.stands.iter().map(|stand| stand.describe()).collect();
        diagnostics.push(misplaced_annotation::misplaced_annotation(
            kind.name,
            annotation.kind_span(),
            &annotation.place,
            &stands.join(" or "),
        ));
    }
    (kind.check)(annotation, models, diagnostics);
}

#[cfg(test)]
mod tests;
