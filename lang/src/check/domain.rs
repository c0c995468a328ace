//! Domains.

use super::condition::Setting;
use super::index::Index;
use super::requirement::{self, Need};
use super::scope::{self, Bindings};
use super::{
    Names, Report, World, action, agents, concurrency, condition, effect, hierarchy, name, network,
};
use crate::ast::{self, ActionKind, DomainSection, Feature, Head, Name, TypeReference, TypedList};
use crate::diagnostic::{Diagnostics, derived_effect, duplicate_definition, unknown_type};
use crate::model::{
    Action, Axiom, Domain, Formula, Function, FunctionId, Object, ObjectId, Owner, Predicate,
    PredicateId, TypeId, Variable,
};
use crate::near::nearest;
use crate::source::Span;
use crate::symbol::{Namespace, Occurrences, Role};

/// Resolves a domain.
pub fn domain(
    ast: &ast::Domain<'_>,
    diagnostics: &mut Diagnostics,
    occurrences: Option<&mut Occurrences>,
) -> Domain {
    let sections = || {
        ast.sections.iter().filter_map(|section| match section {
            DomainSection::Requirements(names) => Some(names),
            _ => None,
        })
    };
    let flags = requirement::read(sections().flatten().copied(), diagnostics);
    let place = requirement::place(sections().flatten().last().copied(), ast.name);
    let mut report = Report::new(diagnostics, flags, place, occurrences);
    report.declared_here(ast.name, Namespace::Domain);
    report.undeclared = sections().next().is_none();
    let declares = |section: &_| matches!(section, DomainSection::Predicates(_));
    report.blind = ast.name.text.is_empty() && !ast.sections.iter().any(declares);
    let mut names = Names::default();
    let lists: Vec<&TypedList<'_>> = ast
        .sections
        .iter()
        .filter_map(|section| match section {
            DomainSection::Types(list) => Some(list),
            _ => None,
        })
        .collect();
    if let Some((first, _)) = lists.iter().flat_map(|list| list.entries()).next() {
        report.need(Need::Types, first.span);
    }
    let mut domain = Domain {
        requirements: flags.requirements(),
        types: hierarchy::build(&lists, ast.name.span, &mut names.types, &mut report),
        ..Domain::new(name(ast.name))
    };
    declarations(ast, &mut domain, &mut names, &mut report);
    action::signatures(ast, &mut domain, &mut names, &mut report);
    let world = World {
        domain: &domain,
        objects: &domain.constants,
        names: &names,
        places: "`:constants`",
    };
    let (axioms, actions) = rules(ast, &world, &mut report);
    for axiom in &axioms {
        domain.predicates[axiom.head.index()].derived = true;
    }
    changed_derived(&domain, &axioms, &actions, &mut report);
    for (function, span) in std::mem::take(&mut report.read) {
        domain.functions[function.index()].read = Some(span);
    }
    for function in std::mem::take(&mut report.assigned) {
        domain.functions[function.index()].assigned = true;
    }
    // What has been said to be missing is not said again of a problem.
    report.declare(report.missing);
    domain.requirements = report.declared.requirements();
    (domain.preferences, domain.uses) = (report.preferences, report.uses);
    (domain.axioms, domain.actions) = (axioms, actions);
    domain
}

/// What can happen and what follows: actions of all kinds, axioms, methods and constraints.
fn rules<'a>(
    ast: &ast::Domain<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> (Vec<Axiom>, Vec<Action>) {
    let (mut axioms, mut actions) = (Vec::new(), Vec::new());
    let (mut constraints, mut dependences) = (Vec::new(), Vec::new());
    for section in &ast.sections {
        match section {
            DomainSection::Derived(derived) => axioms.extend(axiom(derived, world, report)),
            DomainSection::Axiom(axiom) => old_axiom(axiom, world, report),
            DomainSection::Action(read) => actions.extend(action::action(read, world, report)),
            DomainSection::Method(method) => network::method(method, world, report),
            DomainSection::Constraints(keyword, formulas) => {
                report.need(Need::Constraint, keyword.span);
                report.uses(Feature::Constraints, keyword.span);
                let mut bindings = Bindings::new("`:constraints`".to_owned());
                for formula in formulas {
                    condition::check(formula, 0, Setting::Plan, &mut bindings, world, report);
                }
            }
            DomainSection::Concurrency(constraint) => constraints.push(constraint),
            DomainSection::Dependence(keyword, names) => {
                dependences.push((*keyword, names.as_slice()));
            }
            DomainSection::Unread(unread) => report.uses(unread.feature, unread.keyword.span),
            _ => {}
        }
    }
    let (constraints, dependences) = agents::constraints(&constraints, &dependences, world, report);
    concurrency::impose(&constraints, &dependences, &mut actions);
    (axioms, actions)
}

/// Reports effects on predicates that are derived.
fn changed_derived(domain: &Domain, axioms: &[Axiom], actions: &[Action], report: &mut Report<'_>) {
    for action in actions {
        for literal in action.effects.iter().flat_map(|effect| &effect.literals) {
            let predicate = &domain.predicates[literal.atom.predicate.index()];
            let rule = axioms
                .iter()
                .find(|axiom| predicate.derived && axiom.head == literal.atom.predicate);
            if let Some(rule) = rule {
                let (action, name) = (&action.name.text, &predicate.name.text);
                report.push(derived_effect::derived_effect(action, name, literal.span, rule.span));
            }
        }
    }
}

pub(super) fn report_duplicate(
    what: &str,
    again: Name<'_>,
    detail: &str,
    first: Span,
    report: &mut Report<'_>,
) {
    report.push(duplicate_definition::duplicate_definition(
        what, again.text, detail, again.span, first,
    ));
}

/// Constants, predicates and functions.
fn declarations<'a>(
    ast: &ast::Domain<'a>,
    domain: &mut Domain,
    names: &mut Names<'a>,
    report: &mut Report<'_>,
) {
    for section in &ast.sections {
        match section {
            DomainSection::Constants(list) => {
                objects(list, "constant", "`:types`", &mut domain.constants, names, report);
            }
            DomainSection::Predicates(parts) => {
                for part in parts {
                    let owner = agents::owner(part, names, report);
                    for head in &part.heads {
                        predicate(head, owner.as_ref(), domain, names, report);
                    }
                }
            }
            DomainSection::Functions(groups) => {
                for group in groups {
                    let values = values(group.types.as_ref(), names, report);
                    for head in &group.heads {
                        function(head, values.clone(), domain, names, report);
                    }
                }
            }
            _ => {}
        }
    }
}

fn predicate<'a>(
    head: &Head<'a>,
    owner: Option<&(String, Owner)>,
    domain: &mut Domain,
    names: &mut Names<'a>,
    report: &mut Report<'_>,
) {
    let id = domain.predicates.len() as u32;
    let parameters = parameters(&head.parameters, &names.types, report);
    if let Some(first) = names.predicates.find(head.name.text) {
        report.declared(head.name, PredicateId(first));
        let first = &domain.predicates[first as usize];
        let detail = difference(first.parameters.len(), parameters.len());
        return report_duplicate("predicate", head.name, &detail, first.name.span, report);
    }
    names.predicates.insert(head.name.text, id);
    report.declared(head.name, PredicateId(id));
    let owner = owner.map(|(variable, owner)| {
        let is = |parameter: &Variable| parameter.name.text.eq_ignore_ascii_case(variable);
        Owner { position: parameters.iter().position(is), ..owner.clone() }
    });
    domain.predicates.push(Predicate { name: name(head.name), parameters, derived: false, owner });
}

/// The types of the objects that functions have as values; none if they are numbers.
fn values(
    types: Option<&TypeReference<'_>>,
    names: &Names<'_>,
    report: &mut Report<'_>,
) -> Option<Vec<TypeId>> {
    let types = types.filter(|types| !types.names[0].is("number"))?;
    let first = types.names[0];
    if names.types.find(first.text).is_some() {
        report.need(Need::ObjectFluent, first.span);
    } else if nearest(first.text, ["number"]).is_some() {
        let near = Some("number");
        report.push(unknown_type::unknown_type(first.text, first.span, "`:types`", near));
        return None;
    }
    Some(hierarchy::resolve(Some(types), &names.types, "`:types`", report))
}

fn function<'a>(
    head: &Head<'a>,
    values: Option<Vec<TypeId>>,
    domain: &mut Domain,
    names: &mut Names<'a>,
    report: &mut Report<'_>,
) {
    let id = domain.functions.len() as u32;
    let parameters = parameters(&head.parameters, &names.types, report);
    if let Some(first) = names.functions.find(head.name.text) {
        report.declared(head.name, FunctionId(first));
        let first = &domain.functions[first as usize];
        let detail = difference(first.parameters.len(), parameters.len());
        report_duplicate("function", head.name, &detail, first.name.span, report);
        return;
    }
    names.functions.insert(head.name.text, id);
    report.declared(head.name, FunctionId(id));
    let name = name(head.name);
    domain.functions.push(Function { name, parameters, values, read: None, assigned: false });
}

/// How two declarations of one name differ.
fn difference(first: usize, second: usize) -> String {
    if first == second {
        String::new()
    } else {
        format!(", with {first} and with {second} arguments")
    }
}

/// The parameters of a declaration. A name that stands twice does no harm there.
pub(super) fn parameters(
    list: &TypedList<'_>,
    types: &Index<'_>,
    report: &mut Report<'_>,
) -> Vec<Variable> {
    let mut parameters = Vec::with_capacity(list.len());
    for group in &list.groups {
        let ids = hierarchy::resolve(group.types.as_ref(), types, "`:types`", report);
        if let Some(reference) = &group.types {
            report.need(Need::Types, reference.names[0].span);
        }
        for &spelling in &group.names {
            let variable = Variable { name: name(spelling), types: ids.clone() };
            report.declared_variable(spelling, &variable);
            parameters.push(variable);
        }
    }
    parameters
}

/// Adds constants or objects to `table`.
pub(super) fn objects<'a>(
    list: &TypedList<'a>,
    what: &str,
    place: &str,
    table: &mut Vec<Object>,
    names: &mut Names<'a>,
    report: &mut Report<'_>,
) {
    for group in &list.groups {
        let types = hierarchy::resolve(group.types.as_ref(), &names.types, place, report);
        if let Some(reference) = &group.types {
            report.need(Need::Types, reference.names[0].span);
        }
        for &spelling in &group.names {
            if let Some(first) = names.objects.find(spelling.text) {
                report.declared(spelling, ObjectId(first));
                let first = table[first as usize].name.span;
                report_duplicate(what, spelling, "", first, report);
                continue;
            }
            report.declared(spelling, ObjectId(table.len() as u32));
            names.objects.insert(spelling.text, table.len() as u32);
            table.push(Object { name: name(spelling), types: types.clone(), holder: None });
        }
    }
    if !list.private.is_empty() {
        agents::private_objects(list, what, place, table, names, report);
    }
}

fn axiom<'a>(
    derived: &ast::Derived<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<Axiom> {
    report.need(Need::Derived, derived.head.name.span);
    let mut bindings = Bindings::new(format!("the rule for `{}`", derived.head.name));
    bindings.bind(&derived.head.parameters, world, report);
    bindings.scope.parameters = bindings.scope.variables.len() as u32;
    report.next(Role::Add);
    let predicate = scope::predicate(derived.head.name, world, report);
    if let Some(predicate) = predicate {
        let declared = &world.domain.predicates[predicate.index()].parameters;
        if declared.len() != bindings.scope.variables.len() {
            let callee = scope::Callee::predicate(predicate, world);
            callee.report_arity(
                &[],
                bindings.scope.variables.len(),
                derived.head.place.0,
                world,
                report,
            );
            return None;
        }
        // A head without types has those of the predicate.
        let untyped = derived.head.parameters.groups.iter().all(|group| group.types.is_none());
        for (variable, declared) in
            bindings.scope.variables.iter_mut().zip(declared).filter(|_| untyped)
        {
            variable.types.clone_from(&declared.types);
        }
    }
    let body = match &derived.body {
        Some(body) => condition::check(body, 0, Setting::State, &mut bindings, world, report),
        None => Formula::truth(derived.place.0),
    };
    Some(Axiom { head: predicate?, scope: bindings.scope, body, span: derived.place.0 })
}

/// An axiom of PDDL 1.2, which is checked and cannot be run.
fn old_axiom<'a>(axiom: &ast::Axiom<'a>, world: &World<'_, 'a>, report: &mut Report<'_>) {
    report.need(Need::Derived, axiom.keyword.span);
    report.uses(Feature::Axioms, axiom.keyword.span);
    let mut bindings = Bindings::new("the axiom".to_owned());
    bindings.bind(&axiom.variables, world, report);
    if let Some(context) = &axiom.context {
        condition::check(context, 0, Setting::State, &mut bindings, world, report);
    }
    if let Some(implies) = &axiom.implies {
        let formulas = std::slice::from_ref(implies);
        let kind = ActionKind::Instant;
        effect::check(formulas, kind, axiom.keyword.span, &mut bindings, world, report);
    }
}
