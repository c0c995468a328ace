//! The ground problem before it has finite-domain variables: facts, operators and axioms over true and false.
//!
//! Made by [`crate::ground`], read by [`crate::encode`].

use std::ops::Range;

use lang::model::{ActionId, ObjectId, PredicateId};

/// Indexes [`Grounded::facts`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FactId(pub u32);

impl FactId {
    /// The position in the table that this id indexes.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A fact that must hold or must not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Literal {
    /// The fact.
    pub fact: FactId,
    /// Whether it must hold.
    pub positive: bool,
}

/// A fact that changes: the arguments are a range of [`Grounded::arguments`].
#[derive(Debug, Clone)]
pub struct Fact {
    /// A fluent or derived predicate of the normal form.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Range<u32>,
}

/// A ground action.
#[derive(Debug, Clone)]
pub struct Operator {
    /// The action of the domain.
    pub action: ActionId,
    /// The objects for the action's parameters, a range of [`Grounded::arguments`].
    pub arguments: Range<u32>,
    /// The objects for these and for the variables of existential conditions, another such range.
    pub bound: Range<u32>,
    /// A range of [`Grounded::literals`], sorted, without repetitions.
    pub precondition: Range<u32>,
    /// A range of [`Grounded::effects`].
    pub effects: Range<u32>,
    /// Its cost; 1 without a metric.
    pub cost: u32,
}

/// Where all conditions hold before, the literal holds after; an add wins over a delete.
#[derive(Debug, Clone)]
pub struct Effect {
    /// A range of [`Grounded::literals`]; empty for an unconditional effect.
    pub conditions: Range<u32>,
    /// What is added or deleted.
    pub literal: Literal,
}

/// `head` holds whenever all conditions do; a derived fact that no axiom gives does not hold.
#[derive(Debug, Clone)]
pub struct Axiom {
    /// A derived fact.
    pub head: FactId,
    /// The objects for the variables of the rule, a range of [`Grounded::arguments`]; empty where nobody asks ([`crate::ground::ground_open`]).
    pub bound: Range<u32>,
    /// A range of [`Grounded::literals`].
    pub conditions: Range<u32>,
}

/// A ground problem.
///
/// Facts that always hold or never hold are gone from all conditions; every fact left can change or is derived.
#[derive(Debug, Clone, Default)]
pub struct Grounded {
    /// The facts.
    pub facts: Vec<Fact>,
    /// Which facts hold initially; false for derived ones.
    pub initial: Vec<bool>,
    /// Which facts are derived.
    pub derived: Vec<bool>,
    /// What must hold in the end.
    pub goal: Vec<Literal>,
    /// The operators.
    pub operators: Vec<Operator>,
    /// The axioms.
    pub axioms: Vec<Axiom>,
    /// Objects of facts and operators.
    pub arguments: Vec<ObjectId>,
    /// Literals of preconditions and conditions.
    pub literals: Vec<Literal>,
    /// Effects of operators.
    pub effects: Vec<Effect>,
    /// Whether costs come from a metric.
    pub uses_metric: bool,
}
