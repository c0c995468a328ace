//! A checked model goes in; warnings come out about what is well formed and still surely not meant.
//!
//! Lints are for those who write PDDL: `check` and editors ask for them, planning does not.
//! They run on files without errors, and take time linear in the size of the files.

mod condition;
mod effect;
mod reach;
mod task;
mod text;
mod list;
mod requirement;
mod action;
mod initial;
mod factor;
mod agents;

use hashbrown::HashMap;

use crate::diagnostic::{Diagnostics, goal_already_true, unused_predicate};
use crate::model::{Domain, Fact, Formula, NodeKind, Problem, Scope, Term};
use crate::source::{SourceId, Sources};
use crate::tree;

use condition::{Named, Place};

pub use factor::tell as tell_factors;

/// What there is to say about a domain.
pub fn domain(domain: &Domain) -> Diagnostics {
    let mut found = Diagnostics::default();
    let place = |scope| Place { domain, objects: &domain.constants, scope };
    // Where something is not resolved, what has been resolved is not all that happens.
    let whole = domain.uses.is_empty();
    for axiom in &domain.axioms {
        condition::check(&axiom.body, place(&axiom.scope), &mut found);
        condition::circular(axiom, domain, &mut found);
        let owner = format!("the rule for `{}`", domain.predicates[axiom.head.index()].name.text);
        if whole {
            named(&axiom.scope, &owner, |named| named.formula(&axiom.body), &mut found);
        }
    }
    let guarded = effect::guarded(domain);
    for action in &domain.actions {
        let place = place(&action.scope);
        condition::check(&action.precondition, place, &mut found);
        for effect in &action.effects {
            condition::check(&effect.condition, place, &mut found);
        }
        condition::fixed(action, place, &mut found);
        let contradictory = condition::contradictions(action, &mut found);
        if whole {
            let owner = format!("action `{}`", action.name.text);
            named(&action.scope, &owner, |named| named.action(action), &mut found);
            if !contradictory {
                effect::check(action, &guarded, &mut found);
            }
        }
    }
    // What is not resolved may use any predicate.
    if whole {
        unused(domain, &mut found);
        agents::check(domain, &mut found);
    }
    found
}

/// What there is to say about a problem of `domain`.
pub fn problem(domain: &Domain, problem: &Problem) -> Diagnostics {
    let mut found = Diagnostics::default();
    let place = Place { domain, objects: &problem.objects, scope: &problem.goal_scope };
    condition::check(&problem.goal, place, &mut found);
    let impossible = condition::impossible(&problem.goal, &mut found);
    if domain.uses.is_empty() && problem.uses.is_empty() {
        named(&problem.goal_scope, "the goal", |named| named.formula(&problem.goal), &mut found);
        let mut stuck = vec![false; domain.actions.len()];
        if already(domain, problem) {
            let span = problem.goal.nodes[problem.goal.root().index()].span;
            found.push(goal_already_true::goal_already_true(span));
        } else if !impossible {
            stuck = reach::check(domain, problem, &mut found);
        }
        task::check(domain, problem, &stuck, &mut found);
        agents::problem(domain, problem, &mut found);
    }
    found
}

/// What there is to say about how a domain, or a problem of `domain`, is written.
///
/// The other lints see only the model, in which facts have no places and repetitions are gone.
pub fn text(sources: &Sources, id: SourceId, domain: &Domain) -> Diagnostics {
    let mut found = Diagnostics::default();
    let tree = tree::parse(id, &sources.get(id).text, &mut Diagnostics::default());
    text::check(&text::Text::new(&tree), domain, &mut found);
    found
}

/// Reports variables of a scope that a quantifier binds in vain.
fn named(scope: &Scope, owner: &str, read: impl FnOnce(&mut Named), found: &mut Diagnostics) {
    if scope.variables.len() > scope.parameters as usize {
        let mut named = Named::default();
        read(&mut named);
        named.report(scope, owner, found);
    }
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
