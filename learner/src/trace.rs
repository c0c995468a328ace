//! What was done, in symbols: a [`Trace`] of states and the actions between them goes from texts and demonstrations to [`crate::rule`].
//!
//! What predicates and actions there are stands in a [`Domain`] whose actions have parameters and nothing else:
//! [`vocabulary`] builds one, takes one from PDDL, or infers one from texts.
//! Ids are those of that domain; its constants are the first objects of each trace.

mod scan;
mod fault;
mod read;
mod infer;
pub mod vocabulary;
mod print;

use lang::model::{Domain, Fact, Object, ObjectId, PredicateId};
use lang::plan::Step;
use rustc_hash::FxHashMap;

pub use fault::Fault;
pub use infer::infer;
pub use print::{print, print_joint};
pub use read::{Reading, read};

/// Indexes [`Trace::facts`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FactId(pub u32);

impl FactId {
    /// The place of the fact in [`Trace::facts`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The facts that hold at one time, sorted; all others do not hold.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct State {
    facts: Box<[FactId]>,
}

impl State {
    /// The facts that hold, sorted.
    pub fn facts(&self) -> &[FactId] {
        &self.facts
    }

    /// Whether a fact holds.
    pub fn holds(&self, fact: FactId) -> bool {
        self.facts.binary_search(&fact).is_ok()
    }
}

/// What is done between two states.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Joint {
    /// One for each agent, none where it does nothing; a single one where there are no agents.
    pub parts: Vec<Option<Step>>,
    /// Nothing was done besides: otherwise what changed may have other causes, and nothing is learned about effects.
    pub whole: bool,
}

/// A sequence of states, with what was done between them.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// What it is called in messages and in `:seen`, such as the name of its file.
    pub name: String,
    /// All objects, the constants of the domain first.
    pub objects: Vec<Object>,
    /// Who acts in each slot of a step; empty where there are no agents.
    pub agents: Vec<ObjectId>,
    /// Every fact that holds in some state, each once.
    pub facts: Vec<Fact>,
    /// The states in their order.
    pub states: Vec<State>,
    /// What is done after each state but the last.
    pub steps: Vec<Joint>,
    /// Facts by predicate and arguments.
    known: FxHashMap<Box<[u32]>, FactId>,
}

impl Trace {
    /// A trace without states, in which the constants of `domain` are all objects.
    pub fn new(name: impl Into<String>, domain: &Domain) -> Self {
        Self { name: name.into(), objects: domain.constants.clone(), ..Self::default() }
    }

    /// The id of a fact, which need not hold in any state.
    pub fn fact(&mut self, predicate: PredicateId, arguments: &[ObjectId]) -> FactId {
        let key: Vec<u32> = key(predicate, arguments.iter().copied()).collect();
        if let Some(&id) = self.known.get(key.as_slice()) {
            return id;
        }
        let id = FactId(self.facts.len() as u32);
        self.facts.push(Fact { predicate, arguments: arguments.into() });
        self.known.insert(key.into(), id);
        id
    }

    /// The id of a fact, if it was ever spoken of.
    pub fn find(&self, fact: &Fact) -> Option<FactId> {
        let key: Vec<u32> = key(fact.predicate, fact.arguments.iter().copied()).collect();
        self.known.get(key.as_slice()).copied()
    }

    /// The same without memory of its own: `scratch` is overwritten.
    pub(crate) fn look_up(
        &self,
        predicate: PredicateId,
        arguments: impl Iterator<Item = ObjectId>,
        scratch: &mut Vec<u32>,
    ) -> Option<FactId> {
        scratch.clear();
        scratch.extend(key(predicate, arguments));
        self.known.get(scratch.as_slice()).copied()
    }

    /// Ends with the state in which exactly `facts` hold.
    ///
    /// # Panics
    /// If nothing was done since the last state.
    pub fn state(&mut self, mut facts: Vec<FactId>) {
        assert_eq!(self.states.len(), self.steps.len(), "a step lies between two states");
        facts.sort_unstable();
        facts.dedup();
        self.states.push(State { facts: facts.into() });
    }

    /// What is done in the last state: one step at most for each agent, or a single one.
    ///
    /// # Panics
    /// If no state came before.
    pub fn step(&mut self, joint: Joint) {
        assert_eq!(self.states.len(), self.steps.len() + 1, "a step follows a state");
        self.steps.push(joint);
    }

    /// Each step with the states before and after it; a step after the last state is none.
    pub fn transitions(&self) -> impl Iterator<Item = (&State, &Joint, &State)> {
        let pairs = self.states.windows(2);
        pairs.zip(&self.steps).map(|(states, joint)| (&states[0], joint, &states[1]))
    }
}

fn key(
    predicate: PredicateId,
    arguments: impl Iterator<Item = ObjectId>,
) -> impl Iterator<Item = u32> {
    std::iter::once(predicate.0).chain(arguments.map(|object| object.0))
}
