//! Axioms go in; they come out in layers, as few as possible: what a layer negates is settled below it.

use crate::encode::cover::Lists;
use crate::task::Task;

/// Sets the layer of each derived variable and sorts the axioms by the layer of their head, else in the order they had.
///
/// A layer is the greatest number of negations on a chain of axioms that ends in the variable.
pub(super) fn stratify(task: &mut Task) {
    let mut layers: Vec<u32> = vec![0; task.variables.len()];
    let uses = task.axioms.iter().enumerate().flat_map(|(axiom, a)| {
        let body = &task.condition_pool[a.conditions.start as usize..a.conditions.end as usize];
        body.iter().map(move |fact| (fact.variable.0, axiom as u32))
    });
    let users = Lists::new(task.variables.len(), uses);
    let bound =
        task.variables.iter().filter(|variable| variable.axiom_layer.is_some()).count() as u32;
    let layer = |layers: &[u32], axiom: &crate::task::Axiom| {
        let lowest =
            |fact: &crate::task::Fact| match task.variables[fact.variable.index()].axiom_layer {
                None => 0,
                Some(_) => {
                    layers[fact.variable.index()]
                        + u32::from(fact.value == task.variables[fact.variable.index()].default)
                }
            };
        task.conditions(&axiom.conditions).iter().map(lowest).max().unwrap_or(0)
    };
    let mut queue: Vec<u32> = (0..task.axioms.len() as u32).collect();
    while let Some(index) = queue.pop() {
        let axiom = &task.axioms[index as usize];
        let head = axiom.head.variable.index();
        let needed = layer(&layers, axiom);
        if needed > layers[head] {
            assert!(needed <= bound, "the checker refuses axioms that recur through a negation");
            layers[head] = needed;
            queue.extend_from_slice(users.row(head));
        }
    }
    for (variable, &layer) in task.variables.iter_mut().zip(&layers) {
        if let Some(own) = &mut variable.axiom_layer {
            *own = layer;
        }
    }
    task.axioms.sort_by_key(|axiom| layers[axiom.head.variable.index()]);
}
