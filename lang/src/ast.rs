//! What the text says, section by section, with the names as they are written and nothing resolved.
//!
//! Places are kept and do not count when two pieces are compared: `(p ?x)` equals `( p  ?x )`.
//! Formulas are flat lists of nodes, each before its children, so that nothing needs recursion.

mod formula;
mod network;
mod domain;
mod problem;

use std::fmt;

use crate::source::Span;

pub use domain::{
    Action, ActionKind, Agent, Axiom, Concurrency, Derived, Domain, DomainSection, Participant,
    Predicates,
};
pub use formula::{
    Application, Connective, Formula, Modality, Node, NodeKind, Operator, Quantifier, Time,
};
pub use network::{InitialNetwork, Method, Network, Subtask, Task};
pub use problem::{Entry, EntryKind, Goal, Init, Metric, Problem, ProblemSection};

/// A word as it is written: a name, a number, a variable with its `?`, a keyword with its `:`.
#[derive(Debug, Clone, Copy)]
pub struct Name<'a> {
    /// Its spelling; empty where the text lacks it.
    pub text: &'a str,
    /// Where it stands.
    pub span: Span,
}

impl PartialEq for Name<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Eq for Name<'_> {}

impl fmt::Display for Name<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.text)
    }
}

impl Name<'_> {
    /// Whether it starts with `?`.
    pub fn is_variable(&self) -> bool {
        self.text.starts_with('?')
    }

    /// Whether it is `word`, whatever the case.
    pub fn is(&self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }
}

/// A place that does not count in comparisons.
#[derive(Debug, Clone, Copy, Default)]
pub struct Place(pub Span);

impl PartialEq for Place {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Place {}

/// A part of the language that can be checked and not be run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "each says its name")]
pub enum Feature {
    NumericConditions,
    NumericEffects,
    ObjectFluents,
    DurativeActions,
    TimedLiterals,
    Preferences,
    Constraints,
    Processes,
    ActionAtoms,
    Hierarchies,
    Nondeterminism,
    Metrics,
    Axioms,
    Invariants,
}

impl Feature {
    /// Its name in the plural, as messages say it.
    pub fn describe(self) -> &'static str {
        match self {
            Self::NumericConditions => "numeric conditions",
            Self::NumericEffects => {
                "numeric effects other than `increase` by a constant or a function"
            }
            Self::ObjectFluents => "object fluents",
            Self::DurativeActions => "durative actions",
            Self::TimedLiterals => "timed initial literals",
            Self::Preferences => "preferences",
            Self::Constraints => "trajectory constraints",
            Self::Processes => "processes and events (PDDL+)",
            Self::ActionAtoms => "action atoms outside of preconditions and effects",
            Self::Hierarchies => "hierarchical tasks and methods (HDDL)",
            Self::Nondeterminism => "nondeterministic and probabilistic effects",
            Self::Metrics => "metrics other than `minimize` of a function without parameters",
            Self::Axioms => "axioms of PDDL 1.2 (`:axiom`, `:vars`, `:expansion`)",
            Self::Invariants => "declared invariants",
        }
    }
}

/// A piece of the text that is not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unread<'a> {
    /// What it belongs to.
    pub feature: Feature,
    /// The word that says so.
    pub keyword: Name<'a>,
    /// All of it.
    pub node: Name<'a>,
}

/// What follows the `-` of a typed list: one type, or several with `either`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TypeReference<'a> {
    /// Never empty.
    pub names: Vec<Name<'a>>,
}

/// `a b c - t`: names that share what follows the `-`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group<'a> {
    /// The names before the `-`.
    pub names: Vec<Name<'a>>,
    /// What follows it; none at the end of a list without one.
    pub types: Option<TypeReference<'a>>,
}

/// A list of names, variables or types with their types.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TypedList<'a> {
    /// The groups in the order of the text.
    pub groups: Vec<Group<'a>>,
    /// The lists that stand in a `(:private …)` among them, each with its keyword.
    pub private: Vec<Private<'a>>,
}

/// `(:private a b - t …)` among objects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Private<'a> {
    /// The keyword.
    pub keyword: Name<'a>,
    /// What stands after it; in a file of all agents the first name is the agent.
    pub groups: Vec<Group<'a>>,
}

impl<'a> TypedList<'a> {
    /// Each name with what follows the `-` of its group.
    pub fn entries(&self) -> impl Iterator<Item = (Name<'a>, Option<&TypeReference<'a>>)> {
        self.groups
            .iter()
            .flat_map(|group| group.names.iter().map(|&name| (name, group.types.as_ref())))
    }

    /// How many names there are.
    pub fn len(&self) -> usize {
        self.groups.iter().map(|group| group.names.len()).sum()
    }

    /// Whether there is no name.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// `(NAME PARAMETERS)`: a predicate or a function as it is declared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Head<'a> {
    /// What is declared.
    pub name: Name<'a>,
    /// Its parameters.
    pub parameters: TypedList<'a>,
    /// The whole declaration.
    pub place: Place,
}

/// Functions that share what follows the `-`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FunctionGroup<'a> {
    /// The functions before the `-`.
    pub heads: Vec<Head<'a>>,
    /// `number` or the type of the value; none where it is left out.
    pub types: Option<TypeReference<'a>>,
}
