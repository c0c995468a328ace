//! The checked model: a [`Domain`] and a [`Problem`] in which every name is resolved and every formula is flat.
//!
//! Names have become ids, which index the tables of the domain or the problem.
//! A formula is a post-order list of nodes, so that nothing that walks, prints or drops it needs recursion.

use std::collections::BTreeSet;

use rust_decimal::Decimal;

use crate::ast::{ActionKind, Feature};
use crate::source::Span;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the table that this id indexes.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(/// Indexes [`Domain::types`].
    TypeId);
id!(/// Indexes [`Domain::predicates`].
    PredicateId);
id!(/// Indexes [`Domain::functions`].
    FunctionId);
id!(/// Indexes [`Domain::actions`].
    ActionId);
id!(/// Indexes [`Domain::axioms`].
    AxiomId);
id!(/// Indexes [`Problem::objects`]; the first of them are the domain's constants, in the order of [`Domain::constants`].
    ObjectId);
id!(/// Indexes the variables of the [`Scope`] at hand: an action's, an axiom's or the goal's.
    VariableId);
id!(/// Indexes the nodes of the [`Formula`] at hand.
    NodeId);

/// A name as it was written first, and where. Names are compared without case.
#[derive(Debug, Clone)]
pub struct Name {
    /// The spelling of the declaration.
    pub text: String,
    /// Where it is declared.
    pub span: Span,
}

/// A requirement flag that the checked model knows by meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each is the flag of its own name")]
pub enum Requirement {
    Strips,
    Typing,
    Equality,
    NegativePreconditions,
    DisjunctivePreconditions,
    ExistentialPreconditions,
    UniversalPreconditions,
    ConditionalEffects,
    DerivedPredicates,
    ActionCosts,
    NumericFluents,
    ObjectFluents,
    DurativeActions,
    DurationInequalities,
    ContinuousEffects,
    TimedInitialLiterals,
    Preferences,
    Constraints,
    Time,
    Hierarchy,
    MultiAgent,
    FactoredPrivacy,
    UnfactoredPrivacy,
}

impl Requirement {
    /// As it is written.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Strips => ":strips",
            Self::Typing => ":typing",
            Self::Equality => ":equality",
            Self::NegativePreconditions => ":negative-preconditions",
            Self::DisjunctivePreconditions => ":disjunctive-preconditions",
            Self::ExistentialPreconditions => ":existential-preconditions",
            Self::UniversalPreconditions => ":universal-preconditions",
            Self::ConditionalEffects => ":conditional-effects",
            Self::DerivedPredicates => ":derived-predicates",
            Self::ActionCosts => ":action-costs",
            Self::NumericFluents => ":numeric-fluents",
            Self::ObjectFluents => ":object-fluents",
            Self::DurativeActions => ":durative-actions",
            Self::DurationInequalities => ":duration-inequalities",
            Self::ContinuousEffects => ":continuous-effects",
            Self::TimedInitialLiterals => ":timed-initial-literals",
            Self::Preferences => ":preferences",
            Self::Constraints => ":constraints",
            Self::Time => ":time",
            Self::Hierarchy => ":hierarchy",
            Self::MultiAgent => ":multi-agent",
            Self::FactoredPrivacy => ":factored-privacy",
            Self::UnfactoredPrivacy => ":unfactored-privacy",
        }
    }
}

impl Requirement {
    /// Whether it is about several agents.
    pub fn is_of_agents(self) -> bool {
        matches!(self, Self::MultiAgent | Self::FactoredPrivacy | Self::UnfactoredPrivacy)
    }
}

/// A part of the language that is used and not yet resolved, so that nothing can run what stands there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Use {
    /// What is used.
    pub feature: Feature,
    /// Where it is used first.
    pub span: Span,
}

impl Use {
    /// Whether a problem with it may do without a goal: in HDDL the tasks say what is to be done.
    pub fn replaces_goal(&self) -> bool {
        self.feature == Feature::Hierarchies
    }
}

/// A PDDL domain in which everything is resolved.
#[derive(Debug, Clone)]
pub struct Domain {
    /// The name in `(define (domain NAME) …)`.
    pub name: Name,
    /// What `:requirements` declares, with the aggregates (`:adl`, `:quantified-preconditions`) taken apart, and what the domain uses without declaring it.
    pub requirements: BTreeSet<Requirement>,
    /// All types; the first is `object`, the root.
    pub types: Vec<Type>,
    /// The `:constants`.
    pub constants: Vec<Object>,
    /// The `:predicates`, in the order of declaration.
    pub predicates: Vec<Predicate>,
    /// The `:functions`, in the order of declaration.
    pub functions: Vec<Function>,
    /// The `:derived` rules.
    pub axioms: Vec<Axiom>,
    /// The `:action`s.
    pub actions: Vec<Action>,
    /// Everything that can be done by name, in the order of the text: actions of all kinds, and the tasks of HDDL.
    pub signatures: Vec<Signature>,
    /// The named preferences of preconditions and constraints.
    pub preferences: Vec<Name>,
    /// What the domain uses beyond that, each once.
    pub uses: Vec<Use>,
}

/// What a [`Signature`] belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Doing {
    /// An action, a durative action, a process or an event.
    Action(ActionKind),
    /// A task of HDDL, which methods take apart.
    Task,
}

/// What can be done, and with what.
#[derive(Debug, Clone)]
pub struct Signature {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub doing: Doing,
    /// Its parameters; in MA-PDDL the agent is the first of them.
    pub parameters: Vec<Variable>,
    /// Whether the first parameter is the agent.
    pub agent: bool,
    /// Where it stands among the actions of the model, if it happens in an instant.
    pub action: Option<ActionId>,
}

/// A type and where it stands in the hierarchy.
#[derive(Debug, Clone)]
pub struct Type {
    /// Its name.
    pub name: Name,
    /// The types directly above it; several with `either` or where it is listed twice; none for `object`.
    pub parents: Vec<TypeId>,
    /// Itself and all types above it, sorted: whatever has this type also has these.
    pub ancestors: Vec<TypeId>,
}

/// An object or a constant.
#[derive(Debug, Clone)]
pub struct Object {
    /// Its name.
    pub name: Name,
    /// Its types; several with `either`, which for an object means that it is of all of them.
    pub types: Vec<TypeId>,
    /// Whose it is, if it is private.
    pub holder: Option<Holder>,
}

/// Whose a private object is, in MA-PDDL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    /// The agent to which the file belongs, in the factored form.
    File,
    /// This agent, which may be the object itself.
    Agent(ObjectId),
}

/// A variable: a parameter or one bound by a quantifier.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name with the `?`.
    pub name: Name,
    /// Its types; several with `either`: an object of any of them will do.
    pub types: Vec<TypeId>,
}

/// A declared predicate. It is *derived* when an axiom has it as head.
#[derive(Debug, Clone)]
pub struct Predicate {
    /// Its name.
    pub name: Name,
    /// Its declared parameters, of which the types count.
    pub parameters: Vec<Variable>,
    /// Whether an axiom derives it.
    pub derived: bool,
    /// Whose it is, in MA-PDDL.
    pub owner: Option<Owner>,
}

/// Whose a private predicate is.
#[derive(Debug, Clone)]
pub struct Owner {
    /// Which of the predicate's parameters is the agent, if one of them is.
    pub position: Option<usize>,
    /// The types of the agents.
    pub types: Vec<TypeId>,
    /// Where it is declared.
    pub span: Span,
}

/// A declared function, such as `total-cost`, `(distance ?a ?b)`, or one that has objects as values.
#[derive(Debug, Clone)]
pub struct Function {
    /// Its name.
    pub name: Name,
    /// Its declared parameters, of which the types count.
    pub parameters: Vec<Variable>,
    /// The types of the objects that are its values; none for a function of numbers.
    pub values: Option<Vec<TypeId>>,
    /// Where its value is asked for first: in a condition, an effect on another function, or a duration.
    pub read: Option<Span>,
    /// Whether some effect gives it a value that does not depend on the one before.
    pub assigned: bool,
}

/// The variables of an action, an axiom or a goal: the parameters first, then one for each variable that a quantifier binds.
///
/// Each binder has variables of its own, so nothing is ever shadowed and a binding is one array indexed by [`VariableId`].
#[derive(Debug, Clone, Default)]
pub struct Scope {
    /// The variables.
    pub variables: Vec<Variable>,
    /// How many of them, from the first, are parameters.
    pub parameters: u32,
}

/// `(:derived HEAD BODY)`: whenever the body holds, so does the head.
#[derive(Debug, Clone)]
pub struct Axiom {
    /// The derived predicate. Its arguments are the parameters of the scope, in order.
    pub head: PredicateId,
    /// The variables.
    pub scope: Scope,
    /// When it holds.
    pub body: Formula,
    /// The whole rule.
    pub span: Span,
}

/// `(:action …)`.
#[derive(Debug, Clone)]
pub struct Action {
    /// Its name.
    pub name: Name,
    /// The variables.
    pub scope: Scope,
    /// Whether the first parameter is the agent that acts.
    pub agent: bool,
    /// What must hold before; true where it is left out.
    pub precondition: Formula,
    /// What it does, in the order of the text, nested `and`, `forall` and `when` taken apart.
    pub effects: Vec<Effect>,
    /// `increase` effects, in the order of the text.
    pub increases: Vec<Increase>,
    /// The whole action.
    pub span: Span,
}

/// One group of effects: for every binding of the variables for which the condition holds in the state before, all literals.
#[derive(Debug, Clone)]
pub struct Effect {
    /// What the enclosing `forall`s bind.
    pub variables: Vec<VariableId>,
    /// What the enclosing `when`s demand; true if there is none.
    pub condition: Formula,
    /// What is added and deleted.
    pub literals: Vec<Literal>,
    /// The group.
    pub span: Span,
}

/// An atom that an effect adds or deletes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Literal {
    /// Whether it is added; otherwise it is deleted.
    pub positive: bool,
    /// The atom.
    pub atom: Atom,
    /// Where it stands.
    pub span: Span,
}

/// `(increase (FUNCTION …) VALUE)` by a number or the value of a function, as costs are written; other numeric effects are a [`Use`].
#[derive(Debug, Clone)]
pub struct Increase {
    /// What the enclosing `forall`s bind.
    pub variables: Vec<VariableId>,
    /// What the enclosing `when`s demand; true if there is none.
    pub condition: Formula,
    /// The function that grows.
    pub function: FunctionId,
    /// Its arguments.
    pub arguments: Vec<Term>,
    /// By how much.
    pub value: Expression,
    /// Where it stands.
    pub span: Span,
}

/// A number that may depend on a function that no action changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Expression {
    /// A literal number.
    Number(Decimal),
    /// The value of a function.
    Function(FunctionId, Vec<Term>),
}

/// A variable or an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// A variable of the scope at hand.
    Variable(VariableId),
    /// An object or a constant.
    Object(ObjectId),
}

/// A predicate applied to terms.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Atom {
    /// The predicate.
    pub predicate: PredicateId,
    /// As many as the predicate has parameters.
    pub arguments: Vec<Term>,
}

/// An action applied to terms, the agent first: whether it stands in the joint action (Kovács 2012, *action formula*).
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct ActionAtom {
    /// The action.
    pub action: ActionId,
    /// As many as the action has parameters.
    pub arguments: Vec<Term>,
}

/// A condition, as a list of nodes in post-order: every child stands before its parent, and the root is the last.
#[derive(Debug, Clone)]
pub struct Formula {
    /// Never empty.
    pub nodes: Vec<Node>,
}

/// One node of a [`Formula`].
#[derive(Debug, Clone)]
pub struct Node {
    /// What it says.
    pub kind: NodeKind,
    /// Where it stands; the span of the field where it was left out.
    pub span: Span,
}

/// What a node of a [`Formula`] says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NodeKind {
    /// A predicate holds.
    Atom(Atom),
    /// Two terms are the same object.
    Equal(Term, Term),
    /// An action stands in the joint action, in MA-PDDL.
    Action(ActionAtom),
    /// The child does not hold.
    Not(NodeId),
    /// All children hold; true without children.
    And(Vec<NodeId>),
    /// One child holds; false without children.
    Or(Vec<NodeId>),
    /// The second holds or the first does not.
    Imply(NodeId, NodeId),
    /// The child holds for every binding of the variables.
    Forall(Vec<VariableId>, NodeId),
    /// The child holds for some binding of the variables.
    Exists(Vec<VariableId>, NodeId),
}

impl Formula {
    /// The formula that always holds.
    pub fn truth(span: Span) -> Self {
        Self { nodes: vec![Node { kind: NodeKind::And(Vec::new()), span }] }
    }

    /// Whether this is [`Formula::truth`].
    pub fn is_truth(&self) -> bool {
        matches!(self.nodes.as_slice(), [Node { kind: NodeKind::And(children), .. }] if children.is_empty())
    }

    /// The outermost node.
    pub fn root(&self) -> NodeId {
        NodeId(self.nodes.len() as u32 - 1)
    }

    /// What the node `id` says.
    pub fn kind(&self, id: NodeId) -> &NodeKind {
        &self.nodes[id.index()].kind
    }
}

/// A ground atom of the initial state.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fact {
    /// The predicate.
    pub predicate: PredicateId,
    /// As many as the predicate has parameters.
    pub arguments: Box<[ObjectId]>,
}

/// `(= (FUNCTION …) VALUE)` in the initial state.
#[derive(Debug, Clone)]
pub struct FunctionValue {
    /// The function.
    pub function: FunctionId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
    /// Its value.
    pub value: Decimal,
    /// Where it stands.
    pub span: Span,
}

/// What `:metric` asks for. Without it every action costs 1.
#[derive(Debug, Clone)]
pub struct Metric {
    /// The function to minimise: `total-cost` or another without parameters.
    pub function: FunctionId,
    /// Where it stands.
    pub span: Span,
}

/// A PDDL problem in which everything is resolved against its domain.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The name in `(define (problem NAME) …)`.
    pub name: Name,
    /// The domain's constants, then the problem's objects.
    pub objects: Vec<Object>,
    /// The facts that hold initially, in the order of the text, without repetitions.
    pub init: Vec<Fact>,
    /// The values of functions, in the order of the text.
    pub values: Vec<FunctionValue>,
    /// The variables that quantifiers of the goal bind; it has no parameters.
    pub goal_scope: Scope,
    /// What must hold in the end.
    pub goal: Formula,
    /// What to minimise.
    pub metric: Option<Metric>,
    /// What the problem uses beyond that, each once.
    pub uses: Vec<Use>,
}

impl Domain {
    /// A domain with nothing in it but its name, not even the type `object`.
    pub fn new(name: Name) -> Self {
        Self {
            name,
            requirements: BTreeSet::new(),
            types: Vec::new(),
            constants: Vec::new(),
            predicates: Vec::new(),
            functions: Vec::new(),
            axioms: Vec::new(),
            actions: Vec::new(),
            signatures: Vec::new(),
            preferences: Vec::new(),
            uses: Vec::new(),
        }
    }

    /// Whether agents act in it, so that plans consist of joint actions.
    pub fn is_multi_agent(&self) -> bool {
        self.actions.iter().any(|action| action.agent)
    }

    /// Whether something of type `sub` is also of type `above`.
    pub fn is_subtype(&self, sub: TypeId, above: TypeId) -> bool {
        self.types[sub.index()].ancestors.binary_search(&above).is_ok()
    }

    /// Whether `object` may stand where one of `types` is asked for.
    pub fn has_type(&self, object: &Object, types: &[TypeId]) -> bool {
        types.iter().any(|&wanted| object.types.iter().any(|&has| self.is_subtype(has, wanted)))
    }
}
