//! A state and the parts of a joint action go in; whether they can be taken together, and what they do, come out.
//!
//! A joint action is a set of ground actions, at most one for each agent. An action without agent counts as that of one more agent.
//! - All conditions read the state before and the joint action.
//! - An action atom is true if the action stands in the joint action.
//!   In a precondition, one that must be false for the precondition to hold does not count the action's own atom;
//!   one that must be true does, and so does every action atom in the condition of an effect.
//! - Of all parts, deletes come first, then adds. A fact that one part adds and another deletes makes the joint action inapplicable.
//! - Where parts must not interfere ([`Concurrency::Safe`]), the precondition of each must still hold once all others have had their effects.
//!
//! The language is that of Kovács 2012; the exemption of the own atom is how Furelos-Blanco & Jonsson (AAAI 2019) compile it,
//! and what all published domains rely on.

use rust_decimal::Decimal;
use rustc_hash::FxHashMap;

use super::relation::Relation;
use super::{Change, Executor, Facts, Misfit, State, Undefined, View, bind};
use crate::model::{ActionId, Domain, Fact, NodeKind, ObjectId, Requirement};
use crate::plan::Step;

/// How much the parts of a joint action may have to do with one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Concurrency {
    /// What action atoms do not forbid is allowed.
    Liberal,
    /// No part may destroy the precondition of another.
    Safe,
}

impl Concurrency {
    /// What a domain means: one of the `CoDMAP` competition, which has privacy and no action atoms, is safe; all others say themselves what excludes what.
    pub fn of(domain: &Domain) -> Self {
        let private = domain.requirements.contains(&Requirement::FactoredPrivacy)
            || domain.requirements.contains(&Requirement::UnfactoredPrivacy)
            || domain.predicates.iter().any(|predicate| predicate.owner.is_some());
        if private && !has_action_atoms(domain) { Self::Safe } else { Self::Liberal }
    }
}

/// Whether some condition of the domain asks about the joint action.
pub fn has_action_atoms(domain: &Domain) -> bool {
    domain.actions.iter().any(|action| {
        let effects = action.effects.iter().map(|effect| &effect.condition);
        let increases = action.increases.iter().map(|increase| &increase.condition);
        effects
            .chain(increases)
            .chain([&action.precondition])
            .flat_map(|formula| &formula.nodes)
            .any(|node| matches!(node.kind, NodeKind::Action(_)))
    })
}

/// Why parts cannot be taken together in a state. Parts are counted from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Clash {
    /// There is no part.
    Empty,
    /// A part is not an instance of its action.
    Misfit(usize, Misfit),
    /// One agent, or nobody, would do two things at once.
    Agent(Option<ObjectId>, [usize; 2]),
    /// The precondition of a part does not hold.
    Precondition(usize),
    /// One part adds what another deletes.
    Conflict {
        /// The fact.
        fact: Fact,
        /// The part that adds it.
        adds: usize,
        /// The part that deletes it.
        deletes: usize,
    },
    /// The precondition of a part does not survive another one, or, without one, all others together.
    Interference {
        /// The part.
        part: usize,
        /// The other one.
        by: Option<usize>,
    },
}

/// The instances of actions that stand in a joint action.
#[derive(Debug, Default)]
pub(crate) struct Crowd {
    relations: FxHashMap<ActionId, Relation>,
}

impl Crowd {
    /// All of `parts` but the one at `without`.
    pub(crate) fn new(parts: &[Step], without: Option<usize>) -> Self {
        let mut crowd = Self::default();
        for (_, part) in parts.iter().enumerate().filter(|&(at, _)| Some(at) != without) {
            let relation = crowd.relations.entry(part.action);
            relation.or_insert_with(|| Relation::new(part.arguments.len())).insert(&part.arguments);
        }
        crowd
    }
}

/// What action atoms are asked about.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Acting<'a> {
    /// The joint action.
    pub(crate) all: &'a Crowd,
    /// The joint action as an atom that must be false sees it.
    pub(crate) others: &'a Crowd,
}

impl<'a> Acting<'a> {
    pub(crate) fn relation(self, action: ActionId, negative: bool) -> Option<&'a Relation> {
        let crowd = if negative { self.others } else { self.all };
        crowd.relations.get(&action)
    }
}

impl<'a> View<'a> {
    /// The same state, as the parts of a joint action see it.
    pub(crate) fn acting(self, all: &'a Crowd, others: &'a Crowd) -> Self {
        Self { joint: Some(Acting { all, others }), ..self }
    }
}

impl Executor<'_> {
    /// Who takes a step: the first argument, if the action has an agent.
    pub fn agent(&self, step: &Step) -> Option<ObjectId> {
        let acts = self.action(step.action).agent;
        acts.then(|| step.arguments.first().copied()).flatten()
    }

    /// Whether `parts` can be taken together in `state`.
    ///
    /// # Errors
    /// The first thing that stands against it.
    pub fn join(
        &self,
        state: &State,
        parts: &[Step],
        concurrency: Concurrency,
    ) -> Result<(), Clash> {
        if parts.is_empty() {
            return Err(Clash::Empty);
        }
        for (at, part) in parts.iter().enumerate() {
            self.fits(part).map_err(|misfit| Clash::Misfit(at, misfit))?;
            let agent = self.agent(part);
            let before = parts[..at].iter().position(|other| self.agent(other) == agent);
            if let Some(before) = before {
                return Err(Clash::Agent(agent, [before, at]));
            }
        }
        let all = Crowd::new(parts, None);
        for at in 0..parts.len() {
            if !self.permits(state, parts, at, &all) {
                return Err(Clash::Precondition(at));
            }
        }
        let effects: Vec<_> = parts
            .iter()
            .map(|part| self.effects(self.view(state).acting(&all, &all), part))
            .collect();
        conflict(&effects)?;
        if concurrency == Concurrency::Safe && parts.len() > 1 {
            self.survive(state, parts, &all)?;
        }
        Ok(())
    }

    /// Whether the precondition of the part at `at` holds in `state`; `all` are the parts.
    fn permits(&self, state: &State, parts: &[Step], at: usize, all: &Crowd) -> bool {
        let others = Crowd::new(parts, Some(at));
        let action = self.action(parts[at].action);
        let precondition = (&action.precondition, &self.queries(parts[at].action).precondition);
        let view = self.view(state).acting(all, &others);
        self.ask(view, &action.scope, precondition, &bind(&action.scope, &parts[at]))
    }

    /// Whether the precondition of each part holds when all others have had their effects.
    fn survive(&self, state: &State, parts: &[Step], all: &Crowd) -> Result<(), Clash> {
        for part in 0..parts.len() {
            let outlives = |others: &[usize]| {
                let mut after = state.clone();
                let (added, deleted) = self.sum(state, parts, others, all);
                self.change(&mut after, added, deleted);
                self.permits(&after, parts, part, all)
            };
            let others: Vec<usize> = (0..parts.len()).filter(|&other| other != part).collect();
            if !outlives(&others) {
                let by = others.iter().copied().find(|&other| !outlives(&[other]));
                return Err(Clash::Interference { part, by });
            }
        }
        Ok(())
    }

    /// What the chosen ones of `parts` add and delete, when all stand in the joint action.
    fn sum(&self, state: &State, parts: &[Step], chosen: &[usize], all: &Crowd) -> (Facts, Facts) {
        let (mut added, mut deleted) = (Facts::default(), Facts::default());
        for &part in chosen {
            let effects = self.effects(self.view(state).acting(all, all), &parts[part]);
            effects.0.into_iter().for_each(|fact| added.push(fact));
            effects.1.into_iter().for_each(|fact| deleted.push(fact));
        }
        (added, deleted)
    }

    /// Turns `state` into the one after all `parts`, which must fit.
    pub fn apply_joint(&self, state: &mut State, parts: &[Step]) -> Change {
        let all = Crowd::new(parts, None);
        let chosen: Vec<usize> = (0..parts.len()).collect();
        let (added, deleted) = self.sum(state, parts, &chosen, &all);
        self.change(state, added, deleted)
    }

    /// What the parts cost together in `state`: the sum of what each costs. They must fit.
    ///
    /// # Errors
    /// The part whose cost needs a value that is not there.
    pub fn joint_cost(&self, state: &State, parts: &[Step]) -> Result<Decimal, (usize, Undefined)> {
        let all = Crowd::new(parts, None);
        let mut sum = Decimal::ZERO;
        for (at, part) in parts.iter().enumerate() {
            let price = self.price(self.view(state).acting(&all, &all), part);
            sum = sum.saturating_add(price.map_err(|undefined| (at, undefined))?);
        }
        Ok(sum)
    }
}

/// Whether no part adds what another deletes.
fn conflict(effects: &[(Facts, Facts)]) -> Result<(), Clash> {
    for (adds, (added, _)) in effects.iter().enumerate() {
        for (deletes, (_, deleted)) in effects.iter().enumerate() {
            let both = added.list.iter().find(|fact| adds != deletes && deleted.contains(fact));
            if let Some(fact) = both {
                return Err(Clash::Conflict { fact: fact.clone(), adds, deletes });
            }
        }
    }
    Ok(())
}
