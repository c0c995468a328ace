//! A state and a component of derived predicates go in; the facts that the axioms derive come out.
//!
//! Each rule is asked once as a whole.
//! After that each new fact is tried, once, as the reason of every atom of its component that it matches.

use std::sync::Arc;

use super::Executor;
use super::query::Goal;
use super::relation::Relation;
use super::solutions::{Binding, Solutions};
use super::state::{State, View};
use super::strata::{Component, Rule};
use crate::model::{Atom, NodeKind, ObjectId, Scope, Term, VariableId};

/// The derived relations of `component`, worked out if they are not known yet, and with them all that they depend on.
pub(super) fn derived<'a>(
    executor: &'a Executor<'a>,
    state: &'a State,
    component: usize,
) -> &'a [Relation] {
    let components = &executor.strata().components;
    let mut open =
        if state.derived[component].get().is_some() { Vec::new() } else { vec![component] };
    while let Some(&next) = open.last() {
        let waiting = open.len();
        open.extend(
            components[next].below.iter().filter(|&&below| state.derived[below].get().is_none()),
        );
        if open.len() == waiting {
            state.derived[next].get_or_init(|| Arc::new(fixpoint(executor, state, next)));
            open.pop();
        }
    }
    state.derived[component].get().expect("it was worked out above")
}

struct Fixpoint<'a> {
    executor: &'a Executor<'a>,
    state: &'a State,
    id: usize,
    component: &'a Component,
    relations: Vec<Relation>,
}

fn fixpoint(executor: &Executor<'_>, state: &State, id: usize) -> Vec<Relation> {
    let component = &executor.strata().components[id];
    // Facts of derived predicates in the initial state hold throughout.
    let relations = component
        .predicates
        .iter()
        .map(|predicate| (*state.relations[predicate.index()]).clone())
        .collect();
    let mut fixpoint = Fixpoint { executor, state, id, component, relations };
    fixpoint.run();
    fixpoint.relations
}

impl Fixpoint<'_> {
    fn run(&mut self) {
        for rule in &self.component.rules {
            self.ask_whole(rule);
        }
        let mut tried = vec![0; self.relations.len()];
        loop {
            self.follow(&mut tried);
            let count = self.count();
            for rule in self.component.rules.iter().filter(|rule| rule.whole) {
                self.ask_whole(rule);
            }
            if self.count() == count {
                return;
            }
        }
    }

    fn count(&self) -> usize {
        self.relations.iter().map(Relation::len).sum()
    }

    /// Tries all facts that were not tried yet, and those that come of it.
    fn follow(&mut self, tried: &mut [usize]) {
        while let Some(at) = (0..tried.len()).find(|&at| tried[at] < self.relations[at].len()) {
            let fact: Box<[ObjectId]> = self.relations[at].row(tried[at] as u32).into();
            tried[at] += 1;
            for recursion in &self.component.recursions {
                let rule = &self.component.rules[recursion.rule];
                let axiom = &self.executor.domain().axioms[rule.axiom.index()];
                let NodeKind::Atom(atom) = axiom.body.kind(recursion.atom) else {
                    unreachable!("it is an atom")
                };
                if atom.predicate != self.component.predicates[at] {
                    continue;
                }
                if let Some(binding) = matched(self.executor, &axiom.scope, atom, &fact) {
                    self.ask(rule, binding, recursion.others.clone());
                }
            }
        }
    }

    fn ask_whole(&mut self, rule: &Rule) {
        let axiom = &self.executor.domain().axioms[rule.axiom.index()];
        self.ask(
            rule,
            vec![None; axiom.scope.variables.len()],
            vec![Goal::Holds(axiom.body.root())],
        );
    }

    /// Adds the heads of all solutions.
    fn ask(&mut self, rule: &Rule, binding: Binding, mut goals: Vec<Goal>) {
        let axiom = &self.executor.domain().axioms[rule.axiom.index()];
        let parameters = axiom.scope.parameters;
        goals.splice(0..0, (0..parameters).rev().map(|variable| Goal::Binds(VariableId(variable))));
        let view = View {
            executor: self.executor,
            state: self.state,
            building: Some((self.id, self.relations.as_slice())),
            joint: None,
        };
        let mut solutions =
            Solutions::new(view, &axiom.scope, (&axiom.body, &rule.query), binding, goals);
        let mut heads: Vec<ObjectId> = Vec::new();
        let mut found = 0;
        while solutions.advance() {
            found += 1;
            let head = &solutions.binding()[..parameters as usize];
            heads.extend(
                head.iter().map(|object| object.expect("the parameters are bound by goals")),
            );
        }
        drop(solutions);
        let (_, at) =
            self.executor.strata().place(axiom.head).expect("the head of an axiom is derived");
        for row in 0..found {
            let width = parameters as usize;
            self.relations[at].insert(&heads[row * width..(row + 1) * width]);
        }
    }
}

/// The binding with which `atom` is `fact`.
fn matched(
    executor: &Executor<'_>,
    scope: &Scope,
    atom: &Atom,
    fact: &[ObjectId],
) -> Option<Binding> {
    let mut binding = vec![None; scope.variables.len()];
    for (term, &object) in atom.arguments.iter().zip(fact) {
        let fits = match term {
            Term::Object(wanted) => *wanted == object,
            Term::Variable(variable) => {
                let known: &mut Option<ObjectId> = &mut binding[variable.index()];
                executor.is_of(object, &scope.variables[variable.index()].types)
                    && *known.get_or_insert(object) == object
            }
        };
        if !fits {
            return None;
        }
    }
    Some(binding)
}
