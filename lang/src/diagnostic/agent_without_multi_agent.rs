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

/// `keyword`, such as `:agent`, is used, and the domain does not declare `:multi-agent`.
pub fn agent_without_multi_agent(keyword: &str, span: Span) -> Diagnostic {
    RULE.at(span, format!("`{keyword}` needs the requirement `:multi-agent`"), "used here first")
        .help("add `:multi-agent` to `:requirements`")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn once() {
        check(&["(define (domain d)
  (:requirements :adl)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates (in ?d - dish ?p - place) (clean ?d - dish) (lit))
  (:action lift :agent ?a - dish :parameters (?d - dish) :effect (clean ?d))
;               ^^^^^^ E0802: `:agent` needs the requirement `:multi-agent`
  (:action drop :agent ?a - dish :parameters (?d - dish) :effect (clean ?d)))
"]);
    }
}
