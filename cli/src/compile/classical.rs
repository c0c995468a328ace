//! A task of several agents goes in; a classical task whose plans are its joint plans comes out, with a map back.

use lang::model::{ActionId, Term};
use lang::multiagent::{self, Compiled, Means, Options, Role};
use lang::write::{self, Style};
use planner::normalize::Unsupported;
use serde_json::{Value, json};

use crate::args::Compile;
use crate::exit::Exit;
use crate::input::{self, Input};
use crate::terminal::Terminal;

/// Writes `domain.pddl`, `problem.pddl` and `map.json`.
pub(super) fn classical(input: &Input, arguments: &Compile, terminal: &mut Terminal) -> Exit {
    let options = Options {
        concurrency: input::concurrency(arguments.concurrency, input),
        size: arguments.joint_size.map(|size| size as usize),
        means: Means::Complete,
        objective: None,
    };
    let compiled = match multiagent::compile(&input.domain, &input.problem, &options) {
        Ok(compiled) => compiled,
        Err(multiagent::Refusal { message, span }) => {
            let refused = input::unsupported(&Unsupported { message, span });
            input.report(refused, arguments.output_format, terminal);
            return Exit::Failed;
        }
    };
    if !compiled.complete {
        terminal.say("note: some joint actions have no counterpart, so that a plan may be missed");
    }
    let head = "A classical form of a task of several agents. An action whose name joins several with `--` takes them\n\
        at the same time. What no sequence of those can do is put together between `begin` and `end`.\n\
        `map.json` says which actions a step stands for."
        .to_owned();
    let style = Style { head, actions: compiled.notes.clone(), ..Style::default() };
    let files = [
        ("domain.pddl".to_owned(), write::domain(&compiled.domain, &style)),
        (
            "problem.pddl".to_owned(),
            write::problem(&compiled.domain, &compiled.problem, &Style::default()),
        ),
        (
            "map.json".to_owned(),
            serde_json::to_string_pretty(&map(input, &compiled)).expect("it is plain data") + "\n",
        ),
    ];
    super::save(input, arguments, &files, terminal)
}

/// What each action of the compiled domain stands for. An argument is the position of a parameter, or the name of an object.
fn map(input: &Input, compiled: &Compiled) -> Value {
    let part = |(action, terms): &(ActionId, Vec<Term>)| {
        let argument = |term: &Term| match *term {
            Term::Variable(variable) => json!(variable.0),
            Term::Object(object) => {
                json!(input.problem.objects[object.index()].name.text)
            }
        };
        json!({
            "action": input.domain.actions[action.index()].name.text,
            "arguments": terms.iter().map(argument).collect::<Vec<_>>(),
        })
    };
    let actions = compiled.domain.actions.iter().zip(&compiled.roles).map(|(action, role)| {
        let meaning = match role {
            Role::Joint(parts) => {
                json!({ "is": "joint step", "parts": parts.iter().map(part).collect::<Vec<_>>() })
            }
            Role::Select(action, terms) => {
                json!({ "is": "part", "parts": [part(&(*action, terms.clone()))] })
            }
            Role::Frame => json!({ "is": "nothing" }),
            Role::End => json!({ "is": "end of a joint step" }),
        };
        (action.name.text.clone(), meaning)
    });
    json!({
        "domain": input.domain.name.text,
        "problem": input.problem.name.text,
        "complete": compiled.complete,
        "actions": actions.collect::<serde_json::Map<_, _>>(),
    })
}
