//! What may be changed, and at what price: the wishes of whoever asks for an excuse.

use lang::group::Group;
use lang::model::{Domain, PredicateId};

/// What it costs, unless said otherwise, to change a fact that no action changes and that relates two or more objects, such as a road.
pub const STATIC: u32 = 3;
/// The same of a fact about one object in a domain without types, where such facts stand for types.
pub const KIND: u32 = 10;
/// What a new object costs, unless said otherwise.
pub const OBJECT: u32 = 5;

/// What may be changed, and at what price.
#[derive(Debug, Clone)]
pub struct Policy {
    /// What a change of a predicate's facts costs, where that was said; at least 1.
    pub costs: Vec<(PredicateId, u32)>,
    /// Predicates that must stay as they are.
    pub protected: Vec<PredicateId>,
    /// The only predicates whose facts may become true or, where nothing else becomes true instead, false.
    pub only: Option<Vec<PredicateId>>,
    /// Whether facts of the goal may be changed, too.
    pub goal: bool,
    /// How many new objects of each type there may be.
    pub objects: u32,
    /// What a new object costs.
    pub object_cost: u32,
    /// What is known of possible states beyond what the actions say.
    pub declared: Vec<Group>,
    /// Whether the initial state may tell what excludes what.
    pub presume: bool,
}

impl Default for Policy {
    fn default() -> Self {
        Self {
            costs: Vec::new(),
            protected: Vec::new(),
            only: None,
            goal: false,
            objects: 1,
            object_cost: OBJECT,
            declared: Vec::new(),
            presume: true,
        }
    }
}

impl Policy {
    /// What it costs to make a fact of `predicate` true; nothing where that is not allowed. `changes` says whether some action changes the predicate.
    pub(super) fn cost(
        &self,
        domain: &Domain,
        predicate: PredicateId,
        changes: bool,
    ) -> Option<u32> {
        let declaration = &domain.predicates[predicate.index()];
        let excluded = self.only.as_ref().is_some_and(|only| !only.contains(&predicate));
        if declaration.derived || excluded || self.protected.contains(&predicate) {
            return None;
        }
        if let Some(&(_, cost)) = self.costs.iter().find(|(one, _)| *one == predicate) {
            return Some(cost.max(1));
        }
        let typed = domain.types.len() > 1;
        Some(match declaration.parameters.len() {
            _ if changes => 1,
            0 => 1,
            1 if typed => 1,
            1 => KIND,
            _ => STATIC,
        })
    }
}
