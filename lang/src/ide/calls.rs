//! A predicate goes in, and the actions come out that make it true and that need it; an action goes in, and the predicates come out.
//!
//! Going from one to the other and on is what a planner does when it looks for a plan from the goal.

use super::Workspace;
use super::outline::{Section, around, sections};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Role, Symbol};

/// A predicate, a function, an action or a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caller {
    /// Its name.
    pub name: String,
    /// What it is: "action", "predicate".
    pub kind: String,
    /// Whether it is done and not true or false.
    pub acts: bool,
    /// All of it.
    pub span: Span,
    /// A place in it that stands for it: its name, and of a rule the keyword.
    pub place: Span,
}

/// Something that is connected, and the places at which it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// What is connected.
    pub other: Caller,
    /// Where.
    pub places: Vec<Span>,
}

/// What the word at `offset` stands for.
pub fn caller(workspace: &Workspace, id: SourceId, offset: u32) -> Option<Caller> {
    if let Some(at) = workspace.at(id, offset) {
        match at.symbol.namespace() {
            Namespace::Predicate | Namespace::Function => fluent(workspace, id, at.symbol),
            Namespace::Action => {
                let target = workspace.target(id, at.symbol)?;
                let declared = workspace.declarations(target).into_iter().next()?;
                let tree = workspace.tree(declared.source);
                let sections = sections(&tree);
                around(&sections, declared.start).map(|section| doing(&tree, section))
            }
            _ => None,
        }
    } else {
        let tree = workspace.tree(id);
        let sections = sections(&tree);
        let section = around(&sections, offset).filter(|section| section.is(&[":derived"]))?;
        let rule = doing(&tree, section);
        (rule.place.start <= offset && offset <= rule.place.end).then_some(rule)
    }
}

/// A predicate or a function where it is declared.
fn fluent(workspace: &Workspace, id: SourceId, symbol: Symbol) -> Option<Caller> {
    let place = workspace.declarations(workspace.target(id, symbol)?).into_iter().next()?;
    Some(Caller {
        name: workspace.sources().text(place).to_owned(),
        kind: symbol.namespace().describe().to_owned(),
        acts: false,
        span: place,
        place,
    })
}

/// A section that does something.
fn doing(tree: &crate::tree::Tree<'_>, section: &Section<'_>) -> Caller {
    let keyword = tree.children(section.node).next().expect("a section has a keyword");
    let keyword = tree.span(keyword);
    let rule = section.is(&[":derived"]);
    let (name, place) = section.name.unwrap_or((section.keyword, keyword));
    Caller {
        name: name.to_owned(),
        kind: if rule { "rule" } else { section.keyword.trim_start_matches(':') }.to_owned(),
        acts: true,
        span: section.span,
        place: if rule { keyword } else { place },
    }
}

/// What makes a predicate true or writes a function; what an action or a rule needs.
pub fn incoming(workspace: &Workspace, of: &Caller) -> Vec<Call> {
    if of.acts {
        inside(workspace, of, &[Role::Read])
    } else {
        outside(workspace, of, &[Role::Add, Role::Write])
    }
}

/// What needs a predicate or a function; what an action or a rule makes true or writes.
pub fn outgoing(workspace: &Workspace, of: &Caller) -> Vec<Call> {
    if of.acts {
        inside(workspace, of, &[Role::Add, Role::Write])
    } else {
        outside(workspace, of, &[Role::Read])
    }
}

/// The predicates and functions that have one of these roles in an action.
fn inside(workspace: &Workspace, of: &Caller, roles: &[Role]) -> Vec<Call> {
    let id = of.span.source;
    let names = workspace.analysis(id).occurrences.within(of.span.start, of.span.end);
    let fluents = names.iter().filter(|one| {
        roles.contains(&one.role)
            && matches!(one.symbol, Symbol::Known(Namespace::Predicate | Namespace::Function, _))
    });
    gather(fluents, |one| fluent(workspace, id, one.symbol))
}

/// The actions in which a predicate or a function has one of these roles.
fn outside(workspace: &Workspace, of: &Caller, roles: &[Role]) -> Vec<Call> {
    let id = of.span.source;
    let Some(at) = workspace.at(id, of.place.start) else { return Vec::new() };
    let tree = workspace.tree(id);
    let sections = sections(&tree);
    let names = workspace.analysis(id).occurrences.list.iter();
    let uses = names.filter(|one| one.symbol == at.symbol && roles.contains(&one.role));
    gather(uses, |one| {
        let section = around(&sections, one.span.start)?;
        (!section.is(&[":predicates", ":functions"])).then(|| doing(&tree, section))
    })
}

fn gather<'o>(
    names: impl Iterator<Item = &'o Occurrence>,
    mut other: impl FnMut(&Occurrence) -> Option<Caller>,
) -> Vec<Call> {
    let mut calls: Vec<Call> = Vec::new();
    for one in names {
        let Some(other) = other(one) else { continue };
        match calls.iter_mut().find(|call| call.other == other) {
            Some(call) => call.places.push(one.span),
            None => calls.push(Call { other, places: vec![one.span] }),
        }
    }
    calls
}

#[cfg(test)]
mod tests {
    use super::{Call, caller, incoming, outgoing};
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};

    fn names(calls: &[Call]) -> Vec<String> {
        calls.iter().map(|call| format!("{} {}", call.other.kind, call.other.name)).collect()
    }

    #[track_caller]
    fn both(texts: &[&str]) -> (Vec<String>, Vec<String>) {
        let (workspace, id, offset) = workspace(texts);
        let of = caller(&workspace, id, offset).expect("something stands here");
        (names(&incoming(&workspace, &of)), names(&outgoing(&workspace, &of)))
    }

    #[test]
    fn a_predicate_has_achievers_and_consumers() {
        let text = PROBLEM.replace("(at mug", "(a$0t mug");
        let (before, after) = both(&[DOMAIN, &text]);
        assert_eq!(before, ["action move"]);
        assert_eq!(after, ["action wash", "action move"]);
    }

    #[test]
    fn an_action_needs_and_gives() {
        let (before, after) = both(&[&DOMAIN.replace(":action wash", ":action wa$0sh")]);
        assert_eq!(before, ["predicate at", "function effort"]);
        assert_eq!(after, ["predicate clean", "function total-cost"]);
    }

    #[test]
    fn rules_count_as_well() {
        let rule =
            DOMAIN.replace("  ; Water", "  (:derived (clean ?d - dish) (at ?d sink))\n  ; Water");
        let (before, _) = both(&[&rule.replace("(clean ?d - dish))", "(cl$0ean ?d - dish))")]);
        assert_eq!(before, ["rule clean", "action wash"]);
        let (before, after) = both(&[&rule.replace(":derived", ":der$0ived")]);
        assert_eq!(
            (before, after),
            (vec!["predicate at".to_owned()], vec!["predicate clean".to_owned()])
        );
    }
}
