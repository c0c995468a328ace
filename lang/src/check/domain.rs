//! Domains.

use super::index::Index;
use super::requirement::{self, Need};
use super::scope::{self, Bindings};
use super::{Names, Report, World, condition, effect, hierarchy, name};
use crate::ast::{self, DomainSection, Head, Name, TypedList};
use crate::diagnostic::{Diagnostics, derived_effect, duplicate_definition, unused_parameter};
use crate::model::{
    Action, Axiom, Domain, Formula, Function, FunctionId, Object, ObjectId, Predicate, PredicateId,
    Variable,
};
use crate::source::Span;
use crate::symbol::{Namespace, Occurrences, Role, Symbol};

/// Resolves a domain.
pub fn domain(
    ast: &ast::Domain<'_>,
    diagnostics: &mut Diagnostics,
    occurrences: Option<&mut Occurrences>,
) -> Domain {
    let requirements = ast.sections.iter().filter_map(|section| match section {
        DomainSection::Requirements(names) => Some(names.iter().copied()),
        _ => None,
    });
    let flags = requirement::read(requirements.flatten(), diagnostics);
    let mut report = Report::new(diagnostics, flags, occurrences);
    report.declared_here(ast.name, Namespace::Domain);
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
        name: name(ast.name),
        requirements: flags.requirements(),
        types: hierarchy::build(&lists, ast.name.span, &mut names.types, &mut report),
        constants: Vec::new(),
        predicates: Vec::new(),
        functions: Vec::new(),
        axioms: Vec::new(),
        actions: Vec::new(),
        uses: Vec::new(),
    };
    declarations(ast, &mut domain, &mut names, &mut report);
    let (mut axioms, mut actions) = (Vec::new(), Vec::new());
    let mut action_names = Index::default();
    let world = World {
        domain: &domain,
        objects: &domain.constants,
        names: &names,
        places: "`:constants`",
    };
    for section in &ast.sections {
        match section {
            DomainSection::Derived(derived) => axioms.extend(axiom(derived, &world, &mut report)),
            DomainSection::Action(read) => {
                if let Some(first) = action_names.find(read.name.text) {
                    let first: &Action = &actions[first as usize];
                    report.declared(read.name, Symbol::at(Namespace::Action, first.name.span));
                    report_duplicate("action", read.name, "", first.name.span, &mut report);
                } else if !read.name.text.is_empty() {
                    action_names.insert(read.name.text, actions.len() as u32);
                    report.declared_here(read.name, Namespace::Action);
                }
                actions.push(action(read, &world, &mut report));
            }
            DomainSection::Unread(unread) => report.uses(unread),
            _ => {}
        }
    }
    for axiom in &axioms {
        domain.predicates[axiom.head.index()].derived = true;
    }
    changed_derived(&domain, &axioms, &actions, &mut report);
    let uses = report.uses;
    (domain.axioms, domain.actions, domain.uses) = (axioms, actions, uses);
    domain
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
            DomainSection::Predicates(heads) => {
                for head in heads {
                    let id = domain.predicates.len() as u32;
                    let parameters = parameters(&head.parameters, &names.types, report);
                    if let Some(first) = names.predicates.find(head.name.text) {
                        report.declared(head.name, PredicateId(first));
                        let first = &domain.predicates[first as usize];
                        let detail = difference(first.parameters.len(), parameters.len());
                        report_duplicate("predicate", head.name, &detail, first.name.span, report);
                        continue;
                    }
                    names.predicates.insert(head.name.text, id);
                    report.declared(head.name, PredicateId(id));
                    domain.predicates.push(Predicate {
                        name: name(head.name),
                        parameters,
                        derived: false,
                    });
                }
            }
            DomainSection::Functions(groups) => {
                for group in groups {
                    let numeric =
                        group.types.as_ref().is_none_or(|types| types.names[0].is("number"));
                    if !numeric {
                        names.object_functions = true;
                        hierarchy::resolve(group.types.as_ref(), &names.types, "`:types`", report);
                    }
                    group.heads.iter().for_each(|head| function(head, domain, names, report));
                }
            }
            _ => {}
        }
    }
}

fn function<'a>(
    head: &Head<'a>,
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
    domain.functions.push(Function { name: name(head.name), parameters });
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
fn parameters(list: &TypedList<'_>, types: &Index<'_>, report: &mut Report<'_>) -> Vec<Variable> {
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
            table.push(Object { name: name(spelling), types: types.clone() });
        }
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
        Some(body) => condition::check(body, 0, &mut bindings, world, report),
        None => Formula::truth(derived.place.0),
    };
    Some(Axiom { head: predicate?, scope: bindings.scope, body, span: derived.place.0 })
}

fn action<'a>(action: &ast::Action<'a>, world: &World<'_, 'a>, report: &mut Report<'_>) -> Action {
    let span = action.place.0;
    let mut bindings = Bindings::new(format!("action `{}`", action.name));
    bindings.bind(&action.parameters, world, report);
    bindings.scope.parameters = bindings.scope.variables.len() as u32;
    if !action.unread.is_empty() {
        // A field that is not read may bind variables, so nothing can be said about the rest.
        action.unread.iter().for_each(|unread| report.uses(unread));
        let precondition = Formula::truth(span);
        let (effects, increases) = (Vec::new(), Vec::new());
        return Action {
            name: name(action.name),
            scope: bindings.scope,
            precondition,
            effects,
            increases,
            span,
        };
    }
    let mut conditions = Vec::new();
    for formula in &action.preconditions {
        conditions.push(condition::check(formula, 0, &mut bindings, world, report));
    }
    let (effects, increases) = effect::check(&action.effects, span, &mut bindings, world, report);
    if !bindings.unsure {
        let parameters = bindings.scope.parameters as usize;
        for (variable, _) in bindings.scope.variables[..parameters]
            .iter()
            .zip(&bindings.used)
            .filter(|(_, used)| !**used)
        {
            let owner = &bindings.owner;
            report.push(unused_parameter::unused_parameter(
                &variable.name.text,
                owner,
                variable.name.span,
            ));
        }
    }
    let precondition = condition::conjoin(conditions, span);
    Action {
        name: name(action.name),
        scope: bindings.scope,
        precondition,
        effects,
        increases,
        span,
    }
}
