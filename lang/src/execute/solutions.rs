//! A state, a formula and a partial binding go in; one after another, the bindings that make the formula true come out.
//!
//! This is backtracking over a conjunction of [`Goal`]s, with stacks of its own, so that no formula is too deep.
//! Connectives are taken apart as they come.
//! Positive atoms bind variables, the one with the fewest matching rows first, and only a variable that no atom binds runs through the objects of its type.
//! A disjunction or a quantifier in which nothing is left to bind is a question of its own, asked once: whether there is a solution at all.

use std::borrow::Cow;

use super::query::{Goal, Query, Shape, shape};
use super::relation::Relation;
use super::state::View;
use crate::model::{ActionAtom, Formula, NodeId, NodeKind, ObjectId, Scope, Term, VariableId};

/// A binding for each variable of a scope, as far as it is known.
pub(crate) type Binding = Vec<Option<ObjectId>>;

/// What `term` stands for.
pub(crate) fn value(term: Term, binding: &[Option<ObjectId>]) -> Option<ObjectId> {
    match term {
        Term::Variable(variable) => binding[variable.index()],
        Term::Object(object) => Some(object),
    }
}

/// The ways to go on from one point, of which the first ones have been tried.
#[derive(Debug)]
enum Alternatives<'a> {
    /// The arguments of an atom are one of these rows of its relation; without a list, one of all rows.
    Rows { arguments: &'a [Term], relation: &'a Relation, rows: Option<&'a [u32]> },
    /// The variable is one of these objects.
    Objects { variable: VariableId, objects: Cow<'a, [ObjectId]> },
    /// One of these goals holds.
    Goals(Vec<Goal>),
}

/// A point to come back to.
#[derive(Debug)]
struct Choice<'a> {
    alternatives: Alternatives<'a>,
    next: usize,
    /// The goals that are open beside the chosen one.
    open: Vec<Goal>,
    /// How many variables were bound.
    trail: usize,
}

/// A question that waits for the answer to another.
#[derive(Debug)]
struct Frame {
    /// Whether the other must have a solution, or must have none.
    wanted: bool,
    tests: Vec<Goal>,
    open: Vec<Goal>,
    choices: usize,
    trail: usize,
}

enum Progress {
    Going,
    Failed,
    Solved,
}

/// The solutions of one query, found on demand.
#[derive(Debug)]
pub(crate) struct Solutions<'a> {
    view: View<'a>,
    scope: &'a Scope,
    formula: &'a Formula,
    query: &'a Query,
    binding: Binding,
    trail: Vec<VariableId>,
    /// Goals to be taken apart.
    todo: Vec<Goal>,
    /// Disjunctions and quantifiers without unbound variables.
    tests: Vec<Goal>,
    /// Goals with unbound variables.
    open: Vec<Goal>,
    choices: Vec<Choice<'a>>,
    frames: Vec<Frame>,
    started: bool,
    tuple: Vec<ObjectId>,
    /// How many goals were taken up and alternatives tried.
    work: u64,
    /// The work after which no more solutions are looked for.
    limit: u64,
}

impl Drop for Solutions<'_> {
    fn drop(&mut self) {
        self.view.executor.worked(self.work);
    }
}

impl<'a> Solutions<'a> {
    /// Asks for what satisfies all `goals`. Free variables must be bound, by `binding` or by a goal.
    pub(crate) fn new(
        view: View<'a>,
        scope: &'a Scope,
        (formula, query): (&'a Formula, &'a Query),
        binding: Binding,
        goals: Vec<Goal>,
    ) -> Self {
        debug_assert_eq!(
            binding.len(),
            scope.variables.len(),
            "a binding has a place for each variable"
        );
        Self {
            view,
            scope,
            formula,
            query,
            binding,
            trail: Vec::new(),
            todo: goals,
            tests: Vec::new(),
            open: Vec::new(),
            choices: Vec::new(),
            frames: Vec::new(),
            started: false,
            tuple: Vec::new(),
            work: 0,
            limit: u64::MAX,
        }
    }

    /// Gives up after so much work, as if there were no more solutions.
    pub(crate) fn within(mut self, limit: u64) -> Self {
        self.limit = limit;
        self
    }

    /// The binding of the solution that [`Solutions::advance`] came to.
    pub(crate) fn binding(&self) -> &[Option<ObjectId>] {
        &self.binding
    }

    /// Goes to the next solution. The same one may come twice where a disjunction or an `exists` has several reasons to hold.
    pub(crate) fn advance(&mut self) -> bool {
        let mut going = !self.started;
        self.started = true;
        loop {
            self.work += 1;
            if self.work > self.limit {
                return false;
            }
            let progress = if going { self.forward() } else { Progress::Failed };
            match progress {
                Progress::Going => going = true,
                Progress::Solved => match self.frames.pop() {
                    None => return true,
                    Some(frame) => going = self.leave(frame, true),
                },
                Progress::Failed => {
                    if self.retry() {
                        going = true;
                    } else {
                        match self.frames.pop() {
                            None => return false,
                            Some(frame) => going = self.leave(frame, false),
                        }
                    }
                }
            }
        }
    }

    /// Gives the answer to the question that waits; false if that question fails by it.
    fn leave(&mut self, frame: Frame, found: bool) -> bool {
        self.choices.truncate(frame.choices);
        self.undo(frame.trail);
        self.todo.clear();
        self.tests = frame.tests;
        self.open = frame.open;
        found == frame.wanted
    }

    /// Takes the next alternative of the last choice of this question.
    fn retry(&mut self) -> bool {
        self.todo.clear();
        self.tests.clear();
        let base = self.frames.last().map_or(0, |frame| frame.choices);
        while self.choices.len() > base {
            let mut choice = self.choices.pop().expect("it is longer than its base");
            self.undo(choice.trail);
            if self.take(&mut choice) {
                self.open.clone_from(&choice.open);
                self.choices.push(choice);
                return true;
            }
        }
        false
    }

    fn take(&mut self, choice: &mut Choice<'a>) -> bool {
        let next = &mut choice.next;
        match &choice.alternatives {
            Alternatives::Rows { arguments, relation, rows } => {
                let count = rows.map_or(relation.len(), <[u32]>::len);
                while *next < count {
                    let row = rows.map_or(*next as u32, |rows| rows[*next]);
                    *next += 1;
                    if self.unify(arguments, relation.row(row)) {
                        return true;
                    }
                    self.undo(choice.trail);
                }
                false
            }
            Alternatives::Objects { variable, objects } => {
                while let Some(&object) = objects.get(*next) {
                    *next += 1;
                    if self.bind(*variable, object) {
                        return true;
                    }
                }
                false
            }
            Alternatives::Goals(goals) => {
                let goal = goals.get(*next).copied();
                *next += 1;
                self.todo.extend(goal);
                goal.is_some()
            }
        }
    }

    fn unify(&mut self, arguments: &[Term], row: &[ObjectId]) -> bool {
        arguments.iter().zip(row).all(|(&term, &object)| match (term, value(term, &self.binding)) {
            (_, Some(known)) => known == object,
            (Term::Variable(variable), None) => self.bind(variable, object),
            (Term::Object(_), None) => unreachable!("an object stands for itself"),
        })
    }

    fn bind(&mut self, variable: VariableId, object: ObjectId) -> bool {
        let fits = self.view.executor.is_of(object, &self.scope.variables[variable.index()].types);
        if fits {
            self.binding[variable.index()] = Some(object);
            self.trail.push(variable);
        }
        fits
    }

    fn undo(&mut self, trail: usize) {
        for variable in self.trail.drain(trail..) {
            self.binding[variable.index()] = None;
        }
    }

    fn forward(&mut self) -> Progress {
        while let Some(goal) = self.todo.pop() {
            if !self.unfold(goal) {
                return Progress::Failed;
            }
        }
        if let Some(goal) = self.tests.pop() {
            return if self.test(goal) { Progress::Going } else { Progress::Failed };
        }
        let (query, binding) = (self.query, &self.binding);
        self.todo.extend(self.open.extract_if(.., |goal| query.closed(binding, *goal)));
        if !self.todo.is_empty() {
            return Progress::Going;
        }
        if self.open.is_empty() { Progress::Solved } else { self.choose() }
    }

    /// Decides a goal, takes it apart or puts it off; false if it cannot be.
    fn unfold(&mut self, goal: Goal) -> bool {
        if let Goal::Binds(variable) = goal {
            if self.binding[variable.index()].is_none() {
                self.open.push(goal);
            }
            return true;
        }
        match shape(self.formula, goal) {
            Shape::All(goals) => self.todo.extend(goals),
            Shape::Any(goals) if goals.len() <= 1 => {
                self.todo.extend(&goals);
                return !goals.is_empty();
            }
            shape if self.query.closed(&self.binding, goal) => match shape {
                Shape::Atom(atom, wanted) => {
                    let relation = self.view.relation(atom.predicate);
                    return self.contains(&atom.arguments, relation) == wanted;
                }
                Shape::Action(node, atom, wanted) => {
                    let stands = self
                        .actions(node, atom)
                        .is_some_and(|relation| self.contains(&atom.arguments, relation));
                    return stands == wanted;
                }
                Shape::Equal(left, right, wanted) => {
                    return (value(left, &self.binding) == value(right, &self.binding)) == wanted;
                }
                _ => self.tests.push(goal),
            },
            _ => self.open.push(goal),
        }
        true
    }

    /// The instances of the atom's action in the joint action; none where there are none.
    fn actions(&self, node: NodeId, atom: &ActionAtom) -> Option<&'a Relation> {
        self.view.joint?.relation(atom.action, self.query.negative(node))
    }

    fn contains(&mut self, arguments: &[Term], relation: &Relation) -> bool {
        let objects =
            arguments.iter().map(|&term| value(term, &self.binding).expect("the atom is closed"));
        self.tuple.clear();
        self.tuple.extend(objects);
        relation.contains(&self.tuple)
    }

    /// Asks the question that a closed disjunction or quantifier is; false if it fails at once.
    fn test(&mut self, goal: Goal) -> bool {
        let shape = shape(self.formula, goal);
        self.frames.push(Frame {
            wanted: !matches!(shape, Shape::No(..)),
            tests: std::mem::take(&mut self.tests),
            open: std::mem::take(&mut self.open),
            choices: self.choices.len(),
            trail: self.trail.len(),
        });
        match shape {
            Shape::Any(goals) => self.branch(Alternatives::Goals(goals)),
            Shape::Some(variables, goal) | Shape::No(variables, goal) => {
                self.enter(variables, goal);
                true
            }
            Shape::Atom(..) | Shape::Action(..) | Shape::Equal(..) | Shape::All(_) => {
                unreachable!("it is decided where it is met")
            }
        }
    }

    fn enter(&mut self, variables: &[VariableId], goal: Goal) {
        self.todo.extend(variables.iter().rev().map(|&variable| Goal::Binds(variable)));
        self.todo.push(goal);
    }

    fn branch(&mut self, alternatives: Alternatives<'a>) -> bool {
        let open = std::mem::take(&mut self.open);
        self.choices.push(Choice { alternatives, next: 0, open, trail: self.trail.len() });
        self.retry()
    }

    /// Binds a variable in one of several ways; all open goals have unbound variables.
    fn choose(&mut self) -> Progress {
        let mut best: Option<(usize, usize, Alternatives<'a>)> = None;
        for (at, &goal) in self.open.iter().enumerate() {
            let Some((cost, alternatives)) = self.generator(goal) else { continue };
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                best = Some((cost, at, alternatives));
            }
            if cost == 0 {
                return Progress::Failed;
            }
        }
        let going = match best {
            Some((_, at, alternatives)) => {
                self.open.swap_remove(at);
                self.branch(alternatives)
            }
            None => self.choose_without_atoms(),
        };
        if going { Progress::Going } else { Progress::Failed }
    }

    /// The rows of `relation` that the arguments may be, and how many they are.
    fn rows(&self, arguments: &'a [Term], relation: &'a Relation) -> (usize, Alternatives<'a>) {
        let rows = arguments
            .iter()
            .enumerate()
            .filter_map(|(at, &term)| Some(relation.rows_with(at, value(term, &self.binding)?)))
            .min_by_key(|rows| rows.len());
        let cost = rows.map_or(relation.len(), <[u32]>::len);
        (cost, Alternatives::Rows { arguments, relation, rows })
    }

    /// The rows or the object that can satisfy an atom or an equality, and how many they are.
    fn generator(&self, goal: Goal) -> Option<(usize, Alternatives<'a>)> {
        let Goal::Holds(node) = goal else { return None };
        match self.formula.kind(node) {
            NodeKind::Atom(atom) => {
                Some(self.rows(&atom.arguments, self.view.relation(atom.predicate)))
            }
            NodeKind::Action(atom) => Some(match self.actions(node, atom) {
                Some(relation) => self.rows(&atom.arguments, relation),
                None => (0, Alternatives::Goals(Vec::new())),
            }),
            NodeKind::Equal(left, right) => {
                let (variable, object) = match (*left, *right) {
                    (Term::Variable(variable), other)
                        if self.binding[variable.index()].is_none() =>
                    {
                        (variable, other)
                    }
                    (other, Term::Variable(variable)) => (variable, other),
                    (Term::Variable(_) | Term::Object(_), Term::Object(_)) => return None,
                };
                let object = value(object, &self.binding)?;
                Some((1, Alternatives::Objects { variable, objects: Cow::Owned(vec![object]) }))
            }
            _ => None,
        }
    }

    /// Goes into an `exists`, then into a disjunction, and only then runs through the objects of a type.
    fn choose_without_atoms(&mut self) -> bool {
        let mut any = None;
        let mut binds: Option<(usize, VariableId)> = None;
        for at in 0..self.open.len() {
            if let Goal::Binds(variable) = self.open[at] {
                binds.get_or_insert((at, variable));
                continue;
            }
            match shape(self.formula, self.open[at]) {
                Shape::Some(variables, goal) => {
                    self.open.swap_remove(at);
                    self.enter(variables, goal);
                    return true;
                }
                Shape::Any(goals) => drop(any.get_or_insert((at, goals))),
                _ => {}
            }
        }
        if let Some((at, goals)) = any {
            self.open.swap_remove(at);
            return self.branch(Alternatives::Goals(goals));
        }
        let (at, variable) = binds.expect("free variables are bound by the caller or by a goal");
        self.open.swap_remove(at);
        let objects = self.view.executor.objects_of(&self.scope.variables[variable.index()].types);
        self.branch(Alternatives::Objects { variable, objects })
    }
}
