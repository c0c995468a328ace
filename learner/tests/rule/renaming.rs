//! Actions that differ in nothing but the names and the order of their parameters are equal, and no others.

use lang::model::{Atom, Term, VariableId};
use learner::rule::schema::Schema;
use proptest::prelude::*;

use super::random::{self, Dice, Kind};
use super::words::domain;

/// The schema with its parameters in another order; the first stays where it is the agent.
fn shuffled(schema: &Schema, dice: &mut Dice) -> (Schema, Vec<VariableId>) {
    let count = schema.parameters.len();
    let mut order: Vec<usize> = (0..count).collect();
    let first = usize::from(schema.agent);
    for at in first..count {
        order.swap(at, at + dice.below(count - at));
    }
    let map: Vec<VariableId> = order.iter().map(|to| VariableId(*to as u32)).collect();
    let term = |term: &Term| match term {
        Term::Variable(id) => Term::Variable(map[id.index()]),
        Term::Object(_) => *term,
    };
    let atoms = |list: &[Atom]| {
        let image = |atom: &Atom| Atom {
            predicate: atom.predicate,
            arguments: atom.arguments.iter().map(term).collect(),
        };
        list.iter().rev().map(image).collect()
    };
    let mut parameters = schema.parameters.clone();
    for (from, to) in order.iter().enumerate() {
        parameters[*to].clone_from(&schema.parameters[from]);
    }
    let equal = schema.equal.iter().map(|(one, other, holds)| (term(other), term(one), *holds));
    let schema = Schema {
        parameters,
        agent: schema.agent,
        required: atoms(&schema.required),
        absent: atoms(&schema.absent),
        equal: equal.collect(),
        adds: atoms(&schema.adds),
        deletes: atoms(&schema.deletes),
    };
    (schema, map)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn another_order_of_parameters_is_found(seed in any::<u64>(), agents in any::<bool>()) {
        let mut dice = Dice::new(seed);
        let domain = domain(&random::text(&mut dice, Kind { negative: true, agents }));
        for action in &domain.actions {
            let mut schema = Schema::of(action).expect("it is plain");
            if schema.parameters.len() > 1 {
                let last = VariableId(schema.parameters.len() as u32 - 1);
                schema.equal.push((Term::Variable(VariableId(0)), Term::Variable(last), false));
            }
            let (other, _) = shuffled(&schema, &mut dice);
            let map = schema.renaming(&other);
            prop_assert!(map.is_some(), "{schema:?}\n{other:?}");
            let map = map.expect("it was looked at");
            for (at, to) in map.iter().enumerate() {
                prop_assert_eq!(&schema.parameters[at], &other.parameters[to.index()]);
            }
            // What has one effect more or another one is another action.
            let mut more = other.clone();
            more.adds.extend(more.deletes.pop());
            prop_assert!(other.deletes.is_empty() || schema.renaming(&more).is_none());
            let mut less = other.clone();
            prop_assert!(less.required.pop().is_none() || schema.renaming(&less).is_none());
        }
    }
}

#[test]
fn a_variable_at_another_place_makes_another_action() {
    let domain = domain(
        "(define (domain d) (:requirements :strips :typing) (:types t) (:predicates (p ?a ?b - t) (q ?a - t))
        (:action one :parameters (?x ?y - t) :precondition (p ?x ?y) :effect (q ?x))
        (:action two :parameters (?y ?x - t) :precondition (p ?x ?y) :effect (q ?x))
        (:action three :parameters (?x ?y - t) :precondition (p ?x ?y) :effect (q ?y)))",
    );
    let schemas: Vec<Schema> =
        domain.actions.iter().map(|action| Schema::of(action).expect("it is plain")).collect();
    assert_eq!(schemas[0].renaming(&schemas[1]), Some(vec![VariableId(1), VariableId(0)]));
    assert_eq!(schemas[0].renaming(&schemas[2]), None);
}
