//! The ground task that search works on: finite-domain variables, operators, axioms, a goal, in flat arrays without names.

use std::ops::Range;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the table that this id indexes.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(/// Indexes [`Task::variables`].
    VariableId);
id!(/// Indexes [`Task::operators`].
    OperatorId);

/// A variable has a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fact {
    /// The variable.
    pub variable: VariableId,
    /// Its value, less than [`Variable::domain_size`].
    pub value: u32,
}

/// A finite-domain variable.
#[derive(Debug, Clone)]
pub struct Variable {
    /// How many values it has; at least 2.
    pub domain_size: u32,
    /// For a derived variable the layer of the axioms that set it: lower layers are evaluated first. `None` for a state variable.
    pub axiom_layer: Option<u32>,
    /// For a derived variable the value it has where no axiom sets it; 0 for a state variable.
    pub default: u32,
}

/// A ground action: ranges into the pools of the [`Task`].
#[derive(Debug, Clone)]
pub struct Operator {
    /// Into [`Task::precondition_pool`]; sorted by variable, each variable at most once.
    pub precondition: Range<u32>,
    /// Into [`Task::effect_pool`].
    pub effects: Range<u32>,
    /// Its cost under the metric; 1 for every operator without one.
    pub cost: u32,
}

/// An effect: where all conditions hold in the state before, the fact holds after.
///
/// The effects of an operator are applied in their order: of two that fire and set the same variable, the later one wins.
/// Those that stem from deletes stand before those that stem from adds, which is PDDL's rule.
#[derive(Debug, Clone)]
pub struct Effect {
    /// Into [`Task::condition_pool`]; sorted by variable; empty for an unconditional effect.
    pub conditions: Range<u32>,
    /// What holds after.
    pub fact: Fact,
}

/// `head` holds whenever all conditions do. Evaluated to a fixpoint, layer by layer.
#[derive(Debug, Clone)]
pub struct Axiom {
    /// Into [`Task::condition_pool`].
    pub conditions: Range<u32>,
    /// A derived variable and the value it is set to, which is not its default.
    pub head: Fact,
}

/// A ground planning task. Plain data, `Send + Sync`.
#[derive(Debug, Clone, Default)]
pub struct Task {
    /// The variables.
    pub variables: Vec<Variable>,
    /// A value for each variable; derived variables at their default.
    pub initial_state: Vec<u32>,
    /// What must hold in the end, sorted by variable, each at most once. May name derived variables.
    pub goal: Vec<Fact>,
    /// The operators.
    pub operators: Vec<Operator>,
    /// The axioms, sorted by the layer of the head.
    pub axioms: Vec<Axiom>,
    /// Preconditions of operators.
    pub precondition_pool: Vec<Fact>,
    /// Effects of operators.
    pub effect_pool: Vec<Effect>,
    /// Conditions of effects and axioms.
    pub condition_pool: Vec<Fact>,
    /// Sets of facts of which at most one holds in any reachable state, beyond those that share a variable.
    pub mutex_groups: Vec<Vec<Fact>>,
    /// Whether costs come from a metric; otherwise every operator costs 1.
    pub uses_metric: bool,
}

impl Task {
    /// What must hold before `operator`.
    #[inline]
    pub fn precondition(&self, operator: OperatorId) -> &[Fact] {
        let range = &self.operators[operator.index()].precondition;
        &self.precondition_pool[range.start as usize..range.end as usize]
    }

    /// What `operator` does.
    #[inline]
    pub fn effects(&self, operator: OperatorId) -> &[Effect] {
        let range = &self.operators[operator.index()].effects;
        &self.effect_pool[range.start as usize..range.end as usize]
    }

    /// The conditions of an effect or an axiom.
    #[inline]
    pub fn conditions(&self, range: &Range<u32>) -> &[Fact] {
        &self.condition_pool[range.start as usize..range.end as usize]
    }

    /// Whether an operator has an effect with a condition.
    pub fn has_conditional_effects(&self) -> bool {
        self.effect_pool.iter().any(|effect| !effect.conditions.is_empty())
    }

    /// Whether a variable is derived.
    pub fn has_axioms(&self) -> bool {
        !self.axioms.is_empty()
    }

    /// All operators in order.
    pub fn operator_ids(&self) -> impl ExactSizeIterator<Item = OperatorId> + use<> {
        (0..self.operators.len() as u32).map(OperatorId)
    }
}
