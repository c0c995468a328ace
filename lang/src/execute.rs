//! A checked domain and problem go in; what conditions mean in a state, and what steps do to it, come out.
//!
//! This is the reference semantics: every plan that leaves the program has passed through it, and the planner shares no code with it.
//! - Effects read the state before. Deletes come first, then adds: a fact that a step both deletes and adds holds afterwards.
//! - Derived predicates hold as the stratified fixpoint of the axioms says, and are worked out only when something asks for them.
//! - With a metric a step costs by how much it increases the metric's function; without one it costs 1.

mod relation;
pub(crate) mod query;
mod solutions;
mod state;
mod strata;
mod derive;
pub mod joint;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use rust_decimal::Decimal;
use rustc_hash::{FxHashMap, FxHashSet};

pub use state::{Change, State};
pub use strata::{Unstratified, stratified};

use crate::model::{
    Action, ActionId, Atom, Domain, Effect, Expression, Fact, Formula, FunctionId, Increase,
    ObjectId, PredicateId, Problem, Scope, Term, TypeId, VariableId,
};
use crate::plan::Step;
use crate::source::Span;
use query::{Goal, Query};
use relation::Relation;
use solutions::Solutions;
pub(crate) use solutions::value;
pub(crate) use state::View;
use strata::Strata;

/// Evaluates the conditions and applies the actions of one domain and problem.
#[derive(Debug)]
pub struct Executor<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    strata: Strata,
    /// For each type the objects that are of it, in order.
    members: Vec<Vec<ObjectId>>,
    values: FxHashMap<(FunctionId, Box<[ObjectId]>), Decimal>,
    /// What each action asks, prepared when it is first used.
    actions: Vec<OnceLock<Queries>>,
    goal: OnceLock<Query>,
    work: AtomicU64,
}

#[derive(Debug)]
struct Queries {
    precondition: Query,
    effects: Vec<Query>,
    increases: Vec<Query>,
}

/// A function has no value where an action's cost needs one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Undefined {
    /// The function.
    pub function: FunctionId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
    /// The `increase` that needs it.
    pub span: Span,
}

/// Why a step is not an instance of its action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misfit {
    /// It has this many arguments, and the action another number of parameters.
    Count(usize),
    /// The argument at this position is not of the parameter's type.
    Type(usize),
}

impl<'a> Executor<'a> {
    /// Prepares a domain and a problem, both checked without errors.
    pub fn new(domain: &'a Domain, problem: &'a Problem) -> Result<Self, Unstratified> {
        let mut members = vec![Vec::new(); domain.types.len()];
        for (at, object) in problem.objects.iter().enumerate() {
            let above = |id: &TypeId| domain.types[id.index()].ancestors.iter().copied();
            let mut types: Vec<_> = object.types.iter().flat_map(above).collect();
            types.sort();
            types.dedup();
            for id in types {
                members[id.index()].push(ObjectId(at as u32));
            }
        }
        // Of several values for the same arguments the last one counts, as an assignment would.
        let values = problem
            .values
            .iter()
            .map(|value| ((value.function, value.arguments.clone()), value.value));
        Ok(Self {
            domain,
            problem,
            strata: Strata::new(domain)?,
            members,
            values: values.collect(),
            actions: domain.actions.iter().map(|_| OnceLock::new()).collect(),
            goal: OnceLock::new(),
            work: AtomicU64::new(0),
        })
    }

    /// The domain that is executed.
    pub fn domain(&self) -> &'a Domain {
        self.domain
    }

    /// The problem that is executed.
    pub fn problem(&self) -> &'a Problem {
        self.problem
    }

    /// The initial state.
    pub fn initial(&self) -> State {
        let mut relations: Vec<_> = self
            .domain
            .predicates
            .iter()
            .map(|predicate| Relation::new(predicate.parameters.len()))
            .collect();
        for fact in &self.problem.init {
            relations[fact.predicate.index()].insert(&fact.arguments);
        }
        State {
            relations: relations.into_iter().map(Arc::new).collect(),
            derived: self.strata.components.iter().map(|_| OnceLock::new()).collect(),
        }
    }

    /// Whether a fact, derived or not, holds in `state`.
    pub fn contains(&self, state: &State, fact: &Fact) -> bool {
        self.view(state).relation(fact.predicate).contains(&fact.arguments)
    }

    /// Whether `formula` holds in `state`. Its free variables must be bound.
    pub fn holds(
        &self,
        state: &State,
        scope: &Scope,
        formula: &Formula,
        binding: &[Option<ObjectId>],
    ) -> bool {
        self.ask(self.view(state), scope, (formula, &Query::new(formula)), binding)
    }

    /// Whether the goal holds in `state`.
    pub fn goal(&self, state: &State) -> bool {
        let (goal, scope) = (&self.problem.goal, &self.problem.goal_scope);
        let query = self.goal.get_or_init(|| Query::new(goal));
        self.ask(self.view(state), scope, (goal, query), &vec![None; scope.variables.len()])
    }

    /// Whether the step's arguments are as many as the action's parameters and of their types.
    pub fn fits(&self, step: &Step) -> Result<(), Misfit> {
        let scope = &self.action(step.action).scope;
        if step.arguments.len() != scope.parameters as usize {
            return Err(Misfit::Count(step.arguments.len()));
        }
        let wrong = step
            .arguments
            .iter()
            .zip(&scope.variables)
            .position(|(&object, variable)| !self.is_of(object, &variable.types));
        wrong.map_or(Ok(()), |at| Err(Misfit::Type(at)))
    }

    /// Whether the step is an instance of its action and its precondition holds in `state`.
    pub fn applicable(&self, state: &State, step: &Step) -> bool {
        let action = self.action(step.action);
        let precondition = (&action.precondition, &self.queries(step.action).precondition);
        self.fits(step).is_ok()
            && self.ask(self.view(state), &action.scope, precondition, &bind(&action.scope, step))
    }

    /// Turns `state` into the one after the step, whether or not the precondition holds. The step must fit.
    pub fn apply(&self, state: &mut State, step: &Step) -> Change {
        let (added, deleted) = self.effects(self.view(state), step);
        self.change(state, added, deleted)
    }

    /// Deletes first, then adds.
    fn change(&self, state: &mut State, added: Facts, deleted: Facts) -> Change {
        let mut change = Change::default();
        for fact in deleted {
            if !added.contains(&fact) && state.remove(fact.predicate, &fact.arguments) {
                self.forget(state, &fact);
                change.deleted.push(fact);
            }
        }
        for fact in added {
            if state.insert(fact.predicate, &fact.arguments) {
                self.forget(state, &fact);
                change.added.push(fact);
            }
        }
        change
    }

    /// Turns the state after a step back into the one before.
    pub fn revert(&self, state: &mut State, change: &Change) {
        for fact in &change.added {
            state.remove(fact.predicate, &fact.arguments);
            self.forget(state, fact);
        }
        for fact in &change.deleted {
            state.insert(fact.predicate, &fact.arguments);
            self.forget(state, fact);
        }
    }

    /// What the step costs in `state`. The step must fit.
    pub fn cost(&self, state: &State, step: &Step) -> Result<Decimal, Undefined> {
        self.price(self.view(state), step)
    }

    fn price(&self, view: View<'_>, step: &Step) -> Result<Decimal, Undefined> {
        let Some(metric) = &self.problem.metric else { return Ok(Decimal::ONE) };
        let action = self.action(step.action);
        let mut sum = Decimal::ZERO;
        for (increase, query) in action.increases.iter().zip(&self.queries(step.action).increases) {
            if increase.function == metric.function {
                sum = sum.saturating_add(self.increase(
                    view,
                    &action.scope,
                    (increase, query),
                    step,
                )?);
            }
        }
        Ok(sum)
    }

    /// The metric's value in the initial state, summed over agents if it has one for each; 0 where there is none.
    pub fn initial_value(&self) -> Decimal {
        let Some(metric) = &self.problem.metric else { return Decimal::ZERO };
        let values = self.values.iter().filter(|((function, _), _)| *function == metric.function);
        values.fold(Decimal::ZERO, |sum, (_, &value)| sum.saturating_add(value))
    }

    fn increase(
        &self,
        view: View<'_>,
        scope: &Scope,
        (increase, query): (&Increase, &Query),
        step: &Step,
    ) -> Result<Decimal, Undefined> {
        let Increase { variables, condition, value, span, .. } = increase;
        let mut sum = Decimal::ZERO;
        // The same binding may come twice, and counts once.
        let mut seen = FxHashSet::default();
        let mut solutions =
            self.instances(view, scope, (condition, query), (variables, bind(scope, step)));
        while solutions.advance() {
            let binding = solutions.binding();
            let key: Vec<_> = variables.iter().map(|variable| binding[variable.index()]).collect();
            if seen.insert(key) {
                sum = sum.saturating_add(self.number(value, binding, *span)?);
            }
        }
        Ok(sum)
    }

    fn number(
        &self,
        expression: &Expression,
        binding: &[Option<ObjectId>],
        span: Span,
    ) -> Result<Decimal, Undefined> {
        match expression {
            Expression::Number(number) => Ok(*number),
            Expression::Function(function, arguments) => {
                let key = (*function, instance(arguments, binding));
                let known = self.values.get(&key).copied();
                known.ok_or(Undefined { function: key.0, arguments: key.1, span })
            }
        }
    }

    /// What the step adds and deletes, each once, as the state before says.
    fn effects(&self, view: View<'_>, step: &Step) -> (Facts, Facts) {
        let action = self.action(step.action);
        let (mut added, mut deleted) = (Facts::default(), Facts::default());
        for (effect, query) in action.effects.iter().zip(&self.queries(step.action).effects) {
            let Effect { variables, condition, literals, .. } = effect;
            let binding = bind(&action.scope, step);
            let mut solutions =
                self.instances(view, &action.scope, (condition, query), (variables, binding));
            while solutions.advance() {
                for literal in literals {
                    let fact = ground(&literal.atom, solutions.binding());
                    if literal.positive { added.push(fact) } else { deleted.push(fact) }
                }
            }
        }
        (added, deleted)
    }

    fn instances<'b>(
        &'b self,
        view: View<'b>,
        scope: &'b Scope,
        condition: (&'b Formula, &'b Query),
        (variables, binding): (&[VariableId], Vec<Option<ObjectId>>),
    ) -> Solutions<'b> {
        let mut goals: Vec<_> = variables.iter().map(|&variable| Goal::Binds(variable)).collect();
        goals.push(Goal::Holds(condition.0.root()));
        self.solutions(view, scope, condition, binding, goals)
    }

    /// The bindings beyond `binding` that satisfy `goals`, which are about `formula`.
    #[expect(clippy::unused_self, reason = "the view is one of this executor")]
    pub(crate) fn solutions<'b>(
        &'b self,
        view: View<'b>,
        scope: &'b Scope,
        formula: (&'b Formula, &'b Query),
        binding: Vec<Option<ObjectId>>,
        goals: Vec<Goal>,
    ) -> Solutions<'b> {
        Solutions::new(view, scope, formula, binding, goals)
    }

    fn ask(
        &self,
        view: View<'_>,
        scope: &Scope,
        formula: (&Formula, &Query),
        binding: &[Option<ObjectId>],
    ) -> bool {
        let goals = vec![Goal::Holds(formula.0.root())];
        self.solutions(view, scope, formula, binding.to_vec(), goals).advance()
    }

    /// Forgets what was derived from facts of this predicate.
    fn forget(&self, state: &mut State, fact: &Fact) {
        for &component in self.strata.dependents(fact.predicate) {
            state.derived[component].take();
        }
    }

    fn queries(&self, id: ActionId) -> &Queries {
        self.actions[id.index()].get_or_init(|| {
            let action = self.action(id);
            Queries {
                precondition: Query::new(&action.precondition),
                effects: action
                    .effects
                    .iter()
                    .map(|effect| Query::new(&effect.condition))
                    .collect(),
                increases: action
                    .increases
                    .iter()
                    .map(|increase| Query::new(&increase.condition))
                    .collect(),
            }
        })
    }

    fn action(&self, id: ActionId) -> &'a Action {
        &self.domain.actions[id.index()]
    }

    /// How much was evaluated so far, counted in steps of the evaluation: the same on every machine, as time is not.
    pub(crate) fn work(&self) -> u64 {
        self.work.load(Ordering::Relaxed)
    }

    fn worked(&self, steps: u64) {
        self.work.fetch_add(steps, Ordering::Relaxed);
    }

    /// Whether `derived` is derived from facts of `base`, directly or by way of other derived predicates.
    pub(crate) fn feeds(&self, base: PredicateId, derived: PredicateId) -> bool {
        let component = self.strata.place(derived).map(|(component, _)| component);
        component.is_some_and(|component| self.strata.dependents(base).contains(&component))
    }

    pub(crate) fn view<'b>(&'b self, state: &'b State) -> View<'b> {
        View { executor: self, state, building: None, joint: None }
    }

    fn strata(&self) -> &Strata {
        &self.strata
    }

    fn is_of(&self, object: ObjectId, types: &[TypeId]) -> bool {
        self.domain.has_type(&self.problem.objects[object.index()], types)
    }

    /// The objects that are of one of `types`, in order.
    fn objects_of(&self, types: &[TypeId]) -> Cow<'_, [ObjectId]> {
        match types {
            [one] => Cow::Borrowed(&self.members[one.index()]),
            several => {
                let mut all: Vec<_> = several
                    .iter()
                    .flat_map(|id| self.members[id.index()].iter().copied())
                    .collect();
                all.sort();
                all.dedup();
                Cow::Owned(all)
            }
        }
    }
}

/// Facts in the order in which they came, each once.
#[derive(Debug, Default)]
struct Facts {
    list: Vec<Fact>,
    set: FxHashSet<Fact>,
}

impl Facts {
    fn push(&mut self, fact: Fact) {
        if self.set.insert(fact.clone()) {
            self.list.push(fact);
        }
    }

    fn contains(&self, fact: &Fact) -> bool {
        self.set.contains(fact)
    }
}

impl IntoIterator for Facts {
    type Item = Fact;
    type IntoIter = std::vec::IntoIter<Fact>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

/// The binding of the scope's parameters to the step's arguments.
pub(crate) fn bind(scope: &Scope, step: &Step) -> Vec<Option<ObjectId>> {
    let mut binding = vec![None; scope.variables.len()];
    for (place, &object) in binding.iter_mut().zip(&step.arguments) {
        *place = Some(object);
    }
    binding
}

/// The objects that `terms` stand for; all of them must be bound.
pub(crate) fn instance(terms: &[Term], binding: &[Option<ObjectId>]) -> Box<[ObjectId]> {
    terms
        .iter()
        .map(|&term| value(term, binding).expect("the variables of an atom are bound"))
        .collect()
}

/// The fact that `atom` is; all its variables must be bound.
pub(crate) fn ground(atom: &Atom, binding: &[Option<ObjectId>]) -> Fact {
    Fact { predicate: atom.predicate, arguments: instance(&atom.arguments, binding) }
}
