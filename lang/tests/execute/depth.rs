//! Formulas that are deeper than any stack.

use lang::execute::Executor;
use lang::model::{
    Atom, Formula, Name, Node, NodeId, NodeKind, ObjectId, PredicateId, Scope, Term, TypeId,
    Variable, VariableId,
};
use lang::plan::Plan;
use lang::source::Span;
use lang::validate::{judge, story};

use crate::random::{Tape, World};

const DEPTH: usize = 100_000;

/// A formula whose node `at` is made of the node below it, over an atom of `o0`.
fn tower(predicate: u32, wrap: impl Fn(usize, NodeId, &mut Vec<Node>) -> NodeKind) -> Formula {
    let arguments = if predicate == 0 { Vec::new() } else { vec![Term::Object(ObjectId(0))] };
    let atom = NodeKind::Atom(Atom { predicate: PredicateId(predicate), arguments });
    let mut nodes = vec![Node { kind: atom, span: Span::default() }];
    for at in 0..DEPTH {
        let below = NodeId(nodes.len() as u32 - 1);
        let kind = wrap(at, below, &mut nodes);
        nodes.push(Node { kind, span: Span::default() });
    }
    Formula { nodes }
}

/// The simplest world: `p0` without arguments and `p1` with one, neither of which holds.
fn check(formula: Formula, scope: Scope, expected: bool) {
    let mut world = World::new(&mut Tape::new(Vec::new()));
    let executor = Executor::new(&world.domain, &world.problem).expect("it has no axioms");
    let binding = vec![None; scope.variables.len()];
    assert_eq!(executor.holds(&executor.initial(), &scope, &formula, &binding), expected);
    drop(executor);
    world.problem.goal = formula;
    world.problem.goal_scope = scope;
    let executor = Executor::new(&world.domain, &world.problem).expect("it has no axioms");
    let verdict = judge(&executor, &Plan::default());
    let text = story(&verdict, &world.domain, &world.problem, &Plan::default());
    assert!(text.len() < 10_000, "{text}");
    assert_eq!(text.starts_with("The plan is valid"), expected, "{text}");
}

#[test]
fn a_hundred_thousand_negations_are_evaluated_and_explained() {
    check(tower(0, |_, below, _| NodeKind::Not(below)), Scope::default(), false);
    let mut odd = tower(0, |_, below, _| NodeKind::Not(below));
    odd.nodes.pop();
    check(odd, Scope::default(), true);
}

#[test]
fn alternating_connectives_are_evaluated_and_explained() {
    let formula = tower(0, |at, below, nodes| {
        nodes.push(Node { kind: NodeKind::And(Vec::new()), span: Span::default() });
        let truth = NodeId(nodes.len() as u32 - 1);
        nodes.push(Node { kind: NodeKind::Not(truth), span: Span::default() });
        let falsity = NodeId(nodes.len() as u32 - 1);
        match at % 3 {
            0 => NodeKind::And(vec![truth, below]),
            1 => NodeKind::Or(vec![falsity, below]),
            _ => NodeKind::Imply(truth, below),
        }
    });
    check(formula, Scope::default(), false);
}

#[test]
fn alternating_quantifiers_are_evaluated_and_explained() {
    let name = |text: String| Name { text, span: Span::default() };
    let variables = (0..DEPTH)
        .map(|at| Variable { name: name(format!("?x{at}")), types: vec![TypeId(0)] })
        .collect();
    let formula = tower(1, |at, below, _| {
        let bound = vec![VariableId(at as u32)];
        if at % 2 == 0 { NodeKind::Exists(bound, below) } else { NodeKind::Not(below) }
    });
    check(formula, Scope { variables, parameters: 0 }, false);
}
