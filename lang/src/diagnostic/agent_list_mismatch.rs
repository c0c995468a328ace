#![doc = include_str!("agent_list_mismatch.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `agent-list-mismatch`.
pub const RULE: Rule = Rule {
    code: "E0812",
    name: "agent-list-mismatch",
    severity: Severity::Error,
    page: include_str!("agent_list_mismatch.md"),
};

/// The agent `name` is no object of its problem.
pub fn no_object(name: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("the agent `{name}` is no object of its problem"), "of this agent")
}

/// There are two problems of the agent `name`.
pub fn two_files(name: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("agent `{name}` has two problems"), "the second")
        .label(first, "the first")
}

/// The object `name` could do `action` in the task of all agents, though no file of its own lets it.
pub fn stranger(name: &str, action: &str, span: Span, declared: Span) -> Diagnostic {
    RULE.at(
        span,
        format!("`{name}` has the type of the agents of action `{action}`, and no file that lets it act so"),
        "not one of the agents",
    )
    .label(declared, "the action")
    .help("give the agents that have the action a type of their own, or name the missing files")
}

/// The list of agents calls the problem or the domain `what` `asked`, and it is called `name`.
pub fn wrong_name(what: &str, asked: &str, name: &str, span: Span, declared: Span) -> Diagnostic {
    let message =
        format!("the list is for {what} `{asked}`, but the files of the agents define `{name}`");
    RULE.at(span, message, format!("no such {what}"))
        .label(declared, "named here")
        .suggest(Some(name))
}

/// The list names an agent of which there are no files; perhaps one that there is was meant.
pub fn unknown_agent(name: &str, span: Span, near: Option<&str>) -> Diagnostic {
    RULE.at(span, format!("there are no files of agent `{name}`"), "unknown agent").suggest(near)
}

/// The list leaves the agent `name` out, of which there are files.
pub fn unlisted(name: &str, list: Span, problem: Span) -> Diagnostic {
    RULE.at(list, format!("the list leaves out agent `{name}`"), "the agents are listed here")
        .label(problem, "of this agent")
}

/// The list names an agent twice.
pub fn twice(name: &str, span: Span, first: Span) -> Diagnostic {
    RULE.at(span, format!("agent `{name}` is listed twice"), "again").label(first, "first here")
}
