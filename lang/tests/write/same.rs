//! A model goes in; a text comes out that is the same for models that differ only in spans, in the names of variables and in the order of types.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{Debug, Write};

use lang::execute::joint::Concurrency;
use lang::model::{Action, Domain, Formula, Holder, Problem, Scope, TypeId, Variable};
use lang::write::{self, Style};

/// All that a domain says.
pub fn domain(domain: &Domain) -> String {
    let mut out = format!("{} {:?}\n", domain.name.text, Concurrency::of(domain));
    let mut types: Vec<String> = Vec::new();
    for of in &domain.types {
        let sorted = |ids: &[TypeId]| {
            let mut names: Vec<&str> =
                ids.iter().map(|id| domain.types[id.index()].name.text.as_str()).collect();
            names.sort_unstable();
            names.join(" ")
        };
        types.push(format!(
            "{}: {} of {}",
            of.name.text,
            sorted(&of.parents),
            sorted(&of.ancestors)
        ));
    }
    types.sort();
    line(&mut out, &types);
    for constant in &domain.constants {
        line(&mut out, (&constant.name.text, names(domain, &constant.types), constant.holder));
    }
    for predicate in &domain.predicates {
        let owner = predicate.owner.as_ref();
        let owner = owner.map(|owner| (owner.position, names(domain, &owner.types)));
        let parameters = parameters(domain, &predicate.parameters);
        line(&mut out, (&predicate.name.text, parameters, predicate.derived, owner));
    }
    for function in &domain.functions {
        let values = function.values.as_ref().map(|types| names(domain, types));
        line(&mut out, (&function.name.text, parameters(domain, &function.parameters), values));
    }
    for axiom in &domain.axioms {
        line(&mut out, (axiom.head, scope_parameters(domain, &axiom.scope)));
        line(&mut out, formula(domain, &axiom.scope, &axiom.body));
    }
    for one in &domain.actions {
        action(&mut out, domain, one);
    }
    out
}

/// All that a problem says.
pub fn problem(domain: &Domain, problem: &Problem) -> String {
    let mut out = format!("{}\n", problem.name.text);
    for object in &problem.objects {
        line(&mut out, (&object.name.text, names(domain, &object.types), object.holder));
    }
    line(&mut out, &problem.init);
    for value in &problem.values {
        line(&mut out, (value.function, &value.arguments, value.value));
    }
    line(&mut out, formula(domain, &problem.goal_scope, &problem.goal));
    line(&mut out, problem.metric.as_ref().map(|metric| metric.function));
    out
}

/// What a task says, each thing by the names that stand in it, so that the order does not count.
pub fn statements(domain: &Domain, problem: &Problem) -> BTreeSet<String> {
    let named = |id: &lang::model::ObjectId| problem.objects[id.index()].name.text.clone();
    let list = |ids: &[lang::model::ObjectId]| ids.iter().map(named).collect::<Vec<_>>().join(" ");
    let mut out = BTreeSet::new();
    for of in &domain.types {
        out.insert(format!("type {} of {}", of.name.text, names(domain, &of.parents)));
    }
    for (id, object) in problem.objects.iter().enumerate() {
        let constant = if id < domain.constants.len() { "constant" } else { "object" };
        let holder = match object.holder {
            Some(Holder::Agent(id)) => named(&id),
            other => format!("{other:?}"),
        };
        let types = names(domain, &object.types);
        out.insert(format!("{constant} {} of {types} held by {holder}", object.name.text));
    }
    for predicate in &domain.predicates {
        let owner = predicate.owner.as_ref();
        let owner = owner.map(|owner| (owner.position, names(domain, &owner.types)));
        let parameters = parameters(domain, &predicate.parameters);
        out.insert(format!("predicate {} {parameters:?} {owner:?}", predicate.name.text));
    }
    for function in &domain.functions {
        let parameters = parameters(domain, &function.parameters);
        out.insert(format!("function {} {parameters:?}", function.name.text));
    }
    for action in &domain.actions {
        let alone = Domain { actions: vec![action.clone()], ..domain.clone() };
        let text = write::domain(&alone, &Style::default());
        out.insert(text[text.find("(:action").expect("it is there")..].to_owned());
    }
    for fact in &problem.init {
        let name = &domain.predicates[fact.predicate.index()].name.text;
        out.insert(format!("({name} {})", list(&fact.arguments)));
    }
    for value in &problem.values {
        let name = &domain.functions[value.function.index()].name.text;
        out.insert(format!("(= ({name} {}) {})", list(&value.arguments), value.value));
    }
    let text = write::problem(domain, problem, &Style::default());
    out.insert(text[text.find("(:goal").expect("it is there")..].to_owned());
    out
}

fn action(out: &mut String, domain: &Domain, action: &Action) {
    let scope = &action.scope;
    line(out, (&action.name.text, action.agent, scope_parameters(domain, scope)));
    line(out, formula(domain, scope, &action.precondition));
    for effect in &action.effects {
        let literals: Vec<_> =
            effect.literals.iter().map(|literal| (literal.positive, &literal.atom)).collect();
        let whole = format!("{:?} {} {literals:?}", effect.variables, nodes(&effect.condition));
        line(out, local(domain, scope, &whole));
    }
    for increase in &action.increases {
        let amount = (increase.function, &increase.arguments, &increase.value);
        let whole = format!("{:?} {} {amount:?}", increase.variables, nodes(&increase.condition));
        line(out, local(domain, scope, &whole));
    }
}

fn line(out: &mut String, what: impl Debug) {
    writeln!(out, "{what:?}").expect("a string takes all");
}

fn names(domain: &Domain, types: &[TypeId]) -> String {
    let names = types.iter().map(|id| domain.types[id.index()].name.text.as_str());
    names.collect::<Vec<_>>().join("|")
}

fn parameters(domain: &Domain, parameters: &[Variable]) -> Vec<String> {
    parameters.iter().map(|parameter| names(domain, &parameter.types)).collect()
}

fn scope_parameters(domain: &Domain, scope: &Scope) -> Vec<String> {
    parameters(domain, &scope.variables[..scope.parameters as usize])
}

fn nodes(formula: &Formula) -> String {
    format!("{:?}", formula.nodes.iter().map(|node| &node.kind).collect::<Vec<_>>())
}

fn formula(domain: &Domain, scope: &Scope, formula: &Formula) -> String {
    local(domain, scope, &nodes(formula))
}

/// The text with bound variables numbered as they come in it, each with its types.
fn local(domain: &Domain, scope: &Scope, text: &str) -> String {
    let mut numbers: BTreeMap<u32, usize> = BTreeMap::new();
    let mut parts = text.split("VariableId(");
    let mut out = parts.next().unwrap_or("").to_owned();
    for part in parts {
        let (id, rest) = part.split_once(')').expect("an id ends");
        let id: u32 = id.parse().expect("an id is a number");
        if id < scope.parameters {
            write!(out, "parameter {id}{rest}").expect("a string takes all");
            continue;
        }
        let next = numbers.len();
        let number = *numbers.entry(id).or_insert(next);
        let types = names(domain, &scope.variables[id as usize].types);
        write!(out, "bound {number} of {types}{rest}").expect("a string takes all");
    }
    out
}
