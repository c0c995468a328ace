//! What the text says, section by section, with the names as they are written and nothing resolved.
//!
//! Places are kept and do not count when two pieces are compared: `(p ?x)` equals `( p  ?x )`.
//! Formulas are flat lists of nodes, each before its children, so that nothing needs recursion.

use std::fmt;
use std::ops::Range;

use crate::source::Span;

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

/// A part of the language that is not read yet, and so is kept as text.
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
    MultiAgent,
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
            Self::MultiAgent => "multi-agent actions and privacy",
            Self::Hierarchies => "hierarchical tasks and methods (HDDL)",
            Self::Nondeterminism => "nondeterministic and probabilistic effects",
            Self::Metrics => "metrics other than `minimize` of a function without parameters",
            Self::Axioms => "axioms of PDDL 1.2 (`:axiom`, `:vars`, `:expansion`)",
            Self::Invariants => "declared invariants",
        }
    }
}

/// A piece of the text that is not read yet.
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

/// A word that joins formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Connective {
    And,
    Or,
    Not,
    Imply,
    When,
}

impl Connective {
    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::And => "and",
            Self::Or => "or",
            Self::Not => "not",
            Self::Imply => "imply",
            Self::When => "when",
        }
    }
}

/// `forall` or `exists`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Quantifier {
    Forall,
    Exists,
}

impl Quantifier {
    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Forall => "forall",
            Self::Exists => "exists",
        }
    }
}

/// A name applied to terms, which stand in the `terms` of the formula or the initial state at hand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Application<'a> {
    /// The predicate or the function.
    pub name: Name<'a>,
    /// Its arguments.
    pub arguments: Range<u32>,
}

/// The right side of `increase`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Amount<'a> {
    /// A literal number.
    Number(Name<'a>),
    /// The value of a function.
    Function(Application<'a>, Place),
}

/// What a [`Node`] says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NodeKind<'a> {
    /// `(PREDICATE TERM …)`
    Atom(Application<'a>),
    /// `(= TERM …)`; the name is the `=`.
    Equal(Application<'a>),
    /// A connective with the nodes that follow as its operands; `()` is an `and` without any.
    Connective(Connective),
    /// A quantifier with its variables; its body follows.
    Quantifier(Quantifier, TypedList<'a>),
    /// `(increase (FUNCTION …) AMOUNT)`
    Increase(Application<'a>, Amount<'a>),
    /// What is not read yet.
    Unread(Unread<'a>),
}

/// One node of a [`Formula`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Node<'a> {
    /// What it says.
    pub kind: NodeKind<'a>,
    /// The node after this one and all of its operands.
    pub next: u32,
    /// The whole of it.
    pub place: Place,
    /// Its first word.
    pub keyword: Place,
}

/// A condition or an effect: nodes, each before its operands.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Formula<'a> {
    /// The nodes; the first is the outermost.
    pub nodes: Vec<Node<'a>>,
    /// The arguments of all nodes.
    pub terms: Vec<Name<'a>>,
}

impl<'a> Formula<'a> {
    /// The arguments of an application in this formula.
    pub fn arguments(&self, application: &Application<'a>) -> &[Name<'a>] {
        &self.terms[application.arguments.start as usize..application.arguments.end as usize]
    }

    /// The operands of the node at `index`.
    pub fn operands(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let end = self.nodes[index].next as usize;
        let mut at = index + 1;
        std::iter::from_fn(move || {
            let current = at;
            (current < end).then(|| {
                at = self.nodes[current].next as usize;
                current
            })
        })
    }
}

/// `(:action NAME …)`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Action<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// The `:parameters`.
    pub parameters: TypedList<'a>,
    /// The `:precondition`s: one, or none where it is left out or empty; more are a mistake that has been reported.
    pub preconditions: Vec<Formula<'a>>,
    /// The `:effect`s, likewise.
    pub effects: Vec<Formula<'a>>,
    /// Fields that are not read yet.
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
    Predicates(Vec<Head<'a>>),
    /// `(:functions …)`
    Functions(Vec<FunctionGroup<'a>>),
    /// `(:action …)`
    Action(Action<'a>),
    /// `(:derived …)`
    Derived(Derived<'a>),
    /// What is not read yet.
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

/// What an [`Entry`] of the initial state says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EntryKind<'a> {
    /// `(PREDICATE OBJECT …)`
    Fact(Application<'a>),
    /// `(not (PREDICATE OBJECT …))`
    Absent(Application<'a>),
    /// `(= (FUNCTION OBJECT …) NUMBER)`
    Value(Application<'a>, Name<'a>),
    /// What is not read yet.
    Unread(Unread<'a>),
}

/// One element of `:init`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry<'a> {
    /// What it says.
    pub kind: EntryKind<'a>,
    /// The whole of it.
    pub place: Place,
}

/// `(:init …)`
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Init<'a> {
    /// The elements in the order of the text.
    pub entries: Vec<Entry<'a>>,
    /// The arguments of all entries.
    pub terms: Vec<Name<'a>>,
}

impl<'a> Init<'a> {
    /// The arguments of an application in this initial state.
    pub fn arguments(&self, application: &Application<'a>) -> &[Name<'a>] {
        &self.terms[application.arguments.start as usize..application.arguments.end as usize]
    }
}

/// A section of a problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ProblemSection<'a> {
    /// `(:domain NAME)`
    Domain(Name<'a>),
    /// `(:requirements …)`
    Requirements(Vec<Name<'a>>),
    /// `(:objects …)`
    Objects(TypedList<'a>),
    /// `(:init …)`
    Init(Init<'a>),
    /// `(:goal …)`; several formulas are a mistake that has been reported.
    Goal(Vec<Formula<'a>>),
    /// `(:metric minimize (FUNCTION))`; the place is that of the function with its parentheses.
    Metric(Name<'a>, Place),
    /// What is not read yet.
    Unread(Unread<'a>),
}

/// `(define (problem NAME) …)`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// Its sections in the order of the text.
    pub sections: Vec<ProblemSection<'a>>,
}
