//! An action goes in; the same as a possible part of a joint action comes out: what it demands, and what it changes under which condition.

use crate::condition::{Condition, depth};
use crate::model::{Action, ActionId, Atom, Formula, Literal, Term, VariableId};

/// Who takes a part.
pub(super) const AGENT: Term = Term::Variable(VariableId(0));

/// An action as a part of a joint action.
pub(super) struct Part<'m> {
    pub(super) id: ActionId,
    pub(super) action: &'m Action,
    pub(super) precondition: Condition,
    pub(super) changes: Vec<Change<'m>>,
}

/// What a part adds and deletes wherever a condition holds.
pub(super) struct Change<'m> {
    /// What it is done for each of.
    pub(super) variables: &'m [VariableId],
    pub(super) condition: Condition,
    pub(super) literals: &'m [Literal],
}

impl Change<'_> {
    /// Whether it is done whenever the action is, and once.
    pub(super) fn is_always(&self) -> bool {
        self.variables.is_empty() && self.condition == Condition::TRUE
    }
}

impl<'m> Part<'m> {
    /// Nothing if a condition is nested too deep.
    pub(super) fn new(id: ActionId, action: &'m Action) -> Option<Self> {
        let change = |effect: &'m crate::model::Effect| {
            Some(Change {
                variables: &effect.variables,
                condition: condition(&effect.condition)?,
                literals: &effect.literals,
            })
        };
        Some(Self {
            id,
            action,
            precondition: condition(&action.precondition)?,
            changes: action.effects.iter().map(change).collect::<Option<_>>()?,
        })
    }

    /// The parameters, the agent first.
    pub(super) fn parameters(&self) -> impl Iterator<Item = Term> + use<> {
        (0..self.action.scope.parameters).map(|id| Term::Variable(VariableId(id)))
    }

    /// Whether a variable is one of a quantifier in a condition.
    pub(super) fn quantifies(&self, variable: VariableId) -> bool {
        variable.0 >= self.action.scope.parameters
            && self.changes.iter().all(|change| !change.variables.contains(&variable))
    }

    /// Whether the atom holds wherever `change` is done.
    pub(super) fn demands(&self, change: &Change<'_>, atom: &Atom) -> bool {
        let conjuncts = self.precondition.conjuncts().iter().chain(change.condition.conjuncts());
        conjuncts
            .into_iter()
            .any(|one| matches!(one, Condition::Atom(other, true) if other == atom))
    }

    /// The literals that happen wherever `change` does: its own, and those that always happen.
    pub(super) fn along(&self, change: &Change<'m>) -> impl Iterator<Item = &'m Literal> {
        let own = change.literals;
        let always = self.changes.iter().filter(|other| other.is_always());
        let others = always.filter(move |other| !std::ptr::eq(other.literals, own));
        own.iter().chain(others.flat_map(|other| other.literals))
    }
}

/// How deep a condition that people write may be nested.
const DEEPEST: usize = 200;

/// A condition in the form in which the lints look at it; nothing if it is nested too deep.
pub(super) fn condition(formula: &Formula) -> Option<Condition> {
    let short = depth(formula) <= DEEPEST;
    short.then(|| Condition::new(formula).map(spread)).flatten()
}

/// The same with one quantifier over each conjunct in place of one over all, and in place of several around one another.
fn spread(condition: Condition) -> Condition {
    match condition {
        Condition::All(parts) => Condition::all(parts.into_iter().map(spread)),
        Condition::Any(parts) => Condition::any(parts.into_iter().map(spread)),
        Condition::Exists(variables, body) => Condition::exists(variables, spread(*body)),
        Condition::Forall(variables, body) => match spread(*body) {
            Condition::All(parts) => {
                Condition::all(parts.into_iter().map(|part| under(&variables, part)))
            }
            body => under(&variables, body),
        },
        leaf => leaf,
    }
}

/// A condition that is spread already, for every binding of more variables.
fn under(variables: &[VariableId], condition: Condition) -> Condition {
    match condition {
        Condition::Forall(inner, body) => {
            Condition::Forall([variables, inner.as_slice()].concat(), body)
        }
        body => Condition::forall(variables.to_vec(), body),
    }
}
