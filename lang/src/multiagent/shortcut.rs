//! A team goes in; one ordinary action that does what all its parts do at once comes out.

use super::assembly::Draft;
use super::team::{Finder, Team};
use crate::condition::Condition;
use crate::model::{Atom, Expression, Increase, PredicateId, Term};

/// The team as an action; none if its parts can never act together.
///
/// `before` orders agents, so that of two ways to say one joint action only one is left.
pub(super) fn shortcut(finder: &Finder<'_>, team: &Team, before: PredicateId) -> Option<Draft> {
    let schemas = finder.schemas;
    let names: Vec<&str> =
        team.members.iter().map(|member| schemas[member.schema].name.as_str()).collect();
    let note = match names.as_slice() {
        [one] => format!("{one}, alone"),
        several => format!("{} at the same time", several.join(" and ")),
    };
    let mut scope = finder.scope(team);
    let mut precondition = Vec::new();
    let ordered = team.interchangeable();
    for one in 0..team.members.len() {
        for other in one + 1..team.members.len() {
            let [left, right] = [one, other].map(|at| &team.members[at]);
            if !schemas[left.schema].agent || !schemas[right.schema].agent {
                continue;
            }
            let (left, right) = (left.arguments[0], right.arguments[0]);
            let types = |term| finder.world.types(term, &team.variables);
            if ordered.contains(&(one, other)) {
                let atom = Atom { predicate: before, arguments: vec![left, right] };
                precondition.push(Condition::Atom(atom, true));
            } else if finder.world.overlap(types(left), types(right)) {
                precondition.push(crate::condition::equal(left, right, false));
            }
        }
    }
    for (of, member) in team.members.iter().enumerate() {
        for part in schemas[member.schema].demands() {
            precondition.push(finder.value(team, of, part, &mut scope));
        }
    }
    if Condition::all(precondition.clone()) == Condition::FALSE {
        return None;
    }
    let mut effects = Vec::new();
    let mut increases = Vec::new();
    for (of, member) in team.members.iter().enumerate() {
        let renamed = finder.renaming(team, of, &mut scope);
        let term = |term: Term| match term {
            Term::Variable(id) => renamed[id.index()],
            object @ Term::Object(_) => object,
        };
        let terms = |terms: &[Term]| terms.iter().map(|&old| term(old)).collect::<Vec<_>>();
        for effect in &schemas[member.schema].effects {
            let condition = finder.effect_value(team, &effect.condition, &renamed, &scope);
            if condition == Condition::FALSE {
                continue;
            }
            let variables = effect
                .variables
                .iter()
                .filter_map(|&variable| match term(Term::Variable(variable)) {
                    Term::Variable(new) => Some(new),
                    Term::Object(_) => None,
                })
                .collect();
            let literals = effect.literals.iter().map(|literal| {
                let arguments = terms(&literal.atom.arguments);
                (Atom { predicate: literal.atom.predicate, arguments }, literal.positive)
            });
            effects.push((variables, condition, literals.collect()));
        }
        for increase in &schemas[member.schema].increases {
            let condition = Condition::new(&increase.condition)?;
            let condition = finder.effect_value(team, &condition, &renamed, &scope);
            if condition == Condition::FALSE {
                continue;
            }
            let value = match &increase.value {
                Expression::Function(function, arguments) => {
                    Expression::Function(*function, terms(arguments))
                }
                number @ Expression::Number(_) => number.clone(),
            };
            let bound =
                terms(&increase.variables.iter().map(|&id| Term::Variable(id)).collect::<Vec<_>>());
            increases.push(Increase {
                variables: bound
                    .into_iter()
                    .filter_map(|term| match term {
                        Term::Variable(id) => Some(id),
                        Term::Object(_) => None,
                    })
                    .collect(),
                condition: condition.formula(increase.span),
                function: increase.function,
                arguments: terms(&increase.arguments),
                value,
                span: increase.span,
            });
        }
    }
    let mut draft = Draft::new(names.join("--"), scope, note);
    (draft.precondition, draft.effects, draft.increases) = (precondition, effects, increases);
    Some(draft)
}
