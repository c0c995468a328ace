//! Schemas go in; the groups of them come out whose joint actions cannot always be taken one after another.
//!
//! A part that may destroy what another needs must come after it, and so must one that may change what another's effects depend on.
//! Parts whose conditions name one another belong together. Where that leaves an order, taking the parts of any joint action in this order
//! leads to the same state; the strongly connected components in which it leaves none are the groups.

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::schema::{Schema, may_meet};
use super::team::{Finder, Member, Team};
use super::world::World;
use crate::condition::Condition;
use crate::model::{Atom, Literal, NodeKind, PredicateId, Term, VariableId};

/// Which schemas must be able to act in one joint step, by their places.
pub(super) fn groups(finder: &Finder<'_>, feeds: &Feeds) -> Vec<Vec<usize>> {
    let schemas = finder.schemas;
    let mut graph = DiGraph::<usize, ()>::new();
    let nodes: Vec<NodeIndex> = (0..schemas.len()).map(|at| graph.add_node(at)).collect();
    for one in 0..schemas.len() {
        for other in 0..schemas.len() {
            if names(&schemas[one], &schemas[other]) {
                graph.update_edge(nodes[one], nodes[other], ());
                graph.update_edge(nodes[other], nodes[one], ());
            } else if disturbs(finder, feeds, one, other) {
                graph.update_edge(nodes[one], nodes[other], ());
            }
        }
    }
    let alone = |group: &[NodeIndex]| group.len() == 1 && !graph.contains_edge(group[0], group[0]);
    let mut groups: Vec<Vec<usize>> = kosaraju_scc(&graph)
        .into_iter()
        .filter(|group| !alone(group))
        .map(|group| {
            let mut group: Vec<usize> = group.into_iter().map(|node| graph[node]).collect();
            group.sort_unstable();
            group
        })
        .collect();
    groups.sort();
    groups
}

/// Whether `one` needs `other` in the joint action, or its effects depend on whether it is there.
fn names(one: &Schema, other: &Schema) -> bool {
    let named = |leaf: &Condition, wanted: &dyn Fn(bool) -> bool| match leaf {
        Condition::Action(atom, holds) => atom.action == other.id && wanted(*holds),
        _ => false,
    };
    one.stated().any(|part| part.some(|leaf| named(leaf, &|holds| holds)))
        || one.effects.iter().any(|effect| effect.condition.some(|leaf| named(leaf, &|_| true)))
}

/// Which derived predicates depend on which.
#[derive(Debug)]
pub(super) struct Feeds {
    /// For each predicate those that it is derived from, itself included.
    below: Vec<Vec<PredicateId>>,
}

impl Feeds {
    pub(super) fn new(world: &World<'_>) -> Self {
        let count = world.domain.predicates.len();
        let mut below: Vec<Vec<PredicateId>> =
            (0..count as u32).map(|at| vec![PredicateId(at)]).collect();
        let mut changed = true;
        while changed {
            changed = false;
            for axiom in &world.domain.axioms {
                for node in &axiom.body.nodes {
                    let NodeKind::Atom(atom) = &node.kind else { continue };
                    for predicate in below[atom.predicate.index()].clone() {
                        let head = &mut below[axiom.head.index()];
                        if !head.contains(&predicate) {
                            head.push(predicate);
                            changed = true;
                        }
                    }
                }
            }
        }
        Self { below }
    }

    /// Whether an effect of a part of another agent may change `atom`; a derived one may become true or false by any effect on what it depends on.
    pub(super) fn touches(
        &self,
        world: &World<'_>,
        (one, literal): (&Schema, &Literal),
        (other, atom): (&Schema, &Atom),
    ) -> bool {
        if world.domain.predicates[atom.predicate.index()].derived {
            return self.below[atom.predicate.index()].contains(&literal.atom.predicate);
        }
        may_meet(world, (one, &literal.atom), (other, atom))
    }
}

/// Whether `one` may destroy what `other` needs, or change what its effects depend on, and so must come after it.
fn disturbs(finder: &Finder<'_>, feeds: &Feeds, one: usize, other: usize) -> bool {
    let (left, right) = (&finder.schemas[one], &finder.schemas[other]);
    let mut read: Vec<(Atom, Option<bool>)> = Vec::new();
    right.precondition.visit(&mut |leaf| {
        if let Condition::Atom(atom, holds) = leaf {
            let derived = finder.world.domain.predicates[atom.predicate.index()].derived;
            read.push((atom.clone(), (!derived).then_some(*holds)));
        }
    });
    let conditions = right.effects.iter().map(|effect| &effect.condition);
    let prices = right.increases.iter().filter_map(|one| Condition::new(&one.condition));
    for condition in conditions.cloned().chain(prices) {
        condition.visit(&mut |leaf| {
            if let Condition::Atom(atom, _) = leaf {
                read.push((atom.clone(), None));
            }
        });
    }
    let literals = left.effects.iter().flat_map(|effect| &effect.literals);
    literals.into_iter().any(|literal| {
        read.iter().any(|(atom, harmed)| {
            harmed.is_none_or(|holds| holds != literal.positive)
                && feeds.touches(finder.world, (left, literal), (right, atom))
                && !excluded(finder, (one, &literal.atom), (other, atom))
        })
    })
}

/// Whether two parts can never stand in one joint action when these atoms are the same fact.
fn excluded(
    finder: &Finder<'_>,
    (one, atom): (usize, &Atom),
    (other, against): (usize, &Atom),
) -> bool {
    let (left, right) = (&finder.schemas[one], &finder.schemas[other]);
    if !left.agent && !right.agent {
        return true;
    }
    let mut variables = left.parameters().to_vec();
    variables.extend(right.parameters().iter().cloned());
    let shift = left.scope.parameters;
    let arguments = |from: u32, to: u32| (from..to).map(|at| Term::Variable(VariableId(at)));
    let first = Member { schema: one, arguments: arguments(0, shift).collect() };
    let second =
        Member { schema: other, arguments: arguments(shift, variables.len() as u32).collect() };
    let mut team = Team { variables, members: vec![first, second] };
    if atom.predicate == against.predicate {
        for (&mine, &theirs) in atom.arguments.iter().zip(&against.arguments) {
            let place = |term: Term, schema: &Schema, shift: u32| match term {
                Term::Object(_) => Some(term),
                Term::Variable(id) if id.0 < schema.scope.parameters => {
                    Some(Term::Variable(VariableId(id.0 + shift)))
                }
                Term::Variable(_) => None,
            };
            if let (Some(mine), Some(theirs)) = (place(mine, left, 0), place(theirs, right, shift))
            {
                unify(&mut team, mine, theirs);
            }
        }
    }
    let mut seen: Vec<(Atom, bool)> = Vec::new();
    for of in 0..2 {
        let schema = &finder.schemas[team.members[of].schema];
        for part in schema.demands() {
            // Others may do what is asked for.
            let hopeful = part.clone().map(&mut |leaf| match leaf {
                Condition::Action(_, true) => Condition::TRUE,
                other => other,
            });
            let mut scope = finder.scope(&team);
            match finder.value(&team, of, &hopeful, &mut scope) {
                Condition::Any(parts) if parts.is_empty() => return true,
                Condition::Atom(atom, holds) => seen.push((atom, holds)),
                _ => {}
            }
        }
    }
    seen.iter().any(|(atom, holds)| seen.contains(&(atom.clone(), !holds)))
}

/// Makes two terms of a team the same; the second gives way where it can.
fn unify(team: &mut Team, one: Term, other: Term) {
    // What was made the same before has moved on, so the terms are looked up in the members.
    let resolve = |team: &Team, term: Term| match term {
        Term::Object(_) => term,
        Term::Variable(id) => {
            let first = team.members[0].arguments.len();
            let (member, at) =
                if id.index() < first { (0, id.index()) } else { (1, id.index() - first) };
            team.members[member].arguments[at]
        }
    };
    let (one, other) = (resolve(team, one), resolve(team, other));
    let (kept, gone) = match (one, other) {
        (_, Term::Variable(_)) => (one, other),
        (Term::Variable(_), _) => (other, one),
        (Term::Object(_), Term::Object(_)) => return,
    };
    for member in &mut team.members {
        for argument in &mut member.arguments {
            if *argument == gone {
                *argument = kept;
            }
        }
    }
}
