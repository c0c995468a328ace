//! A problem goes in; the predicates come out that are needed and can never be true, by a relaxation that looks at predicates only.

use std::fmt::Write;

use super::condition::conjuncts;
use crate::diagnostic::{Diagnostics, goal_unreachable};
use crate::model::{Domain, Formula, PredicateId, Problem};

/// What makes predicates true when others are: an action or an axiom.
struct Rule<'m> {
    /// Its name, if it is an action.
    name: Option<&'m str>,
    needs: Vec<PredicateId>,
    adds: Vec<PredicateId>,
}

/// Warns of what the goal or an action needs and nothing can make true.
pub(super) fn check(domain: &Domain, problem: &Problem, found: &mut Diagnostics) {
    let rules = rules(domain);
    let mut added = vec![false; domain.predicates.len()];
    let mut held = vec![false; domain.predicates.len()];
    problem.init.iter().for_each(|fact| held[fact.predicate.index()] = true);
    rules.iter().flat_map(|rule| &rule.adds).for_each(|add| added[add.index()] = true);
    let mut waiting: Vec<&Rule<'_>> = rules.iter().collect();
    loop {
        let before = waiting.len();
        waiting.retain(|rule| {
            let applies = rule.needs.iter().all(|need| held[need.index()]);
            if applies {
                rule.adds.iter().for_each(|add| held[add.index()] = true);
            }
            !applies
        });
        if waiting.len() == before {
            break;
        }
    }
    let goal: Vec<_> =
        conjuncts(&problem.goal).0.into_iter().filter(|literal| literal.positive).collect();
    let mut causes = 0;
    for (index, predicate) in domain.predicates.iter().enumerate() {
        let id = PredicateId(index as u32);
        if held[index] || added[index] {
            continue;
        }
        let wanted = goal.iter().any(|literal| literal.atom.predicate == id);
        let needing: Vec<&Rule<'_>> =
            waiting.iter().copied().filter(|rule| rule.needs.contains(&id)).collect();
        if !wanted && needing.is_empty() {
            continue;
        }
        causes += 1;
        found.push(goal_unreachable::never_true(
            &predicate.name.text,
            &problem.name.text,
            predicate.name.span,
            &consequence(wanted, &needing),
        ));
    }
    let out = goal.iter().find(|literal| !held[literal.atom.predicate.index()]);
    if let Some(literal) = out.filter(|_| causes == 0) {
        let name = &domain.predicates[literal.atom.predicate.index()].name.text;
        found.push(goal_unreachable::out_of_reach(name, literal.span));
    }
}

/// What follows from a predicate that is never true.
fn consequence(wanted: bool, needing: &[&Rule<'_>]) -> String {
    let mut names: Vec<String> =
        needing.iter().filter_map(|rule| rule.name).map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(SHOWN);
    names.truncate(SHOWN);
    let mut listed = names.join(", ");
    if more > 0 {
        write!(listed, " and {more} more").expect("writing to a string cannot fail");
    }
    match (wanted, listed.as_str()) {
        (true, "") => "the goal needs it, so there is no plan".to_owned(),
        (true, _) => format!("the goal needs it, so there is no plan; so do the actions {listed}"),
        (false, "") => "what is derived from it is never true".to_owned(),
        (false, _) => format!("actions that need it can never be applied: {listed}"),
    }
}

/// How many actions a message names.
const SHOWN: usize = 6;

fn rules(domain: &Domain) -> Vec<Rule<'_>> {
    let needs = |formula: &Formula| {
        let positive = conjuncts(formula).0.into_iter().filter(|literal| literal.positive);
        positive.map(|literal| literal.atom.predicate).collect()
    };
    let actions = domain.actions.iter().map(|action| Rule {
        name: Some(&action.name.text),
        needs: needs(&action.precondition),
        adds: action
            .effects
            .iter()
            .flat_map(|effect| &effect.literals)
            .filter(|literal| literal.positive)
            .map(|literal| literal.atom.predicate)
            .collect(),
    });
    let axioms = domain.axioms.iter().map(|axiom| Rule {
        name: None,
        needs: needs(&axiom.body),
        adds: vec![axiom.head],
    });
    actions.chain(axioms).collect()
}
