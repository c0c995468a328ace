//! A translated task goes in; what the goal does not need and what is never reached goes away, and variables get their final order.

use hashbrown::HashTable;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};

use crate::encode::cover::Lists;
use crate::encode::order;
use crate::task::{Effect, Fact, OperatorId, Task, Variable, VariableId};

/// Stands for a variable or a value that is gone.
const GONE: u32 = u32::MAX;

/// What became of variables and values.
pub(super) struct Pruned {
    /// For each kept variable, in the new order, the one it was.
    pub(super) variables: Vec<u32>,
    /// For each kept variable, for each kept value, the one it was.
    pub(super) values: Vec<Vec<u32>>,
    /// For each variable that was, what it is.
    map: Vec<u32>,
    /// Where the values of each variable that was start in `mapped`.
    offsets: Vec<u32>,
    mapped: Vec<u32>,
    /// Whether a goal is never reached.
    pub(super) unsolvable: bool,
}

impl Pruned {
    /// What an old fact is now; `None` if its variable or its value is gone.
    pub(super) fn fact(&self, old: Fact) -> Option<Fact> {
        let variable = self.map[old.variable.index()];
        let value = self.mapped[(self.offsets[old.variable.index()] + old.value) as usize];
        (variable != GONE && value != GONE)
            .then_some(Fact { variable: VariableId(variable), value })
    }
}

/// Prunes and reorders in place. `origins` follows the operators.
pub(super) fn prune(task: &mut Task, origins: &mut Vec<u32>) -> Pruned {
    let mut offsets = Vec::with_capacity(task.variables.len() + 1);
    let mut total = 0;
    for variable in &task.variables {
        offsets.push(total);
        total += variable.domain_size;
    }
    offsets.push(total);
    let reached = Reach::explore(task, &offsets, total as usize);
    let unsolvable = task.goal.iter().any(|&fact| !reached.has(fact));
    let kept = relevant(task, &reached);
    let variables = if unsolvable { Vec::new() } else { order::order(task, &kept) };
    let mut pruned = Pruned {
        map: vec![GONE; task.variables.len()],
        values: Vec::with_capacity(variables.len()),
        variables,
        mapped: vec![GONE; total as usize],
        offsets,
        unsolvable,
    };
    for (new, &old) in pruned.variables.iter().enumerate() {
        pruned.map[old as usize] = new as u32;
        let mut values = Vec::new();
        for value in 0..task.variables[old as usize].domain_size {
            let fact = Fact { variable: VariableId(old), value };
            if reached.has(fact) {
                pruned.mapped[(pruned.offsets[old as usize] + value) as usize] =
                    values.len() as u32;
                values.push(value);
            }
        }
        pruned.values.push(values);
    }
    rewrite_variables(task, &pruned);
    rewrite_operators(task, origins, &pruned, &reached);
    rewrite_axioms(task, &pruned, &reached);
    pruned
}

/// Which values can be reached when a variable keeps every value that it ever had.
struct Reach {
    offsets: Vec<u32>,
    values: Vec<bool>,
    /// Whether more than one value of the variable is reached.
    moves: Vec<bool>,
}

impl Reach {
    /// Sweeps over the operators not yet applied until nothing is new. Operators stand in the order in which grounding found them, which
    /// is nearly one in which each can be applied when its turn comes, so that few sweeps suffice; where not, everything counts as reached.
    fn explore(task: &Task, offsets: &[u32], total: usize) -> Self {
        let mut reach =
            Self { offsets: offsets.to_vec(), values: vec![false; total], moves: Vec::new() };
        for (variable, &value) in task.initial_state.iter().enumerate() {
            reach.values[(offsets[variable] + value) as usize] = true;
        }
        let mut waiting: Vec<u32> = Vec::new();
        let mut axioms: Vec<u32> = (0..task.axioms.len() as u32).collect();
        let mut progress = false;
        for operator in task.operator_ids() {
            if !reach.apply(task, operator, &mut progress) {
                waiting.push(operator.0);
            }
        }
        let mut work = 16 * (task.operators.len() + task.axioms.len());
        progress = true;
        while progress {
            progress = false;
            axioms.retain(|&axiom| {
                let axiom = &task.axioms[axiom as usize];
                let fires = reach.all(task.conditions(&axiom.conditions));
                if fires {
                    progress |= reach.add(axiom.head);
                }
                !fires
            });
            waiting.retain(|&operator| !reach.apply(task, OperatorId(operator), &mut progress));
            work = work.saturating_sub(waiting.len() + axioms.len() + 1);
            if work == 0 && progress {
                reach.values.fill(true);
                break;
            }
        }
        reach.moves = (0..task.variables.len())
            .map(|variable| {
                let values =
                    &reach.values[offsets[variable] as usize..offsets[variable + 1] as usize];
                values.iter().filter(|&&value| value).count() > 1
            })
            .collect();
        reach
    }

    #[inline]
    fn has(&self, fact: Fact) -> bool {
        self.values[(self.offsets[fact.variable.index()] + fact.value) as usize]
    }

    fn all(&self, facts: &[Fact]) -> bool {
        facts.iter().all(|&fact| self.has(fact))
    }

    fn add(&mut self, fact: Fact) -> bool {
        let cell = &mut self.values[(self.offsets[fact.variable.index()] + fact.value) as usize];
        !std::mem::replace(cell, true)
    }

    /// Applies the operator as far as it goes; whether nothing of it is left.
    fn apply(&mut self, task: &Task, operator: OperatorId, progress: &mut bool) -> bool {
        if !self.all(task.precondition(operator)) {
            return false;
        }
        let mut done = true;
        for effect in task.effects(operator) {
            if self.all(task.conditions(&effect.conditions)) {
                *progress |= self.add(effect.fact);
            } else {
                done = false;
            }
        }
        done
    }
}

/// The variables that move and on which the goal depends.
fn relevant(task: &Task, reached: &Reach) -> Vec<bool> {
    let written = |operator: u32| {
        task.effects(OperatorId(operator))
            .iter()
            .map(move |effect| (effect.fact.variable.0, operator))
    };
    let writers = (0..task.operators.len() as u32).flat_map(written);
    let writers = Lists::new(task.variables.len(), writers);
    let heads = Lists::new(
        task.variables.len(),
        task.axioms.iter().enumerate().map(|(axiom, a)| (a.head.variable.0, axiom as u32)),
    );
    let mut kept = vec![false; task.variables.len()];
    let mut queue: Vec<u32> = Vec::new();
    let mut need = |facts: &[Fact], queue: &mut Vec<u32>| {
        for fact in facts {
            let variable = fact.variable.index();
            if !kept[variable] && reached.moves[variable] {
                kept[variable] = true;
                queue.push(fact.variable.0);
            }
        }
    };
    let mut seen = vec![false; task.operators.len()];
    need(&task.goal, &mut queue);
    while let Some(variable) = queue.pop() {
        for &axiom in heads.row(variable as usize) {
            need(task.conditions(&task.axioms[axiom as usize].conditions), &mut queue);
        }
        for &operator in writers.row(variable as usize) {
            let id = OperatorId(operator);
            if !std::mem::replace(&mut seen[operator as usize], true) {
                if !reached.all(task.precondition(id)) {
                    continue;
                }
                need(task.precondition(id), &mut queue);
            }
            for effect in task.effects(id).iter().filter(|effect| {
                effect.fact.variable.0 == variable && !effect.conditions.is_empty()
            }) {
                if reached.all(task.conditions(&effect.conditions)) {
                    need(task.conditions(&effect.conditions), &mut queue);
                }
            }
        }
    }
    kept
}

fn rewrite_variables(task: &mut Task, pruned: &Pruned) {
    let old = std::mem::take(&mut task.variables);
    let old_state = std::mem::take(&mut task.initial_state);
    for (&variable, values) in pruned.variables.iter().zip(&pruned.values) {
        let was = &old[variable as usize];
        let now = |value| {
            pruned.fact(Fact { variable: VariableId(variable), value }).map_or(0, |fact| fact.value)
        };
        let default = if was.axiom_layer.is_some() { now(was.default) } else { 0 };
        task.variables.push(Variable {
            domain_size: values.len() as u32,
            axiom_layer: was.axiom_layer,
            default,
        });
        task.initial_state.push(now(old_state[variable as usize]));
    }
    task.goal.retain_mut(|fact| match pruned.fact(*fact) {
        Some(new) => {
            *fact = new;
            true
        }
        None => false,
    });
    task.goal.sort_unstable();
}

/// Moves the facts of a range of a pool to `end`, under their new names, sorted, without those on variables that are gone.
fn compact(
    pool: &mut [Fact],
    range: &std::ops::Range<u32>,
    end: &mut usize,
    pruned: &Pruned,
) -> std::ops::Range<u32> {
    let start = *end;
    for index in range.start as usize..range.end as usize {
        if let Some(fact) = pruned.fact(pool[index]) {
            pool[*end] = fact;
            *end += 1;
        }
    }
    pool[start..*end].sort_unstable();
    start as u32..*end as u32
}

/// Renames operators in place: nothing ever grows, so each pool is read ahead of where it is written.
fn rewrite_operators(task: &mut Task, origins: &mut Vec<u32>, pruned: &Pruned, reached: &Reach) {
    let (mut operators, mut preconditions, mut effects, mut conditions) = (0, 0, 0, 0);
    let mut cheapest: HashTable<u32> = HashTable::with_capacity(task.operators.len());
    for index in 0..task.operators.len() {
        let mut operator = task.operators[index].clone();
        let starts = (preconditions, effects, conditions);
        if pruned.unsolvable || !reached.all(task.precondition(OperatorId(index as u32))) {
            continue;
        }
        for position in operator.effects.clone() {
            let Effect { conditions: range, fact } = task.effect_pool[position as usize].clone();
            let Some(fact) = pruned.fact(fact) else { continue };
            if !reached.all(&task.condition_pool[range.start as usize..range.end as usize]) {
                continue;
            }
            let range = compact(&mut task.condition_pool, &range, &mut conditions, pruned);
            task.effect_pool[effects] = Effect { conditions: range, fact };
            effects += 1;
        }
        if effects == starts.1 {
            continue;
        }
        operator.precondition = compact(
            &mut task.precondition_pool,
            &operator.precondition,
            &mut preconditions,
            pruned,
        );
        effects = sort_effects(&mut task.effect_pool, starts.1, effects);
        operator.effects = starts.1 as u32..effects as u32;
        task.operators[operators] = operator;
        let twin = OperatorId(operators as u32);
        let hash = fingerprint(task, twin);
        match cheapest.find(hash, |&other| same(task, twin, OperatorId(other))) {
            None => {
                cheapest.insert_unique(hash, twin.0, |&other| fingerprint(task, OperatorId(other)));
                origins[operators] = origins[index];
                operators += 1;
            }
            Some(&other) => {
                let cost = task.operators[operators].cost;
                if cost < task.operators[other as usize].cost {
                    task.operators[other as usize].cost = cost;
                    origins[other as usize] = origins[index];
                }
                (preconditions, effects, conditions) = starts;
            }
        }
    }
    task.operators.truncate(operators);
    origins.truncate(operators);
    task.precondition_pool.truncate(preconditions);
    task.effect_pool.truncate(effects);
    move_axiom_conditions(task, conditions);
}

/// Sorts effects without conditions by variable, of several on one the last, and says where they end. With conditions their order means
/// something. A condition may have gone, so that an add now always follows a delete.
fn sort_effects(pool: &mut [Effect], start: usize, end: usize) -> usize {
    let effects = &mut pool[start..end];
    if effects.iter().any(|effect| !effect.conditions.is_empty()) {
        return end;
    }
    effects.sort_by_key(|effect| effect.fact.variable);
    let mut kept = 0;
    for index in 1..effects.len() {
        if effects[index].fact.variable != effects[kept].fact.variable {
            kept += 1;
        }
        effects.swap(kept, index);
    }
    start + kept + 1
}

/// The conditions of axioms follow those of effects: closes the gap between them.
fn move_axiom_conditions(task: &mut Task, end: usize) {
    let Some(start) = task.axioms.iter().map(|axiom| axiom.conditions.start).min() else {
        task.condition_pool.truncate(end);
        return;
    };
    task.condition_pool.drain(end..start as usize);
    let gap = start - end as u32;
    for axiom in &mut task.axioms {
        axiom.conditions = axiom.conditions.start - gap..axiom.conditions.end - gap;
    }
}

fn fingerprint(task: &Task, operator: OperatorId) -> u64 {
    let mut hasher = FxHasher::default();
    for fact in task.precondition(operator) {
        fact.hash(&mut hasher);
    }
    for effect in task.effects(operator) {
        effect.fact.hash(&mut hasher);
        task.conditions(&effect.conditions).hash(&mut hasher);
    }
    hasher.finish()
}

/// Whether two operators are applicable in the same states and do the same.
fn same(task: &Task, left: OperatorId, right: OperatorId) -> bool {
    let equal = |(a, b): (&Effect, &Effect)| {
        a.fact == b.fact && task.conditions(&a.conditions) == task.conditions(&b.conditions)
    };
    let (ours, theirs) = (task.effects(left), task.effects(right));
    task.precondition(left) == task.precondition(right)
        && ours.len() == theirs.len()
        && ours.iter().zip(theirs).all(equal)
}

fn rewrite_axioms(task: &mut Task, pruned: &Pruned, reached: &Reach) {
    let mut end = task
        .axioms
        .iter()
        .map(|axiom| axiom.conditions.start)
        .min()
        .unwrap_or(task.condition_pool.len() as u32) as usize;
    let mut axioms = std::mem::take(&mut task.axioms);
    axioms.retain_mut(|axiom| {
        let Some(head) = pruned.fact(axiom.head) else { return false };
        let range = axiom.conditions.start as usize..axiom.conditions.end as usize;
        if pruned.unsolvable || !reached.all(&task.condition_pool[range]) {
            return false;
        }
        axiom.head = head;
        axiom.conditions = compact(&mut task.condition_pool, &axiom.conditions, &mut end, pruned);
        true
    });
    task.axioms = axioms;
    task.condition_pool.truncate(end);
}
