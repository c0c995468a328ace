//! A task goes in; an order of its variables in which causes stand before what they act on comes out.
//!
//! The order of Fast Downward's causal graph (Helmert, "The Fast Downward planning system", JAIR 2006, section 5.1): strongly connected
//! components in topological order, and within each one again and again the variable with the least weight of arcs from those left.
//! The weight of an arc counts how often a condition on its source goes with an effect on its target; variables of the goal get a bonus,
//! so that they come late. The successor generator branches on variables in this order, so those that many operators ask for come first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use rustc_hash::FxHashMap;

use crate::task::Task;

/// From so many pairs of a condition and an effect on, only every second, third … operator is looked at: weights are a matter of taste,
/// and time is not.
const SAMPLE: usize = 500_000;

/// Variables of a goal weigh this much more in their component, which is more than all arcs of a usual task.
const GOAL: u64 = 100_000;

/// The kept variables in their new order.
pub(super) fn order(task: &Task, kept: &[bool]) -> Vec<u32> {
    let weights = weights(task, kept);
    let mut names: Vec<NodeIndex> = vec![NodeIndex::end(); kept.len()];
    let mut graph: DiGraph<u32, u64> = DiGraph::with_capacity(kept.len(), weights.len());
    for variable in (0..kept.len()).filter(|&variable| kept[variable]) {
        names[variable] = graph.add_node(variable as u32);
    }
    for &(source, target, weight) in &weights {
        graph.add_edge(names[source as usize], names[target as usize], weight);
    }
    let mut bonus = vec![0; kept.len()];
    for fact in &task.goal {
        bonus[fact.variable.index()] = GOAL;
    }
    let mut order = Vec::with_capacity(graph.node_count());
    let mut component = vec![u32::MAX; graph.node_count()];
    // Components come in reverse topological order: effects before causes.
    let components = kosaraju_scc(&graph);
    for (index, members) in components.iter().enumerate() {
        for member in members {
            component[member.index()] = index as u32;
        }
    }
    for members in components.iter().rev() {
        arrange(&graph, members, &component, &bonus, &mut order);
    }
    order
}

/// Appends one component: of the variables left the one into which those left act least, of equals the first.
fn arrange(
    graph: &DiGraph<u32, u64>,
    members: &[NodeIndex],
    component: &[u32],
    bonus: &[u64],
    order: &mut Vec<u32>,
) {
    if let [only] = members {
        order.push(graph[*only]);
        return;
    }
    let home = component[members[0].index()];
    let within = |node: NodeIndex| component[node.index()] == home;
    let mut incoming: FxHashMap<NodeIndex, u64> =
        members.iter().map(|&member| (member, bonus[graph[member] as usize])).collect();
    for &member in members {
        for target in graph.neighbors(member).filter(|&target| within(target)) {
            let edge = graph.find_edge(member, target).expect("the target is a neighbour");
            *incoming.get_mut(&target).expect("the target is a member") += graph[edge];
        }
    }
    let mut heap: BinaryHeap<Reverse<(u64, u32, NodeIndex)>> =
        incoming.iter().map(|(&node, &weight)| Reverse((weight, graph[node], node))).collect();
    while let Some(Reverse((weight, variable, node))) = heap.pop() {
        if incoming.get(&node) != Some(&weight) {
            continue;
        }
        incoming.remove(&node);
        order.push(variable);
        let mut targets = graph.neighbors(node).detach();
        while let Some((edge, target)) = targets.next(graph) {
            if let Some(left) = incoming.get_mut(&target) {
                *left -= graph[edge];
                heap.push(Reverse((*left, graph[target], target)));
            }
        }
    }
}

/// The arcs of the causal graph between kept variables, sorted, each once with its weight.
fn weights(task: &Task, kept: &[bool]) -> Vec<(u32, u32, u64)> {
    let pairs: usize = task
        .operators
        .iter()
        .map(|operator| operator.precondition.len() * operator.effects.len())
        .sum();
    let mut found = Vec::with_capacity(pairs.min(2 * SAMPLE));
    let mut add = |source: u32, target: u32| {
        if source != target && kept[source as usize] && kept[target as usize] {
            found.push(u64::from(source) << 32 | u64::from(target));
        }
    };
    for operator in task.operator_ids().step_by(pairs / SAMPLE + 1) {
        let precondition = task.precondition(operator);
        for effect in task.effects(operator) {
            for source in precondition.iter().chain(task.conditions(&effect.conditions)) {
                add(source.variable.0, effect.fact.variable.0);
            }
        }
    }
    for axiom in &task.axioms {
        for source in task.conditions(&axiom.conditions) {
            add(source.variable.0, axiom.head.variable.0);
        }
    }
    found.sort_unstable();
    let arc = |run: &[u64]| ((run[0] >> 32) as u32, run[0] as u32, run.len() as u64);
    found.chunk_by(|left, right| left == right).map(arc).collect()
}
