//! A problem goes in; the predicates come out that are needed and can never be true, by a relaxation that looks at predicates only,
//! and the facts that the goal wants otherwise than they are though no action changes their predicate.

use std::fmt::Write;

use hashbrown::HashMap;

use super::condition::conjuncts;
use crate::diagnostic::{Diagnostics, goal_unreachable};
use crate::model::{Domain, Fact, Formula, PredicateId, Problem, Term};
use crate::source::Span;

/// What makes predicates true when others are: an action or an axiom.
struct Rule<'m> {
    /// Its name, if it is an action.
    name: Option<&'m str>,
    /// Each once.
    needs: Vec<PredicateId>,
    adds: Vec<PredicateId>,
}

/// Warns of what the goal or an action needs and nothing can make true; says of each action whether that explains why it is never applied.
pub(super) fn check(domain: &Domain, problem: &Problem, found: &mut Diagnostics) -> Vec<bool> {
    let rules = rules(domain);
    let mut added = vec![false; domain.predicates.len()];
    let mut held = vec![false; domain.predicates.len()];
    problem.init.iter().for_each(|fact| held[fact.predicate.index()] = true);
    rules.iter().flat_map(|rule| &rule.adds).for_each(|add| added[add.index()] = true);
    // The rules that need each predicate, and how many predicates each still lacks.
    let mut needing: Vec<Vec<usize>> = vec![Vec::new(); domain.predicates.len()];
    let mut lacking = vec![0; rules.len()];
    for (index, rule) in rules.iter().enumerate() {
        rule.needs.iter().for_each(|need| needing[need.index()].push(index));
        lacking[index] = rule.needs.iter().filter(|need| !held[need.index()]).count();
    }
    let mut ready: Vec<usize> = (0..rules.len()).filter(|&rule| lacking[rule] == 0).collect();
    while let Some(rule) = ready.pop() {
        for add in &rules[rule].adds {
            if !std::mem::replace(&mut held[add.index()], true) {
                for &other in &needing[add.index()] {
                    lacking[other] -= 1;
                    if lacking[other] == 0 {
                        ready.push(other);
                    }
                }
            }
        }
    }
    let goal: Vec<_> =
        conjuncts(&problem.goal).0.into_iter().filter(|literal| literal.positive).collect();
    let mut wanted = vec![false; domain.predicates.len()];
    for literal in &goal {
        wanted[literal.atom.predicate.index()] = true;
    }
    let mut causes = 0;
    for (index, predicate) in domain.predicates.iter().enumerate() {
        let never = !held[index] && !added[index];
        if !never || (!wanted[index] && needing[index].is_empty()) {
            continue;
        }
        causes += 1;
        let needing: Vec<&Rule<'_>> = needing[index].iter().map(|&rule| &rules[rule]).collect();
        found.push(goal_unreachable::never_true(
            &predicate.name.text,
            &problem.name.text,
            predicate.name.span,
            &consequence(wanted[index], &needing),
        ));
    }
    let out = goal.iter().find(|literal| !held[literal.atom.predicate.index()]);
    if let Some(literal) = out.filter(|_| causes == 0) {
        let name = &domain.predicates[literal.atom.predicate.index()].name.text;
        found.push(goal_unreachable::out_of_reach(name, literal.span));
    } else {
        fixed(domain, problem, &added, &held, found);
    }
    let actions = &lacking[..domain.actions.len()];
    actions.iter().map(|&lacking| lacking > 0 && causes > 0).collect()
}

/// Warns of facts that the goal wants to become true or false, of predicates that no action adds or deletes.
fn fixed(
    domain: &Domain,
    problem: &Problem,
    added: &[bool],
    held: &[bool],
    found: &mut Diagnostics,
) {
    let mut deleted = vec![false; domain.predicates.len()];
    let effects = domain.actions.iter().flat_map(|action| &action.effects);
    for literal in effects.flat_map(|effect| &effect.literals).filter(|one| !one.positive) {
        deleted[literal.atom.predicate.index()] = true;
    }
    // The wanted facts of which it is still to be seen that they are as they are wanted.
    let mut wanted: HashMap<Fact, (bool, Span)> = HashMap::new();
    for literal in conjuncts(&problem.goal).0 {
        let index = literal.atom.predicate.index();
        let settled = if literal.positive { !added[index] && held[index] } else { !deleted[index] };
        let object = |term: &Term| match term {
            Term::Object(id) => Some(*id),
            Term::Variable(_) => None,
        };
        let arguments: Option<Box<[_]>> = literal.atom.arguments.iter().map(object).collect();
        let open = settled && !domain.predicates[index].derived;
        if let Some(arguments) = arguments.filter(|_| open) {
            let fact = Fact { predicate: literal.atom.predicate, arguments };
            wanted.insert(fact, (literal.positive, literal.span));
        }
    }
    let mut wrong: Vec<(Span, bool, PredicateId)> = Vec::new();
    for fact in &problem.init {
        if let Some((false, span)) = wanted.remove(fact) {
            wrong.push((span, false, fact.predicate));
        }
    }
    let missing = wanted.into_iter().filter(|(_, (positive, _))| *positive);
    wrong.extend(missing.map(|(fact, (_, span))| (span, true, fact.predicate)));
    wrong.sort_unstable();
    // One word about each predicate: most often one action lacks an effect.
    let mut told = vec![false; domain.predicates.len()];
    for (span, positive, predicate) in wrong {
        if !std::mem::replace(&mut told[predicate.index()], true) {
            let name = &domain.predicates[predicate.index()].name.text;
            found.push(goal_unreachable::settled(name, positive, span));
        }
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

/// A rule for each action, then one for each axiom.
fn rules(domain: &Domain) -> Vec<Rule<'_>> {
    let needs = |formula: &Formula| {
        let positive = conjuncts(formula).0.into_iter().filter(|literal| literal.positive);
        let mut needs: Vec<PredicateId> = positive.map(|literal| literal.atom.predicate).collect();
        needs.sort_unstable();
        needs.dedup();
        needs
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
