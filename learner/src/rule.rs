//! Traces go in; what their actions demand and do comes out, as [`Learned`] actions.
//!
//! From examples in which an action was taken, what it demands is known only between two bounds:
//! at least what it changes (the rule of the thesis, section 3.2.2), at most all that held whenever it was taken.
//! The upper bound makes plans that cannot fail: the *safe* model of Juba, Le and Stern (KR 2021).
//! Several agents are learned from together as in Mordoch, Stern and Juba (*Safe Learning of Multi-Agent Action Models*, MA-SAM):
//! an effect is credited to an action only if no other part of the joint step can have had it.
//!
//! What the safe model promises: if the true actions demand only positive literals and delete only what they demand or what was seen to be deleted,
//! each step that the learned model allows is allowed by the true one, with the same result.
//! With [`Options::negative`] the promise holds for all actions of STRIPS with negative preconditions.
//! Several parameters may have been bound to one object: what then remains unclear is kept out of the model by `=` and `(not (= …))`
//! in the precondition, or the action is refused.
//! Joint steps are as safe where no part destroys what another demands, and no action adds what it demands.
//!
//! [`Evidence`] is all that is kept of the examples; it can be added to at any time.

mod candidate;
mod evidence;
mod settle;
mod guard;
mod partner;
mod conclude;
mod reason;
pub mod schema;

use lang::model::{ActionId, Atom, Domain, PredicateId, Term};

use crate::trace::Trace;

pub use evidence::Evidence;
pub use reason::{Reason, Refusal, describe};

/// Which bound of the preconditions is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rule {
    /// Only what the action changes, as the thesis has it. Plans may fail.
    Changed,
    /// All that held whenever the action was taken. Plans cannot fail.
    Safe,
    /// As `Safe`, and what is between the bounds is named as doubtful.
    #[default]
    Both,
}

/// When an action demands that another agent takes another one at the same time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Company {
    /// Never: an action of which it is not clear whether an effect is its own is refused.
    #[default]
    Never,
    /// Where an effect never came without another part that may have been the cause: one that all objects of the effect are arguments of.
    Unclear,
    /// Also where an effect never came without another part that one object of the effect is an argument of, such as what another hand holds.
    Together,
}

/// How to learn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// Which bound counts.
    pub rule: Rule,
    /// Demand also that what never held before the action does not hold.
    pub negative: bool,
    /// The share of the examples, from 0 to below 0.5, that may be outvoted by the others.
    pub tolerance: f64,
    /// When actions of several agents demand each other.
    pub joint: Company,
    /// What is said of hands: the lower bound demands it also where it does not change, as the thesis has it.
    pub hand: Vec<PredicateId>,
}

/// What was learned.
#[derive(Debug, Clone)]
pub struct Learned {
    /// What predicates, types and actions there are; the actions of this domain are bare.
    pub domain: Domain,
    /// By which rule.
    pub rule: Rule,
    /// The actions of which enough is known, in the order of the domain.
    pub actions: Vec<Action>,
    /// The other actions of the domain, and why.
    pub refused: Vec<Refusal>,
    /// How many facts changed that no action of the step can be about.
    pub strays: u32,
}

/// An action that was learned. The variables of its atoms are the parameters of its namesake in [`Learned::domain`].
#[derive(Debug, Clone, PartialEq)]
pub struct Action {
    /// Which action of the domain.
    pub action: ActionId,
    /// How often it was seen.
    pub count: u32,
    /// In which traces, and how often in each.
    pub sources: Vec<(String, u32)>,
    /// The upper bound of the precondition: what always held before.
    pub required: Vec<Atom>,
    /// The lower bound: what always held before and is deleted, or is said of hands.
    pub changed: Vec<Atom>,
    /// What must not hold before; empty without [`Options::negative`].
    pub absent: Vec<Atom>,
    /// What must be the same object.
    pub same: Vec<(Term, Term)>,
    /// What must not be the same object.
    pub distinct: Vec<(Term, Term)>,
    /// What it adds.
    pub adds: Vec<Atom>,
    /// What it deletes.
    pub deletes: Vec<Atom>,
    /// What is in the upper bound and not in the lower one, each with its evidence.
    pub doubts: Vec<Doubt>,
    /// What must be done at the same time by other agents.
    pub partners: Vec<Partner>,
}

impl Action {
    /// The positive precondition by a rule.
    pub fn precondition(&self, rule: Rule) -> &[Atom] {
        match rule {
            Rule::Changed => &self.changed,
            Rule::Safe | Rule::Both => &self.required,
        }
    }
}

/// A precondition that may be a coincidence, and what speaks for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doubt {
    /// What held.
    pub atom: Atom,
    /// How often it held when the action was taken.
    pub seen: u32,
    /// How often the action was taken.
    pub of: u32,
    /// How many facts of this predicate there could have been in the states before steps, and how many there were:
    /// what holds nearly always says little.
    pub usual: Usual,
}

/// How common the facts of a predicate are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Usual {
    /// How many facts held, summed over states.
    pub held: u64,
    /// How many could have, summed over states.
    pub possible: u64,
}

/// An action that another agent must take at the same time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Partner {
    /// Which action.
    pub action: ActionId,
    /// Its arguments in terms of the action that demands it; none where any object will do.
    pub arguments: Vec<Option<Term>>,
}

/// Learns the actions of `domain` from traces in its words.
pub fn learn(domain: &Domain, traces: &[Trace], options: &Options) -> Learned {
    let mut evidence = Evidence::new(domain);
    for trace in traces {
        evidence.add(trace);
    }
    evidence.conclude(options)
}
