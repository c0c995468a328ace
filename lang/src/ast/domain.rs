//! The sections of a domain as they are written.

use super::{
    Formula, FunctionGroup, Head, Method, Name, Place, Task, TypeReference, TypedList, Unread,
};

/// What kind of action a section defines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ActionKind {
    /// `:action`
    Instant,
    /// `:durative-action`
    Durative,
    /// `:process` of PDDL+
    Process,
    /// `:event` of PDDL+
    Event,
}

impl ActionKind {
    /// The keyword of the section.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Instant => ":action",
            Self::Durative => ":durative-action",
            Self::Process => ":process",
            Self::Event => ":event",
        }
    }

    /// As messages say it.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Instant => "action",
            Self::Durative => "durative action",
            Self::Process => "process",
            Self::Event => "event",
        }
    }

    /// The field that holds the conditions.
    pub fn condition(self) -> &'static str {
        if self == Self::Durative { ":condition" } else { ":precondition" }
    }
}

/// What stands after `:agent`: `?a - t`, `?a`, or the name of a type or an object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Agent<'a> {
    /// The keyword.
    pub keyword: Name<'a>,
    /// The variable, the type or the object.
    pub name: Name<'a>,
    /// The type of a variable.
    pub types: Option<TypeReference<'a>>,
}

/// `(:action NAME …)`, and the sections that are built like it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Action<'a> {
    /// Which section it is.
    pub kind: ActionKind,
    /// Its name.
    pub name: Name<'a>,
    /// Who acts, in MA-PDDL.
    pub agent: Option<Agent<'a>>,
    /// The `:parameters`.
    pub parameters: TypedList<'a>,
    /// The `:duration` of a durative action; at most one without a mistake.
    pub durations: Vec<Formula<'a>>,
    /// The `:precondition`s or `:condition`s: one, or none where it is left out or empty; more are a mistake that has been reported.
    pub preconditions: Vec<Formula<'a>>,
    /// The `:effect`s, likewise.
    pub effects: Vec<Formula<'a>>,
    /// Fields that are not read.
    pub unread: Vec<Unread<'a>>,
    /// The whole action.
    pub place: Place,
}

/// `(:derived (NAME PARAMETERS) BODY)`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Derived<'a> {
    /// What is derived.
    pub head: Head<'a>,
    /// When it holds.
    pub body: Option<Formula<'a>>,
    /// The whole rule.
    pub place: Place,
}

/// `(:axiom :vars (…) :context CONDITION :implies LITERAL)` of PDDL 1.2.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axiom<'a> {
    /// The keyword.
    pub keyword: Name<'a>,
    /// The `:vars`.
    pub variables: TypedList<'a>,
    /// The `:context`: when it holds.
    pub context: Option<Formula<'a>>,
    /// The `:implies`: what holds then.
    pub implies: Option<Formula<'a>>,
}

/// Declared predicates: public ones, or those of a `(:private …)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Predicates<'a> {
    /// The keyword `:private`, if they are.
    pub private: Option<Name<'a>>,
    /// Whose they are, as `?agent - t`; empty where the file belongs to one agent.
    pub owner: TypedList<'a>,
    /// The declarations.
    pub heads: Vec<Head<'a>>,
}

/// `(ACTION POSITION …)` in a concurrency constraint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Participant<'a> {
    /// The action.
    pub action: Name<'a>,
    /// Which of its arguments are the constraint's parameters; 0 is the agent.
    pub positions: Vec<Name<'a>>,
    /// The whole of it.
    pub place: Place,
}

/// `(:concurrency-constraint NAME :parameters (…) :bounds (LEAST MOST) :actions (…))`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Concurrency<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// Whose use is counted.
    pub parameters: TypedList<'a>,
    /// How many agents at least and at most, as they are written.
    pub bounds: Vec<Name<'a>>,
    /// Which actions use the parameters.
    pub actions: Vec<Participant<'a>>,
    /// The whole constraint.
    pub place: Place,
}

/// A section of a domain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DomainSection<'a> {
    /// `(:requirements …)`
    Requirements(Vec<Name<'a>>),
    /// `(:types …)`
    Types(TypedList<'a>),
    /// `(:constants …)`
    Constants(TypedList<'a>),
    /// `(:predicates …)`
    Predicates(Vec<Predicates<'a>>),
    /// `(:functions …)`
    Functions(Vec<FunctionGroup<'a>>),
    /// `(:action …)` and what is built like it
    Action(Action<'a>),
    /// `(:derived …)`
    Derived(Derived<'a>),
    /// `(:axiom …)`
    Axiom(Axiom<'a>),
    /// `(:constraints …)`; the name is the keyword.
    Constraints(Name<'a>, Vec<Formula<'a>>),
    /// `(:task …)`
    Task(Task<'a>),
    /// `(:method …)`
    Method(Method<'a>),
    /// `(:concurrency-constraint …)`
    Concurrency(Concurrency<'a>),
    /// `(:positive-dependence CONSTRAINT CONSTRAINT)`; the first name is the keyword.
    Dependence(Name<'a>, Vec<Name<'a>>),
    /// What is not read.
    Unread(Unread<'a>),
}

/// `(define (domain NAME) …)`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Domain<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// Its sections in the order of the text.
    pub sections: Vec<DomainSection<'a>>,
}
