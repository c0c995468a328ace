//! Best-first search, lazy (Richter and Helmert, ICAPS 2009): a state is evaluated when it is taken from the open list, where it waits with the
//! estimate of its parent. With preferred operators it gets by with a fraction of the evaluations that the eager one needs.
//!
//! Each heuristic has a list of all successors and one of those that a preferred operator leads to; the lists take turns, and whenever an estimate
//! falls below all before, the preferred ones are served [`BOOST`] times more (LAMA; Richter and Westphal, JAIR 2010).
//! Ties: within a list the oldest first; between lists the one served least, then the first.

use super::node::{MOST_COST, Node, Nodes, Status};
use super::{End, Profile, Run};
use crate::heuristics::{Costs, DEAD_END, Heuristic};
use crate::open::{Open, Order};
use crate::registry::StateId;
use crate::segmented::Segmented;
use crate::space::Space;
use crate::task::OperatorId;

/// How often the preferred lists are served more after progress.
const BOOST: i64 = 1000;

/// How it is listed.
pub fn profile() -> Profile {
    Profile {
        name: "lazy",
        summary: "lazy best-first with preferred operators in lists that take turns",
        source: "Richter and Helmert, ICAPS 2009; Richter and Westphal, JAIR 2010",
        optimal: false,
    }
}

/// How it orders and prunes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Options {
    /// f = g + weight·h; `None` for greedy, which orders by h alone and never re-opens.
    pub weight: Option<u32>,
    /// Which cost g counts.
    pub costs: Costs,
}

/// Takes turns between lists.
struct Lists {
    /// For each heuristic the list of all, then that of the preferred.
    lists: Vec<Open<Entry>>,
    served: Vec<i64>,
}

/// An operator to be applied in a state.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    state: u32,
    operator: u32,
}

impl Lists {
    fn new(heuristics: usize) -> Self {
        Self {
            lists: (0..2 * heuristics).map(|_| Open::new(Order::Fifo)).collect(),
            served: vec![0; 2 * heuristics],
        }
    }

    fn push(&mut self, keys: &[u32], is_preferred: bool, entry: Entry) {
        for (pair, &key) in self.lists.chunks_exact_mut(2).zip(keys) {
            pair[0].push((key, 0), entry);
            if is_preferred {
                pair[1].push((key, 0), entry);
            }
        }
    }

    fn pop(&mut self) -> Option<Entry> {
        let list = (0..self.lists.len())
            .filter(|&list| !self.lists[list].is_empty())
            .min_by_key(|&list| (self.served[list], list))?;
        self.served[list] += 1;
        self.lists[list].pop().map(|(_, entry)| entry)
    }

    fn boost(&mut self) {
        for pair in self.served.chunks_exact_mut(2) {
            pair[1] -= BOOST;
        }
    }
}

/// The nodes, and beside them the true costs where g counts others.
struct Ways {
    nodes: Nodes,
    metric: Option<Segmented<u32>>,
}

impl Ways {
    fn metric(&self, state: StateId) -> u32 {
        self.metric
            .as_ref()
            .map_or_else(|| self.nodes.get(state).cost, |metric| metric.get(state.index()))
    }

    fn set(&mut self, state: StateId, node: Node, metric_cost: u32) {
        self.nodes.set(state, node);
        if let Some(metric) = &mut self.metric {
            if state.index() == metric.len() {
                metric.push(metric_cost);
            } else {
                metric.set(state.index(), metric_cost);
            }
        }
    }
}

/// Runs until a plan is found that is cheaper than those before.
pub(super) fn search(
    space: &mut Space,
    heuristics: &mut [Box<dyn Heuristic + '_>],
    options: Options,
    run: &mut Run,
) -> End {
    let task = space.task();
    let keeps_metric = task.uses_metric && options.costs != Costs::Metric;
    let mut ways =
        Ways { nodes: Nodes::default(), metric: keeps_metric.then(|| Segmented::new(0)) };
    let mut lists = Lists::new(heuristics.len());
    let mut values = task.initial_state.clone();
    let mut operators: Vec<OperatorId> = Vec::new();
    let mut estimates = vec![0; heuristics.len()];
    let mut keys = estimates.clone();
    let mut best = vec![u32::MAX; heuristics.len()];
    let mut preferred_at = vec![u32::MAX; task.operators.len()];
    let mut state = space.initial();
    let mut way = (0, 0, state);
    let mut is_new = true;
    loop {
        let (cost, metric_cost, parent) = way;
        let expand = if is_new {
            true
        } else {
            let known = ways.nodes.get(state);
            options.weight.is_some() && known.status != Status::DeadEnd && cost < known.cost
        };
        if expand {
            if let Some(end) = run.stopped(space) {
                return end;
            }
            space.load(state, &mut values);
            let is_dead_end = evaluate(heuristics, &values, &mut estimates);
            if parent == state {
                run.initial(if is_dead_end { DEAD_END } else { estimates[0] });
            } else {
                run.statistics.evaluated += 1;
                run.statistics.dead_ends += u64::from(is_dead_end);
            }
            run.statistics.reopened += u64::from(!is_new);
            let status = if is_dead_end { Status::DeadEnd } else { Status::Closed };
            ways.set(state, Node { status, cost, parent }, metric_cost);
            if !is_dead_end {
                if space.is_goal(&values) {
                    return run.solved(space, state, |state| ways.nodes.parent(state));
                }
                if progresses(&estimates, &mut best) {
                    run.reached(best[0]);
                    lists.boost();
                }
                run.statistics.expanded += 1;
                space.applicable(&values, &mut operators);
                for heuristic in heuristics.iter() {
                    for preferred in heuristic.preferred() {
                        preferred_at[preferred.index()] = state.0;
                    }
                }
                for (key, &estimate) in keys.iter_mut().zip(&estimates) {
                    *key = options.weight.map_or(estimate, |weight| {
                        cost.saturating_add(estimate.saturating_mul(weight))
                    });
                }
                for &operator in &operators {
                    if !run.is_too_much(
                        u64::from(metric_cost) + u64::from(task.operators[operator.index()].cost),
                    ) {
                        let is_preferred = preferred_at[operator.index()] == state.0;
                        lists.push(
                            &keys,
                            is_preferred,
                            Entry { state: state.0, operator: operator.0 },
                        );
                    }
                }
            }
        }
        // The next state: one whose way is cheap enough and fits a node.
        loop {
            let Some(Entry { state: parent, operator }) = lists.pop() else {
                return End::Exhausted;
            };
            let (parent, operator) = (StateId(parent), OperatorId(operator));
            let cost = ways.nodes.get(parent).cost.saturating_add(options.costs.of(task, operator));
            let metric_cost =
                ways.metric(parent).saturating_add(task.operators[operator.index()].cost);
            if cost.max(metric_cost) > MOST_COST {
                run.overflow = true;
                continue;
            }
            if run.is_too_much(u64::from(metric_cost)) {
                continue;
            }
            space.load(parent, &mut values);
            run.statistics.generated += 1;
            (state, is_new) = space.successor(parent, &values, operator);
            way = (cost, metric_cost, parent);
            break;
        }
    }
}

/// Fills in the estimates; whether one of them says that the state is a dead end.
fn evaluate(
    heuristics: &mut [Box<dyn Heuristic + '_>],
    values: &[u32],
    estimates: &mut [u32],
) -> bool {
    for (heuristic, estimate) in heuristics.iter_mut().zip(estimates) {
        *estimate = heuristic.evaluate(values);
        if *estimate == DEAD_END {
            return true;
        }
    }
    false
}

/// Notes estimates that are below all before; whether there is one.
fn progresses(estimates: &[u32], best: &mut [u32]) -> bool {
    let mut progress = false;
    for (&estimate, best) in estimates.iter().zip(best) {
        if estimate < *best {
            *best = estimate;
            progress = true;
        }
    }
    progress
}
