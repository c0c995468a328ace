//! The actions of a domain go in; their conditions come out as trees, with what the semantics adds to them written out as action atoms:
//! that no part adds what another deletes and, where parts must not interfere, that none destroys the precondition of another.

use super::interact::Feeds;
use super::protect::{Protector, counting_own};
use super::world::{Simplifier, World};
use crate::condition::{self, Condition};
use crate::execute::joint::Concurrency;
use crate::model::{
    Action, ActionAtom, ActionId, Atom, Increase, Literal, Scope, Term, TypeId, Variable,
    VariableId,
};

/// An action to be compiled.
#[derive(Debug, Clone)]
pub(super) struct Schema {
    pub(super) id: ActionId,
    pub(super) name: String,
    /// The action's variables, and those of what is added to its precondition.
    pub(super) scope: Scope,
    /// Whether the first parameter is the agent.
    pub(super) agent: bool,
    pub(super) precondition: Condition,
    /// What keeps the precondition true while the others have their effects, where parts must not interfere: parts of the precondition too.
    pub(super) protections: Vec<Condition>,
    /// That no effect that depends on a condition clashes with one of another part: parts of the precondition, which blocks see to in their own way.
    pub(super) clashes: Vec<Condition>,
    pub(super) effects: Vec<Effect>,
    pub(super) increases: Vec<Increase>,
}

/// For every binding of the variables under which the condition holds, all literals.
#[derive(Debug, Clone)]
pub(super) struct Effect {
    pub(super) variables: Vec<VariableId>,
    pub(super) condition: Condition,
    pub(super) literals: Vec<Literal>,
}

impl Effect {
    /// Whether it happens always, and to one fact for each literal.
    pub(super) fn is_plain(&self) -> bool {
        self.variables.is_empty() && self.condition == Condition::TRUE
    }
}

impl Schema {
    fn new(id: ActionId, actions: &[Action]) -> Option<Self> {
        let action = &actions[id.index()];
        let effects = action.effects.iter().map(|effect| {
            Some(Effect {
                variables: effect.variables.clone(),
                condition: Condition::new(&effect.condition)?,
                literals: effect.literals.clone(),
            })
        });
        let precondition = Condition::new(&action.precondition)?;
        Some(Self {
            id,
            name: action.name.text.clone(),
            scope: action.scope.clone(),
            agent: action.agent,
            precondition: if action.agent { others(precondition, actions) } else { precondition },
            protections: Vec::new(),
            clashes: Vec::new(),
            effects: effects.collect::<Option<_>>()?,
            increases: action.increases.clone(),
        })
    }

    /// All that must hold before but that effects do not clash.
    pub(super) fn stated(&self) -> impl Iterator<Item = &Condition> {
        self.precondition.conjuncts().iter().chain(&self.protections)
    }

    /// All that must hold before.
    pub(super) fn demands(&self) -> impl Iterator<Item = &Condition> {
        self.stated().chain(&self.clashes)
    }

    /// The parameters.
    pub(super) fn parameters(&self) -> &[Variable] {
        &self.scope.variables[..self.scope.parameters as usize]
    }

    /// Whether a term is the agent.
    pub(super) fn is_agent(&self, term: Term) -> bool {
        self.agent && term == Term::Variable(VariableId(0))
    }
}

/// The precondition of an agent's action without what need not be said: that another one is the agent itself, or does not act.
/// The agent itself does nothing but the action, which does not count.
fn others(condition: Condition, actions: &[Action]) -> Condition {
    let own = Term::Variable(VariableId(0));
    match condition {
        Condition::All(parts) => {
            Condition::all(parts.into_iter().map(|part| others(part, actions)))
        }
        Condition::Forall(variables, body) => Condition::forall(variables, others(*body, actions)),
        Condition::Exists(variables, body) => Condition::exists(variables, others(*body, actions)),
        Condition::Any(parts) => {
            let idle: Vec<Term> = parts
                .iter()
                .filter_map(|part| match part {
                    Condition::Action(atom, false) if actions[atom.action.index()].agent => {
                        atom.arguments.first().copied()
                    }
                    _ => None,
                })
                .collect();
            let said = |part: &Condition| match *part {
                Condition::Equal(one, other, true) => {
                    one == own && idle.contains(&other) || other == own && idle.contains(&one)
                }
                _ => false,
            };
            Condition::any(
                parts.into_iter().filter(|part| !said(part)).map(|part| others(part, actions)),
            )
        }
        leaf => leaf,
    }
}

/// The schemas of `world`'s domain. Nothing if a condition is nested too deep. Also whether they say exactly what the semantics does,
/// and not more: with [`Concurrency::Safe`], what recursive derived predicates depend on must not be changed at all.
pub(super) fn schemas(
    world: &World<'_>,
    feeds: &Feeds,
    concurrency: Concurrency,
) -> Option<(Vec<Schema>, bool)> {
    let actions = &world.domain.actions;
    let mut schemas = (0..actions.len() as u32)
        .map(|at| Schema::new(ActionId(at), actions))
        .collect::<Option<Vec<_>>>()?;
    let plain = schemas.clone();
    let mut exact = true;
    for (schema, own) in schemas.iter_mut().zip(&plain) {
        if concurrency == Concurrency::Safe {
            let (schemas, own) = (&plain, own.clone());
            let mut protector = Protector { world, schemas, feeds, own, exact: true };
            schema.protections = protector.demands();
            exact &= protector.exact;
            schema.scope = protector.own.scope;
        }
        let mut added = Vec::new();
        for other in &plain {
            let (plain, clashes) = conflicts(world, own, other, &mut schema.scope);
            added.extend(plain);
            schema.clashes.extend(clashes);
        }
        let before = std::mem::replace(&mut schema.precondition, Condition::TRUE);
        schema.precondition = Condition::all(std::iter::once(before).chain(added));
        let simplifier = Simplifier { world, variables: &schema.scope.variables, distinct: &[] };
        let before = std::mem::replace(&mut schema.precondition, Condition::TRUE);
        schema.precondition = simplifier.simplify(before);
        for list in [&mut schema.protections, &mut schema.clashes] {
            let parts = std::mem::take(list).into_iter().map(|part| simplifier.simplify(part));
            *list = Condition::all(parts).conjuncts().to_vec();
        }
    }
    Some((schemas, exact))
}

/// That no instance of `other` deletes what `own` adds, or adds what it deletes: first where both happen always, then all others.
fn conflicts(
    world: &World<'_>,
    own: &Schema,
    other: &Schema,
    scope: &mut Scope,
) -> (Vec<Condition>, Vec<Condition>) {
    let (mut plain, mut clashes) = (Vec::new(), Vec::new());
    for mine in &own.effects {
        for literal in &mine.literals {
            for theirs in &other.effects {
                let opposite =
                    theirs.literals.iter().filter(|one| one.positive != literal.positive);
                for against in opposite {
                    if !may_meet(world, (own, &literal.atom), (other, &against.atom)) {
                        continue;
                    }
                    let list = if mine.is_plain() && theirs.is_plain() {
                        &mut plain
                    } else {
                        &mut clashes
                    };
                    let mine = (mine.variables.clone(), mine.condition.clone());
                    list.push(never(
                        scope,
                        own,
                        mine,
                        &literal.atom,
                        (other, theirs, &against.atom),
                    ));
                }
            }
        }
    }
    (plain, clashes)
}

/// That no other instance of a schema has the effect on the very fact `atom`, while `mine` holds; `owner` is who demands it.
pub(super) fn never(
    scope: &mut Scope,
    owner: &Schema,
    mine: (Vec<VariableId>, Condition),
    atom: &Atom,
    (other, theirs, against): (&Schema, &Effect, &Atom),
) -> Condition {
    // Both sides get variables of their own, since each binder must have its own.
    let own_bound: Vec<VariableId> = (0..scope.variables.len() as u32).map(VariableId).collect();
    let own = copy_bound(scope, &own_bound, &mine.0);
    let (variables, condition) = mine;
    let first = scope.variables.len() as u32;
    scope.variables.extend(other.scope.variables.iter().cloned());
    let theirs_new = |variable: VariableId| Term::Variable(VariableId(first + variable.0));
    let term = |term: Term, new: &dyn Fn(VariableId) -> Term| match term {
        Term::Variable(variable) => new(variable),
        object @ Term::Object(_) => object,
    };
    let mine_new = |variable: VariableId| own[variable.index()];
    let conditions = [condition.rename(&mine_new), theirs.condition.clone().rename(&theirs_new)];
    let mut parts = vec![counting_own(Condition::all(conditions).not(), owner)];
    let arguments = (0..other.scope.parameters).map(|at| theirs_new(VariableId(at))).collect();
    parts.push(Condition::Action(ActionAtom { action: other.id, arguments }, false));
    for (&left, &right) in atom.arguments.iter().zip(&against.arguments) {
        parts.push(condition::equal(term(left, &mine_new), term(right, &theirs_new), false));
    }
    let mut bound: Vec<VariableId> = variables
        .iter()
        .filter_map(|variable| match own[variable.index()] {
            Term::Variable(variable) => Some(variable),
            Term::Object(_) => None,
        })
        .collect();
    bound.extend((0..other.scope.parameters).map(|at| VariableId(first + at)));
    bound.extend(theirs.variables.iter().map(|variable| VariableId(first + variable.0)));
    Condition::forall(bound, Condition::any(parts))
}

/// Fresh copies of the variables `copied` in `scope`; all others stay.
fn copy_bound(scope: &mut Scope, all: &[VariableId], copied: &[VariableId]) -> Vec<Term> {
    all.iter()
        .map(|&variable| {
            if !copied.contains(&variable) {
                return Term::Variable(variable);
            }
            scope.variables.push(scope.variables[variable.index()].clone());
            Term::Variable(VariableId(scope.variables.len() as u32 - 1))
        })
        .collect()
}

/// Whether an atom of one part and an atom of a part of another agent may be the same fact.
pub(super) fn may_meet(
    world: &World<'_>,
    (one, atom): (&Schema, &Atom),
    (other, against): (&Schema, &Atom),
) -> bool {
    atom.predicate == against.predicate
        && atom.arguments.iter().zip(&against.arguments).all(|(&left, &right)| {
            let agents = one.is_agent(left) && other.is_agent(right);
            let objects = match (left, right) {
                (Term::Object(left), Term::Object(right)) => left == right,
                _ => true,
            };
            let (left, right): (&[TypeId], &[TypeId]) = (
                world.types(left, &one.scope.variables),
                world.types(right, &other.scope.variables),
            );
            !agents && objects && world.overlap(left, right)
        })
}
