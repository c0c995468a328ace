#![doc = include_str!("agent_without_multi_agent.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `agent-without-multi-agent`.
pub const RULE: Rule = Rule {
    code: "E0802",
    name: "agent-without-multi-agent",
    severity: Severity::Error,
    page: include_str!("agent_without_multi_agent.md"),
};

/// An action has an `:agent`, and the domain does not declare `:multi-agent`.
pub fn agent_without_multi_agent(span: Span) -> Diagnostic {
    RULE.at(span, "`:agent` needs the requirement `:multi-agent`", "")
        .help("add `:multi-agent` to `:requirements`")
}
