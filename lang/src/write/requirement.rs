//! A model goes in; the fewest requirements under which what is written of it is well formed come out.

use std::collections::BTreeSet;

use crate::model::{Domain, Formula, Holder, NodeKind, Object, Problem, Requirement};

/// The requirements of a domain: `:strips` if it needs nothing.
pub fn of_domain(domain: &Domain) -> BTreeSet<Requirement> {
    let mut needed = BTreeSet::new();
    let mut note = |requirement: Requirement, is_needed: bool| {
        needed.extend(is_needed.then_some(requirement));
    };
    note(Requirement::Typing, domain.types.len() > 1);
    note(Requirement::DerivedPredicates, !domain.axioms.is_empty());
    let numeric = domain.functions.iter().any(|function| function.values.is_none());
    note(Requirement::ActionCosts, numeric);
    let objects = domain.functions.iter().any(|function| function.values.is_some());
    note(Requirement::ObjectFluents, objects);
    let effects = || domain.actions.iter().flat_map(|action| &action.effects);
    let increases = || domain.actions.iter().flat_map(|action| &action.increases);
    let conditional = effects()
        .map(|effect| (&effect.variables, &effect.condition))
        .chain(increases().map(|increase| (&increase.variables, &increase.condition)))
        .any(|(variables, condition)| !variables.is_empty() || !condition.is_truth());
    note(Requirement::ConditionalEffects, conditional);
    privacy(domain, &mut needed);
    let conditions = effects().map(|effect| &effect.condition);
    let conditions = conditions.chain(increases().map(|increase| &increase.condition));
    let bodies = domain.axioms.iter().map(|axiom| &axiom.body);
    let preconditions = domain.actions.iter().map(|action| &action.precondition);
    for formula in preconditions.chain(conditions).chain(bodies) {
        of_formula(formula, &mut needed);
    }
    if needed.is_empty() {
        needed.insert(Requirement::Strips);
    }
    needed
}

/// The requirements of a problem that its domain does not have.
pub fn of_problem(domain: &Domain, problem: &Problem) -> BTreeSet<Requirement> {
    let mut needed = BTreeSet::new();
    of_formula(&problem.goal, &mut needed);
    of_objects(&problem.objects, &mut needed);
    &needed - &of_domain(domain)
}

/// Agents, and how their privacy is written, which also says what agents may do at one time.
fn privacy(domain: &Domain, needed: &mut BTreeSet<Requirement>) {
    let factored = domain.requirements.contains(&Requirement::FactoredPrivacy);
    let owned = domain.predicates.iter().any(|predicate| predicate.owner.is_some());
    if factored {
        needed.insert(Requirement::FactoredPrivacy);
    } else if owned || domain.is_multi_agent() {
        needed.insert(Requirement::MultiAgent);
        let declared = domain.requirements.contains(&Requirement::UnfactoredPrivacy);
        needed.extend((owned || declared).then_some(Requirement::UnfactoredPrivacy));
    }
    of_objects(&domain.constants, needed);
}

/// What private objects need.
fn of_objects(objects: &[Object], needed: &mut BTreeSet<Requirement>) {
    for object in objects {
        match object.holder {
            Some(Holder::File) => {
                needed.insert(Requirement::FactoredPrivacy);
            }
            Some(Holder::Agent(_)) => {
                needed.extend([Requirement::MultiAgent, Requirement::UnfactoredPrivacy]);
            }
            None => {}
        }
    }
}

/// What the connectives of a formula need.
fn of_formula(formula: &Formula, needed: &mut BTreeSet<Requirement>) {
    for node in &formula.nodes {
        needed.extend(match &node.kind {
            NodeKind::Equal(..) => Some(Requirement::Equality),
            NodeKind::Or(_) | NodeKind::Imply(..) => Some(Requirement::DisjunctivePreconditions),
            NodeKind::Forall(..) => Some(Requirement::UniversalPreconditions),
            NodeKind::Exists(..) => Some(Requirement::ExistentialPreconditions),
            NodeKind::Not(child) => match formula.kind(*child) {
                NodeKind::Atom(_) | NodeKind::Action(_) => Some(Requirement::NegativePreconditions),
                // `:equality` is enough for two objects that are not the same.
                NodeKind::Equal(..) => None,
                _ => Some(Requirement::DisjunctivePreconditions),
            },
            NodeKind::Action(_) => Some(Requirement::MultiAgent),
            NodeKind::Atom(_) | NodeKind::And(_) => None,
        });
    }
}
