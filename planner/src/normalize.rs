//! A checked domain and problem go in; their normal form comes out, in which every condition is a conjunction.
//!
//! Where Fast Downward's translator turns every universal condition into an axiom and every disjunction into several actions,
//! this normal form keeps both where it can: a part over static predicates stays one formula that is evaluated while joining,
//! a universal condition over facts is expanded when an instance is made, and only a disjunction over facts that change is split.

mod formula;
mod split;
mod cost;

pub(crate) use cost::scaled;
pub(crate) use formula::negate;
pub(crate) use split::static_condition;

use lang::model::{Domain, Node, NodeKind, PredicateId, Problem};
use lang::source::Span;

use crate::normal::{Kind, Normal, Predicate};

/// What the planner cannot plan, and where the problem asks for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unsupported {
    /// What it is, as a sentence without a full stop.
    pub message: String,
    /// Where it stands.
    pub span: Span,
}

/// Brings `problem` of `domain` into normal form.
///
/// # Errors
/// Action atoms, which [`lang::multiagent`] compiles away; costs that are negative, depend on a condition, or do not fit into 32 bits when scaled to integers.
pub fn normalize(domain: &Domain, problem: &Problem) -> Result<Normal, Unsupported> {
    normalize_open(domain, problem, &[])
}

/// As [`normalize`], but the predicates `open` count as if some effect changed them, so that nothing is decided by what the initial state says of them.
///
/// # Errors
/// As there.
pub fn normalize_open(
    domain: &Domain,
    problem: &Problem,
    open: &[PredicateId],
) -> Result<Normal, Unsupported> {
    if let Some(span) = action_atom(domain) {
        let message = "an action atom, unless the domain is compiled".to_owned();
        return Err(Unsupported { message, span });
    }
    let mut builder = split::Builder::new(predicates(domain, open));
    let costs = cost::Costs::new(domain, problem)?;
    let mut schemas = Vec::new();
    for (index, action) in domain.actions.iter().enumerate() {
        let costs = costs.of(action)?;
        builder.schemas(lang::model::ActionId(index as u32), action, &costs, &mut schemas);
    }
    for axiom in &domain.axioms {
        builder.axiom(axiom);
    }
    let (goal, goal_variables) = builder.goal(problem);
    Ok(Normal {
        predicates: builder.predicates,
        schemas,
        rules: builder.rules,
        goal,
        goal_variables,
        scale: costs.scale,
        uses_metric: problem.metric.is_some(),
    })
}

/// Where a condition first asks about the joint action.
fn action_atom(domain: &Domain) -> Option<Span> {
    let asks = |node: &&Node| matches!(node.kind, NodeKind::Action(_));
    let conditions = domain.actions.iter().flat_map(|action| {
        let effects = action.effects.iter().map(|effect| &effect.condition);
        let increases = action.increases.iter().map(|increase| &increase.condition);
        effects.chain(increases).chain([&action.precondition])
    });
    conditions.flat_map(|formula| &formula.nodes).find(asks).map(|node| node.span)
}

/// The predicates of `domain` with what changes them.
fn predicates(domain: &Domain, open: &[PredicateId]) -> Vec<Predicate> {
    let mut predicates: Vec<Predicate> = domain
        .predicates
        .iter()
        .map(|predicate| Predicate {
            name: predicate.name.text.to_lowercase(),
            arity: predicate.parameters.len(),
            kind: if predicate.derived { Kind::Derived } else { Kind::Static },
        })
        .collect();
    let literals = domain
        .actions
        .iter()
        .flat_map(|action| &action.effects)
        .flat_map(|effect| &effect.literals);
    for PredicateId(id) in
        literals.map(|literal| literal.atom.predicate).chain(open.iter().copied())
    {
        predicates[id as usize].kind = Kind::Fluent;
    }
    predicates
}
