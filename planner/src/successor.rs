//! A task goes in; a decision tree comes out that lists the operators applicable in a state.
//!
//! The tree is one array of words. A *block* is a run of items, read in order until an end item; each item is one word of tag and payload, then its data:
//! a leaf lists operators, a test goes into one block where a variable has one value, a switch has a block for each value of a variable.
//! Operators are found in the order of their sorted preconditions, then of their ids; this order is the same in every run.

use crate::task::{OperatorId, Task};

const TAG_BITS: u32 = 2;
const END: u32 = 0;
const LEAF: u32 = 1;
const TEST: u32 = 2;
const SWITCH: u32 = 3;

/// Lists applicable operators.
#[derive(Debug, Clone)]
pub struct Successors {
    code: Vec<u32>,
    root: u32,
}

impl Successors {
    /// Builds the tree for the operators of `task`.
    pub fn new(task: &Task) -> Self {
        let mut order: Vec<OperatorId> = task.operator_ids().collect();
        order.sort_by(|&a, &b| task.precondition(a).cmp(task.precondition(b)).then(a.cmp(&b)));
        // Word 0 is an empty block, so that 0 can stand for "no block" in switches.
        let mut code = vec![END];
        let root = block(task, &order, 0, &mut code);
        Self { code, root }
    }

    /// Appends to `found` the operators whose preconditions hold in `values`.
    #[inline]
    pub fn applicable(&self, values: &[u32], found: &mut Vec<OperatorId>) {
        self.visit(self.root as usize, values, found);
    }

    fn visit(&self, mut at: usize, values: &[u32], found: &mut Vec<OperatorId>) {
        loop {
            let item = self.code[at];
            let payload = (item >> TAG_BITS) as usize;
            match item & ((1 << TAG_BITS) - 1) {
                END => return,
                LEAF => {
                    found.extend(
                        self.code[at + 1..=at + payload]
                            .iter()
                            .map(|&operator| OperatorId(operator)),
                    );
                    at += 1 + payload;
                }
                TEST => {
                    if values[payload] == self.code[at + 1] {
                        self.visit(self.code[at + 2] as usize, values, found);
                    }
                    at += 3;
                }
                _ => {
                    let child = self.code[at + 2 + values[payload] as usize];
                    if child != 0 {
                        self.visit(child as usize, values, found);
                    }
                    at += 2 + self.code[at + 1] as usize;
                }
            }
        }
    }
}

/// Emits the block of `operators`, which agree on their first `depth` preconditions and are sorted; returns where it starts.
fn block(task: &Task, operators: &[OperatorId], depth: usize, code: &mut Vec<u32>) -> u32 {
    let leaves = operators.partition_point(|&operator| task.precondition(operator).len() == depth);
    let mut items = Vec::new();
    if leaves > 0 {
        items.push((leaves as u32) << TAG_BITS | LEAF);
        items.extend(operators[..leaves].iter().map(|operator| operator.0));
    }
    let fact = |operator: OperatorId| task.precondition(operator)[depth];
    for group in operators[leaves..].chunk_by(|&a, &b| fact(a).variable == fact(b).variable) {
        let variable = fact(group[0]).variable;
        let children: Vec<(u32, u32)> = group
            .chunk_by(|&a, &b| fact(a).value == fact(b).value)
            .map(|same| (fact(same[0]).value, block(task, same, depth + 1, code)))
            .collect();
        let domain = task.variables[variable.index()].domain_size;
        if children.len() as u32 * 3 <= domain {
            for (value, child) in children {
                items.extend([variable.0 << TAG_BITS | TEST, value, child]);
            }
        } else {
            items.extend([variable.0 << TAG_BITS | SWITCH, domain]);
            let table = items.len();
            items.resize(table + domain as usize, 0);
            for (value, child) in children {
                items[table + value as usize] = child;
            }
        }
    }
    items.push(END);
    let start = u32::try_from(code.len())
        .expect("the tree is smaller than the operators' preconditions, which are indexed by u32");
    code.extend(items);
    start
}
