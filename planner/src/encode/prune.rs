//! A translated task goes in; what the goal does not need and what is never reached goes away, and variables get their final order.

use crate::encode::order;
use crate::encode::twins::{self, Ends};
use crate::task::{Effect, Fact, OperatorId, Task, Variable, VariableId};

/// Stands for a fact that is gone.
const GONE: Fact = Fact { variable: VariableId(u32::MAX), value: 0 };

/// What became of variables and values.
pub(super) struct Pruned {
    /// For each kept variable, in the new order, the one it was.
    pub(super) variables: Vec<u32>,
    /// For each kept variable, for each kept value, the one it was.
    pub(super) values: Vec<Vec<u32>>,
    /// Where the values of each variable that was start in `facts`.
    offsets: Vec<u32>,
    /// For each fact that was, what it is.
    facts: Vec<Fact>,
    /// Whether a goal is never reached.
    pub(super) unsolvable: bool,
}

impl Pruned {
    /// What an old fact is now; `None` if its variable or its value is gone.
    #[inline]
    pub(super) fn fact(&self, old: Fact) -> Option<Fact> {
        let fact = self.facts[(self.offsets[old.variable.index()] + old.value) as usize];
        (fact != GONE).then_some(fact)
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
    let kept = Relevance::explore(task, &reached);
    let variables = if unsolvable { Vec::new() } else { order::order(task, &kept) };
    let mut pruned = Pruned {
        values: Vec::with_capacity(variables.len()),
        variables,
        facts: vec![GONE; total as usize],
        offsets,
        unsolvable,
    };
    for (new, &old) in pruned.variables.iter().enumerate() {
        let mut values = Vec::new();
        for value in 0..task.variables[old as usize].domain_size {
            let fact = Fact { variable: VariableId(old), value };
            if reached.has(fact) {
                pruned.facts[(pruned.offsets[old as usize] + value) as usize] =
                    Fact { variable: VariableId(new as u32), value: values.len() as u32 };
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
struct Relevance<'a> {
    task: &'a Task,
    reached: &'a Reach,
    kept: Vec<bool>,
    /// How many variables move and are not kept yet.
    left: usize,
}

impl<'a> Relevance<'a> {
    /// Sweeps over the operators, last first, until no variable is new: operators near the goal tend to come last, and mostly two sweeps
    /// find that everything matters. Where many would be needed, everything does.
    fn explore(task: &'a Task, reached: &'a Reach) -> Vec<bool> {
        let left = reached.moves.iter().filter(|&&moves| moves).count();
        let mut relevance = Self { task, reached, kept: vec![false; task.variables.len()], left };
        relevance.need(&task.goal);
        let mut operators: Vec<u32> = Vec::new();
        let mut axioms: Vec<u32> = (0..task.axioms.len() as u32).collect();
        let mut before = usize::MAX;
        for operator in (0..task.operators.len() as u32).rev() {
            if relevance.left == 0 {
                break;
            }
            if reached.all(task.precondition(OperatorId(operator)))
                && !relevance.operator(OperatorId(operator))
            {
                operators.push(operator);
            }
        }
        let mut work = 64 * (task.operators.len() + task.axioms.len());
        while relevance.left > 0 && relevance.left < before {
            before = relevance.left;
            if work < operators.len() + axioms.len() {
                return reached.moves.clone();
            }
            work -= operators.len() + axioms.len();
            axioms.retain(|&axiom| !relevance.axiom(axiom));
            operators.retain(|&operator| !relevance.operator(OperatorId(operator)));
        }
        relevance.kept
    }

    fn need(&mut self, facts: &[Fact]) {
        for fact in facts {
            let variable = fact.variable.index();
            if !self.kept[variable] && self.reached.moves[variable] {
                self.kept[variable] = true;
                self.left -= 1;
            }
        }
    }

    /// Needs what the operator's effects on kept variables need; whether it has no others.
    fn operator(&mut self, operator: OperatorId) -> bool {
        let task = self.task;
        let mut done = true;
        let mut any = false;
        for effect in task.effects(operator) {
            if self.kept[effect.fact.variable.index()] {
                any = true;
                if !effect.conditions.is_empty()
                    && self.reached.all(task.conditions(&effect.conditions))
                {
                    self.need(task.conditions(&effect.conditions));
                }
            } else {
                done &= effect.conditions.is_empty();
            }
        }
        if any {
            self.need(task.precondition(operator));
        }
        any && done
    }

    /// Needs what the axiom needs if its head is kept; whether it is.
    fn axiom(&mut self, axiom: u32) -> bool {
        let axiom = &self.task.axioms[axiom as usize];
        let kept = self.kept[axiom.head.variable.index()];
        if kept && self.reached.all(self.task.conditions(&axiom.conditions)) {
            self.need(self.task.conditions(&axiom.conditions));
        }
        kept
    }
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
    let facts = &mut pool[start..*end];
    if !facts.is_sorted() {
        facts.sort_unstable();
    }
    start as u32..*end as u32
}

/// Renames operators in place: nothing ever grows, so each pool is read ahead of where it is written.
fn rewrite_operators(task: &mut Task, origins: &mut Vec<u32>, pruned: &Pruned, reached: &Reach) {
    let mut ends = Ends::default();
    let mut kept = 0;
    for index in 0..task.operators.len() {
        let mut operator = task.operators[index].clone();
        if pruned.unsolvable || !reached.all(task.precondition(OperatorId(index as u32))) {
            continue;
        }
        let start = ends.effects;
        for position in operator.effects.clone() {
            let Effect { conditions, fact } = task.effect_pool[position as usize].clone();
            let Some(fact) = pruned.fact(fact) else { continue };
            if reached.all(task.conditions(&conditions)) {
                let pool = &mut task.condition_pool;
                let conditions = compact(pool, &conditions, &mut ends.conditions, pruned);
                task.effect_pool[ends.effects] = Effect { conditions, fact };
                ends.effects += 1;
            }
        }
        if ends.effects == start {
            continue;
        }
        let pool = &mut task.precondition_pool;
        operator.precondition =
            compact(pool, &operator.precondition, &mut ends.preconditions, pruned);
        ends.effects = sort_effects(&mut task.effect_pool, start, ends.effects);
        operator.effects = start as u32..ends.effects as u32;
        task.operators[kept] = operator;
        origins[kept] = origins[index];
        kept += 1;
    }
    task.operators.truncate(kept);
    origins.truncate(kept);
    let ends = twins::merge(task, origins, ends);
    task.operators.shrink_to_fit();
    origins.shrink_to_fit();
    task.precondition_pool.truncate(ends.preconditions);
    task.precondition_pool.shrink_to_fit();
    task.effect_pool.truncate(ends.effects);
    task.effect_pool.shrink_to_fit();
    move_axiom_conditions(task, ends.conditions);
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
