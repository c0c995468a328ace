//! A range of a text goes in; small things come out to be shown between the words there.

use super::{Workspace, hover, outline, words};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Role, Symbol};
use crate::tree::{NodeId, Tree};

/// Something to be shown at a byte.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hint {
    /// Before this byte.
    pub offset: u32,
    /// What is shown.
    pub label: String,
    /// Whether it names a parameter; otherwise it says a type or what ends here.
    pub parameter: bool,
}

/// A section of so many lines is named again where it ends.
const LONG: usize = 25;

/// What helps to read the lists that start between two bytes: the types that a rule takes from its predicate, and which section ends.
///
/// With `arguments` each argument gets the name of its parameter, which few want to see all the time.
pub fn hints(workspace: &Workspace, within: Span, arguments: bool) -> Vec<Hint> {
    let id = within.source;
    if workspace.is_plan(id) {
        return Vec::new();
    }
    let tree = workspace.tree(id);
    let mut found = Vec::new();
    for section in outline::sections(&tree) {
        if section.span.start > within.end || section.span.end < within.start {
            continue;
        }
        if section.is(&[":derived"]) {
            rule(workspace, &tree, section.node, &mut found);
        }
        let lines = tree.slice(section.node).bytes().filter(|&byte| byte == b'\n').count();
        if lines >= LONG {
            let label = section.name.map_or(section.keyword, |(name, _)| name).to_owned();
            found.push(Hint { offset: section.span.end, label, parameter: false });
        }
    }
    if arguments {
        let names = workspace.analysis(id).occurrences.within(within.start, within.end);
        for one in names.iter().filter(|one| one.role != Role::Declare) {
            applied(workspace, &tree, id, one, &mut found);
        }
    }
    found.retain(|hint| (within.start..=within.end).contains(&hint.offset));
    found.sort_by_key(|hint| hint.offset);
    found
}

/// The types that the variables of a rule have from its predicate.
fn rule(workspace: &Workspace, tree: &Tree<'_>, section: NodeId, found: &mut Vec<Hint>) {
    let domain = workspace.domain(tree.source);
    let Some(list) = tree.children(section).nth(1).filter(|&list| tree.is_list(list)) else {
        return;
    };
    let mut parts = tree.children(list);
    let head = parts.next().and_then(|head| workspace.at(tree.source, tree.node(head).start));
    let Some((_, parameters)) = head.and_then(|head| hover::parameters(domain, head.symbol)) else {
        return;
    };
    let variables: Vec<NodeId> = parts.collect();
    let typed = variables.iter().any(|&one| tree.slice(one) == "-");
    if typed || domain.types.len() <= 1 || variables.len() != parameters.len() {
        return;
    }
    for (variable, parameter) in variables.into_iter().zip(parameters) {
        let label = format!(" - {}", words::types(domain, &parameter.types));
        found.push(Hint { offset: tree.node(variable).end, label, parameter: false });
    }
}

/// The names of the parameters at the arguments of one predicate or function.
fn applied(
    workspace: &Workspace,
    tree: &Tree<'_>,
    id: SourceId,
    one: &Occurrence,
    found: &mut Vec<Hint>,
) {
    let known = matches!(one.symbol, Symbol::Known(Namespace::Predicate | Namespace::Function, _));
    let parameters = hover::parameters(workspace.domain(id), one.symbol).filter(|_| known);
    let Some((_, parameters)) = parameters else { return };
    let path = super::path(tree, one.span.start);
    let Some(&list) = path.iter().rev().find(|&&node| tree.is_list(node)) else { return };
    for (argument, parameter) in tree.children(list).skip(1).zip(parameters) {
        let name = parameter.name.text.trim_start_matches('?');
        if !tree.slice(argument).trim_start_matches('?').eq_ignore_ascii_case(name) {
            let offset = tree.node(argument).start;
            found.push(Hint { offset, label: format!("{name}:"), parameter: true });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::hints;
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};
    use crate::source::{SourceId, Span};

    #[track_caller]
    fn shown(texts: &[&str], id: u32, arguments: bool) -> Vec<String> {
        let (workspace, ..) = workspace(texts);
        let text = workspace.text(SourceId(id));
        let found = hints(&workspace, Span::new(SourceId(id), 0, text.len() as u32), arguments);
        found
            .into_iter()
            .map(|hint| {
                let before = text[..hint.offset as usize].split_whitespace().last().unwrap_or("");
                format!("{before}|{}", hint.label)
            })
            .collect()
    }

    #[test]
    fn types_that_a_rule_does_not_write() {
        let text = DOMAIN.replace("  ; Water", "  (:derived (at ?d ?p) (clean ?d))\n  ; Water");
        assert_eq!(shown(&[&text], 1, false), ["?d| - dish", "?p| - place"]);
        let text = text.replace("(at ?d ?p) (clean", "(at ?d - dish ?p - place) (clean");
        assert_eq!(shown(&[&text], 1, false), [""; 0]);
    }

    #[test]
    fn the_end_of_a_long_section() {
        let text =
            DOMAIN.replace("(and (clean ?d)", &format!("(and {}(clean ?d)", "\n".repeat(30)));
        assert_eq!(shown(&[&text], 1, false), ["?d))))|wash"]);
    }

    #[test]
    fn parameters_at_arguments_if_wanted() {
        assert_eq!(
            shown(&[DOMAIN, PROBLEM], 2, true),
            ["(at|d:", "mug|p:", "(effort|d:", "(clean|d:"]
        );
        assert_eq!(shown(&[DOMAIN, PROBLEM], 2, false), [""; 0]);
    }
}
