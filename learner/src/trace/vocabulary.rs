//! Names and their types go in; a [`Domain`] that declares them comes out, for traces to speak of.

use lang::ast::ActionKind;
use lang::model::{
    Action, ActionId, Doing, Domain, Formula, Name, Object, ObjectId, Predicate, PredicateId,
    Scope, Signature, Type, TypeId, Variable,
};
use lang::source::Span;

use super::Trace;

/// A name that stands in no text.
pub fn name(text: impl Into<String>) -> Name {
    Name { text: text.into(), span: Span::default() }
}

/// A domain in which there are only the type `object` and a name.
pub fn empty(title: &str) -> Domain {
    let mut domain = Domain::new(name(title));
    let root = TypeId(0);
    domain.types.push(Type { name: name("object"), parents: Vec::new(), ancestors: vec![root] });
    domain
}

/// What `domain` declares, with actions that demand nothing and do nothing.
///
/// Quantified variables, axioms and functions are left out: traces say nothing about them. Ids stay the same.
#[must_use]
pub fn of(domain: &Domain) -> Domain {
    let mut bare = domain.clone();
    for action in &mut bare.actions {
        action.scope.variables.truncate(action.scope.parameters as usize);
        action.precondition = Formula::truth(action.span);
        action.effects.clear();
        action.increases.clear();
    }
    bare.functions.clear();
    bare.axioms.clear();
    bare.preferences.clear();
    bare.uses.clear();
    bare
}

/// The type of this name, which is added below `parent`, or below `object`, if there is none yet.
pub fn declare_type(domain: &mut Domain, text: &str, parent: Option<TypeId>) -> TypeId {
    if let Some(at) = domain.types.iter().position(|one| one.name.text.eq_ignore_ascii_case(text)) {
        return TypeId(at as u32);
    }
    let id = TypeId(domain.types.len() as u32);
    let parent = parent.unwrap_or(TypeId(0));
    let mut ancestors = domain.types[parent.index()].ancestors.clone();
    ancestors.push(id);
    ancestors.sort_unstable();
    domain.types.push(Type { name: name(text), parents: vec![parent], ancestors });
    id
}

/// Adds a predicate; `parameters` has the types of each position, any of which will do.
pub fn declare_predicate(
    domain: &mut Domain,
    text: &str,
    parameters: &[Vec<TypeId>],
) -> PredicateId {
    let id = PredicateId(domain.predicates.len() as u32);
    let parameters = variables(domain, parameters);
    domain.predicates.push(Predicate { name: name(text), parameters, derived: false, owner: None });
    id
}

/// Adds an action; with `agent` its first parameter is the one who acts.
pub fn declare_action(
    domain: &mut Domain,
    text: &str,
    parameters: &[Vec<TypeId>],
    agent: bool,
) -> ActionId {
    let id = ActionId(domain.actions.len() as u32);
    let variables = variables(domain, parameters);
    domain.signatures.push(Signature {
        name: name(text),
        doing: Doing::Action(ActionKind::Instant),
        parameters: variables.clone(),
        agent,
        action: Some(id),
    });
    domain.actions.push(Action {
        name: name(text),
        scope: Scope { parameters: variables.len() as u32, variables },
        agent,
        precondition: Formula::truth(Span::default()),
        effects: Vec::new(),
        increases: Vec::new(),
        span: Span::default(),
    });
    id
}

/// An object for [`super::Trace::objects`].
pub fn object(text: &str, types: Vec<TypeId>) -> Object {
    Object { name: name(text), types, holder: None }
}

/// Where an object of this name stands.
pub fn find_object(objects: &[Object], text: &str) -> Option<ObjectId> {
    let at = objects.iter().position(|one| one.name.text.eq_ignore_ascii_case(text));
    at.map(|at| ObjectId(at as u32))
}

/// Variables that are named after their types, with a number where one name would stand twice: `?cube1 ?cube2 ?table`.
pub fn variables(domain: &Domain, types: &[Vec<TypeId>]) -> Vec<Variable> {
    let stem = |types: &Vec<TypeId>| match types.as_slice() {
        [one] => domain.types[one.index()].name.text.to_ascii_lowercase(),
        _ => "object".to_owned(),
    };
    let stems: Vec<String> = types.iter().map(stem).collect();
    let mut names: Vec<String> = Vec::new();
    for (at, stem) in stems.iter().enumerate() {
        let alike = stems.iter().filter(|other| *other == stem).count();
        let mut number = 1 + stems[..at].iter().filter(|other| *other == stem).count();
        let mut text = if alike > 1 { format!("?{stem}{number}") } else { format!("?{stem}") };
        // A type may itself be called `cube1`.
        while names.contains(&text) || (alike > 1 && stems.contains(&text[1..].to_owned())) {
            number += alike;
            text = format!("?{stem}{number}");
        }
        names.push(text);
    }
    let pairs = names.into_iter().zip(types);
    pairs.map(|(text, types)| Variable { name: name(text), types: types.clone() }).collect()
}

/// Makes the first parameter of an action its agent where in all traces it is the one in whose slot the action stands.
///
/// Actions that no trace with agents has, and those without parameters, stay as they are.
pub fn declare_agents(domain: &mut Domain, traces: &[Trace]) {
    let mut acts: Vec<Option<bool>> = vec![None; domain.actions.len()];
    for trace in traces {
        for joint in &trace.steps {
            for (agent, part) in trace.agents.iter().zip(&joint.parts) {
                let Some(part) = part else { continue };
                let own = part.arguments.first() == Some(agent);
                let acts = &mut acts[part.action.index()];
                *acts = Some(own && acts.unwrap_or(true));
            }
        }
    }
    for (action, acts) in domain.actions.iter_mut().zip(&acts) {
        action.agent |= *acts == Some(true);
    }
    for signature in &mut domain.signatures {
        let action = signature.action.map(|id| &domain.actions[id.index()]);
        signature.agent = action.map_or(signature.agent, |action| action.agent);
    }
}
