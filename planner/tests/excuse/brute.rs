//! Every set of changes in the order of its cost, and every state of each changed problem, by the executor.

use std::collections::{BTreeSet, HashSet};

use lang::execute::Executor;
use lang::model::{Domain, Fact, ObjectId, Problem};
use lang::plan::Step;
use planner::excuse::Catalogue;

/// What holds no longer, and what holds instead.
pub type Change = (Option<Fact>, Option<Fact>);

/// All instances of all actions.
fn steps(domain: &Domain, problem: &Problem) -> Vec<Step> {
    let mut steps = Vec::new();
    for (number, action) in domain.actions.iter().enumerate() {
        let mut rows: Vec<Vec<ObjectId>> = vec![Vec::new()];
        for _ in 0..action.scope.parameters {
            rows = rows
                .into_iter()
                .flat_map(|row| {
                    (0..problem.objects.len() as u32).map(move |object| {
                        let mut row = row.clone();
                        row.push(ObjectId(object));
                        row
                    })
                })
                .collect();
        }
        steps.extend(rows.into_iter().map(|row| Step {
            action: lang::model::ActionId(number as u32),
            arguments: row.into(),
        }));
    }
    steps
}

/// Whether some sequence of steps reaches the goal.
pub fn has_plan(domain: &Domain, problem: &Problem) -> bool {
    plan_length(domain, problem).is_some()
}

/// The length of the shortest plan.
fn plan_length(domain: &Domain, problem: &Problem) -> Option<usize> {
    let executor = Executor::new(domain, problem).expect("it is stratified");
    let facts = |state: &lang::execute::State| -> Vec<bool> {
        all(domain, problem).iter().map(|fact| executor.contains(state, fact)).collect()
    };
    let steps: Vec<Step> =
        steps(domain, problem).into_iter().filter(|step| executor.fits(step).is_ok()).collect();
    let mut seen = HashSet::from([facts(&executor.initial())]);
    let mut layer = vec![executor.initial()];
    let mut length = 0;
    while !layer.is_empty() {
        let mut next = Vec::new();
        for state in layer {
            if executor.goal(&state) {
                return Some(length);
            }
            for step in &steps {
                if executor.applicable(&state, step) {
                    let mut after = state.clone();
                    executor.apply(&mut after, step);
                    if seen.insert(facts(&after)) {
                        next.push(after);
                    }
                }
            }
        }
        layer = next;
        length += 1;
    }
    None
}

/// All facts of predicates that are not derived.
fn all(domain: &Domain, problem: &Problem) -> Vec<Fact> {
    let mut facts = Vec::new();
    for (number, predicate) in domain.predicates.iter().enumerate() {
        if predicate.derived {
            continue;
        }
        let mut rows: Vec<Vec<ObjectId>> = vec![Vec::new()];
        for _ in &predicate.parameters {
            rows = rows
                .into_iter()
                .flat_map(|row| {
                    (0..problem.objects.len() as u32).map(move |object| {
                        let mut row = row.clone();
                        row.push(ObjectId(object));
                        row
                    })
                })
                .collect();
        }
        facts.extend(rows.into_iter().map(|row| Fact {
            predicate: lang::model::PredicateId(number as u32),
            arguments: row.into(),
        }));
    }
    facts
}

/// The problem after some changes.
fn changed(problem: &Problem, changes: &[Change]) -> Problem {
    let mut problem = problem.clone();
    for (from, _) in changes {
        problem.init.retain(|fact| Some(fact) != from.as_ref());
    }
    problem.init.extend(changes.iter().filter_map(|(_, to)| to.clone()));
    problem
}

/// What trying everything says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Tried {
    /// The cost of the smallest excuses, and all of that cost.
    Smallest(u32, BTreeSet<BTreeSet<Change>>),
    /// None is so cheap.
    Nothing,
    /// There are too many sets to try.
    TooMany,
}

/// Tries all sets that cost `most` at most, of which there are `most_sets` at most.
pub fn smallest(
    domain: &Domain,
    problem: &Problem,
    catalogue: &Catalogue,
    most: u32,
    most_sets: usize,
) -> Tried {
    let mut sets: Vec<(u32, Vec<Change>)> = vec![(0, Vec::new())];
    for choice in &catalogue.variables {
        let before = sets.clone();
        for (to, cost) in &choice.to {
            for (sum, set) in &before {
                if sum + cost <= most {
                    let mut set = set.clone();
                    set.push((choice.from.clone(), to.clone()));
                    sets.push((sum + cost, set));
                }
            }
        }
        if sets.len() > most_sets {
            return Tried::TooMany;
        }
    }
    sets.sort_by_key(|(cost, _)| *cost);
    let mut found: Option<(u32, BTreeSet<BTreeSet<Change>>)> = None;
    for (cost, set) in sets.into_iter().filter(|(_, set)| !set.is_empty()) {
        if found.as_ref().is_some_and(|(least, _)| cost > *least) {
            break;
        }
        let problem = changed(problem, &set);
        let possible = catalogue.groups.iter().all(|(facts, exactly)| {
            let count = facts.iter().filter(|fact| problem.init.contains(fact)).count();
            count == 1 || count == 0 && !exactly
        });
        if possible && plan_length(domain, &problem).is_some_and(|length| length > 0) {
            found.get_or_insert((cost, BTreeSet::new())).1.insert(set.into_iter().collect());
        }
    }
    match found {
        Some((cost, sets)) => Tried::Smallest(cost, sets),
        None => Tried::Nothing,
    }
}
