//! A domain and a problem of it go in; warnings come out about what the one offers and the other makes no use of:
//! types without objects, predicates that hold always or that nobody asks for, costs that do not count.

use std::fmt::Write;

use crate::diagnostic::{
    Diagnostics, constant_metric, cost_without_metric, static_predicate, type_without_objects,
    unread_predicate,
};
use crate::model::{Domain, Formula, NodeKind, Predicate, Problem, TypeId, Variable};

/// A static predicate that holds for fewer combinations than this may hold for all of them by chance.
const COMBINATIONS: u64 = 4;

/// How many names a message lists.
const SHOWN: usize = 6;

/// What there is to say about the two together. Of the actions, some are `stuck` for other reasons, which have been reported.
pub(super) fn check(domain: &Domain, problem: &Problem, stuck: &[bool], found: &mut Diagnostics) {
    let extents = extents(domain, problem);
    empty(domain, problem, stuck, &extents, found);
    predicates(domain, problem, &extents, found);
    costs(domain, problem, found);
}

/// How many objects of each type there are.
pub(super) fn extents(domain: &Domain, problem: &Problem) -> Vec<u64> {
    let mut extents = vec![0; domain.types.len()];
    for object in &problem.objects {
        match object.types.as_slice() {
            [only] => {
                domain.types[only.index()].ancestors.iter().for_each(|id| extents[id.index()] += 1);
            }
            several => {
                let above = several.iter().flat_map(|id| &domain.types[id.index()].ancestors);
                let mut above: Vec<TypeId> = above.copied().collect();
                above.sort_unstable();
                above.dedup();
                for id in above {
                    extents[id.index()] += 1;
                }
            }
        }
    }
    extents
}

/// How many objects may stand for a variable, if that is known without looking at each.
fn extent(variable: &Variable, extents: &[u64]) -> Option<u64> {
    match variable.types.as_slice() {
        [only] => Some(extents[only.index()]),
        _ => None,
    }
}

/// Warns once of all types of which the problem has no objects though actions need some.
fn empty(
    domain: &Domain,
    problem: &Problem,
    stuck: &[bool],
    extents: &[u64],
    found: &mut Diagnostics,
) {
    let (mut types, mut actions): (Vec<TypeId>, Vec<&str>) = (Vec::new(), Vec::new());
    for (action, _) in domain.actions.iter().zip(stuck).filter(|(_, stuck)| !**stuck) {
        for parameter in &action.scope.variables[..action.scope.parameters as usize] {
            if extent(parameter, extents) == Some(0) {
                types.push(parameter.types[0]);
                actions.push(&action.name.text);
            }
        }
    }
    types.sort_unstable();
    types.dedup();
    actions.dedup();
    let names = |id: &TypeId| domain.types[id.index()].name.text.as_str();
    if let Some(&first) = types.first() {
        found.push(type_without_objects::type_without_objects(
            &listed(&types.iter().map(names).collect::<Vec<_>>()),
            types.len(),
            domain.types[first.index()].name.span,
            &problem.name.text,
            problem.name.span,
            &listed(&actions),
        ));
    }
}

/// The first of some names, and how many more there are.
fn listed(names: &[&str]) -> String {
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let mut listed = shown.join(", ");
    if let Some(more @ 1..) = names.len().checked_sub(SHOWN) {
        write!(listed, " and {more} more").expect("writing to a string cannot fail");
    }
    listed
}

/// What is done with a predicate.
#[derive(Clone, Copy, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says one thing, and any may be so with any"
)]
struct Deeds {
    read: bool,
    demanded: bool,
    added: bool,
    deleted: bool,
    facts: u64,
}

fn deeds(domain: &Domain, problem: &Problem) -> Vec<Deeds> {
    let mut deeds = vec![Deeds::default(); domain.predicates.len()];
    let read = |deeds: &mut [Deeds], formula: &Formula| {
        for node in &formula.nodes {
            if let NodeKind::Atom(atom) = &node.kind {
                deeds[atom.predicate.index()].read = true;
            }
        }
    };
    for axiom in &domain.axioms {
        read(&mut deeds, &axiom.body);
        deeds[axiom.head.index()].added = true;
    }
    read(&mut deeds, &problem.goal);
    for action in &domain.actions {
        read(&mut deeds, &action.precondition);
        for literal in super::condition::conjuncts(&action.precondition).0 {
            deeds[literal.atom.predicate.index()].demanded |= literal.positive;
        }
        for effect in &action.effects {
            read(&mut deeds, &effect.condition);
            for literal in &effect.literals {
                let deed = &mut deeds[literal.atom.predicate.index()];
                if literal.positive { deed.added = true } else { deed.deleted = true }
            }
        }
        action.increases.iter().for_each(|increase| read(&mut deeds, &increase.condition));
    }
    problem.init.iter().for_each(|fact| deeds[fact.predicate.index()].facts += 1);
    deeds
}

/// Warns of predicates that are demanded though they always hold, and of those that change though nobody asks for them.
fn predicates(domain: &Domain, problem: &Problem, extents: &[u64], found: &mut Diagnostics) {
    for (predicate, deeds) in domain.predicates.iter().zip(deeds(domain, problem)) {
        let (name, span) = (&predicate.name.text, predicate.name.span);
        let changes = deeds.added || deeds.deleted;
        if deeds.demanded
            && !changes
            && deeds.facts >= COMBINATIONS
            && combinations(predicate, extents) == Some(deeds.facts)
        {
            found.push(static_predicate::static_predicate(
                name,
                span,
                deeds.facts,
                &problem.name.text,
            ));
        }
        // What is only added may be a mark that others look at.
        if deeds.added && deeds.deleted && !deeds.read {
            found.push(unread_predicate::unread_predicate(name, span, &problem.name.text));
        }
    }
}

/// For how many combinations of objects a predicate may hold.
fn combinations(predicate: &Predicate, extents: &[u64]) -> Option<u64> {
    let mut product: u64 = 1;
    for parameter in &predicate.parameters {
        product = product.checked_mul(extent(parameter, extents)?)?;
    }
    Some(product)
}

/// Warns of costs that nothing minimises, and of a metric that no action changes.
fn costs(domain: &Domain, problem: &Problem, found: &mut Diagnostics) {
    let mut increases = domain.actions.iter().flat_map(|action| &action.increases);
    match &problem.metric {
        Some(metric) => {
            if increases.all(|increase| increase.function != metric.function) {
                let name = &domain.functions[metric.function.index()].name.text;
                found.push(constant_metric::constant_metric(name, metric.span));
            }
        }
        None => {
            if let Some(first) = increases.next() {
                let name = &domain.functions[first.function.index()].name.text;
                found.push(cost_without_metric::cost_without_metric(
                    name,
                    problem.name.span,
                    first.span,
                ));
            }
        }
    }
}
