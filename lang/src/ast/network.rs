//! Tasks, methods and task networks of HDDL as they are written.

use super::{Application, Formula, Name, Place, TypedList};

/// `(:task NAME :parameters (…))`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Task<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// The `:parameters`.
    pub parameters: TypedList<'a>,
    /// The whole of it.
    pub place: Place,
}

/// `(:method NAME :parameters (…) :task (TASK TERM …) :precondition CONDITION NETWORK)`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Method<'a> {
    /// Its name.
    pub name: Name<'a>,
    /// The `:parameters`.
    pub parameters: TypedList<'a>,
    /// The `:task` that it achieves, a formula of one application.
    pub task: Option<Formula<'a>>,
    /// The `:precondition`s; at most one without a mistake.
    pub preconditions: Vec<Formula<'a>>,
    /// What it does.
    pub network: Network<'a>,
    /// The whole of it.
    pub place: Place,
}

/// Subtasks, their order and what their arguments must satisfy.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Network<'a> {
    /// Whether the subtasks are done in the order in which they stand.
    pub ordered: bool,
    /// The subtasks.
    pub subtasks: Vec<Subtask<'a>>,
    /// The arguments of all subtasks.
    pub terms: Vec<Name<'a>>,
    /// The `:ordering`: pairs of which the first comes before the second.
    pub ordering: Vec<(Name<'a>, Name<'a>)>,
    /// The `:constraints`; at most one formula without a mistake.
    pub constraints: Vec<Formula<'a>>,
}

/// `(TASK TERM …)` or `(ID (TASK TERM …))`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Subtask<'a> {
    /// Under which name the ordering knows it.
    pub label: Option<Name<'a>>,
    /// The task or the action with its arguments.
    pub task: Application<'a>,
    /// `(TASK TERM …)`
    pub place: Place,
}

/// `(:htn :parameters (…) NETWORK)`: what a problem asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InitialNetwork<'a> {
    /// The keyword.
    pub keyword: Name<'a>,
    /// The `:parameters`, which the planner chooses.
    pub parameters: TypedList<'a>,
    /// What is to be done.
    pub network: Network<'a>,
}
