//! Which names stand where in a text and what each of them means, as the checker found out: a table of [`Occurrence`]s.
//!
//! The table is filled only when it is asked for, by [`crate::index_domain`] and [`crate::index_problem`].

use crate::model::{FunctionId, ObjectId, PredicateId, TypeId, Variable};
use crate::source::Span;

/// PDDL keeps kinds of names apart: an action may be called like a predicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each says its name")]
pub enum Namespace {
    Domain,
    Problem,
    Type,
    Predicate,
    Function,
    /// Objects and constants.
    Object,
    Action,
    /// Parameters, and what quantifiers bind.
    Variable,
    Task,
    Method,
    /// The name of a subtask within its task network.
    Subtask,
    Preference,
    /// A concurrency constraint of MA-PDDL.
    Constraint,
}

impl Namespace {
    /// As messages say it.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Domain => "domain",
            Self::Problem => "problem",
            Self::Type => "type",
            Self::Predicate => "predicate",
            Self::Function => "function",
            Self::Object => "object",
            Self::Action => "action",
            Self::Variable => "variable",
            Self::Task => "task",
            Self::Method => "method",
            Self::Subtask => "subtask",
            Self::Preference => "preference",
            Self::Constraint => "concurrency constraint",
        }
    }
}

/// What a name means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A type, predicate, function or object with its position in the table of the model;
    /// anything else with the byte at which it is declared.
    Known(Namespace, u32),
    /// Nothing that is declared, though something of this kind is wanted.
    Unknown(Namespace),
}

impl Symbol {
    /// The kind of name.
    pub fn namespace(self) -> Namespace {
        match self {
            Self::Known(namespace, _) | Self::Unknown(namespace) => namespace,
        }
    }

    /// What is declared at `span` and has no table in the model.
    pub fn at(namespace: Namespace, span: Span) -> Self {
        Self::Known(namespace, span.start)
    }
}

macro_rules! of {
    ($id:ident, $namespace:ident) => {
        impl From<$id> for Symbol {
            fn from(id: $id) -> Self {
                Self::Known(Namespace::$namespace, id.0)
            }
        }
    };
}

of!(TypeId, Type);
of!(PredicateId, Predicate);
of!(FunctionId, Function);
of!(ObjectId, Object);

/// What a name does where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Role {
    /// It is declared.
    Declare,
    /// It is used; of a predicate or a function: its value is asked for.
    #[default]
    Read,
    /// A predicate that an effect or a rule makes true.
    Add,
    /// A predicate that an effect makes false.
    Delete,
    /// A function to which an effect gives a value.
    Write,
    /// A predicate or a function of the initial state.
    Initial,
}

/// A name where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Occurrence {
    /// Where.
    pub span: Span,
    /// What it means.
    pub symbol: Symbol,
    /// What it does there.
    pub role: Role,
}

/// All names of one text.
#[derive(Debug, Clone, Default)]
pub struct Occurrences {
    /// In the order of the text; no two overlap.
    pub list: Vec<Occurrence>,
    /// All variables that are declared, in the order of the text.
    pub variables: Vec<Variable>,
}

impl Occurrences {
    /// Puts everything into the order of the text.
    ///
    /// What is resolved twice, such as the type of a group of names, counts once, with the first thing that was said of it.
    pub(crate) fn sort(&mut self) {
        self.list.sort_by_key(|occurrence| occurrence.span);
        self.list.dedup_by_key(|occurrence| occurrence.span);
        self.variables.sort_by_key(|variable| variable.name.span);
    }

    /// The name at a byte, or just before it, as a cursor stands.
    pub fn at(&self, offset: u32) -> Option<&Occurrence> {
        let after = self.list.partition_point(|occurrence| occurrence.span.start <= offset);
        let found = self.list[..after].last()?;
        (offset <= found.span.end).then_some(found)
    }

    /// The names that start in a range of bytes.
    pub fn within(&self, start: u32, end: u32) -> &[Occurrence] {
        let first = self.list.partition_point(|occurrence| occurrence.span.start < start);
        let after = self.list.partition_point(|occurrence| occurrence.span.start < end);
        &self.list[first..after.max(first)]
    }

    /// The variable that is declared at a byte.
    pub fn variable(&self, declared: u32) -> Option<&Variable> {
        let found = self
            .variables
            .binary_search_by_key(&declared, |variable| variable.name.span.start)
            .ok()?;
        Some(&self.variables[found])
    }
}
