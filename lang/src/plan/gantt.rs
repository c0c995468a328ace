//! A joint plan goes in; a picture in text comes out: a row for each agent, a column for each joint step.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::{JointPlan, Step};
use crate::model::{Domain, ObjectId, Problem};

/// Columns that a line may have before the picture goes on below.
const WIDEST: usize = 120;

/// The picture. Agents stand in the order of their objects; what has no agent is in a row `-`.
pub fn gantt(plan: &JointPlan, domain: &Domain, problem: &Problem) -> String {
    let name = |object: ObjectId| problem.objects[object.index()].name.text.to_lowercase();
    let agent = |step: &Step| {
        let acts = domain.actions[step.action.index()].agent;
        acts.then(|| step.arguments.first().copied()).flatten()
    };
    let mut rows: BTreeMap<Option<ObjectId>, Vec<String>> = BTreeMap::new();
    for parts in &plan.steps {
        for part in parts {
            rows.entry(agent(part)).or_default();
        }
    }
    let mut widths = Vec::new();
    for (at, parts) in plan.steps.iter().enumerate() {
        for part in parts {
            let skipped = usize::from(agent(part).is_some());
            let mut words = vec![domain.actions[part.action.index()].name.text.to_lowercase()];
            words.extend(part.arguments.iter().skip(skipped).map(|&object| name(object)));
            let row = rows.get_mut(&agent(part)).expect("each agent has a row");
            row.resize(at, String::new());
            row.push(words.join(" "));
        }
        let longest = rows.values().filter_map(|row| row.get(at)).map(|cell| cell.chars().count());
        widths.push(longest.max().unwrap_or(0).max((at + 1).to_string().len()));
    }
    let label = |agent: &Option<ObjectId>| agent.map_or_else(|| "-".to_owned(), name);
    let first = rows.keys().map(|agent| label(agent).chars().count()).max().unwrap_or(0).max(4);
    let mut text = String::new();
    let mut from = 0;
    while from < widths.len() {
        let mut to = from;
        let mut width = first;
        while to < widths.len() && (to == from || width + widths[to] + 3 <= WIDEST) {
            width += widths[to] + 3;
            to += 1;
        }
        if from > 0 {
            text.push('\n');
        }
        let numbers: Vec<String> = (from..to).map(|at| (at + 1).to_string()).collect();
        line(&mut text, "step", first, numbers.iter().zip(&widths[from..to]));
        let rule: Vec<String> = widths[from..to].iter().map(|&width| "-".repeat(width)).collect();
        line(&mut text, &"-".repeat(first), first, rule.iter().zip(&widths[from..to]));
        for (agent, row) in &rows {
            let cells: Vec<String> =
                (from..to).map(|at| row.get(at).cloned().unwrap_or_default()).collect();
            line(&mut text, &label(agent), first, cells.iter().zip(&widths[from..to]));
        }
        from = to;
    }
    text
}

fn line<'a>(
    text: &mut String,
    label: &str,
    first: usize,
    cells: impl Iterator<Item = (&'a String, &'a usize)>,
) {
    let mut line = format!("{label:<first$}");
    for (cell, &width) in cells {
        write!(line, " | {cell:<width$}").expect("a string takes all that is written to it");
    }
    text.push_str(line.trim_end());
    text.push('\n');
}
