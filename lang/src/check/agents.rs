//! What MA-PDDL adds: agents, action atoms, private predicates and concurrency constraints.

use std::collections::BTreeSet;

use hashbrown::HashMap;

use super::concurrency::Constraint;
use super::requirement::Need;
use super::scope::{Bindings, Callee};
use super::{Report, World, domain, hierarchy, name};
use crate::ast::{
    Agent, Concurrency, DomainSection, Feature, Group, Name, Participant, Predicates, TypedList,
};
use crate::diagnostic::{
    agent_without_multi_agent, constraint_position, private_access, unexpected_item,
    unknown_action, unknown_constraint, unknown_object, unknown_type,
};
use crate::model::{
    ActionAtom, Formula, FunctionId, Holder, Node, NodeKind, Object, ObjectId, Owner, PredicateId,
    Signature, Term, TypeId, Variable, VariableId,
};
use crate::near::nearest;
use crate::source::Span;
use crate::symbol::{Namespace, Symbol};

/// Who acts.
pub(super) enum Acting {
    /// A parameter, the first of the action.
    Variable(VariableId),
    /// An object.
    Object(Term),
    /// Any object of a type; it has no name.
    Any(Vec<TypeId>),
}

/// Notes that a domain speaks of agents, and reports it if it does not declare that.
pub(super) fn need(keyword: Name<'_>, report: &mut Report<'_>) {
    if !report.declared.agents() && report.first(&agent_without_multi_agent::RULE, "") {
        let diagnostic =
            agent_without_multi_agent::agent_without_multi_agent(keyword.text, keyword.span);
        let diagnostic = diagnostic.fix_requirement(":multi-agent", report.flags);
        report.push(diagnostic);
    }
}

/// An agent that the action has no variable for becomes its first parameter, under a name that nothing can refer to;
/// where it is an object, the condition that makes it that object is returned.
pub(super) fn nameless(
    bindings: &mut Bindings<'_>,
    world: &World<'_, '_>,
    span: Span,
) -> Option<Formula> {
    let (types, object) = match bindings.acting.as_ref()? {
        Acting::Variable(_) => return None,
        Acting::Object(term) => (bindings.types(*term, world).0.to_vec(), Some(*term)),
        Acting::Any(types) => (types.clone(), None),
    };
    let name = crate::model::Name { text: "?agent".to_owned(), span };
    bindings.scope.variables.push(Variable { name, types });
    bindings.used.push(true);
    let agent = Term::Variable(VariableId(bindings.scope.variables.len() as u32 - 1));
    let is = |object| Node { kind: NodeKind::Equal(agent, object), span };
    object.map(|object| Formula { nodes: vec![is(object)] })
}

/// Binds the agent of an action, a goal or a metric.
pub(super) fn agent<'a>(
    agent: &Agent<'a>,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<Acting> {
    need(agent.keyword, report);
    if agent.name.is_variable() {
        let group = Group { names: vec![agent.name], types: agent.types.clone() };
        let list = TypedList { groups: vec![group], private: Vec::new() };
        let (bound, _) = bindings.bind(&list, world, report);
        // An action that says nothing of its agent still belongs to it.
        for variable in &bound {
            bindings.used[variable.index()] = true;
        }
        return bound.first().map(|&variable| Acting::Variable(variable));
    }
    if let Some(id) = world.names.types.find(agent.name.text) {
        report.found(agent.name, TypeId(id));
        return Some(Acting::Any(vec![TypeId(id)]));
    }
    if world.names.objects.find(agent.name.text).is_some() {
        return bindings.term(agent.name, world, report).map(Acting::Object);
    }
    report.lost(agent.name, Namespace::Type);
    if report.first(&unknown_type::RULE, agent.name.text) {
        let near = report.nearest(agent.name.text, &world.names.types);
        let diagnostic =
            unknown_type::unknown_type(agent.name.text, agent.name.span, world.places, near);
        report.push(diagnostic);
    }
    None
}

/// A goal that every agent has: with a variable, what is demanded of it is demanded of each.
pub(super) fn of_each(agent: Option<&Acting>, mut goal: Formula) -> Formula {
    if let Some(Acting::Variable(variable)) = agent {
        let (root, span) = (goal.root(), goal.nodes[goal.root().index()].span);
        goal.nodes.push(Node { kind: NodeKind::Forall(vec![*variable], root), span });
    }
    goal
}

/// Whether a metric of each agent adds up to all that a function of one agent counts.
pub(super) fn sums(
    agent: Option<&Acting>,
    function: FunctionId,
    terms: &[Term],
    bindings: &Bindings<'_>,
    world: &World<'_, '_>,
) -> bool {
    let Some(Acting::Variable(variable)) = agent else { return false };
    let types = &bindings.scope.variables[variable.index()].types;
    let parameters = &world.domain.functions[function.index()].parameters;
    terms == [Term::Variable(*variable)]
        && parameters.iter().all(|parameter| world.fits(&parameter.types, false, types))
}

/// The actions that conditions or constraints name, by their position among the signatures.
pub(super) fn named(ast: &crate::ast::Domain<'_>, names: &super::Names<'_>) -> BTreeSet<u32> {
    let mut named = BTreeSet::new();
    for section in &ast.sections {
        match section {
            DomainSection::Action(action) => {
                let formulas = action.preconditions.iter().chain(&action.effects);
                for node in formulas.flat_map(|formula| &formula.nodes) {
                    if let crate::ast::NodeKind::Apply(application) = &node.kind {
                        named.extend(names.actions.find(application.name.text));
                    }
                }
            }
            DomainSection::Concurrency(constraint) => {
                let actions = constraint.actions.iter().map(|participant| participant.action);
                named.extend(actions.filter_map(|action| names.actions.find(action.text)));
            }
            _ => {}
        }
    }
    named
}

/// Whether a name in a condition means an action: it is one and no predicate, or no predicate with as many arguments.
pub(super) fn is_action_atom(name: Name<'_>, arguments: usize, world: &World<'_, '_>) -> bool {
    let Some(action) = world.names.actions.find(name.text) else { return false };
    let action = &world.domain.signatures[action as usize];
    let agents = world.domain.signatures.iter().any(|signature| signature.agent);
    let predicate = world.names.predicates.find(name.text);
    let predicate = predicate.map(|id| world.domain.predicates[id as usize].parameters.len());
    agents
        && predicate.is_none_or(|arity| arity != arguments && action.parameters.len() == arguments)
}

/// The action that a name which is neither an action's nor a predicate's was probably meant to be,
/// unless a predicate is as near and takes as many arguments.
pub(super) fn misspelt<'w>(
    name: Name<'_>,
    arguments: usize,
    world: &World<'w, '_>,
    report: &mut Report<'_>,
) -> Option<&'w Signature> {
    let names = world.names;
    let known = [&names.predicates, &names.functions, &names.actions];
    if known.iter().any(|table| table.find(name.text).is_some())
        || !world.domain.signatures.iter().any(|signature| signature.agent)
    {
        return None;
    }
    let action = report.nearest(name.text, &names.actions)?;
    let predicate = report.nearest(name.text, &names.predicates);
    let action = &world.domain.signatures[names.actions.find(action)? as usize];
    let Some(predicate) = predicate else { return Some(action) };
    let id = names.predicates.find(predicate)?;
    let arities = [&action.parameters, &world.domain.predicates[id as usize].parameters];
    let [action_fits, predicate_fits] = arities.map(|parameters| parameters.len() == arguments);
    let nearer = nearest(name.text, [predicate, &action.name.text]);
    let is_action = match (action_fits, predicate_fits) {
        (true, false) => true,
        (false, true) => false,
        _ => nearer != Some(predicate),
    };
    is_action.then_some(action)
}

/// `(ACTION AGENT TERM …)` in a condition: the action stands in the joint action.
pub(super) fn action_atom<'a>(
    spelling: Name<'a>,
    arguments: &[Name<'a>],
    span: Span,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<ActionAtom> {
    need(spelling, report);
    if !bindings.joint {
        report.uses(Feature::ActionAtoms, spelling.span);
    }
    let id = world.names.actions.find(spelling.text)?;
    let signature = &world.domain.signatures[id as usize];
    report.found(spelling, Symbol::at(Namespace::Action, signature.name.span));
    let arguments =
        bindings.arguments(&Callee::action_atom(signature), arguments, span, world, report)?;
    let action = signature.action.filter(|_| bindings.joint)?;
    Some(ActionAtom { action, arguments })
}

/// Whose the predicates of a `(:private …)` are; the parameters of each say at which position.
pub(super) fn owner(
    predicates: &Predicates<'_>,
    names: &super::Names<'_>,
    report: &mut Report<'_>,
) -> Option<(String, Owner)> {
    let keyword = predicates.private?;
    need(keyword, report);
    let Some((spelling, types)) = predicates.owner.entries().next() else {
        if !report.declared.factored() {
            let expected = "the agent whose predicates these are, such as `?a - agent`";
            report.push(unexpected_item::missing_item(expected, keyword.span));
            return None;
        }
        // It is private to the agent whose file this is.
        let owner = Owner { position: None, types: Vec::new(), span: keyword.span };
        return Some((String::new(), owner));
    };
    let types = hierarchy::resolve(types, &names.types, "`:types`", report);
    let variable = Variable { name: name(spelling), types: types.clone() };
    report.declared_variable(spelling, &variable);
    Some((spelling.text.to_owned(), Owner { position: None, types, span: spelling.span }))
}

/// Declares the objects that are private to agents.
pub(super) fn private_objects<'a>(
    list: &TypedList<'a>,
    what: &str,
    place: &str,
    table: &mut Vec<Object>,
    names: &mut super::Names<'a>,
    report: &mut Report<'_>,
) {
    let mut owned = Vec::new();
    for private in &list.private {
        need(private.keyword, report);
        let mut groups = private.groups.clone();
        let mut owner = None;
        if !report.declared.factored()
            && let Some(first) = groups.first_mut()
        {
            // The first name is that of the agent: `(:private truck1 crate1 - crate)`.
            let agent = first.names.remove(0);
            if first.names.is_empty() && first.types.is_some() {
                // It is declared right here: `(:private truck1 - truck)`.
                first.names.push(agent);
            }
            owner = Some(agent);
        }
        groups.retain(|group| !group.names.is_empty());
        let list = TypedList { groups, private: Vec::new() };
        let first = table.len();
        domain::objects(&list, what, place, table, names, report);
        owned.push((owner, first..table.len()));
    }
    // An agent may be declared after what is private to it.
    for (owner, objects) in owned {
        let holder = match owner {
            Some(owner) => holder(owner, place, names, report),
            None => Some(Holder::File),
        };
        table[objects].iter_mut().for_each(|object| object.holder = holder);
    }
}

/// The agent that a `(:private …)` of a file of all agents names.
fn holder(
    owner: Name<'_>,
    place: &str,
    names: &super::Names<'_>,
    report: &mut Report<'_>,
) -> Option<Holder> {
    if let Some(id) = names.objects.find(owner.text).map(ObjectId) {
        report.found(owner, id);
        return Some(Holder::Agent(id));
    }
    if names.types.find(owner.text).is_none() {
        report.lost(owner, Namespace::Object);
        let near = report.nearest(owner.text, &names.objects);
        if report.first(&unknown_object::RULE, owner.text) {
            let diagnostic = unknown_object::unknown_object(owner.text, owner.span, place, near);
            report.push(diagnostic);
        }
    }
    None
}

/// Warns of a private predicate of which the acting agent is not the owner.
pub(super) fn access(
    predicate: PredicateId,
    arguments: &[Term],
    span: Span,
    bindings: &Bindings<'_>,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) {
    let predicate = &world.domain.predicates[predicate.index()];
    let (Some(owner), Some(acting)) = (&predicate.owner, &bindings.acting) else { return };
    let types: &[TypeId] = match acting {
        Acting::Variable(id) => &bindings.scope.variables[id.index()].types,
        Acting::Object(term) => bindings.types(*term, world).0,
        Acting::Any(types) => types,
    };
    let may_own = types.is_empty() || owner.types.is_empty() || world.overlap(types, &owner.types);
    let owns = match (owner.position.and_then(|position| arguments.get(position)), acting) {
        (Some(argument), Acting::Variable(id)) => *argument == Term::Variable(*id),
        (Some(argument), Acting::Object(term)) => argument == term,
        _ => true,
    };
    if !may_own || !owns {
        let actor = match acting {
            Acting::Variable(id) => bindings.scope.variables[id.index()].name.text.clone(),
            Acting::Object(_) | Acting::Any(_) => world.describe_types(types),
        };
        report.push(private_access::private_access(
            &predicate.name.text,
            &actor,
            &world.describe_types(&owner.types),
            span,
            owner.span,
        ));
    }
}

/// The concurrency constraints of a domain and how they depend on one another.
pub(super) fn constraints<'a>(
    all: &[&Concurrency<'a>],
    dependences: &[(Name<'a>, &[Name<'a>])],
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> (Vec<Constraint>, Vec<(usize, usize)>) {
    let mut known: HashMap<String, (usize, Span)> = HashMap::new();
    let (mut constraints, mut pairs) = (Vec::new(), Vec::new());
    for constraint in all {
        report.need(Need::Concurrency, constraint.name.span);
        if let Some(&(_, first)) = known.get(&constraint.name.text.to_ascii_lowercase()) {
            domain::report_duplicate("concurrency constraint", constraint.name, "", first, report);
        }
        report.declared_here(constraint.name, Namespace::Constraint);
        let place = (constraints.len(), constraint.name.span);
        known.insert(constraint.name.text.to_ascii_lowercase(), place);
        let mut bindings = Bindings::new(format!("concurrency constraint `{}`", constraint.name));
        bindings.bind(&constraint.parameters, world, report);
        let (least, most) = bounds(&constraint.bounds, report);
        let mut actions = Vec::new();
        for participant in &constraint.actions {
            actions.extend(self::participant(participant, &bindings, world, report));
        }
        constraints.push(Constraint { least, most, actions });
    }
    for &(keyword, names) in dependences {
        report.need(Need::Concurrency, keyword.span);
        if names.len() != 2 {
            let expected = "the names of two concurrency constraints";
            report.push(unexpected_item::missing_item(expected, keyword.span));
        }
        if let [needed, using] = names {
            let at = |name: &Name<'_>| known.get(&name.text.to_ascii_lowercase());
            pairs.extend(at(needed).zip(at(using)).map(|(one, other)| (one.0, other.0)));
        }
        for constraint in names {
            if let Some(&(_, declared)) = known.get(&constraint.text.to_ascii_lowercase()) {
                report.found(*constraint, Symbol::at(Namespace::Constraint, declared));
            } else {
                report.lost(*constraint, Namespace::Constraint);
                let near = nearest(constraint.text, all.iter().map(|one| one.name.text));
                let diagnostic =
                    unknown_constraint::unknown_constraint(constraint.text, constraint.span, near);
                report.push(diagnostic);
            }
        }
    }
    (constraints, pairs)
}

/// `(LEAST MOST)`, of which the second may be `inf`.
fn bounds(bounds: &[Name<'_>], report: &mut Report<'_>) -> (u32, Option<u32>) {
    let number = |bound: &Name<'_>| bound.text.parse::<u32>().ok();
    let &[least, most] = bounds else { return (1, None) };
    let meant = (number(&least).unwrap_or(1), number(&most));
    let wrong = match (number(&least), number(&most)) {
        (None, _) => Some(("a whole number of agents", least.span)),
        (_, None) if !most.is("inf") => Some(("a whole number of agents or `inf`", most.span)),
        (Some(least), Some(upper)) if upper < least => {
            Some(("an upper bound that is not below the lower one", most.span))
        }
        _ => None,
    };
    if let Some((expected, span)) = wrong {
        report.push(unexpected_item::unexpected_item(expected, span));
        return (1, None);
    }
    meant
}

/// `(ACTION POSITION …)`: there are as many positions as the constraint has parameters, and their types fit.
fn participant(
    participant: &Participant<'_>,
    bindings: &Bindings<'_>,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) -> Option<(usize, Vec<usize>)> {
    let action = participant.action;
    let Some(id) = world.names.actions.find(action.text) else {
        report.lost(action, Namespace::Action);
        if report.first(&unknown_action::RULE, action.text) {
            let near = report.nearest(action.text, &world.names.actions);
            report.push(unknown_action::unknown_action(action.text, action.span, near));
        }
        return None;
    };
    let signature = &world.domain.signatures[id as usize];
    report.found(action, Symbol::at(Namespace::Action, signature.name.span));
    // Position 0 is the agent, and the parameters are counted from 1.
    let shift = usize::from(!signature.agent);
    let wanted = &bindings.scope.variables;
    if participant.positions.len() != wanted.len() {
        report.push(constraint_position::count(
            wanted.len(),
            participant.positions.len(),
            participant.place.0,
        ));
        return None;
    }
    let mut positions = Vec::new();
    for (position, parameter) in participant.positions.iter().zip(wanted) {
        let index = position.text.parse::<usize>().ok().and_then(|index| index.checked_sub(shift));
        let Some(argument) = index.and_then(|index| signature.parameters.get(index)) else {
            let last = (signature.parameters.len() + shift).saturating_sub(1);
            report.push(constraint_position::position(
                position.text,
                action.text,
                (shift, last),
                position.span,
                signature.name.span,
            ));
            continue;
        };
        positions.extend(index);
        let fits = argument.types.is_empty()
            || parameter.types.is_empty()
            || world.overlap(&argument.types, &parameter.types);
        if !fits {
            report.push(constraint_position::types(
                (&argument.name.text, &world.describe_types(&argument.types)),
                (&parameter.name.text, &world.describe_types(&parameter.types)),
                position.span,
                argument.name.span,
            ));
        }
    }
    let complete = positions.len() == wanted.len();
    signature.action.filter(|_| complete).map(|id| (id.index(), positions))
}
