//! The sections of a problem as they are written.

use super::{Agent, Application, Formula, InitialNetwork, Name, Place, TypedList, Unread};

/// What an [`Entry`] of the initial state says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EntryKind<'a> {
    /// `(PREDICATE OBJECT …)`
    Fact(Application<'a>),
    /// `(not (PREDICATE OBJECT …))`
    Absent(Application<'a>),
    /// `(= (FUNCTION OBJECT …) VALUE)`, where the value is a number or an object.
    Value(Application<'a>, Name<'a>),
    /// What is not read.
    Unread(Unread<'a>),
}

/// One element of `:init`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry<'a> {
    /// What it says.
    pub kind: EntryKind<'a>,
    /// The point in time of `(at TIME …)`; none for what holds from the beginning.
    pub time: Option<Name<'a>>,
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

/// `(:goal CONDITION)`, or in MA-PDDL `(:goal :agent AGENT :condition CONDITION)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Goal<'a> {
    /// Whose goal it is; everybody's where this is left out.
    pub agent: Option<Agent<'a>>,
    /// What must hold; several formulas are a mistake that has been reported.
    pub formulas: Vec<Formula<'a>>,
}

/// `(:metric DIRECTION VALUE)`, or in MA-PDDL `(:metric :agent AGENT :utility DIRECTION VALUE)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Metric<'a> {
    /// The keyword.
    pub keyword: Name<'a>,
    /// Whose metric it is; everybody's where this is left out.
    pub agent: Option<Agent<'a>>,
    /// `minimize` or `maximize`, if it is one of them.
    pub direction: Name<'a>,
    /// What is to be as small or as large as possible, an expression.
    pub value: Option<Formula<'a>>,
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
    /// `(:goal …)`
    Goal(Goal<'a>),
    /// `(:metric …)`
    Metric(Metric<'a>),
    /// `(:constraints …)`; the name is the keyword.
    Constraints(Name<'a>, Vec<Formula<'a>>),
    /// `(:htn …)`
    Network(InitialNetwork<'a>),
    /// What is not read.
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
