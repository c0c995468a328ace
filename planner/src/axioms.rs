//! The values of the state variables go in; those of the derived variables come out.
//!
//! Layer by layer, a queue of facts counts down the unsatisfied conditions of each axiom, and one that reaches zero sets its head.
//! What no axiom of a layer has set by then has its default value for good: conditions of higher layers on that value are counted down next.

use crate::task::Task;

/// Evaluates the axioms of one task, with the space it needs for that.
#[derive(Debug, Clone)]
pub struct Evaluator {
    /// For each variable where its facts start.
    offsets: Vec<u32>,
    /// For each fact the axioms that it is a condition of, in one array.
    users: Vec<u32>,
    user_starts: Vec<u32>,
    /// State variables that occur in conditions.
    inputs: Vec<u32>,
    /// For each layer the derived variables in it, with their defaults.
    layers: Vec<Vec<(u32, u32)>>,
    heads: Vec<(u32, u32)>,
    conditions: Vec<u32>,
    /// Axioms without conditions.
    facts: Vec<u32>,
    unsatisfied: Vec<u32>,
    queue: Vec<(u32, u32)>,
}

impl Evaluator {
    /// Prepares the axioms of `task`.
    pub fn new(task: &Task) -> Self {
        let mut offsets = Vec::with_capacity(task.variables.len());
        let mut fact_count = 0;
        for variable in &task.variables {
            offsets.push(fact_count);
            fact_count += variable.domain_size;
        }
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        let mut is_input = vec![false; task.variables.len()];
        for (axiom, index) in task.axioms.iter().zip(0..) {
            for condition in task.conditions(&axiom.conditions) {
                pairs.push((offsets[condition.variable.index()] + condition.value, index));
                is_input[condition.variable.index()] |=
                    task.variables[condition.variable.index()].axiom_layer.is_none();
            }
        }
        let (user_starts, users) = by_key(&pairs, fact_count as usize);
        let mut layers: Vec<Vec<(u32, u32)>> = Vec::new();
        for (variable, index) in task.variables.iter().zip(0..) {
            if let Some(layer) = variable.axiom_layer {
                layers.resize(layers.len().max(layer as usize + 1), Vec::new());
                layers[layer as usize].push((index, variable.default));
            }
        }
        layers.retain(|layer| !layer.is_empty());
        let conditions: Vec<u32> =
            task.axioms.iter().map(|axiom| axiom.conditions.len() as u32).collect();
        Self {
            offsets,
            users,
            user_starts,
            inputs: (0..)
                .zip(&is_input)
                .filter(|&(_, &input)| input)
                .map(|(variable, _)| variable)
                .collect(),
            layers,
            heads: task
                .axioms
                .iter()
                .map(|axiom| (axiom.head.variable.0, axiom.head.value))
                .collect(),
            facts: (0..)
                .zip(&conditions)
                .filter(|&(_, &count)| count == 0)
                .map(|(axiom, _)| axiom)
                .collect(),
            unsatisfied: conditions.clone(),
            conditions,
            queue: Vec::new(),
        }
    }

    /// Sets the derived variables in `values` from the state variables there.
    pub fn evaluate(&mut self, values: &mut [u32]) {
        for &(variable, default) in self.layers.iter().flatten() {
            values[variable as usize] = default;
        }
        self.unsatisfied.copy_from_slice(&self.conditions);
        for &axiom in &self.facts {
            set(self.heads[axiom as usize], values, &mut self.queue);
        }
        for index in 0..self.inputs.len() {
            let variable = self.inputs[index];
            self.satisfy((variable, values[variable as usize]), values);
        }
        self.drain(values);
        for layer in 0..self.layers.len() {
            for index in 0..self.layers[layer].len() {
                let (variable, default) = self.layers[layer][index];
                if values[variable as usize] == default {
                    self.satisfy((variable, default), values);
                }
            }
            self.drain(values);
        }
    }

    fn drain(&mut self, values: &mut [u32]) {
        while let Some(fact) = self.queue.pop() {
            self.satisfy(fact, values);
        }
    }

    #[inline]
    fn satisfy(&mut self, (variable, value): (u32, u32), values: &mut [u32]) {
        let fact = (self.offsets[variable as usize] + value) as usize;
        for &axiom in
            &self.users[self.user_starts[fact] as usize..self.user_starts[fact + 1] as usize]
        {
            let left = &mut self.unsatisfied[axiom as usize];
            *left -= 1;
            if *left == 0 {
                set(self.heads[axiom as usize], values, &mut self.queue);
            }
        }
    }
}

#[inline]
fn set(head: (u32, u32), values: &mut [u32], queue: &mut Vec<(u32, u32)>) {
    if values[head.0 as usize] != head.1 {
        values[head.0 as usize] = head.1;
        queue.push(head);
    }
}

/// Groups the second parts of `pairs` by the first: where each group starts, and all groups in one array, each in the order of `pairs`.
pub(crate) fn by_key(pairs: &[(u32, u32)], keys: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; keys + 1];
    for &(key, _) in pairs {
        starts[key as usize + 1] += 1;
    }
    for key in 0..keys {
        starts[key + 1] += starts[key];
    }
    let mut next = starts.clone();
    let mut grouped = vec![0; pairs.len()];
    for &(key, value) in pairs {
        let at = &mut next[key as usize];
        grouped[*at as usize] = value;
        *at += 1;
    }
    (starts, grouped)
}
