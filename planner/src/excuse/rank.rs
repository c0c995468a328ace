//! Excuses of one cost go in; the same come out with better plans and with the deepest causes first.
//!
//! An excuse explains another where a plan leads from its state to what the other one changes (the "good" excuses of Göbelbecker et al., ICAPS 2010:
//! a drawer that is not clear explains one that is not open).

use lang::condition::Condition;
use lang::model::{Atom, Domain, Problem, Scope, Term};

use super::{Asked, Excuse};
use crate::limits::Limits;
use crate::solve::{Answer, solve};

/// So many pairs are compared at most.
const MOST_PAIRS: usize = 2_000;

/// Ranks excuses of one cost.
pub(super) fn rank(asked: Asked<'_>, mut excuses: Vec<Excuse>) -> Vec<Excuse> {
    let Asked { domain, problem, question, limits } = asked;
    let count = excuses.len();
    let mut leads = vec![vec![false; count]; count];
    let share = question.polish / (count as u64 * count as u64 + 1) + 10_000;
    for from in 0..count {
        for to in 0..count {
            if from == to || count * count > MOST_PAIRS || limits.stopped().is_some() {
                continue;
            }
            leads[from][to] =
                explains(domain, problem, &excuses[from], &excuses[to], share, limits);
        }
    }
    // What explains one another is on one level.
    for middle in 0..count {
        for from in 0..count {
            for to in 0..count {
                leads[from][to] |= from != to && leads[from][middle] && leads[middle][to];
            }
        }
    }
    for to in 0..count {
        let deeper: Vec<usize> =
            (0..count).filter(|&from| leads[from][to] && !leads[to][from]).collect();
        excuses[to].level = deeper.len() as u32;
    }
    let levels: Vec<u32> = {
        // The length of the longest chain of deeper causes.
        let mut levels = vec![0_u32; count];
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&one| excuses[one].level);
        for &to in &order {
            let deeper = (0..count).filter(|&from| leads[from][to] && !leads[to][from]);
            levels[to] = deeper.map(|from| levels[from] + 1).max().unwrap_or(0);
        }
        levels
    };
    let mut order: Vec<usize> = (0..count).collect();
    for (excuse, level) in excuses.iter_mut().zip(levels) {
        excuse.level = level;
        polish(domain, excuse, question.polish / (count as u64).max(1), limits);
    }
    order.sort_by_key(|&one| {
        (excuses[one].level, excuses[one].changes.len(), excuses[one].plan.steps.len(), one)
    });
    let place = |old: usize| order.iter().position(|&one| one == old);
    let mut ranked: Vec<Excuse> = order.iter().map(|&old| excuses[old].clone()).collect();
    for (new, &old) in order.iter().enumerate() {
        let deeper = (0..count).filter(|&from| leads[from][old] && !leads[old][from]);
        let mut deeper: Vec<usize> = deeper.filter_map(place).collect();
        deeper.sort_unstable();
        ranked[new].follows_from = deeper;
    }
    ranked
}

/// Whether a plan leads from the state of one excuse to what the other one changes.
fn explains(
    domain: &Domain,
    original: &Problem,
    one: &Excuse,
    other: &Excuse,
    budget: u64,
    limits: &Limits,
) -> bool {
    if other.changes.iter().any(|change| change.object.is_some()) {
        return false;
    }
    let mut problem = one.problem.clone();
    let atom = |fact: &lang::model::Fact| {
        let terms = fact.arguments.iter().map(|&object| Term::Object(object)).collect();
        Condition::Atom(Atom { predicate: fact.predicate, arguments: terms }, true)
    };
    let parts = other.changes.iter().flat_map(|change| {
        let made = change.to.as_ref().map(atom);
        let gone = change.from.as_ref().map(|fact| atom(fact).not());
        made.into_iter().chain(gone)
    });
    problem.goal = Condition::all(parts).formula(original.name.span);
    problem.goal_scope = Scope::default();
    problem.metric = None;
    matches!(solve(domain, &problem, false, budget, limits), Ok(Answer::Plan(_)))
}

/// Looks for a shorter plan.
fn polish(domain: &Domain, excuse: &mut Excuse, budget: u64, limits: &Limits) {
    if let Ok(Answer::Plan(plan)) = solve(domain, &excuse.problem, true, budget, limits)
        && plan.steps.len() <= excuse.plan.steps.len()
    {
        excuse.plan = plan;
    }
}
