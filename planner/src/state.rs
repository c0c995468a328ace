//! A task goes in; a [`Packer`] comes out, which turns values into packed words and applies operators to packed words.
//!
//! Only state variables are packed: a derived value follows from them. Variables fill the words largest first, so that little of a word is lost.
//! A state of 40 binary variables takes two words. Effects are kept as masks over words, so that an operator without conditional effects costs one
//! step per touched word, however many effects it has.

use std::ops::Range;

use crate::task::{Fact, OperatorId, Task, VariableId};

/// Bits in a word of a packed state.
const WORD_BITS: u32 = u32::BITS;

/// Where a state variable stands.
#[derive(Debug, Clone, Copy)]
struct Field {
    variable: u32,
    word: u32,
    shift: u32,
    /// Unshifted: the largest value that fits.
    mask: u32,
}

/// Replaces the bits outside `keep` by those of `set`.
#[derive(Debug, Clone, Copy)]
struct Write {
    word: u32,
    keep: u32,
    set: u32,
}

impl Write {
    #[inline]
    fn apply(self, words: &mut [u32]) {
        let word = &mut words[self.word as usize];
        *word = (*word & self.keep) | self.set;
    }
}

/// A write that happens where conditions hold in the state before.
#[derive(Debug, Clone)]
struct Guarded {
    conditions: Range<u32>,
    write: Write,
}

/// What the operators do to packed states: for each operator a range of plain writes, or one of guarded writes.
#[derive(Debug, Clone, Default)]
struct Transitions {
    plain: Vec<Write>,
    plain_starts: Vec<u32>,
    guarded: Vec<Guarded>,
    guarded_starts: Vec<u32>,
}

/// Turns values into packed words, back, and one packed state into its successor.
#[derive(Debug, Clone)]
pub struct Packer {
    fields: Vec<Field>,
    /// For each variable its entry in `fields`; `u32::MAX` for a derived one.
    field_of: Vec<u32>,
    words: usize,
    transitions: Transitions,
    /// The goal as (word, mask, value), if it names no derived variable.
    goal: Option<Vec<(u32, u32, u32)>>,
}

impl Packer {
    /// Lays out the state variables of `task`.
    pub fn new(task: &Task) -> Self {
        let (fields, words) = layout(task);
        let mut field_of = vec![u32::MAX; task.variables.len()];
        for (index, field) in fields.iter().enumerate() {
            field_of[field.variable as usize] = index as u32;
        }
        let mut packer =
            Self { fields, field_of, words, transitions: Transitions::default(), goal: None };
        packer.transitions = packer.transitions_of(task);
        packer.goal = packer.goal_of(task);
        packer
    }

    /// How many words a state takes.
    #[inline]
    pub fn words(&self) -> usize {
        self.words
    }

    fn field(&self, variable: VariableId) -> Option<Field> {
        self.fields.get(self.field_of[variable.index()] as usize).copied()
    }

    fn write_of(&self, fact: Fact) -> Write {
        let field = self.field(fact.variable).expect("operators set state variables only");
        Write {
            word: field.word,
            keep: !(field.mask << field.shift),
            set: fact.value << field.shift,
        }
    }

    fn transitions_of(&self, task: &Task) -> Transitions {
        let mut transitions = Transitions::default();
        for operator in task.operator_ids() {
            transitions.plain_starts.push(transitions.plain.len() as u32);
            transitions.guarded_starts.push(transitions.guarded.len() as u32);
            let effects = task.effects(operator);
            if effects.iter().any(|effect| !effect.conditions.is_empty()) {
                for effect in effects {
                    transitions.guarded.push(Guarded {
                        conditions: effect.conditions.clone(),
                        write: self.write_of(effect.fact),
                    });
                }
            } else {
                let first = transitions.plain.len();
                for effect in effects {
                    let write = self.write_of(effect.fact);
                    match transitions.plain[first..]
                        .iter_mut()
                        .find(|other| other.word == write.word)
                    {
                        Some(other) => {
                            other.keep &= write.keep;
                            other.set = (other.set & write.keep) | write.set;
                        }
                        None => transitions.plain.push(write),
                    }
                }
            }
        }
        transitions.plain_starts.push(transitions.plain.len() as u32);
        transitions.guarded_starts.push(transitions.guarded.len() as u32);
        transitions
    }

    fn goal_of(&self, task: &Task) -> Option<Vec<(u32, u32, u32)>> {
        let mut goal: Vec<(u32, u32, u32)> = Vec::new();
        for &fact in &task.goal {
            let field = self.field(fact.variable)?;
            let (mask, value) = (field.mask << field.shift, fact.value << field.shift);
            match goal.iter_mut().find(|entry| entry.0 == field.word) {
                Some(entry) => {
                    entry.1 |= mask;
                    entry.2 |= value;
                }
                None => goal.push((field.word, mask, value)),
            }
        }
        Some(goal)
    }

    /// Packs the state variables of `values` into `words`.
    pub fn pack(&self, values: &[u32], words: &mut [u32]) {
        words.fill(0);
        for field in &self.fields {
            debug_assert!(
                values[field.variable as usize] <= field.mask,
                "a value is less than the domain size"
            );
            words[field.word as usize] |= values[field.variable as usize] << field.shift;
        }
    }

    /// Writes the state variables of `words` into `values`; derived variables stay as they are.
    #[inline]
    pub fn unpack(&self, words: &[u32], values: &mut [u32]) {
        for field in &self.fields {
            values[field.variable as usize] =
                (words[field.word as usize] >> field.shift) & field.mask;
        }
    }

    /// Applies `operator` to `words`, which hold the state before; `values` is the same state unpacked, with derived values.
    #[inline]
    pub fn apply(&self, task: &Task, operator: OperatorId, values: &[u32], words: &mut [u32]) {
        let index = operator.index();
        let table = &self.transitions;
        for write in
            &table.plain[table.plain_starts[index] as usize..table.plain_starts[index + 1] as usize]
        {
            write.apply(words);
        }
        for guarded in &table.guarded
            [table.guarded_starts[index] as usize..table.guarded_starts[index + 1] as usize]
        {
            if holds(task.conditions(&guarded.conditions), values) {
                guarded.write.apply(words);
            }
        }
    }

    /// Whether the goal holds, if that can be read from the words alone.
    #[inline]
    pub fn is_goal(&self, words: &[u32]) -> Option<bool> {
        self.goal.as_ref().map(|goal| {
            goal.iter().all(|&(word, mask, value)| words[word as usize] & mask == value)
        })
    }
}

/// Whether all `facts` hold in `values`.
#[inline]
pub fn holds(facts: &[Fact], values: &[u32]) -> bool {
    facts.iter().all(|fact| values[fact.variable.index()] == fact.value)
}

/// First-fit decreasing: each variable, largest first, goes to the first word with room for it.
fn layout(task: &Task) -> (Vec<Field>, usize) {
    let bits = |domain: u32| WORD_BITS - domain.saturating_sub(1).leading_zeros();
    let mut variables: Vec<(u32, u32)> = task
        .variables
        .iter()
        .zip(0..)
        .filter(|(variable, _)| variable.axiom_layer.is_none())
        .map(|(variable, id)| (bits(variable.domain_size).max(1), id))
        .collect();
    variables.sort_by_key(|&(width, id)| (u32::MAX - width, id));
    let mut used: Vec<u32> = Vec::new();
    // Words before this one have no room for the present width; as widths only fall they may get room again for smaller ones.
    let mut open = 0;
    let mut last_width = 0;
    let mut fields = Vec::with_capacity(variables.len());
    for (width, variable) in variables {
        if width != last_width {
            open = 0;
            last_width = width;
        }
        while open < used.len() && used[open] + width > WORD_BITS {
            open += 1;
        }
        if open == used.len() {
            used.push(0);
        }
        let mask = if width == WORD_BITS { u32::MAX } else { (1 << width) - 1 };
        fields.push(Field { variable, word: open as u32, shift: used[open], mask });
        used[open] += width;
    }
    fields.sort_by_key(|field| (field.word, field.shift));
    (fields, used.len().max(1))
}
