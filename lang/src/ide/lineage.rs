//! A type goes in, and the types above and below it come out; anything with a type goes in, and that type comes out.

use super::{Target, Workspace};
use crate::model::TypeId;
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Symbol};

/// Where the types are declared that are directly above the one at `offset`.
pub fn above(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let Some(of) = at(workspace, id, offset) else { return Vec::new() };
    declared(workspace, id, &workspace.domain(id).types[of.index()].parents)
}

/// Where the types are declared that are directly below the one at `offset`.
pub fn below(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let Some(of) = at(workspace, id, offset) else { return Vec::new() };
    let types = workspace.domain(id).types.iter().enumerate();
    let below: Vec<TypeId> = types
        .filter(|(_, one)| one.parents.contains(&of))
        .map(|(at, _)| TypeId(at as u32))
        .collect();
    declared(workspace, id, &below)
}

/// Where the types are declared of the variable or the object at `offset`.
pub fn typed_as(workspace: &Workspace, id: SourceId, offset: u32) -> Vec<Span> {
    let Some(one) = workspace.at(id, offset) else { return Vec::new() };
    let Symbol::Known(namespace, number) = one.symbol else { return Vec::new() };
    let domain = workspace.domain(id);
    let types = match namespace {
        Namespace::Variable => {
            let variable = workspace.analysis(id).occurrences.variable(number);
            variable.map(|variable| variable.types.as_slice())
        }
        Namespace::Object => {
            let problem = workspace.problem(id);
            let objects = problem.map_or(&domain.constants, |problem| &problem.objects);
            objects.get(number as usize).map(|object| object.types.as_slice())
        }
        _ => None,
    };
    declared(workspace, id, types.unwrap_or_default())
}

/// Where the type at `offset` is declared.
pub fn type_at(workspace: &Workspace, id: SourceId, offset: u32) -> Option<Span> {
    let of = at(workspace, id, offset)?;
    declared(workspace, id, &[of]).into_iter().next()
}

/// The type at a place.
fn at(workspace: &Workspace, id: SourceId, offset: u32) -> Option<TypeId> {
    match workspace.at(id, offset)?.symbol {
        Symbol::Known(Namespace::Type, number) => Some(TypeId(number)),
        _ => None,
    }
}

fn declared(workspace: &Workspace, id: SourceId, types: &[TypeId]) -> Vec<Span> {
    let Some(home) = workspace.home(id) else { return Vec::new() };
    let place = |&of: &TypeId| {
        let target = Target { home, symbol: of.into() };
        workspace.declarations(target).into_iter().next()
    };
    types.iter().filter_map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::{above, below, typed_as};
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};

    #[test]
    fn types_above_and_below() {
        let (workspace, id, offset) =
            workspace(&[&DOMAIN.replace("?d - dish ?p", "?d - d$0ish ?p")]);
        let names = |spans: Vec<crate::source::Span>| -> Vec<&str> {
            spans.into_iter().map(|span| workspace.sources().text(span)).collect()
        };
        assert_eq!(names(below(&workspace, id, offset)), ["cup", "plate"]);
        assert_eq!(names(above(&workspace, id, offset)), [""; 0]);
        let cup = DOMAIN.find("cup").expect("it is there") as u32;
        assert_eq!(names(above(&workspace, id, cup)), ["dish"]);
    }

    #[test]
    fn the_type_of_an_object() {
        let text = PROBLEM.replace("(clean mug)", "(clean m$0ug)");
        let (workspace, id, offset) = workspace(&[DOMAIN, &text]);
        let found = typed_as(&workspace, id, offset);
        assert_eq!(found.len(), 1);
        assert_eq!(workspace.sources().text(found[0]), "cup");
        assert_ne!(found[0].source, id);
    }
}
