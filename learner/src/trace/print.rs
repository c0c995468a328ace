//! A [`Trace`] goes in; its text comes out, as `AMLGym` and SAM or as MA-SAM write it.

use lang::model::{Domain, ObjectId};
use lang::plan::Step;

use super::{State, Trace};

/// `(:trajectory (:state …) (:action …) …)`: one action in each step. Of a joint step all parts that do something are written.
pub fn print(trace: &Trace, domain: &Domain) -> String {
    let mut text = String::from("(:trajectory\n");
    for (at, state) in trace.states.iter().enumerate() {
        text.push_str("\n(:state");
        facts(&mut text, trace, domain, state);
        text.push_str(")\n");
        if let Some(joint) = trace.steps.get(at) {
            text.push_str("\n(:action");
            for part in joint.parts.iter().flatten() {
                text.push(' ');
                step(&mut text, trace, domain, part);
            }
            text.push_str(")\n");
        }
    }
    text.push_str("\n)\n");
    text
}

/// `((:init …) (operators: (…) (nop ) …) (:state …) …)`: one action or `nop` for each agent in each step.
pub fn print_joint(trace: &Trace, domain: &Domain) -> String {
    let mut text = String::from("(");
    for (at, state) in trace.states.iter().enumerate() {
        text.push_str(if at == 0 { "(:init" } else { "(:state" });
        facts(&mut text, trace, domain, state);
        text.push_str(")\n");
        if let Some(joint) = trace.steps.get(at) {
            text.push_str("(operators:");
            for part in &joint.parts {
                text.push(' ');
                match part {
                    Some(part) => step(&mut text, trace, domain, part),
                    None => text.push_str("(nop )"),
                }
            }
            text.push_str(")\n");
        }
    }
    text.push_str(")\n");
    text
}

fn facts(text: &mut String, trace: &Trace, domain: &Domain, state: &State) {
    for id in state.facts() {
        let fact = &trace.facts[id.index()];
        text.push(' ');
        list(text, trace, &domain.predicates[fact.predicate.index()].name.text, &fact.arguments);
    }
}

fn step(text: &mut String, trace: &Trace, domain: &Domain, part: &Step) {
    list(text, trace, &domain.actions[part.action.index()].name.text, &part.arguments);
}

fn list(text: &mut String, trace: &Trace, head: &str, arguments: &[ObjectId]) {
    text.push('(');
    text.push_str(head);
    for argument in arguments {
        text.push(' ');
        text.push_str(&trace.objects[argument.index()].name.text);
    }
    text.push(')');
}
