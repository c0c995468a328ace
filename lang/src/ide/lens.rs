//! A domain goes in; how many change and how many need each predicate and function comes out, to be shown above it.

use super::hover::owners;
use super::outline::sections;
use super::{Workspace, words};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Role};

/// A line above a declaration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lens {
    /// The name that is declared.
    pub span: Span,
    /// What is shown.
    pub title: String,
}

/// A line for each predicate and function.
pub fn lenses(workspace: &Workspace, id: SourceId) -> Vec<Lens> {
    let tree = workspace.tree(id);
    let sections = sections(&tree);
    let list = &workspace.analysis(id).occurrences.list;
    let mut declared: Vec<&Occurrence> = list
        .iter()
        .filter(|one| {
            one.role == Role::Declare
                && matches!(one.symbol.namespace(), Namespace::Predicate | Namespace::Function)
        })
        .collect();
    declared.dedup_by_key(|one| one.symbol);
    // One walk for all of them, since there may be many.
    let mut uses: Vec<Occurrence> = list.clone();
    uses.sort_by_key(|one| one.symbol);
    let lens = |one: &Occurrence| {
        let first = uses.partition_point(|other| other.symbol < one.symbol);
        let after = uses.partition_point(|other| other.symbol <= one.symbol);
        let count = |roles: &[Role], word: &str| {
            words::count(owners(&sections, &uses[first..after], roles).len(), word)
        };
        let counts = match one.symbol.namespace() {
            Namespace::Predicate => vec![
                count(&[Role::Add], "achiever"),
                count(&[Role::Delete], "deleter"),
                count(&[Role::Read], "reader"),
            ],
            _ => vec![count(&[Role::Write], "writer"), count(&[Role::Read], "reader")],
        };
        Lens { span: one.span, title: counts.join(" · ") }
    };
    declared.into_iter().map(lens).collect()
}

#[cfg(test)]
mod tests {
    use super::lenses;
    use crate::ide::fixture::{DOMAIN, workspace};
    use crate::source::SourceId;

    #[test]
    fn who_changes_and_who_needs() {
        let (workspace, ..) = workspace(&[DOMAIN]);
        let found: Vec<String> = lenses(&workspace, SourceId(1))
            .into_iter()
            .map(|lens| format!("{}: {}", workspace.sources().text(lens.span), lens.title))
            .collect();
        assert_eq!(
            found,
            [
                "at: 1 achiever · 1 deleter · 2 readers",
                "clean: 1 achiever · 0 deleters · 0 readers",
                "total-cost: 1 writer · 0 readers",
                "effort: 0 writers · 1 reader",
            ]
        );
    }
}
