//! A tree goes in; its sections come out: where each begins and ends, and what it is called.

use crate::source::Span;
use crate::tree::{NodeId, Tree};

/// A list directly in the definition.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section<'a> {
    /// Its first word, such as `:action`.
    pub(super) keyword: &'a str,
    /// The name that follows, such as that of an action; of a rule that of its head.
    pub(super) name: Option<(&'a str, Span)>,
    /// All of it.
    pub(super) span: Span,
    /// The list.
    pub(super) node: NodeId,
}

impl Section<'_> {
    /// Whether its keyword is one of these.
    pub(super) fn is(&self, keywords: &[&str]) -> bool {
        keywords.iter().any(|keyword| keyword.eq_ignore_ascii_case(self.keyword))
    }

    /// As messages speak of it: "action `drive`".
    pub(super) fn describe(&self) -> String {
        let kind = self.keyword.trim_start_matches(':').to_ascii_lowercase();
        match (kind.as_str(), self.name) {
            ("derived", Some((name, _))) => format!("rule for `{name}`"),
            (_, Some((name, _))) => format!("{} `{name}`", kind.replace('-', " ")),
            ("init", None) => "initial state".to_owned(),
            (_, None) => kind.replace('-', " "),
        }
    }
}

/// The list that is the definition.
pub(super) fn definition(tree: &Tree<'_>) -> Option<NodeId> {
    tree.roots().find(|&root| tree.is_list(root))
}

/// The sections in the order of the text.
pub(super) fn sections<'a>(tree: &Tree<'a>) -> Vec<Section<'a>> {
    let Some(root) = definition(tree) else { return Vec::new() };
    tree.children(root).filter_map(|list| section(tree, list)).collect()
}

fn section<'a>(tree: &Tree<'a>, list: NodeId) -> Option<Section<'a>> {
    let keyword = head(tree, list)?;
    let second = tree.children(list).nth(1);
    let named = match second {
        Some(second) if tree.is_list(second) && keyword.eq_ignore_ascii_case(":derived") => {
            tree.children(second).next().filter(|&name| !tree.is_list(name))
        }
        Some(second) if is_named(keyword) && !tree.is_list(second) => Some(second),
        _ => None,
    };
    let named = named.map(|name| (tree.slice(name), tree.span(name)));
    let name = named.filter(|(name, _)| !name.starts_with([':', '?', '-']));
    Some(Section { keyword, name, span: tree.span(list), node: list })
}

/// Whether a name follows the keyword.
fn is_named(keyword: &str) -> bool {
    let named = [
        ":action",
        ":durative-action",
        ":process",
        ":event",
        ":task",
        ":method",
        ":concurrency-constraint",
        ":domain",
        "domain",
        "problem",
    ];
    named.iter().any(|one| one.eq_ignore_ascii_case(keyword))
}

/// The first word of a list.
pub(super) fn head<'a>(tree: &Tree<'a>, list: NodeId) -> Option<&'a str> {
    if !tree.is_list(list) {
        return None;
    }
    let first = tree.children(list).next()?;
    (!tree.is_list(first)).then(|| tree.slice(first))
}

/// The section that a byte lies in.
pub(super) fn around<'s, 'a>(sections: &'s [Section<'a>], offset: u32) -> Option<&'s Section<'a>> {
    let after = sections.partition_point(|section| section.span.start <= offset);
    sections[..after].last().filter(|section| offset < section.span.end)
}
