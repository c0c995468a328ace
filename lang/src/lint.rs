//! A checked model goes in; warnings come out about what is well formed and still surely not meant.
//!
//! Lints are for those who write PDDL: `check` and editors ask for them, planning does not.
//! They run on files without errors, and take time linear in the size of the files.

mod condition;
mod reach;

use hashbrown::HashMap;

use crate::diagnostic::{Diagnostics, goal_already_true, unused_predicate};
use crate::model::{Domain, Fact, Formula, NodeKind, Problem, Term};

/// What there is to say about a domain.
pub fn domain(domain: &Domain) -> Diagnostics {
    let mut found = Diagnostics::default();
    for axiom in &domain.axioms {
        condition::constants(&axiom.body, &mut found);
    }
    for action in &domain.actions {
        condition::constants(&action.precondition, &mut found);
        condition::contradictions(action, &mut found);
        for effect in &action.effects {
            condition::constants(&effect.condition, &mut found);
        }
    }
    // What is not resolved may use any predicate.
    if domain.uses.is_empty() {
        unused(domain, &mut found);
    }
    found
}

/// What there is to say about a problem of `domain`.
pub fn problem(domain: &Domain, problem: &Problem) -> Diagnostics {
    let mut found = Diagnostics::default();
    condition::constants(&problem.goal, &mut found);
    if domain.uses.is_empty() && problem.uses.is_empty() {
        if already(domain, problem) {
            let span = problem.goal.nodes[problem.goal.root().index()].span;
            found.push(goal_already_true::goal_already_true(span));
        } else {
            reach::check(domain, problem, &mut found);
        }
    }
    found
}

/// Reports predicates that nothing names.
fn unused(domain: &Domain, found: &mut Diagnostics) {
    // A domain without actions is a vocabulary, and using it is left to others.
    if domain.actions.is_empty() {
        return;
    }
    let mut used = vec![false; domain.predicates.len()];
    let mut mark = |formula: &Formula| {
        for node in &formula.nodes {
            if let NodeKind::Atom(atom) = &node.kind {
                used[atom.predicate.index()] = true;
            }
        }
    };
    domain.axioms.iter().for_each(|axiom| mark(&axiom.body));
    for action in &domain.actions {
        mark(&action.precondition);
        action.effects.iter().for_each(|effect| mark(&effect.condition));
        action.increases.iter().for_each(|increase| mark(&increase.condition));
    }
    for action in &domain.actions {
        for literal in action.effects.iter().flat_map(|effect| &effect.literals) {
            used[literal.atom.predicate.index()] = true;
        }
    }
    domain.axioms.iter().for_each(|axiom| used[axiom.head.index()] = true);
    for (predicate, _) in domain.predicates.iter().zip(used).filter(|(_, used)| !used) {
        found.push(unused_predicate::unused_predicate(&predicate.name.text, predicate.name.span));
    }
}

/// Whether the goal is a conjunction of literals that all hold initially.
fn already(domain: &Domain, problem: &Problem) -> bool {
    let Some(literals) = condition::literals(&problem.goal) else { return false };
    let mut wanted: HashMap<Fact, bool> = HashMap::new();
    for literal in &literals {
        let object = |term: &Term| match term {
            Term::Object(id) => Some(*id),
            Term::Variable(_) => None,
        };
        let arguments: Option<Box<[_]>> = literal.atom.arguments.iter().map(object).collect();
        let derived = domain.predicates[literal.atom.predicate.index()].derived;
        let Some(arguments) = arguments.filter(|_| !derived) else { return false };
        let fact = Fact { predicate: literal.atom.predicate, arguments };
        if *wanted.entry(fact).or_insert(literal.positive) != literal.positive {
            return false;
        }
    }
    let positive = wanted.values().filter(|positive| **positive).count();
    let mut met = 0;
    for fact in &problem.init {
        match wanted.get(fact) {
            Some(true) => met += 1,
            Some(false) => return false,
            None => {}
        }
    }
    met == positive && !literals.is_empty()
}
