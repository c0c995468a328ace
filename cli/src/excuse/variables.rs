//! What may be changed of a problem, as JSON, for whoever wants to check by other means that an excuse is a smallest one.

use planner::excuse::{CatalogueError, Policy, catalogue};
use serde_json::{Value, json};

use super::report::origin;
use super::words::Words;
use crate::args::OutputFormat;
use crate::exit::Exit;
use crate::input::{self, Input};
use crate::limits::Watch;
use crate::terminal::Terminal;

/// Prints the variables with their edits of cost `most` at most, and the groups that no set of edits may break.
pub fn print(
    input: &Input,
    policy: &Policy,
    most: u32,
    watch: &Watch,
    format: OutputFormat,
    terminal: &mut Terminal,
) -> Exit {
    let words = Words { domain: &input.domain, problem: &input.problem };
    let found = match catalogue(&input.domain, &input.problem, policy, most, &watch.limits) {
        Ok(found) => found,
        Err(CatalogueError::Unsupported(unsupported)) => {
            input.report(input::unsupported(&unsupported), format, terminal);
            return Exit::Failed;
        }
        Err(CatalogueError::Unfinished(_)) => {
            terminal.say("A limit was reached before it was known what may be changed.");
            return Exit::Incomplete;
        }
    };
    let (variables, groups) = found.map_or((Vec::new(), Vec::new()), |catalogue| {
        let variables: Vec<Value> = catalogue
            .variables
            .iter()
            .map(|choice| {
                let value = |(fact, cost): &(Option<lang::model::Fact>, u32)| {
                    json!({ "to": fact.as_ref().map(|fact| words.atom(fact)), "cost": cost })
                };
                json!({
                    "from": choice.from.as_ref().map(|fact| words.atom(fact)),
                    "values": choice.to.iter().map(value).collect::<Vec<_>>(),
                    "group": origin(choice.origin),
                })
            })
            .collect();
        let groups: Vec<Value> = catalogue
            .groups
            .iter()
            .map(|(facts, exactly)| {
                let atoms: Vec<String> = facts.iter().map(|fact| words.atom(fact)).collect();
                json!({ "atoms": atoms, "exactly": exactly })
            })
            .collect();
        (variables, groups)
    });
    let document = json!({ "variables": variables, "groups": groups });
    terminal.line(serde_json::to_string_pretty(&document).expect("it is plain data"));
    Exit::Done
}
