//! A place in a text goes in; the places come out at which the same thing is declared and named.

use super::Workspace;
use crate::source::{SourceId, Span};
use crate::symbol::{Occurrence, Role, Symbol};

/// Where the name at `offset` is declared.
pub fn definition(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let Some(at) = workspace.at(id, offset) else { return Vec::new() };
    let target = workspace.target(id, at.symbol);
    target.map(|target| workspace.declarations(target)).unwrap_or_default()
}

/// Where the predicate at `offset` is made true, or the function gets a value.
pub fn achievers(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let at = workspace.at(id, offset);
    let Some(target) = at.and_then(|at| workspace.target(id, at.symbol)) else { return Vec::new() };
    let home = workspace.analysis(target.home).occurrences.list.iter();
    let gives = |one: &&Occurrence| {
        one.symbol == target.symbol && matches!(one.role, Role::Add | Role::Write)
    };
    home.filter(gives).map(|one| one.span).collect()
}

/// Every place at which the name at `offset` stands, in all texts; with the declaration only if that is asked for.
pub fn references(
    workspace: &Workspace,
    id: SourceId,
    offset: u32,
    declaration: bool,
) -> Vec<Span> {
    let Some(at) = workspace.at(id, offset) else { return Vec::new() };
    let found = match workspace.target(id, at.symbol) {
        Some(target) => workspace.occurrences(target),
        None => same(workspace, id, at),
    };
    let wanted = found.into_iter().filter(|one| declaration || one.role != Role::Declare);
    wanted.map(|one| one.span).collect()
}

/// The same in one text, each with what the name does there.
pub fn highlights(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<(Span, Role)> {
    let Some(at) = workspace.at(id, offset) else { return Vec::new() };
    let found = match at.symbol {
        Symbol::Known(..) => {
            let here = workspace.analysis(id).occurrences.list.iter();
            here.filter(|one| one.symbol == at.symbol).copied().collect()
        }
        Symbol::Unknown(_) => same(workspace, id, at),
    };
    found.into_iter().map(|one| (one.span, one.role)).collect()
}

/// The other places in a text at which an unknown name stands.
fn same(workspace: &Workspace, id: SourceId, at: Occurrence) -> Vec<Occurrence> {
    let spelling = |one: &Occurrence| workspace.sources().text(one.span);
    let here = workspace.analysis(id).occurrences.list.iter();
    here.filter(|one| one.symbol == at.symbol && spelling(one).eq_ignore_ascii_case(spelling(&at)))
        .copied()
        .collect()
}
