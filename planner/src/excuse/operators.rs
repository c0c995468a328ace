//! A problem without a plan goes in; which missing operators would be enough comes out: for each, what it would do, under which facts it was needed, and a
//! plan that uses it.
//!
//! For each predicate a trial operator is added that makes one fact of it true, at any time, and what excludes it false. The smallest sets of such operators
//! with which there is a plan are found in the order of their size. What was true of its objects whenever a trial operator was used is under which it
//! has to be shown. Facts of the goal are not made true so, or the answer would be the goal itself.

use std::collections::BTreeSet;

use lang::condition::Condition;
use lang::execute::Executor;
use lang::model::{
    Action, ActionId, Atom, Domain, Effect, Fact, Formula, Literal, Name, ObjectId, Predicate,
    PredicateId, Problem, Requirement, Scope, Term, TypeId, Variable, VariableId,
};
use lang::plan::Plan;

use super::open::{Obstacle, Open};
use super::policy::{KIND, Policy};
use super::vocabulary::Vocabulary;
use super::{known, stages};
use crate::limits::Limits;
use crate::normalize::Unsupported;
use crate::solve::{Answer, solve};

/// How much work a set of operators gets, and how many operators a set has at most.
const EFFORT: u64 = 20_000_000;
const MOST_OPERATORS: usize = 3;

/// An operator that is missing.
#[derive(Debug, Clone)]
pub struct Abstract {
    /// What it makes true: the predicate, whose arguments are the first of `variables`.
    pub predicate: PredicateId,
    /// Its parameters, each with its types.
    pub variables: Vec<Vec<TypeId>>,
    /// What was true of them whenever it was used.
    pub before: Vec<Atom>,
    /// What it made false each time.
    pub removes: Vec<Atom>,
    /// What it made true, each time.
    pub uses: Vec<Fact>,
}

/// A step of a plan with missing operators.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// An action of the domain.
    Known(lang::plan::Step),
    /// A missing operator makes this true.
    Missing(Fact),
}

/// A smallest set of missing operators.
#[derive(Debug, Clone)]
pub struct Missing {
    /// The operators.
    pub operators: Vec<Abstract>,
    /// A plan with them.
    pub plan: Vec<Step>,
}

/// The smallest sets of missing operators, the shortest plans first; and whether each smaller set was refuted.
///
/// # Errors
/// What the planner does not plan.
pub fn missing(
    domain: &Domain,
    problem: &Problem,
    policy: &Policy,
    limits: &Limits,
) -> Result<(Vec<Missing>, bool), Unsupported> {
    let trials = Trials::new(domain, problem, policy, limits)?;
    let mut found = Vec::new();
    let mut refuted = true;
    for size in 1..=MOST_OPERATORS {
        for set in subsets(trials.predicates.len(), size) {
            if limits.stopped().is_some() {
                return Ok((found, false));
            }
            let set: Vec<usize> = set;
            let (changed, extended) = trials.world(&set);
            match solve(&changed, &extended, true, EFFORT, limits)? {
                Answer::Plan(plan) => found.push(trials.read(&set, &changed, &extended, &plan)),
                Answer::Unsolvable(_) => {}
                Answer::Spent | Answer::Stopped(_) => refuted = false,
            }
        }
        if !found.is_empty() {
            break;
        }
    }
    found.sort_by_key(|one| trials.rank(one));
    Ok((found, refuted))
}

/// All subsets of this size, in lexicographic order.
fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..size {
        sets = sets
            .into_iter()
            .flat_map(|set| {
                let first = set.last().map_or(0, |last| last + 1);
                (first..count).map(move |next| {
                    let mut set = set.clone();
                    set.push(next);
                    set
                })
            })
            .collect();
    }
    sets
}

/// The trial operators of a problem.
struct Trials<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    /// What they make true.
    predicates: Vec<PredicateId>,
    /// For each the groups that it is in: the atoms that exclude it, in its own arguments and in counted variables behind them.
    rivals: Vec<Vec<(Atom, usize)>>,
    /// The facts of the goal.
    goal: BTreeSet<Fact>,
}

impl<'a> Trials<'a> {
    fn new(
        domain: &'a Domain,
        problem: &'a Problem,
        policy: &Policy,
        limits: &Limits,
    ) -> Result<Self, Unsupported> {
        let policy = Policy { objects: 0, ..policy.clone() };
        let mut opened = None;
        for level in stages(domain, problem, &policy)? {
            if level.most >= KIND {
                break;
            }
            match Open::new(domain, problem, &policy, level.most, level.bound, limits) {
                Ok(open) => opened = Some(open),
                Err(Obstacle::Unsupported(unsupported)) => return Err(unsupported),
                Err(Obstacle::Hopeless { .. }) => {}
                Err(_) => break,
            }
            if level.last {
                break;
            }
        }
        let mut trials = Self {
            domain,
            problem,
            predicates: Vec::new(),
            rivals: Vec::new(),
            goal: BTreeSet::new(),
        };
        let Some(open) = opened else { return Ok(trials) };
        let invariants = known(domain, &open, limits);
        for (number, editable) in open.editable.iter().enumerate() {
            let fact = Vocabulary::fact(&open, crate::grounded::FactId(number as u32));
            let Some(fact) = fact else { continue };
            if open.locked[number] {
                trials.goal.insert(fact);
            } else if *editable != 0 && !trials.predicates.contains(&fact.predicate) {
                trials.predicates.push(fact.predicate);
            }
        }
        trials.predicates.sort_unstable();
        for &predicate in &trials.predicates {
            let mut rivals = Vec::new();
            for invariant in &invariants {
                let Some(own) = invariant.part(predicate.0) else { continue };
                for part in &invariant.parts {
                    // The counted argument is a variable of its own, behind those of the predicate.
                    let arity = domain.predicates[predicate.index()].parameters.len() as u32;
                    let count = domain.predicates[part.predicate as usize].parameters.len();
                    let mut arguments = vec![Term::Variable(VariableId(arity)); count];
                    for (mine, theirs) in own.order.iter().zip(&part.order) {
                        arguments[*theirs as usize] = Term::Variable(VariableId(*mine));
                    }
                    let counted = usize::from(part.counted.is_some());
                    let predicate = PredicateId(part.predicate);
                    rivals.push((Atom { predicate, arguments }, counted));
                }
            }
            for group in &policy.declared {
                rivals.extend(declared_rivals(domain, predicate, group));
            }
            trials.rivals.push(rivals);
        }
        Ok(trials)
    }

    /// What no action makes true is what is missing; then, the less often an operator is needed and the shorter the plan, the better.
    fn rank(&self, missing: &Missing) -> (usize, usize, usize) {
        let makes = |predicate: PredicateId| {
            let effects = self.domain.actions.iter().flat_map(|action| &action.effects);
            let mut literals = effects.flat_map(|effect| &effect.literals);
            literals.any(|literal| literal.positive && literal.atom.predicate == predicate)
        };
        let relates = |predicate: PredicateId| {
            self.domain.predicates[predicate.index()].parameters.len() > 1 && !makes(predicate)
        };
        let operators = &missing.operators;
        let known = operators.iter().filter(|one| makes(one.predicate)).count();
        let dear = operators.iter().filter(|one| relates(one.predicate)).count();
        let uses = operators.iter().map(|one| one.uses.len()).sum();
        (known + 2 * dear, uses, missing.plan.len())
    }

    /// The domain with trial operators, and the problem in it.
    fn world(&self, set: &[usize]) -> (Domain, Problem) {
        let mut domain = self.domain.clone();
        let mut problem = self.problem.clone();
        problem.metric = None;
        domain.requirements.extend([
            Requirement::NegativePreconditions,
            Requirement::ConditionalEffects,
            Requirement::UniversalPreconditions,
        ]);
        for &trial in set {
            let predicate = self.predicates[trial];
            let declaration = self.domain.predicates[predicate.index()].clone();
            let span = declaration.name.span;
            let named =
                |prefix: &str| Name { text: format!("{prefix}-{}", declaration.name.text), span };
            let goal = PredicateId(domain.predicates.len() as u32);
            domain.predicates.push(Predicate {
                name: named("goal"),
                parameters: declaration.parameters.clone(),
                derived: false,
                owner: None,
            });
            problem.init.extend(
                self.goal
                    .iter()
                    .filter(|fact| fact.predicate == predicate)
                    .map(|fact| Fact { predicate: goal, arguments: fact.arguments.clone() }),
            );
            let arity = declaration.parameters.len() as u32;
            let own: Vec<Term> = (0..arity).map(|one| Term::Variable(VariableId(one))).collect();
            let mut scope = Scope { variables: declaration.parameters.clone(), parameters: arity };
            let mut effects = Vec::new();
            let truth = Formula::truth(span);
            let literal = |positive, atom| Literal { positive, atom, span };
            for (atom, counted) in &self.rivals[trial] {
                let mut atom = atom.clone();
                let mut variables = Vec::new();
                if *counted > 0 {
                    // Each quantified effect has variables of its own.
                    let rival = &self.domain.predicates[atom.predicate.index()];
                    let behind = |term: &Term| *term == Term::Variable(VariableId(arity));
                    for position in 0..atom.arguments.len() {
                        if behind(&atom.arguments[position]) {
                            let fresh = VariableId(scope.variables.len() as u32);
                            scope.variables.push(Variable {
                                name: Name { text: format!("?other{}", fresh.0), span },
                                types: rival.parameters[position].types.clone(),
                            });
                            atom.arguments[position] = Term::Variable(fresh);
                            variables.push(fresh);
                        }
                    }
                }
                let literals = vec![literal(false, atom)];
                effects.push(Effect { variables, condition: truth.clone(), literals, span });
            }
            let made = Atom { predicate, arguments: own.clone() };
            effects.push(Effect {
                variables: Vec::new(),
                condition: truth,
                literals: vec![literal(true, made.clone())],
                span,
            });
            let not = |atom| Condition::Atom(atom, false);
            let precondition =
                Condition::all([not(made), not(Atom { predicate: goal, arguments: own })]);
            domain.actions.push(Action {
                name: named("missing"),
                scope,
                agent: false,
                precondition: precondition.formula(span),
                effects,
                increases: Vec::new(),
                span,
            });
        }
        (domain, problem)
    }

    /// What a plan says of the operators that it uses.
    fn read(&self, set: &[usize], domain: &Domain, problem: &Problem, plan: &Plan) -> Missing {
        let executor = Executor::new(domain, problem).expect("no axiom was added");
        let first = self.domain.actions.len();
        let mut state = executor.initial();
        let mut steps = Vec::new();
        let mut seen: Vec<Vec<Use>> = vec![Vec::new(); set.len()];
        for step in &plan.steps {
            let ActionId(action) = step.action;
            if let Some(trial) = (action as usize).checked_sub(first) {
                let predicate = self.predicates[set[trial]];
                let fact = Fact { predicate, arguments: step.arguments.clone() };
                let before = self.around(&executor, &state, &step.arguments);
                executor.apply(&mut state, step);
                let gone = before.iter().filter(|fact| !executor.contains(&state, fact));
                let lift = |facts: &mut dyn Iterator<Item = &Fact>| -> Lifted {
                    facts.filter_map(|fact| lifted(fact, &step.arguments)).collect()
                };
                let removed = lift(&mut gone.into_iter());
                seen[trial].push((step.arguments.to_vec(), lift(&mut before.iter()), removed));
                steps.push(Step::Missing(fact));
            } else {
                executor.apply(&mut state, step);
                steps.push(Step::Known(step.clone()));
            }
        }
        let operators = set
            .iter()
            .zip(seen)
            .filter(|(_, seen)| !seen.is_empty())
            .map(|(&trial, seen)| self.operator(trial, seen))
            .collect();
        Missing { operators, plan: steps }
    }

    /// The facts that are true of some objects and of nothing else.
    fn around(
        &self,
        executor: &Executor<'_>,
        state: &lang::execute::State,
        objects: &[ObjectId],
    ) -> Vec<Fact> {
        let mut facts = Vec::new();
        for (number, predicate) in self.domain.predicates.iter().enumerate() {
            if predicate.derived || predicate.parameters.len() > 3 {
                continue;
            }
            let mut rows: Vec<Vec<ObjectId>> = vec![Vec::new()];
            for _ in &predicate.parameters {
                rows = rows
                    .into_iter()
                    .flat_map(|row| {
                        objects.iter().map(move |&object| {
                            let mut row = row.clone();
                            row.push(object);
                            row
                        })
                    })
                    .collect();
            }
            rows.sort_unstable();
            rows.dedup();
            let fact = |row: Vec<ObjectId>| Fact {
                predicate: PredicateId(number as u32),
                arguments: row.into(),
            };
            facts.extend(rows.into_iter().map(fact).filter(|one| executor.contains(state, one)));
        }
        facts
    }

    fn operator(&self, trial: usize, seen: Vec<Use>) -> Abstract {
        let predicate = self.predicates[trial];
        let common = |of: &dyn Fn(&Use) -> Lifted| {
            let mut all = seen.iter().map(of);
            let first = all.next().unwrap_or_default();
            all.fold(first, |left, right| left.intersection(&right).cloned().collect())
        };
        let atom = |(predicate, places): (PredicateId, Vec<u32>)| Atom {
            predicate,
            arguments: places.into_iter().map(|one| Term::Variable(VariableId(one))).collect(),
        };
        let parameters = &self.domain.predicates[predicate.index()].parameters;
        Abstract {
            predicate,
            variables: parameters.iter().map(|parameter| parameter.types.clone()).collect(),
            before: common(&|one| one.1.clone()).into_iter().map(atom).collect(),
            removes: common(&|one| one.2.clone()).into_iter().map(atom).collect(),
            uses: seen
                .into_iter()
                .map(|(arguments, ..)| Fact { predicate, arguments: arguments.into() })
                .collect(),
        }
    }
}

/// A use of a trial operator: its objects, what was true of them, and what it made false of that.
type Use = (Vec<ObjectId>, Lifted, Lifted);

/// Facts in terms of the parameters that their objects stand for.
type Lifted = BTreeSet<(PredicateId, Vec<u32>)>;

fn lifted(fact: &Fact, objects: &[ObjectId]) -> Option<(PredicateId, Vec<u32>)> {
    let place =
        |object: &ObjectId| objects.iter().position(|one| one == object).map(|at| at as u32);
    Some((fact.predicate, fact.arguments.iter().map(place).collect::<Option<Vec<u32>>>()?))
}

/// What a declared group excludes where an atom of this predicate is made true.
fn declared_rivals(
    domain: &Domain,
    predicate: PredicateId,
    group: &lang::group::Group,
) -> Vec<(Atom, usize)> {
    let parameters = group.parameters();
    let arity = domain.predicates[predicate.index()].parameters.len() as u32;
    let mut rivals = Vec::new();
    for own in group.atoms.iter().filter(|atom| atom.predicate == predicate) {
        let place = |wanted: Term| own.arguments.iter().position(|&term| term == wanted);
        for other in &group.atoms {
            let mut counted = 0;
            let arguments = other
                .arguments
                .iter()
                .map(|&term| match term {
                    Term::Variable(variable) if parameters.contains(&variable) => {
                        let place = place(term).expect("all atoms share the parameters");
                        Term::Variable(VariableId(place as u32))
                    }
                    Term::Variable(_) => {
                        counted += 1;
                        Term::Variable(VariableId(arity))
                    }
                    object @ Term::Object(_) => object,
                })
                .collect();
            rivals.push((Atom { predicate: other.predicate, arguments }, counted));
        }
    }
    rivals
}
