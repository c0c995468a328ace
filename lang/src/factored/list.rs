//! The list of the agents of a task, as it stands in an `.addl` file: a text goes in and the names come out, and the other way round.

use crate::diagnostic::{Diagnostics, agent_list_mismatch, unexpected_item};
use crate::model::Name;
use crate::near::nearest;
use crate::source::{SourceId, Sources, Span};
use crate::tree::{self, NodeId, Tree};

use super::{Part, same};

/// What such a file says.
#[derive(Debug, Clone, Default)]
pub struct AgentList {
    /// The problem, if it is named.
    pub problem: Option<Name>,
    /// The domain, if it is named.
    pub domain: Option<Name>,
    /// The agents.
    pub agents: Vec<Name>,
}

/// Reads `(define (problem P) (:domain D) (:agents A …))`, or one name a line.
pub fn read_list(sources: &Sources, id: SourceId) -> (AgentList, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let tree = tree::parse(id, &sources.get(id).text, &mut diagnostics);
    let mut list = AgentList::default();
    let mut roots = tree.roots();
    let definition = roots.next().filter(|&root| tree.is_list(root));
    let items: Vec<NodeId> = match definition {
        // A definition is followed by nothing.
        Some(definition) => tree.children(definition).skip(1).chain(roots).collect(),
        None => tree.roots().collect(),
    };
    let mut unexpected = |what: &str, span: Span| {
        diagnostics.push(unexpected_item::unexpected_item(what, span));
    };
    for item in items {
        let words: Vec<Name> = tree.children(item).map(|word| name(&tree, word)).collect();
        match (definition, words.as_slice()) {
            (None, _) if !tree.is_list(item) => list.agents.push(name(&tree, item)),
            (Some(_), [section, one]) if same(&section.text, "problem") => {
                list.problem = Some(one.clone());
            }
            (Some(_), [section, one]) if same(&section.text, ":domain") => {
                list.domain = Some(one.clone());
            }
            (Some(_), [section, agents @ ..]) if same(&section.text, ":agents") => {
                list.agents.extend_from_slice(agents);
            }
            (None, _) => unexpected("the name of an agent", tree.span(item)),
            _ => unexpected(
                "`(problem NAME)`, `(:domain NAME)` or `(:agents NAME …)`",
                tree.span(item),
            ),
        }
    }
    (list, diagnostics)
}

/// What is wrong with a list, of which `whole` is the place, as that of the agents of these parts.
pub fn check_list(list: &AgentList, parts: &[Part], whole: Span) -> Diagnostics {
    let mut found = Diagnostics::default();
    let Some(first) = parts.first() else { return found };
    let names = [
        ("problem", &list.problem, &first.problem.name),
        ("domain", &list.domain, &first.domain.name),
    ];
    for (what, asked, defined) in names {
        if let Some(asked) = asked.as_ref().filter(|asked| !same(&asked.text, &defined.text)) {
            let spans = (asked.span, defined.span);
            let wrong = agent_list_mismatch::wrong_name;
            found.push(wrong(what, &asked.text, &defined.text, spans.0, spans.1));
        }
    }
    for (at, agent) in list.agents.iter().enumerate() {
        let first = list.agents[..at].iter().find(|other| same(&other.text, &agent.text));
        if let Some(first) = first {
            found.push(agent_list_mismatch::twice(&agent.text, agent.span, first.span));
        } else if !parts.iter().any(|part| same(&part.agent, &agent.text)) {
            let near = nearest(&agent.text, parts.iter().map(|part| part.agent.as_str()));
            found.push(agent_list_mismatch::unknown_agent(&agent.text, agent.span, near));
        }
    }
    for part in parts {
        if !list.agents.iter().any(|agent| same(&agent.text, &part.agent)) {
            let problem = part.problem.name.span;
            found.push(agent_list_mismatch::unlisted(&part.agent, whole, problem));
        }
    }
    found
}

fn name(tree: &Tree<'_>, word: NodeId) -> Name {
    Name { text: tree.slice(word).to_owned(), span: tree.span(word) }
}

/// Writes the agents of a task.
pub fn write_list(parts: &[Part]) -> String {
    let Some(first) = parts.first() else { return String::new() };
    let agents: Vec<&str> = parts.iter().map(|part| part.agent.as_str()).collect();
    let (problem, domain) = (&first.problem.name.text, &first.domain.name.text);
    let agents = agents.join(" ");
    let text = format!("(define (problem {problem})\n(:domain {domain})\n(:agents {agents}))\n");
    crate::format::format(&text).unwrap_or(text)
}
