//! Task networks of HDDL: methods, and what a problem asks for.

use hashbrown::HashMap;

use super::condition::Setting;
use super::requirement::Need;
use super::scope::{Bindings, Callee};
use super::{Report, World, action, condition, domain};
use crate::ast::{Feature, InitialNetwork, Method, Name, Network, NodeKind as Ast};
use crate::diagnostic::{unknown_subtask, unknown_task};
use crate::model::Doing;
use crate::near::nearest;
use crate::source::Span;
use crate::symbol::{Namespace, Symbol};

/// Checks a method.
pub(super) fn method<'a>(method: &Method<'a>, world: &World<'_, 'a>, report: &mut Report<'_>) {
    report.need(Need::Hierarchy, method.name.span);
    report.uses(Feature::Hierarchies, method.name.span);
    report.declared_here(method.name, Namespace::Method);
    let mut bindings = Bindings::new(format!("method `{}`", method.name));
    bindings.bind(&method.parameters, world, report);
    bindings.scope.parameters = bindings.scope.variables.len() as u32;
    if let Some(task) = &method.task {
        match &task.nodes[0].kind {
            Ast::Apply(application) => {
                let arguments = task.arguments(application);
                let span = task.nodes[0].place.0;
                self::task(application.name, arguments, span, false, &mut bindings, world, report);
            }
            _ => bindings.unsure = true,
        }
    }
    for formula in &method.preconditions {
        condition::check(formula, 0, Setting::State, &mut bindings, world, report);
    }
    network(&method.network, &mut bindings, world, report);
    action::unused(&bindings, report);
}

/// Checks what a problem asks for.
pub(super) fn initial<'a>(
    asked: &InitialNetwork<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) {
    report.uses(Feature::Hierarchies, asked.keyword.span);
    let mut bindings = Bindings::new(format!("`{}`", asked.keyword));
    bindings.bind(&asked.parameters, world, report);
    network(&asked.network, &mut bindings, world, report);
}

fn network<'a>(
    network: &Network<'a>,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) {
    let mut labels: HashMap<String, Span> = HashMap::new();
    for subtask in &network.subtasks {
        if let Some(label) = subtask.label {
            if let Some(&first) = labels.get(&label.text.to_ascii_lowercase()) {
                domain::report_duplicate("subtask", label, "", first, report);
            }
            report.declared_here(label, Namespace::Subtask);
            labels.insert(label.text.to_ascii_lowercase(), label.span);
        }
        let range = subtask.task.arguments.start as usize..subtask.task.arguments.end as usize;
        let arguments = &network.terms[range];
        task(subtask.task.name, arguments, subtask.place.0, true, bindings, world, report);
    }
    for name in network.ordering.iter().flat_map(|&(first, second)| [first, second]) {
        if let Some(&declared) = labels.get(&name.text.to_ascii_lowercase()) {
            report.found(name, Symbol::at(Namespace::Subtask, declared));
        } else {
            report.lost(name, Namespace::Subtask);
            let spellings = network.subtasks.iter().filter_map(|one| one.label);
            let near = nearest(name.text, spellings.map(|label| label.text));
            report.push(unknown_subtask::unknown_subtask(name.text, name.span, near));
        }
    }
    for formula in &network.constraints {
        condition::check(formula, 0, Setting::State, bindings, world, report);
    }
}

/// A task, or an action where `actions` may be, with its arguments.
fn task<'a>(
    spelling: Name<'a>,
    arguments: &[Name<'a>],
    span: Span,
    actions: bool,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) {
    let found = world.names.tasks.find(spelling.text);
    let found = found.or_else(|| world.names.actions.find(spelling.text).filter(|_| actions));
    if let Some(id) = found {
        let signature = &world.domain.signatures[id as usize];
        let namespace = match signature.doing {
            Doing::Task => Namespace::Task,
            Doing::Action(_) => Namespace::Action,
        };
        report.found(spelling, Symbol::at(namespace, signature.name.span));
        bindings.arguments(&Callee::task(signature), arguments, span, world, report);
        return;
    }
    bindings.unsure = true;
    report.lost(spelling, Namespace::Task);
    if report.first(&unknown_task::RULE, spelling.text) {
        let known = world.domain.signatures.iter();
        let known = known.filter(|one| actions || one.doing == Doing::Task);
        let near = nearest(spelling.text, known.map(|one| one.name.text.as_str()));
        report.push(unknown_task::unknown_task(spelling.text, spelling.span, actions, near));
    }
}
