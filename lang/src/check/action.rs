//! Actions of all kinds.

use super::condition::Setting;
use super::requirement::Need;
use super::scope::Bindings;
use super::{Names, Report, World, agents, condition, domain, effect, name, temporal};
use crate::ast::{self, ActionKind, Agent, DomainSection, Feature, Group, Name, TypedList};
use crate::diagnostic::unused_parameter;
use crate::model::{
    Action, ActionId, Atom, Doing, Domain, Formula, NodeKind, Signature, TypeId, Variable,
};
use crate::symbol::{Namespace, Symbol};

/// Takes down the names and parameters of all actions and tasks, so that each may be named before it is defined.
pub(super) fn signatures<'a>(
    ast: &ast::Domain<'a>,
    domain: &mut Domain,
    names: &mut Names<'a>,
    report: &mut Report<'_>,
) {
    let mut instants = 0;
    for section in &ast.sections {
        let (spelling, doing, what, namespace) = match section {
            DomainSection::Action(action) => {
                let doing = Doing::Action(action.kind);
                (action.name, doing, action.kind.describe(), Namespace::Action)
            }
            DomainSection::Task(task) => (task.name, Doing::Task, "task", Namespace::Task),
            _ => continue,
        };
        let agent = match section {
            DomainSection::Action(action) => action.agent.as_ref(),
            _ => None,
        };
        let instant = doing == Doing::Action(ActionKind::Instant);
        let action = instant.then_some(ActionId(instants));
        instants += u32::from(instant);
        let mut parameters: Vec<Variable> = Vec::new();
        parameters.extend(agent.map(|agent| agent_parameter(agent, domain, names)));
        match section {
            DomainSection::Action(action) => {
                parameters.extend(quietly(&action.parameters, names));
            }
            // A task is nowhere looked at again.
            DomainSection::Task(task) => {
                report.need(Need::Hierarchy, task.name.span);
                report.uses(Feature::Hierarchies, task.name.span);
                parameters = domain::parameters(&task.parameters, &names.types, report);
            }
            _ => {}
        }
        let table =
            if namespace == Namespace::Task { &mut names.tasks } else { &mut names.actions };
        if let Some(first) = table.find(spelling.text) {
            let first = domain.signatures[first as usize].name.span;
            report.declared(spelling, Symbol::at(namespace, first));
            domain::report_duplicate(what, spelling, "", first, report);
            continue;
        }
        if spelling.text.is_empty() {
            continue;
        }
        table.insert(spelling.text, domain.signatures.len() as u32);
        report.declared_here(spelling, namespace);
        let (name, agent) = (name(spelling), agent.is_some());
        domain.signatures.push(Signature { name, doing, parameters, agent, action });
    }
    if domain.signatures.iter().any(|signature| signature.agent) {
        names.asked = agents::named(ast, names);
    }
}

/// Parameters without a word about types that are unknown: that is said where the action is checked.
fn quietly(list: &TypedList<'_>, names: &Names<'_>) -> Vec<Variable> {
    let group = |group: &Group<'_>| -> Vec<Variable> {
        let types = types(group.types.as_ref().map(|types| types.names.as_slice()), names);
        let variable =
            |spelling: &Name<'_>| Variable { name: name(*spelling), types: types.clone() };
        group.names.iter().map(variable).collect()
    };
    list.groups.iter().flat_map(group).collect()
}

fn types(spellings: Option<&[Name<'_>]>, names: &Names<'_>) -> Vec<TypeId> {
    let Some(spellings) = spellings else { return vec![super::OBJECT] };
    let types: Vec<TypeId> = spellings
        .iter()
        .filter_map(|spelling| names.types.find(spelling.text).map(TypeId))
        .collect();
    if types.len() == spellings.len() { types } else { Vec::new() }
}

/// The agent as the first parameter.
fn agent_parameter(agent: &Agent<'_>, domain: &Domain, names: &Names<'_>) -> Variable {
    let types = if agent.name.is_variable() {
        types(agent.types.as_ref().map(|types| types.names.as_slice()), names)
    } else if let Some(id) = names.types.find(agent.name.text) {
        vec![TypeId(id)]
    } else {
        let object = names.objects.find(agent.name.text);
        object.map_or_else(Vec::new, |id| domain.constants[id as usize].types.clone())
    };
    Variable { name: name(agent.name), types }
}

/// Checks an action; the model holds those that happen in an instant.
pub(super) fn action<'a>(
    action: &ast::Action<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<Action> {
    let span = action.place.0;
    let mut bindings = Bindings::new(format!("{} `{}`", action.kind.describe(), action.name));
    let used = match action.kind {
        ActionKind::Instant => None,
        ActionKind::Durative => Some((Need::DurativeAction, Feature::DurativeActions)),
        ActionKind::Process | ActionKind::Event => Some((Need::Process, Feature::Processes)),
    };
    if let Some((need, feature)) = used {
        report.need(need, action.name.span);
        report.uses(feature, action.name.span);
    }
    bindings.durative = action.kind == ActionKind::Durative;
    bindings.continuous = matches!(action.kind, ActionKind::Durative | ActionKind::Process);
    bindings.joint = true;
    if let Some(agent) = &action.agent {
        bindings.acting = agents::agent(agent, &mut bindings, world, report);
    }
    let who = agents::nameless(&mut bindings, world, span);
    bindings.bind(&action.parameters, world, report);
    bindings.scope.parameters = bindings.scope.variables.len() as u32;
    let instant = action.kind == ActionKind::Instant;
    let agent = action.agent.is_some() && bindings.acting.is_some();
    if !action.unread.is_empty() {
        // A field that is not read may bind variables, so nothing can be said about the rest.
        for unread in &action.unread {
            report.uses(unread.feature, unread.keyword.span);
        }
        let precondition = Formula::truth(span);
        let (effects, increases) = (Vec::new(), Vec::new());
        let (name, scope) = (name(action.name), bindings.scope);
        return instant.then_some(Action {
            name,
            scope,
            agent,
            precondition,
            effects,
            increases,
            span,
        });
    }
    for duration in &action.durations {
        temporal::duration(duration, &mut bindings, world, report);
    }
    let durative = action.kind == ActionKind::Durative;
    let setting = if durative { Setting::Durative } else { Setting::State };
    let mut conditions: Vec<Formula> = who.into_iter().collect();
    for formula in &action.preconditions {
        conditions.push(condition::check(formula, 0, setting, &mut bindings, world, report));
    }
    if bindings.acting.is_some() {
        bindings.demanded = conditions.iter().flat_map(conjoined).collect();
    }
    let (effects, increases) =
        effect::check(&action.effects, action.kind, span, &mut bindings, world, report);
    // What others ask of an action, they ask with its arguments.
    let asked = world.names.actions.find(action.name.text);
    if asked.is_none_or(|id| !world.names.asked.contains(&id)) {
        unused(&bindings, report);
    }
    let precondition = condition::conjoin(conditions, span);
    let (name, scope) = (name(action.name), bindings.scope);
    instant.then_some(Action { name, scope, agent, precondition, effects, increases, span })
}

/// The atoms that a condition names outside of negations.
fn conjoined(formula: &Formula) -> Vec<Atom> {
    let denied = |at: usize| {
        let above = formula.nodes.get(at + 1).map(|node| &node.kind);
        matches!(above, Some(NodeKind::Not(child)) if child.index() == at)
    };
    let positive = formula.nodes.iter().enumerate().filter(|&(at, _)| !denied(at));
    let atoms = positive.filter_map(|(_, node)| match &node.kind {
        NodeKind::Atom(atom) => Some(atom.clone()),
        _ => None,
    });
    atoms.collect()
}

/// Warns of parameters that nothing uses.
pub(super) fn unused(bindings: &Bindings<'_>, report: &mut Report<'_>) {
    if bindings.unsure {
        return;
    }
    let parameters = bindings.scope.parameters as usize;
    let unused = bindings.scope.variables[..parameters].iter().zip(&bindings.used);
    for (variable, _) in unused.filter(|(_, used)| !**used) {
        report.push(unused_parameter::unused_parameter(
            &variable.name.text,
            &bindings.owner,
            variable.name.span,
        ));
    }
}
