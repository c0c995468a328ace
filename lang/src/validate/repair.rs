//! A plan that fails goes in; the nearest change of one step that makes it valid comes out.
//!
//! The search goes back from the failing step.
//! At each position it first tries to move steps, then to insert an instance of an action that makes a false part true.
//! What it may spend is counted in steps of the evaluation, so that the answer is the same on every machine.

use rustc_hash::FxHashSet;

use super::{Part, Place, Run, What};
use crate::execute::query::{Goal, Query};
use crate::execute::{Executor, State, bind};
use crate::model::{ActionId, Atom, Fact, ObjectId, Term, VariableId};
use crate::plan::Step;

/// How much the search may evaluate.
const WORK: u64 = 10_000_000;

/// How much of it may go into finding the instances of one action at one position.
const SEARCH: u64 = 100_000;

/// How many instances of one action are tried at one position.
const INSTANCES: usize = 50;

/// What would mend a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Repair {
    /// The plan is valid with this step in another place.
    Move {
        /// The step.
        step: usize,
        /// It comes before this one then; behind all if there is none of that number.
        before: usize,
    },
    /// The plan is valid with one step more.
    Insert {
        /// The new step.
        step: Step,
        /// It comes before this one; behind all if there is none of that number.
        before: usize,
    },
    /// No one step was found. The failing condition would hold if these facts were true, or false.
    Set(Vec<(Fact, bool)>),
    /// There is nothing to advise.
    None,
}

/// The repair for a plan whose condition at `place` fails in `parts`.
pub(super) fn search(run: &Run<'_>, place: Place, parts: &[Part]) -> Repair {
    let mut needs = Vec::new();
    let mut culprits = Vec::new();
    gather(parts, &mut needs, &mut culprits);
    let steps = &run.plan.steps;
    let failing = match place {
        Place::Step(at) => at,
        Place::Goal => steps.len(),
    };
    let executor = run.executor;
    let limit = executor.work() + WORK;
    let mut search = Search { executor, steps, failing, needs, culprits, limit };
    let mut state = run.state.clone();
    for position in (0..=failing).rev() {
        if let Some(change) = run.history.get(position) {
            executor.revert(&mut state, change);
        }
        let found = search.moves(&state, position).or_else(|| search.insertions(&state, position));
        if let Some(repair) = found {
            return repair;
        }
        if search.is_spent() {
            break;
        }
    }
    // Facts alone do not mend an equality, and of an alternative's parts it is not ours to choose.
    let plain =
        parts.iter().all(|part| matches!(part.what, What::Missing { .. } | What::Forbidden { .. }));
    let basic =
        |(fact, _): &(Fact, bool)| !executor.domain().predicates[fact.predicate.index()].derived;
    if plain && !search.needs.is_empty() && search.needs.iter().all(basic) {
        Repair::Set(search.needs)
    } else {
        Repair::None
    }
}

/// The facts that `parts` need, and the steps that stand in their way.
fn gather(parts: &[Part], needs: &mut Vec<(Fact, bool)>, culprits: &mut Vec<usize>) {
    for part in parts {
        match &part.what {
            What::Missing { fact, since } => {
                needs.push((fact.clone(), true));
                culprits.extend(since);
            }
            What::Forbidden { fact, since } => {
                needs.push((fact.clone(), false));
                culprits.extend(since);
            }
            What::Unmet { parts, .. } => gather(parts, needs, culprits),
            What::Different { .. } | What::Same { .. } | What::Action { .. } => {}
        }
    }
}

struct Search<'a> {
    executor: &'a Executor<'a>,
    steps: &'a [Step],
    failing: usize,
    needs: Vec<(Fact, bool)>,
    culprits: Vec<usize>,
    /// The executor's work at which the search ends.
    limit: u64,
}

impl Search<'_> {
    fn is_spent(&self) -> bool {
        self.executor.work() > self.limit
    }

    /// Tries all moves of which the first change is at `position`, where `state` holds.
    fn moves(&mut self, state: &State, position: usize) -> Option<Repair> {
        let (failing, count) = (self.failing, self.steps.len());
        // Each is a step and the step before which it comes.
        let mut moves: Vec<(usize, usize)> = Vec::new();
        if position == failing {
            moves.extend(
                (failing + 1..count)
                    .filter(|&later| self.helps(later))
                    .map(|later| (later, failing)),
            );
            moves.extend((failing + 2..=count).map(|behind| (failing, behind)));
        } else {
            if failing < count {
                moves.push((failing, position));
            }
            if self.culprits.contains(&position) || self.helps(position) {
                moves.push((position, failing));
                moves.push((position, failing + 1));
            }
            let earlier = self.culprits.iter().filter(|&&culprit| culprit > position);
            moves.extend(earlier.map(|&culprit| (culprit, position)));
        }
        moves.retain(|&(step, before)| step + 1 != before && before <= count);
        let valid = moves.into_iter().find(|&(step, before)| {
            let order = reordered(step, before, position, count);
            self.goes_through(state, order.map(|at| &self.steps[at]))
        });
        valid.map(|(step, before)| Repair::Move { step, before })
    }

    /// Tries each instance that is applicable at `position` and may make a false part true.
    fn insertions(&mut self, state: &State, position: usize) -> Option<Repair> {
        let mut seen = FxHashSet::default();
        for (fact, wanted) in self.needs.clone() {
            for action in 0..self.executor.domain().actions.len() as u32 {
                for step in self.instances(state, ActionId(action), (&fact, wanted)) {
                    if self.is_spent() {
                        return None;
                    }
                    if !seen.insert(step.clone()) {
                        continue;
                    }
                    let rest = self.steps[position..].iter();
                    if self.goes_through(state, std::iter::once(&step).chain(rest)) {
                        return Some(Repair::Insert { step, before: position });
                    }
                }
            }
        }
        None
    }

    /// Whether the steps can be executed from `state` and end in the goal. Costs are not asked for.
    fn goes_through<'s>(&mut self, state: &State, steps: impl Iterator<Item = &'s Step>) -> bool {
        let mut state = state.clone();
        for step in steps {
            if self.is_spent() || !self.executor.applicable(&state, step) {
                return false;
            }
            self.executor.apply(&mut state, step);
        }
        self.executor.goal(&state)
    }

    /// Whether an effect of the step may make one of the false parts true.
    fn helps(&self, at: usize) -> bool {
        let step = &self.steps[at];
        let action = &self.executor.domain().actions[step.action.index()];
        let literals = action.effects.iter().flat_map(|effect| &effect.literals);
        let mut literals = literals.map(|literal| (literal.positive, &literal.atom));
        literals.any(|(positive, atom)| {
            self.needs.iter().any(|(fact, wanted)| {
                let bound = bind(&action.scope, step);
                self.serves((positive, atom), (fact, *wanted)).is_some_and(|binding| {
                    binding.iter().all(|&(variable, object)| {
                        bound[variable.index()].is_none_or(|known| known == object)
                    })
                })
            })
        })
    }

    /// What the variables of an effect are if it serves the need; nothing where it feeds a derived fact.
    fn serves(
        &self,
        (positive, atom): (bool, &Atom),
        (fact, wanted): (&Fact, bool),
    ) -> Option<Vec<(VariableId, ObjectId)>> {
        if self.executor.feeds(atom.predicate, fact.predicate) {
            return Some(Vec::new());
        }
        if atom.predicate != fact.predicate || positive != wanted {
            return None;
        }
        let mut binding = Vec::new();
        for (&term, &object) in atom.arguments.iter().zip(&fact.arguments) {
            match term {
                Term::Object(other) if other == object => {}
                Term::Object(_) => return None,
                Term::Variable(variable) => binding.push((variable, object)),
            }
        }
        Some(binding)
    }

    /// Instances of the action that are applicable in `state` and of which an effect serves the need.
    fn instances(&self, state: &State, id: ActionId, need: (&Fact, bool)) -> Vec<Step> {
        let action = &self.executor.domain().actions[id.index()];
        let scope = &action.scope;
        let mut steps = Vec::new();
        for literal in action.effects.iter().flat_map(|effect| &effect.literals) {
            let Some(served) = self.serves((literal.positive, &literal.atom), need) else {
                continue;
            };
            let mut binding = vec![None; scope.variables.len()];
            // Where a variable is asked to be two objects, the trial shows that the step does not help.
            for (variable, object) in
                served.into_iter().filter(|(variable, _)| variable.0 < scope.parameters)
            {
                binding[variable.index()] = Some(object);
            }
            let mut goals: Vec<_> =
                (0..scope.parameters).map(|at| Goal::Binds(VariableId(at))).collect();
            goals.push(Goal::Holds(action.precondition.root()));
            let query = Query::new(&action.precondition);
            let formula = (&action.precondition, &query);
            let mut solutions = self
                .executor
                .solutions(self.executor.view(state), scope, formula, binding, goals)
                .within(SEARCH);
            let mut found = 0;
            while found < INSTANCES && solutions.advance() {
                let parameters = &solutions.binding()[..scope.parameters as usize];
                let objects =
                    parameters.iter().map(|object| object.expect("goals bind the parameters"));
                let step = Step { action: id, arguments: objects.collect() };
                if self.executor.fits(&step).is_ok() {
                    steps.push(step);
                }
                found += 1;
            }
        }
        steps
    }
}

/// The numbers of the steps from `from` on, with `step` before `before`.
fn reordered(step: usize, before: usize, from: usize, count: usize) -> impl Iterator<Item = usize> {
    let moved = move |at: usize| (at == before).then_some(step);
    let stays = move |at: usize| (at < count && at != step).then_some(at);
    (from..=count).flat_map(move |at| moved(at).into_iter().chain(stays(at)))
}
