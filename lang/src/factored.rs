//! The files of each agent go in, and one task of all agents comes out; and the way back.
//!
//! This is the factored form of MA-PDDL, as the competition of 2015 used it: each agent has a domain and a problem of its own, which hold what is public
//! and what is private to it. In its actions the agent is an ordinary parameter, the first.

mod list;
mod merge;
mod split;
mod translate;

use crate::ast::ActionKind;
use crate::model::{
    Action, ActionId, Doing, Domain, Fact, Object, ObjectId, Problem, Signature, TypeId,
};

pub use list::{AgentList, check_list, read_list, write_list};
pub use merge::merge;
pub use split::split;

/// The files of one agent.
#[derive(Debug, Clone)]
pub struct Part {
    /// Whose they are: the name of an object of the problem.
    pub agent: String,
    /// What the agent knows of the domain.
    pub domain: Domain,
    /// What it knows of the problem.
    pub problem: Problem,
}

/// What the agent is called among the parameters of its private predicates.
const AGENT: &str = "?agent";

/// Whether a name means the same as another.
fn same(one: &str, other: &str) -> bool {
    one.eq_ignore_ascii_case(other)
}

/// The agent to which a domain and a problem belong, of those that the names of their files suggest:
/// one of these that is an object, or else the only private object that all actions can have as their first argument.
pub fn agent<'p>(domain: &Domain, problem: &'p Problem, suggested: &[&str]) -> Option<&'p str> {
    let objects = &problem.objects;
    let called = |name: &&str| objects.iter().find(|object| same(&object.name.text, name));
    if let Some(object) = suggested.iter().find_map(called) {
        return Some(&object.name.text);
    }
    let acts = |object: &&Object| {
        domain.actions.iter().all(|action| {
            let first = action.scope.variables.first();
            first.is_some_and(|first| domain.has_type(object, &first.types))
        })
    };
    let mut own = objects.iter().filter(|object| object.holder.is_some()).filter(acts);
    match (own.next(), own.next()) {
        (Some(only), None) => Some(&only.name.text),
        _ => None,
    }
}

/// The objects that are agents: those for which some action is.
fn agents(domain: &Domain, problem: &Problem) -> Vec<ObjectId> {
    let acts = |object: &Object| {
        domain
            .actions
            .iter()
            .any(|action| action.agent && domain.has_type(object, &action.scope.variables[0].types))
    };
    let ids = (0..problem.objects.len() as u32).map(ObjectId);
    ids.filter(|id| acts(&problem.objects[id.index()])).collect()
}

/// A fact of a problem as it is written.
fn written(fact: &Fact, domain: &Domain, problem: &Problem) -> String {
    let objects = fact.arguments.iter().map(|id| &problem.objects[id.index()].name.text);
    let words =
        std::iter::once(&domain.predicates[fact.predicate.index()].name.text).chain(objects);
    format!("({})", words.map(String::as_str).collect::<Vec<_>>().join(" "))
}

/// What can be done by name in a domain of which the actions are known.
fn signatures(actions: &[Action]) -> Vec<Signature> {
    let signature = |(id, action): (usize, &Action)| Signature {
        name: action.name.clone(),
        doing: Doing::Action(ActionKind::Instant),
        parameters: action.scope.variables[..action.scope.parameters as usize].to_vec(),
        agent: action.agent,
        action: Some(ActionId(id as u32)),
    };
    actions.iter().enumerate().map(signature).collect()
}

/// The types that no other of them is above.
fn highest(domain: &Domain, types: &[TypeId]) -> Vec<TypeId> {
    let mut types = types.to_vec();
    types.sort_unstable();
    types.dedup();
    let highest =
        |&&one: &&TypeId| !types.iter().any(|&other| other != one && domain.is_subtype(one, other));
    types.iter().filter(highest).copied().collect()
}
