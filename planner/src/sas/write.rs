//! An encoded problem goes in; the file that Fast Downward's search reads comes out.
//!
//! The format is that of the translator of Fast Downward (documented on its page "Translator output format", version 3).

use std::io::{self, Write};

use lang::model::{Domain, ObjectId, Problem};

use crate::encode::{Encoded, Value};
use crate::grounded::{FactId, Grounded};
use crate::normal::Normal;
use crate::task::{Effect, Fact, OperatorId, Task, VariableId};

/// Spelled names, in lower case, of what ground facts and operators are made of.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// By [`lang::model::PredicateId`], with the auxiliary predicates of the normal form.
    pub predicates: Vec<String>,
    /// By [`lang::model::ActionId`].
    pub actions: Vec<String>,
    /// By [`ObjectId`].
    pub objects: Vec<String>,
}

impl Names {
    /// The names of a problem.
    pub fn new(domain: &Domain, problem: &Problem, normal: &Normal) -> Self {
        Self {
            predicates: normal
                .predicates
                .iter()
                .map(|predicate| predicate.name.to_lowercase())
                .collect(),
            actions: domain.actions.iter().map(|action| action.name.text.to_lowercase()).collect(),
            objects: problem.objects.iter().map(|object| object.name.text.to_lowercase()).collect(),
        }
    }
}

/// Counts in the words of Fast Downward's translator, a line each.
pub fn summary(encoded: &Encoded) -> String {
    let task = &encoded.task;
    let derived = task.variables.iter().filter(|variable| variable.axiom_layer.is_some()).count();
    let facts: u64 = task.variables.iter().map(|variable| u64::from(variable.domain_size)).sum();
    let sizes: usize = task.mutex_groups.iter().map(Vec::len).sum();
    let counts = [
        ("variables", task.variables.len()),
        ("derived variables", derived),
        ("facts", facts as usize),
        ("goal facts", task.goal.len()),
        ("mutex groups", task.mutex_groups.len()),
        ("total mutex groups size", sizes),
        ("operators", task.operators.len()),
        ("axioms", task.axioms.len()),
    ];
    let line = |(what, count): &(&str, usize)| format!("Translator {what}: {count}\n");
    counts.iter().map(line).collect::<Vec<_>>().concat()
}

/// Writes the whole file.
///
/// # Errors
/// Those of `out`.
pub fn write(
    encoded: &Encoded,
    grounded: &Grounded,
    names: &Names,
    out: &mut impl Write,
) -> io::Result<()> {
    let task = &encoded.task;
    let mut text = Text { bytes: Vec::with_capacity(2 * BUFFER), out };
    text.line("begin_version\n3\nend_version\nbegin_metric");
    text.number(u32::from(task.uses_metric)).end();
    text.line("end_metric");
    variables(&mut text, encoded, grounded, names)?;
    text.number(task.mutex_groups.len() as u32).end();
    for group in &task.mutex_groups {
        text.line("begin_mutex_group");
        facts(&mut text, group);
        text.line("end_mutex_group");
        text.flush_if_full()?;
    }
    text.line("begin_state");
    for &value in &task.initial_state {
        text.number(value).end();
    }
    text.line("end_state\nbegin_goal");
    facts(&mut text, &task.goal);
    text.line("end_goal");
    operators(&mut text, encoded, grounded, names)?;
    text.number(task.axioms.len() as u32).end();
    for axiom in &task.axioms {
        text.line("begin_rule");
        facts(&mut text, task.conditions(&axiom.conditions));
        let default = task.variables[axiom.head.variable.index()].default;
        text.number(axiom.head.variable.0)
            .space()
            .number(default)
            .space()
            .number(axiom.head.value)
            .end();
        text.line("end_rule");
        text.flush_if_full()?;
    }
    text.flush()
}

fn variables(
    text: &mut Text<impl Write>,
    encoded: &Encoded,
    grounded: &Grounded,
    names: &Names,
) -> io::Result<()> {
    text.number(encoded.task.variables.len() as u32).end();
    for (index, variable) in encoded.task.variables.iter().enumerate() {
        text.line("begin_variable");
        text.push("var").number(index as u32).end();
        match variable.axiom_layer {
            None => text.line("-1"),
            Some(layer) => text.number(layer).end(),
        }
        text.number(variable.domain_size).end();
        for value in 0..variable.domain_size {
            match encoded.value(Fact { variable: VariableId(index as u32), value }) {
                Value::Atom(fact) => atom(text.push("Atom "), fact, grounded, names),
                Value::Negated(fact) => atom(text.push("NegatedAtom "), fact, grounded, names),
                Value::Other => text.line("<none of those>"),
            }
        }
        text.line("end_variable");
        text.flush_if_full()?;
    }
    Ok(())
}

fn atom(text: &mut Text<impl Write>, fact: FactId, grounded: &Grounded, names: &Names) {
    let fact = &grounded.facts[fact.index()];
    text.push(&names.predicates[fact.predicate.index()]).push("(");
    for (position, &ObjectId(object)) in grounded.arguments
        [fact.arguments.start as usize..fact.arguments.end as usize]
        .iter()
        .enumerate()
    {
        if position > 0 {
            text.push(", ");
        }
        text.push(&names.objects[object as usize]);
    }
    text.line(")");
}

/// A count, then a line for each fact.
fn facts(text: &mut Text<impl Write>, facts: &[Fact]) {
    text.number(facts.len() as u32).end();
    for fact in facts {
        text.number(fact.variable.0).space().number(fact.value).end();
    }
}

fn operators(
    text: &mut Text<impl Write>,
    encoded: &Encoded,
    grounded: &Grounded,
    names: &Names,
) -> io::Result<()> {
    let task = &encoded.task;
    text.number(task.operators.len() as u32).end();
    // For each variable the last operator that has an effect on it.
    let mut changed = vec![u32::MAX; task.variables.len()];
    for operator in task.operator_ids() {
        let origin = &grounded.operators[encoded.origins[operator.index()] as usize];
        text.line("begin_operator");
        text.push(&names.actions[origin.action.index()]);
        for object in
            &grounded.arguments[origin.arguments.start as usize..origin.arguments.end as usize]
        {
            text.space().push(&names.objects[object.index()]);
        }
        text.end();
        for effect in task.effects(operator) {
            changed[effect.fact.variable.index()] = operator.0;
        }
        let prevails = |fact: &&Fact| changed[fact.variable.index()] != operator.0;
        text.number(task.precondition(operator).iter().filter(prevails).count() as u32).end();
        for fact in task.precondition(operator).iter().filter(prevails) {
            text.number(fact.variable.0).space().number(fact.value).end();
        }
        text.number(task.effects(operator).len() as u32).end();
        for effect in task.effects(operator) {
            self::effect(text, task, operator, effect);
        }
        text.number(task.operators[operator.index()].cost).end();
        text.line("end_operator");
        text.flush_if_full()?;
    }
    Ok(())
}

/// One line: the conditions, the variable, its value before (-1 where any will do) and after.
fn effect(text: &mut Text<impl Write>, task: &Task, operator: OperatorId, effect: &Effect) {
    let conditions = task.conditions(&effect.conditions);
    text.number(conditions.len() as u32).space();
    for fact in conditions {
        text.number(fact.variable.0).space().number(fact.value).space();
    }
    let precondition = task.precondition(operator);
    text.number(effect.fact.variable.0).space();
    match precondition.iter().find(|fact| fact.variable == effect.fact.variable) {
        Some(before) => text.number(before.value),
        None => text.push("-1"),
    };
    text.space().number(effect.fact.value).end();
}

/// So many bytes are gathered before they are written.
const BUFFER: usize = 1 << 16;

/// Text on its way out.
struct Text<'a, W: Write> {
    bytes: Vec<u8>,
    out: &'a mut W,
}

impl<W: Write> Text<'_, W> {
    #[inline]
    fn push(&mut self, text: &str) -> &mut Self {
        self.bytes.extend_from_slice(text.as_bytes());
        self
    }

    #[inline]
    fn line(&mut self, text: &str) {
        self.push(text).end();
    }

    #[inline]
    fn space(&mut self) -> &mut Self {
        self.bytes.push(b' ');
        self
    }

    #[inline]
    fn end(&mut self) {
        self.bytes.push(b'\n');
    }

    /// Decimal digits, most significant first.
    #[inline]
    fn number(&mut self, mut number: u32) -> &mut Self {
        let mut digits = [0; 10];
        let mut start = digits.len();
        loop {
            start -= 1;
            digits[start] = b'0' + (number % 10) as u8;
            number /= 10;
            if number == 0 {
                break;
            }
        }
        self.bytes.extend_from_slice(&digits[start..]);
        self
    }

    fn flush_if_full(&mut self) -> io::Result<()> {
        if self.bytes.len() >= BUFFER { self.flush() } else { Ok(()) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.write_all(&self.bytes)?;
        self.bytes.clear();
        Ok(())
    }
}

#[cfg(test)]
mod tests;
