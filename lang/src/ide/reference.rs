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

#[cfg(test)]
mod tests {
    use super::{achievers, definition, highlights, references};
    use crate::ide::Workspace;
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};
    use crate::source::Span;
    use crate::symbol::Role;

    const PLAN: &str = "(move mug shelf sink)\n(wash mug)\n";

    /// Each place as the number of its text and the line from there on.
    fn shown(workspace: &Workspace, spans: &[Span]) -> Vec<String> {
        let line = |span: &Span| {
            let rest = &workspace.text(span.source)[span.start as usize..];
            format!("{}: {}", span.source.0, rest.lines().next().unwrap_or(""))
        };
        spans.iter().map(line).collect()
    }

    #[test]
    fn from_a_problem_into_its_domain() {
        let text = PROBLEM.replace("(clean", "(c$0lean");
        let (workspace, id, offset) = workspace(&[DOMAIN, &text]);
        let found = definition(&workspace, id, offset);
        assert_eq!(shown(&workspace, &found), ["1: clean ?d - dish))"]);
    }

    #[test]
    fn everything_has_a_definition() {
        for (old, new, wanted) in [
            ("(:domain kitchen", "(:domain kit$0chen", "1: kitchen)"),
            ("mug - cup", "mug - c$0up", "1: cup plate - dish place)"),
            ("(at mug", "(at $0mug", "2: mug - cup shelf - place)"),
            ("(effort mug", "(eff$0ort mug", "1: effort ?d - dish) - number)"),
        ] {
            let text = PROBLEM.replacen(old, new, 1);
            let (workspace, id, offset) = workspace(&[DOMAIN, &text]);
            assert_eq!(shown(&workspace, &definition(&workspace, id, offset)), [wanted]);
        }
        // A type that only ever stands above others is declared there.
        let text = DOMAIN.replace("(?d - dish ?from", "(?d - di$0sh ?from");
        let (workspace, id, offset) = workspace(&[&text]);
        assert_eq!(shown(&workspace, &definition(&workspace, id, offset)), ["1: dish place)"]);
    }

    #[test]
    fn a_name_in_all_texts() {
        let text = PROBLEM.replacen("mug - cup", "mu$0g - cup", 1);
        let (workspace, id, offset) = workspace(&[DOMAIN, &text, PLAN]);
        let found = references(&workspace, id, offset, true);
        assert_eq!(found.iter().filter(|span| span.source == id).count(), 4);
        assert_eq!(found.len(), 6);
        assert_eq!(references(&workspace, id, offset, false).len(), 5);
        let text = DOMAIN.replace(":action move", ":action $0move");
        let (workspace, id, offset) = super::super::fixture::workspace(&[&text, PROBLEM, PLAN]);
        let found = references(&workspace, id, offset, false);
        assert_eq!(shown(&workspace, &found), ["3: move mug shelf sink)"]);
    }

    #[test]
    fn variables_stay_in_their_action() {
        let text = DOMAIN.replace("(at ?d sink)", "(at ?$0d sink)");
        let (workspace, id, offset) = workspace(&[&text]);
        assert_eq!(references(&workspace, id, offset, true).len(), 4);
    }

    #[test]
    fn highlights_say_what_is_done() {
        let text = DOMAIN.replace("(not (at", "(not (a$0t");
        let (workspace, id, offset) = workspace(&[&text]);
        let roles: Vec<Role> =
            highlights(&workspace, id, offset).into_iter().map(|(_, role)| role).collect();
        assert_eq!(roles, [Role::Declare, Role::Read, Role::Read, Role::Delete, Role::Add]);
        let spans = achievers(&workspace, id, offset);
        assert_eq!(shown(&workspace, &spans), ["1: at ?d ?to))))"]);
    }

    #[test]
    fn unknown_names_are_found_again_where_they_stand() {
        let text = DOMAIN.replace("(clean ?d) (inc", "(cl$0ene ?d) (not (clene ?d)) (inc");
        let (workspace, id, offset) = workspace(&[&text]);
        assert_eq!(references(&workspace, id, offset, true).len(), 2);
        assert_eq!(definition(&workspace, id, offset), []);
    }
}
