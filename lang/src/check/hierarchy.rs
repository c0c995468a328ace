//! The type hierarchy: several parents, types that are used before they are declared, cycles.

use petgraph::Direction::Outgoing;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::index::Index;
use super::{OBJECT, Report, name};
use crate::ast::{Name, TypeReference, TypedList};
use crate::diagnostic::{cyclic_types, unknown_type};
use crate::model::{self, Type, TypeId};
use crate::source::Span;
use crate::symbol::Namespace;

/// Builds the table of types from all `:types` sections.
pub(super) fn build<'a>(
    lists: &[&TypedList<'a>],
    domain: Span,
    index: &mut Index<'a>,
    report: &mut Report<'_>,
) -> Vec<Type> {
    let object = model::Name { text: "object".to_owned(), span: domain };
    let mut types = vec![Type { name: object, parents: Vec::new(), ancestors: Vec::new() }];
    index.insert("object", OBJECT.0);
    let mut known = |spelling: Name<'a>, types: &mut Vec<Type>| -> TypeId {
        if let Some(id) = index.find(spelling.text) {
            return TypeId(id);
        }
        let id = types.len() as u32;
        index.insert(spelling.text, id);
        types.push(Type { name: name(spelling), parents: Vec::new(), ancestors: Vec::new() });
        TypeId(id)
    };
    for (spelling, above) in lists.iter().flat_map(|list| list.entries()) {
        let id = known(spelling, &mut types);
        report.declared(spelling, id);
        let above = above.map_or(&[][..], |above| &above.names);
        for &spelling in above.iter().filter(|spelling| !spelling.text.is_empty()) {
            let parent = known(spelling, &mut types);
            report.found(spelling, parent);
            // What stands above `object` is of no use: everything is an object.
            if id != OBJECT && !types[id.index()].parents.contains(&parent) {
                types[id.index()].parents.push(parent);
            }
        }
    }
    close(&mut types, report);
    types
}

/// Reports cycles, takes them apart and fills in the ancestors.
fn close(types: &mut [Type], report: &mut Report<'_>) {
    let mut graph = DiGraph::<(), ()>::with_capacity(types.len(), types.len());
    for _ in 0..types.len() {
        graph.add_node(());
    }
    for (id, of) in types.iter().enumerate() {
        for parent in &of.parents {
            graph.add_edge(NodeIndex::new(id), NodeIndex::new(parent.index()), ());
        }
    }
    let mut component_of = vec![0; types.len()];
    // Components come in post-order: what is above comes first.
    let components = kosaraju_scc(&graph);
    for (number, component) in components.iter().enumerate() {
        for &node in component {
            component_of[node.index()] = number;
        }
        let alone = component.len() == 1;
        if !alone || graph.contains_edge(component[0], component[0]) {
            report_cycle(&graph, component, types, report);
        }
    }
    for (number, component) in components.iter().enumerate() {
        // The types of a cycle are the same, so far as anybody can tell, and so have all the same above them.
        let members = component.iter().map(|node| TypeId(node.index() as u32));
        let mut ancestors: Vec<TypeId> = members.clone().chain([OBJECT]).collect();
        for id in members.clone() {
            let of = &mut types[id.index()];
            of.parents.retain(|parent| component_of[parent.index()] != number);
            if of.parents.is_empty() && id != OBJECT {
                of.parents.push(OBJECT);
            }
            for parent in types[id.index()].parents.clone() {
                ancestors.extend_from_slice(&types[parent.index()].ancestors);
            }
        }
        ancestors.sort_unstable();
        ancestors.dedup();
        for id in members {
            types[id.index()].ancestors.clone_from(&ancestors);
        }
    }
}

/// Walks round the cycle from the type that is declared first.
fn report_cycle(
    graph: &DiGraph<(), ()>,
    component: &[NodeIndex],
    types: &[Type],
    report: &mut Report<'_>,
) {
    let start = component.iter().copied().min().expect("a component is never empty");
    let mut cycle = vec![start];
    loop {
        let at = *cycle.last().expect("the walk has a start");
        let mut above =
            graph.neighbors_directed(at, Outgoing).filter(|next| component.contains(next));
        match above.next() {
            Some(next) if !cycle.contains(&next) && cycle.len() < SHOWN => cycle.push(next),
            _ => break,
        }
    }
    let names: Vec<String> =
        cycle.iter().map(|node| types[node.index()].name.text.clone()).collect();
    let spans: Vec<Span> = cycle.iter().map(|node| types[node.index()].name.span).collect();
    report.push(cyclic_types::cyclic_types(&names, spans[0], &spans[1..]));
}

/// How many types of a cycle a message names.
const SHOWN: usize = 8;

/// What follows a `-`, as ids: `object` without one, nothing after a mistake.
pub(super) fn resolve(
    reference: Option<&TypeReference<'_>>,
    index: &Index<'_>,
    place: &str,
    report: &mut Report<'_>,
) -> Vec<TypeId> {
    let Some(reference) = reference else { return vec![OBJECT] };
    let mut types = Vec::with_capacity(reference.names.len());
    let mut unknown = false;
    for spelling in &reference.names {
        if let Some(id) = index.find(spelling.text) {
            types.push(TypeId(id));
            report.found(*spelling, TypeId(id));
            continue;
        }
        unknown = true;
        report.lost(*spelling, Namespace::Type);
        if !spelling.text.is_empty() && report.first(&unknown_type::RULE, spelling.text) {
            let near = report.nearest(spelling.text, index);
            report.push(unknown_type::unknown_type(spelling.text, spelling.span, place, near));
        }
    }
    if unknown { Vec::new() } else { types }
}
