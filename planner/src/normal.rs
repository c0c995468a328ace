//! The normal form of a problem that grounding, invariant synthesis and relevance work on.
//!
//! Every condition is a conjunction of literals, static filters and universal literals; disjunctions over facts that change are split
//! into several schemas or hidden behind auxiliary derived predicates. Made by [`crate::normalize`].

use lang::model::{ActionId, FunctionId, ObjectId, PredicateId, TypeId};

/// What changes the truth of a predicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Nothing: it is what the initial state says.
    Static,
    /// Effects of actions.
    Fluent,
    /// Axioms.
    Derived,
}

/// A predicate of the domain, or an auxiliary derived one behind them.
#[derive(Debug, Clone)]
pub struct Predicate {
    /// Its name in lower case.
    pub name: String,
    /// How many arguments it takes.
    pub arity: usize,
    /// What changes it.
    pub kind: Kind,
}

/// A term of a schema: one of its variables, by position, or an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// The variable at this position of [`Schema::variables`] (or [`Rule::variables`]).
    Variable(u32),
    /// An object.
    Object(ObjectId),
}

/// A predicate applied to terms.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Atom {
    /// Indexes [`Normal::predicates`]; the domain's predicates keep their ids.
    pub predicate: PredicateId,
    /// As many as its arity.
    pub arguments: Vec<Term>,
}

/// An atom or its negation.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Literal {
    /// Whether the atom must hold (or is added); otherwise it must not hold (or is deleted).
    pub positive: bool,
    /// The atom.
    pub atom: Atom,
}

/// A formula over static predicates and equality only: decided as soon as its variables are bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Filter {
    /// A static predicate holds initially.
    Atom(Atom),
    /// Two terms are the same object.
    Equal(Term, Term),
    /// The child does not hold.
    Not(Box<Filter>),
    /// All hold.
    All(Vec<Filter>),
    /// One holds.
    Any(Vec<Filter>),
    /// It holds for some binding of these variables, which are not bound outside.
    Exists(Vec<u32>, Box<Filter>),
    /// It holds for all bindings of these variables, which are not bound outside.
    Forall(Vec<u32>, Box<Filter>),
}

/// For every binding of the variables under which the guard holds, all literals hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Universal {
    /// The variables that it binds.
    pub variables: Vec<u32>,
    /// The static part.
    pub guard: Filter,
    /// The literals, over fluent or derived predicates.
    pub literals: Vec<Literal>,
}

/// A conjunction.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Condition {
    /// Literals over any predicate. Negative literals over static predicates are found here or in the filters.
    pub literals: Vec<Literal>,
    /// Static parts that are more than a literal.
    pub filters: Vec<Filter>,
    /// Universal literals over facts that change.
    pub universals: Vec<Universal>,
}

/// A variable of a schema.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name with the `?`, for messages only.
    pub name: String,
    /// An object of any of these types will do.
    pub types: Vec<TypeId>,
}

/// An action whose condition is a conjunction. One action of the domain may become several.
#[derive(Debug, Clone)]
pub struct Schema {
    /// The action of the domain that it stems from.
    pub action: ActionId,
    /// All variables that occur: the action's parameters, then those of existential preconditions (all of which are part of an instance),
    /// then those that effects and universals bind.
    pub variables: Vec<Variable>,
    /// How many of the variables, from the first, are the action's own parameters.
    pub parameters: usize,
    /// How many of the variables, from the first, an instance binds: the parameters and the existential ones.
    pub bound: usize,
    /// When it may be applied.
    pub condition: Condition,
    /// What it does.
    pub effects: Vec<Effect>,
    /// What it costs: the sum of these. Empty without a metric, where every instance costs 1.
    pub costs: Vec<Cost>,
}

/// For every binding of the variables under which the condition holds in the state before, the literal holds after; adds win over deletes.
#[derive(Debug, Clone)]
pub struct Effect {
    /// The variables beyond those that the instance binds.
    pub variables: Vec<u32>,
    /// When it fires.
    pub condition: Condition,
    /// What is added or deleted, over a fluent predicate.
    pub literal: Literal,
}

/// A part of the cost of an instance.
#[derive(Debug, Clone)]
pub enum Cost {
    /// A constant, already scaled to an integer.
    Constant(u32),
    /// The initial value of a static function.
    Function(FunctionId, Vec<Term>),
}

/// `head` holds whenever the condition does.
#[derive(Debug, Clone)]
pub struct Rule {
    /// All variables that occur: those of the head and the existential ones of the body, then those that universals bind.
    pub variables: Vec<Variable>,
    /// How many of the variables, from the first, an instance binds.
    pub bound: usize,
    /// What is derived.
    pub head: Atom,
    /// From what.
    pub condition: Condition,
}

/// A problem in normal form.
#[derive(Debug, Clone)]
pub struct Normal {
    /// The domain's predicates, then the auxiliary derived ones.
    pub predicates: Vec<Predicate>,
    /// The actions, with axioms and schemas in the order of the domain.
    pub schemas: Vec<Schema>,
    /// The axioms, the domain's first.
    pub rules: Vec<Rule>,
    /// What must hold in the end: literals without variables and universals; more than that has become an auxiliary derived predicate.
    pub goal: Condition,
    /// The variables that universals and filters of the goal bind.
    pub goal_variables: Vec<Variable>,
    /// By which power of ten costs were multiplied to become integers: `10^scale`.
    pub scale: u32,
    /// Whether a metric counts; otherwise every operator costs 1.
    pub uses_metric: bool,
}
