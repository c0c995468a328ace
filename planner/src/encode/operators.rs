//! Ground operators, axioms and the goal go in; their finite-domain forms come out, over the variables of a [`Layout`].

use std::ops::Range;

use crate::encode::cover::{Layout, NONE};
use crate::grounded::{self, FactId, Grounded, Literal};
use crate::limits::{Limits, Stop};
use crate::task::{Axiom, Effect, Fact, Operator, Task, VariableId};

/// How many operators pass between two looks at the limits.
const POLL: usize = 4096;

/// The task over the variables of the layout, before anything is pruned.
pub(super) struct Translated {
    /// Variables are those of the layout, axioms have no layers yet.
    pub(super) task: Task,
    /// For each operator the ground operator that it stems from.
    pub(super) origins: Vec<u32>,
    /// Whether a goal contradicts itself or another.
    pub(super) contradictory: bool,
}

/// Translates the whole ground problem.
pub(super) fn translate(
    grounded: &Grounded,
    layout: &Layout,
    limits: &Limits,
) -> Result<Translated, Stop> {
    let mut translator = Translator::new(grounded, layout);
    let mut origins = Vec::with_capacity(grounded.operators.len());
    // Nothing but duals makes the task longer than the ground problem; what is not used is given back when pruning ends.
    translator.task.operators.reserve(grounded.operators.len());
    translator.task.precondition_pool.reserve(grounded.literals.len());
    translator.task.effect_pool.reserve(grounded.effects.len());
    for (index, operator) in grounded.operators.iter().enumerate() {
        if index % POLL == 0
            && let Some(stop) = limits.stopped()
        {
            return Err(stop);
        }
        if translator.operator(operator) {
            origins.push(index as u32);
        }
    }
    for axiom in &grounded.axioms {
        translator.axiom(axiom);
    }
    translator.next_stamp();
    let goal = translator.precondition(&grounded.goal);
    translator.task.goal = std::mem::take(&mut translator.scratch);
    Ok(Translated { task: translator.task, origins, contradictory: !goal })
}

/// What is known about a variable while one operator is translated: each mark counts while it equals the translator's stamp.
#[derive(Debug, Clone, Copy, Default)]
struct Slot {
    /// The precondition fixes the variable to `value`.
    known: u32,
    value: u32,
    /// An unconditional effect sets the variable to one of its facts.
    added: u32,
    /// A conditional effect may do so.
    perhaps: u32,
    /// An effect that stems from a delete is kept.
    cleared: u32,
}

/// An effect on its way; conditions are a range of the translator's scratch.
struct Change {
    conditions: Range<usize>,
    fact: Fact,
}

struct Translator<'a> {
    grounded: &'a Grounded,
    layout: &'a Layout,
    task: Task,
    slots: Vec<Slot>,
    /// For each group the stamp under which the precondition holds one of its facts, and that fact.
    held: Vec<(u32, FactId)>,
    stamp: u32,
    scratch: Vec<Fact>,
    adds: Vec<Change>,
    deletes: Vec<Change>,
}

impl<'a> Translator<'a> {
    fn new(grounded: &'a Grounded, layout: &'a Layout) -> Self {
        let variables = layout.members.len();
        let groups = layout.crossing.bound();
        let mut task = Task { uses_metric: grounded.uses_metric, ..Task::default() };
        for (variable, members) in layout.members.iter().enumerate() {
            let derived = variable < layout.covering && grounded.derived[members[0].index()];
            let none = members.len() as u32;
            let holds = members.iter().position(|fact| grounded.initial[fact.index()]);
            task.initial_state.push(holds.map_or(none, |value| value as u32));
            task.variables.push(crate::task::Variable {
                domain_size: layout.size(variable),
                axiom_layer: derived.then_some(0),
                default: if derived { none } else { 0 },
            });
        }
        Self {
            grounded,
            layout,
            task,
            slots: vec![Slot::default(); variables],
            held: vec![(0, FactId(0)); groups],
            stamp: 0,
            scratch: Vec::new(),
            adds: Vec::new(),
            deletes: Vec::new(),
        }
    }

    fn next_stamp(&mut self) {
        self.stamp += 1;
        self.scratch.clear();
        self.adds.clear();
        self.deletes.clear();
    }

    fn literals(&self, range: &Range<u32>) -> &'a [Literal] {
        let grounded: &'a Grounded = self.grounded;
        &grounded.literals[range.start as usize..range.end as usize]
    }

    /// Whether the operator is kept; one that can never be applied or never changes anything is not.
    fn operator(&mut self, operator: &grounded::Operator) -> bool {
        self.next_stamp();
        if !self.precondition(self.literals(&operator.precondition)) {
            return false;
        }
        let pool = self.task.precondition_pool.len() as u32;
        let conditions = self.task.condition_pool.len();
        let effects = self.task.effect_pool.len() as u32;
        let preconditions = self.scratch.len();
        let ground_effects =
            &self.grounded.effects[operator.effects.start as usize..operator.effects.end as usize];
        if !self.collect_adds(ground_effects) {
            return false;
        }
        self.collect_deletes(ground_effects);
        self.emit_effects();
        if self.task.effect_pool.len() as u32 == effects {
            self.task.condition_pool.truncate(conditions);
            return false;
        }
        self.task.precondition_pool.extend_from_slice(&self.scratch[..preconditions]);
        let ends = (self.task.precondition_pool.len() as u32, self.task.effect_pool.len() as u32);
        self.task.operators.push(Operator {
            precondition: pool..ends.0,
            effects: effects..ends.1,
            cost: operator.cost,
        });
        true
    }

    /// Leaves the precondition (of an operator or an axiom, or the goal) in the scratch, not sorted, and marks what it fixes; false if it
    /// can never hold.
    fn precondition(&mut self, literals: &[Literal]) -> bool {
        for literal in literals.iter().filter(|literal| literal.positive) {
            let home = self.layout.homes[literal.fact.index()];
            match self.known(home.variable) {
                Some(value) if value == home.value => continue,
                Some(_) => return false,
                None => {
                    self.fix(home);
                    self.scratch.push(home);
                }
            }
            let dual = self.layout.duals[literal.fact.index()];
            if dual != NONE {
                self.fix(Fact { variable: VariableId(dual), value: 0 });
            }
            for &group in self.layout.crossing.row(literal.fact.index()) {
                let held = &mut self.held[group as usize];
                if held.0 == self.stamp && held.1 != literal.fact {
                    return false;
                }
                *held = (self.stamp, literal.fact);
            }
        }
        for literal in literals.iter().filter(|literal| !literal.positive) {
            match self.truth(literal.fact) {
                Some(true) => return false,
                Some(false) => {
                    let dual = self.layout.duals[literal.fact.index()];
                    if dual != NONE {
                        self.fix(Fact { variable: VariableId(dual), value: 1 });
                    }
                }
                None => {
                    let negation = self.negation(literal.fact);
                    self.fix(negation);
                    self.scratch.push(negation);
                }
            }
        }
        true
    }

    /// Marks a variable as fixed by the precondition.
    fn fix(&mut self, fact: Fact) {
        let slot = &mut self.slots[fact.variable.index()];
        slot.known = self.stamp;
        slot.value = fact.value;
    }

    /// What the precondition fixes a variable to.
    #[inline]
    fn known(&self, variable: VariableId) -> Option<u32> {
        let slot = &self.slots[variable.index()];
        (slot.known == self.stamp).then_some(slot.value)
    }

    /// Whether the fact holds where the precondition does, if that is settled.
    fn truth(&self, fact: FactId) -> Option<bool> {
        let home = self.layout.homes[fact.index()];
        if let Some(value) = self.known(home.variable) {
            return Some(value == home.value);
        }
        let dual = self.layout.duals[fact.index()];
        if dual != NONE
            && let Some(value) = self.known(VariableId(dual))
        {
            return Some(value == 0);
        }
        let excluded = |&group: &u32| {
            let (stamp, held) = self.held[group as usize];
            stamp == self.stamp && held != fact
        };
        self.layout.crossing.row(fact.index()).iter().any(excluded).then_some(false)
    }

    /// The value that says that the fact does not hold.
    fn negation(&self, fact: FactId) -> Fact {
        let dual = self.layout.duals[fact.index()];
        if dual != NONE {
            return Fact { variable: VariableId(dual), value: 1 };
        }
        let home = self.layout.homes[fact.index()];
        debug_assert_eq!(
            self.layout.size(home.variable.index()),
            2,
            "every other fact that is asked for negatively has a dual"
        );
        Fact { variable: home.variable, value: 1 - home.value }
    }

    /// Appends a condition to the scratch, without what the precondition implies; false, with nothing appended, if it can never hold.
    fn conditions(&mut self, literals: &[Literal]) -> bool {
        let start = self.scratch.len();
        let possible = self.append_conditions(literals, start);
        if !possible {
            self.scratch.truncate(start);
        }
        possible
    }

    fn append_conditions(&mut self, literals: &[Literal], start: usize) -> bool {
        for literal in literals.iter().filter(|literal| literal.positive) {
            match self.truth(literal.fact) {
                Some(true) => {}
                Some(false) => return false,
                None => self.scratch.push(self.layout.homes[literal.fact.index()]),
            }
        }
        for literal in literals.iter().filter(|literal| !literal.positive) {
            match self.truth(literal.fact) {
                Some(true) => return false,
                Some(false) => {}
                None => {
                    let home = self.layout.homes[literal.fact.index()];
                    match self.scratch[start..].iter().find(|fact| fact.variable == home.variable) {
                        Some(fact) if *fact == home => return false,
                        Some(_) => {}
                        None => self.scratch.push(self.negation(literal.fact)),
                    }
                }
            }
        }
        self.scratch[start..].sort_unstable();
        let mut end = start;
        for index in start..self.scratch.len() {
            let fact = self.scratch[index];
            if end > start && self.scratch[end - 1].variable == fact.variable {
                if self.scratch[end - 1] != fact {
                    return false;
                }
            } else {
                self.scratch[end] = fact;
                end += 1;
            }
        }
        self.scratch.truncate(end);
        true
    }

    /// Collects the adds; false if two of them would always make two facts of one group true: then the precondition never holds.
    fn collect_adds(&mut self, effects: &[grounded::Effect]) -> bool {
        for effect in effects.iter().filter(|effect| effect.literal.positive) {
            let start = self.scratch.len();
            if !self.conditions(self.literals(&effect.conditions)) {
                continue;
            }
            let conditions = start..self.scratch.len();
            let home = self.layout.homes[effect.literal.fact.index()];
            let dual = self.layout.duals[effect.literal.fact.index()];
            if conditions.is_empty() {
                if self.slots[home.variable.index()].added == self.stamp {
                    let earlier = self.adds.iter().find(|add| {
                        add.fact.variable == home.variable && add.conditions.is_empty()
                    });
                    if earlier.is_some_and(|add| add.fact != home) {
                        return false;
                    }
                    continue;
                }
                self.slots[home.variable.index()].added = self.stamp;
                if dual != NONE {
                    self.slots[dual as usize].added = self.stamp;
                }
            } else {
                self.slots[home.variable.index()].perhaps = self.stamp;
                if dual != NONE {
                    self.slots[dual as usize].perhaps = self.stamp;
                }
            }
            self.adds.push(Change { conditions: conditions.clone(), fact: home });
            if dual != NONE {
                self.adds.push(Change {
                    conditions,
                    fact: Fact { variable: VariableId(dual), value: 0 },
                });
            }
        }
        true
    }

    /// Collects the deletes that may change something, with the conditions under which they do.
    fn collect_deletes(&mut self, effects: &[grounded::Effect]) {
        for effect in effects.iter().filter(|effect| !effect.literal.positive) {
            let fact = effect.literal.fact;
            if self.truth(fact) == Some(false) {
                continue;
            }
            let start = self.scratch.len();
            if !self.conditions(self.literals(&effect.conditions)) {
                continue;
            }
            let end = self.scratch.len();
            self.collect_delete(self.layout.homes[fact.index()], start..end);
            let dual = self.layout.duals[fact.index()];
            if dual != NONE {
                self.collect_delete(Fact { variable: VariableId(dual), value: 0 }, start..end);
            }
        }
    }

    /// Collects what it means that `fact` is deleted under the conditions: its variable, if it has that value, has none.
    fn collect_delete(&mut self, fact: Fact, conditions: Range<usize>) {
        let variable = fact.variable.index();
        if self.slots[variable].added == self.stamp {
            return;
        }
        let mut conditions = conditions;
        match self.scratch[conditions.clone()]
            .iter()
            .find(|condition| condition.variable == fact.variable)
        {
            Some(condition) if *condition == fact => {}
            Some(_) => return,
            None if self.task.variables[variable].domain_size > 2
                && self.known(fact.variable).is_none() =>
            {
                let start = self.scratch.len();
                self.scratch.extend_from_within(conditions);
                self.scratch.push(fact);
                self.scratch[start..].sort_unstable();
                conditions = start..self.scratch.len();
            }
            None => {}
        }
        if self.slots[variable].perhaps == self.stamp && self.always_refilled(fact, &conditions) {
            return;
        }
        if !self.layout.open[variable] {
            debug_assert!(false, "one fact of a closed variable always holds");
            return;
        }
        self.slots[variable].cleared = self.stamp;
        let none = self.layout.members[variable].len() as u32;
        self.deletes
            .push(Change { conditions, fact: Fact { variable: fact.variable, value: none } });
    }

    /// Whether some add to the variable of `fact` fires whenever `fact` holds and the conditions do.
    fn always_refilled(&self, fact: Fact, conditions: &Range<usize>) -> bool {
        let given = &self.scratch[conditions.clone()];
        self.adds.iter().filter(|add| add.fact.variable == fact.variable).any(|add| {
            self.scratch[add.conditions.clone()]
                .iter()
                .all(|needed| *needed == fact || given.binary_search(needed).is_ok())
        })
    }

    /// Moves deletes, then adds, to the pools of the task, without those that change nothing.
    fn emit_effects(&mut self) {
        self.merge_deletes();
        for index in 0..self.deletes.len() {
            let Change { conditions, fact } = &self.deletes[index];
            if self.known(fact.variable) != Some(fact.value) {
                self.task.push_effect(&self.scratch[conditions.clone()], *fact);
            }
        }
        for index in 0..self.adds.len() {
            let Change { conditions, fact } = &self.adds[index];
            let slot = &self.slots[fact.variable.index()];
            if slot.added == self.stamp && !conditions.is_empty() {
                // The unconditional add beside it adds the same fact, or else the condition never holds.
                continue;
            }
            let conditions = &self.scratch[conditions.clone()];
            let holds_before = self.known(fact.variable) == Some(fact.value)
                || conditions.binary_search(fact).is_ok();
            if !holds_before || slot.cleared == self.stamp {
                self.task.push_effect(conditions, *fact);
            }
        }
    }

    /// Where an operator deletes all facts of a variable, whichever holds, one unconditional effect says so.
    fn merge_deletes(&mut self) {
        if self.deletes.len() < 2 {
            return;
        }
        self.deletes.sort_by_key(|delete| delete.fact.variable);
        let mut kept = 0;
        let mut start = 0;
        while start < self.deletes.len() {
            let variable = self.deletes[start].fact.variable;
            let run = self.deletes[start..]
                .iter()
                .take_while(|delete| delete.fact.variable == variable)
                .count();
            let own = |delete: &Change| match self.scratch[delete.conditions.clone()] {
                [only] if only.variable == variable => Some(only.value),
                _ => None,
            };
            let mut values: Vec<u32> = Vec::new();
            if run >= self.layout.members[variable.index()].len() {
                values.extend(self.deletes[start..start + run].iter().filter_map(own));
                values.sort_unstable();
                values.dedup();
            }
            if values.len() > 1 && values.len() == self.layout.members[variable.index()].len() {
                self.deletes[start].conditions = 0..0;
                self.deletes.swap(kept, start);
                kept += 1;
            } else {
                for index in start..start + run {
                    self.deletes.swap(kept, index);
                    kept += 1;
                }
            }
            start += run;
        }
        self.deletes.truncate(kept);
    }

    fn axiom(&mut self, axiom: &grounded::Axiom) {
        self.next_stamp();
        if !self.precondition(self.literals(&axiom.conditions)) {
            return;
        }
        let start = self.task.condition_pool.len() as u32;
        self.task.condition_pool.extend_from_slice(&self.scratch);
        let conditions = start..self.task.condition_pool.len() as u32;
        self.task.axioms.push(Axiom { conditions, head: self.layout.homes[axiom.head.index()] });
    }
}

impl Task {
    /// Appends an effect to the pools.
    fn push_effect(&mut self, conditions: &[Fact], fact: Fact) {
        let start = self.condition_pool.len() as u32;
        self.condition_pool.extend_from_slice(conditions);
        let end = self.condition_pool.len() as u32;
        self.effect_pool.push(Effect { conditions: start..end, fact });
    }
}
