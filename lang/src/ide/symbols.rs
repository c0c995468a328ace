//! A text goes in, or a part of a name; the declared names come out, as an outline or as a list.

use super::outline::{Section, definition, head, sections};
use super::{Workspace, path, words};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence};
use crate::tree::Tree;

/// A part of a text with a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Its name, or its keyword.
    pub name: String,
    /// What else there is to say in a few words; may be empty.
    pub detail: String,
    /// What is declared; nothing for a section that only contains declarations.
    pub namespace: Option<Namespace>,
    /// All of it.
    pub span: Span,
    /// Its name alone.
    pub name_span: Span,
    /// The parts in it.
    pub children: Vec<Entry>,
}

/// The definition of a text, its sections, and what they declare.
pub fn outline(workspace: &Workspace, id: SourceId) -> Vec<Entry> {
    let tree = workspace.tree(id);
    let sections = sections(&tree);
    let Some(root) = definition(&tree).filter(|_| !workspace.is_plan(id)) else {
        return Vec::new();
    };
    let title = sections.first().filter(|section| section.is(&["domain", "problem"]));
    let rest = sections.iter().filter(|section| section.keyword.starts_with(':'));
    let names = workspace.declared(id);
    let children = rest.map(|section| entry(workspace, &tree, section, &names)).collect();
    let named = title.and_then(|title| title.name);
    let kind = title
        .map(|title| if title.is(&["domain"]) { Namespace::Domain } else { Namespace::Problem });
    let span = tree.span(root);
    vec![Entry {
        name: named.map_or("define", |(name, _)| name).to_owned(),
        detail: kind.map_or("", Namespace::describe).to_owned(),
        namespace: kind,
        span,
        name_span: named.map_or(Span { end: span.start + 1, ..span }, |(_, span)| span),
        children,
    }]
}

fn entry(
    workspace: &Workspace,
    tree: &Tree<'_>,
    section: &Section<'_>,
    names: &[Occurrence],
) -> Entry {
    let first = tree.children(section.node).next().expect("a section has a keyword");
    let keyword = tree.span(first);
    let kind = match section.keyword.to_ascii_lowercase().as_str() {
        ":action" | ":durative-action" | ":process" | ":event" => Some(Namespace::Action),
        ":derived" => Some(Namespace::Predicate),
        ":task" => Some(Namespace::Task),
        ":method" => Some(Namespace::Method),
        ":concurrency-constraint" => Some(Namespace::Constraint),
        _ => None,
    };
    let (span, node) = (section.span, section.node);
    if let (Some(kind), Some((name, name_span))) = (kind, section.name) {
        let (name, detail) = (name.to_owned(), section.keyword.to_owned());
        return Entry {
            name,
            detail,
            namespace: Some(kind),
            span,
            name_span,
            children: Vec::new(),
        };
    }
    let detail = match section.keyword.to_ascii_lowercase().as_str() {
        ":init" => words::count(tree.children(node).count() - 1, "fact"),
        ":domain" => section.name.map_or(String::new(), |(name, _)| name.to_owned()),
        _ => String::new(),
    };
    let children = declared(workspace, tree, section, names);
    let name = section.keyword.to_owned();
    Entry { name, detail, namespace: None, span, name_span: keyword, children }
}

/// What a section declares.
fn declared(
    workspace: &Workspace,
    tree: &Tree<'_>,
    section: &Section<'_>,
    names: &[Occurrence],
) -> Vec<Entry> {
    let lists = [":types", ":constants", ":objects", ":predicates", ":functions"];
    if !section.is(&lists) {
        return Vec::new();
    }
    let inside = |one: &&Occurrence| {
        (section.span.start..section.span.end).contains(&one.span.start)
            && one.symbol.namespace() != Namespace::Variable
    };
    let entry = |one: &Occurrence| {
        let name = workspace.sources().text(one.span);
        let kind = one.symbol.namespace();
        let list = matches!(kind, Namespace::Predicate | Namespace::Function)
            .then(|| path(tree, one.span.start))
            .and_then(|path| path.into_iter().rev().find(|&node| tree.is_list(node)))
            .filter(|&list| head(tree, list) == Some(name));
        let (detail, span) = match list {
            Some(list) => {
                (tree.slice(list).split_whitespace().collect::<Vec<_>>().join(" "), tree.span(list))
            }
            None => (String::new(), one.span),
        };
        Entry {
            name: name.to_owned(),
            detail,
            namespace: Some(kind),
            span,
            name_span: one.span,
            children: Vec::new(),
        }
    };
    names.iter().filter(inside).map(entry).collect()
}

/// A declared name in some text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// The name.
    pub name: String,
    /// What it is.
    pub namespace: Namespace,
    /// Where it is declared.
    pub span: Span,
    /// The name of what the text defines.
    pub container: String,
}

/// No more names are found at once.
const MANY: usize = 500;

/// All declared names of which the letters of `query` are a part in their order; those that begin with it come first.
pub fn search(workspace: &Workspace, query: &str) -> Vec<Found> {
    let query = query.to_ascii_lowercase();
    let mut found = Vec::new();
    for id in workspace.sources().ids().skip(1) {
        let analysis = workspace.analysis(id);
        let container = match (&analysis.domain, &analysis.problem) {
            (Some(domain), _) => &domain.name.text,
            (_, Some(problem)) => &problem.name.text,
            _ => continue,
        };
        for one in workspace.declared(id) {
            let namespace = one.symbol.namespace();
            let name = workspace.sources().text(one.span);
            let local = matches!(namespace, Namespace::Variable | Namespace::Subtask);
            if !local && contains(&name.to_ascii_lowercase(), &query) {
                let (name, container) = (name.to_owned(), container.clone());
                found.push(Found { name, namespace, span: one.span, container });
            }
        }
    }
    found.sort_by_cached_key(|one| {
        let name = one.name.to_ascii_lowercase();
        (name != query, !name.starts_with(&query), name, one.span)
    });
    found.truncate(MANY);
    found
}

/// Whether the letters of `part` come in this order in `name`.
fn contains(name: &str, part: &str) -> bool {
    let mut letters = name.chars();
    part.chars().all(|wanted| letters.any(|letter| letter == wanted))
}

#[cfg(test)]
mod tests {
    use super::{Entry, outline, search};
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};
    use crate::source::SourceId;

    fn shown(entries: &[Entry]) -> Vec<String> {
        let line = |one: &Entry| {
            let children: Vec<&str> =
                one.children.iter().map(|child| child.name.as_str()).collect();
            format!("{} | {} | {}", one.name, one.detail, children.join(" "))
        };
        entries.iter().map(line).collect()
    }

    #[test]
    fn sections_and_what_they_declare() {
        let (workspace, ..) = workspace(&[DOMAIN, PROBLEM]);
        let domain = outline(&workspace, SourceId(1));
        assert_eq!((domain.len(), domain[0].name.as_str()), (1, "kitchen"));
        assert_eq!(
            shown(&domain[0].children),
            [
                ":requirements |  | ",
                ":types |  | cup plate dish place",
                ":constants |  | sink",
                ":predicates |  | at clean",
                ":functions |  | total-cost effort",
                "wash | :action | ",
                "move | :action | ",
            ]
        );
        let problem = outline(&workspace, SourceId(2));
        assert_eq!(
            shown(&problem[0].children),
            [
                ":domain | kitchen | ",
                ":objects |  | mug shelf",
                ":init | 2 facts | ",
                ":goal |  | "
            ]
        );
    }

    #[test]
    fn unfinished_texts_have_an_outline() {
        let (workspace, ..) =
            workspace(&["(define (domain d)\n  (:action a\n  (:action b :effect (p))"]);
        let found = outline(&workspace, SourceId(1));
        assert_eq!(shown(&found[0].children), ["a | :action | ", "b | :action | "]);
        let (workspace, ..) = super::super::fixture::workspace(&["(define"]);
        assert_eq!(shown(&outline(&workspace, SourceId(1))), ["define |  | "]);
    }

    #[test]
    fn names_anywhere() {
        let (workspace, ..) = workspace(&[DOMAIN, PROBLEM]);
        let found = |query: &str| -> Vec<String> {
            search(&workspace, query)
                .into_iter()
                .map(|one| format!("{} in {}", one.name, one.container))
                .collect()
        };
        assert_eq!(found("sh"), ["shelf in breakfast", "dish in kitchen", "wash in kitchen"]);
        assert_eq!(found("mug"), ["mug in breakfast"]);
        assert_eq!(found("zz"), [""; 0]);
    }
}
