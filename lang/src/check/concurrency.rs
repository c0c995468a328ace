//! Concurrency constraints go in; what they demand of the actions they name becomes part of the preconditions.
//!
//! A constraint is about a tuple of objects, and counts the agents that use it through the listed actions at one time
//! (Crosby, Jonsson & Rovatsos 2014). Nobody uses it, or at least the lower and at most the upper bound do.
//! As conditions with action atoms: there are so many other agents, and not too many.

use crate::condition::{Condition, equal};
use crate::model::{Action, ActionAtom, Scope, Term, TypeId, Variable, VariableId};
use crate::source::Span;

/// A checked constraint.
pub(super) struct Constraint {
    /// How many agents at least.
    pub(super) least: u32,
    /// How many at most; any number without it.
    pub(super) most: Option<u32>,
    /// The positions of the tuple among the parameters of each action, by its place in the model.
    pub(super) actions: Vec<(usize, Vec<usize>)>,
}

/// Makes the constraints, and that using the second of a dependence needs a use of the first, parts of the preconditions.
pub(super) fn impose(
    constraints: &[Constraint],
    dependences: &[(usize, usize)],
    actions: &mut [Action],
) {
    let signatures: Vec<Vec<Variable>> = actions
        .iter()
        .map(|action| action.scope.variables[..action.scope.parameters as usize].to_vec())
        .collect();
    let agents: Vec<bool> = actions.iter().map(|action| action.agent).collect();
    for constraint in constraints {
        for (at, positions) in constraint.actions.iter().filter(|(at, _)| agents[*at]) {
            let (action, mut added) = (&mut actions[*at], Vec::new());
            let mut writer = Writer { signatures: &signatures, agents: &agents, action, positions };
            if constraint.least > 1 {
                added.push(writer.others(constraint, constraint.least - 1));
            }
            if let Some(most) = constraint.most {
                added.push(writer.others(constraint, most).not());
            }
            writer.demand(added);
        }
    }
    for &(needed, using) in dependences {
        for (at, positions) in constraints[using].actions.iter().filter(|(at, _)| agents[*at]) {
            let action = &mut actions[*at];
            let mut writer = Writer { signatures: &signatures, agents: &agents, action, positions };
            let demanded = writer.others(&constraints[needed], 1);
            writer.demand(vec![demanded]);
        }
    }
}

/// Writes into the precondition of one action.
struct Writer<'a> {
    signatures: &'a [Vec<Variable>],
    agents: &'a [bool],
    action: &'a mut Action,
    /// Where the tuple stands among the action's parameters.
    positions: &'a [usize],
}

impl Writer<'_> {
    fn demand(&mut self, added: Vec<Condition>) {
        let span = self.action.name.span;
        let before =
            std::mem::replace(&mut self.action.precondition, crate::model::Formula::truth(span));
        let added = Condition::all(added).formula(span);
        self.action.precondition = super::condition::conjoin(vec![before, added], span);
    }

    /// There are `count` other agents that use the same tuple through the constraint's actions.
    fn others(&mut self, constraint: &Constraint, count: u32) -> Condition {
        let tuple: Vec<Term> =
            self.positions.iter().map(|&at| Term::Variable(VariableId(at as u32))).collect();
        let span = self.action.name.span;
        let using = || constraint.actions.iter().filter(|(at, _)| self.agents[*at]);
        let mut types: Vec<TypeId> =
            using().flat_map(|(at, _)| self.signatures[*at][0].types.clone()).collect();
        types.sort();
        types.dedup();
        let using: Vec<_> = using().cloned().collect();
        let scope = &mut self.action.scope;
        let agents: Vec<VariableId> = (0..count)
            .map(|number| declare(scope, &format!("?other{}", number + 1), &types, span))
            .collect();
        let mut parts = Vec::new();
        let own = Term::Variable(VariableId(0));
        for (number, &agent) in agents.iter().enumerate() {
            let before = agents[..number].iter().map(|&other| Term::Variable(other));
            for other in before.chain([own]) {
                parts.push(equal(other, Term::Variable(agent), false));
            }
        }
        for &agent in &agents {
            let uses = using.iter().map(|(at, positions)| {
                let mut conditions = Vec::new();
                let mut bound = Vec::new();
                let mut arguments = vec![Term::Variable(agent)];
                for (at, parameter) in self.signatures[*at].iter().enumerate().skip(1) {
                    let place = positions.iter().position(|&position| position == at);
                    arguments.push(place.map_or_else(
                        || {
                            let name = &parameter.name.text;
                            let variable = declare(scope, name, &parameter.types, span);
                            bound.push(variable);
                            Term::Variable(variable)
                        },
                        |place| tuple[place],
                    ));
                }
                for (place, &position) in positions.iter().enumerate() {
                    if position == 0 {
                        conditions.push(equal(Term::Variable(agent), tuple[place], true));
                    }
                }
                let action = crate::model::ActionId(*at as u32);
                conditions.push(Condition::Action(ActionAtom { action, arguments }, true));
                Condition::exists(bound, Condition::all(conditions))
            });
            let uses = uses.collect::<Vec<_>>();
            parts.push(Condition::any(uses));
        }
        Condition::exists(agents, Condition::all(parts))
    }
}

fn declare(scope: &mut Scope, name: &str, types: &[TypeId], span: Span) -> VariableId {
    let name = crate::model::Name { text: name.to_owned(), span };
    scope.variables.push(Variable { name, types: types.to_vec() });
    VariableId(scope.variables.len() as u32 - 1)
}
