//! Deeds of several hands go in; which of them only go together comes out, as partners of actions.
//!
//! The guidelines of the thesis (section 3.2.4) tie together whatever two hands do at the same time.
//! That locks hands together that only happened to be busy; [`Synergy::Needed`] ties what one hand could not have done alone.

use std::collections::BTreeMap;

use lang::model::{ActionId, ObjectId, Term, VariableId};

use crate::rule::{Learned, Partner};

use super::deed::{Deed, Deeds, Verb};
use super::line::Line;
use super::record::{Grip, Record};

/// Which deeds of two hands are tied together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Synergy {
    /// What happened at the same time, as long as no hand was idle: the thesis.
    Thesis,
    /// What happened while both hands were in teach mode, as in kinesthetic teaching.
    Flag,
    /// What changed something that both hands held.
    #[default]
    Needed,
}

/// Two deeds belong together if they overlap for so much of the shorter one.
const OVERLAP: f64 = 0.5;

/// Ties deeds together by what happened at the same time; [`Synergy::Needed`] is what [`super::deed::deeds`] has found already.
pub fn tie(record: &Record, found: &mut Deeds, synergy: Synergy) {
    if synergy == Synergy::Needed {
        return;
    }
    // What was found by need comes again if it also was at the same time.
    found.deeds.retain(|deed| deed.verb != Verb::Hold);
    for deed in &mut found.deeds {
        deed.with.clear();
    }
    let grips = record.grips();
    let mut holds: Vec<Deed> = Vec::new();
    let count = found.deeds.len();
    for place in 0..count {
        if !found.deeds[place].with.is_empty() {
            continue;
        }
        let deed = &found.deeds[place];
        if synergy == Synergy::Flag && !taught(record, deed) {
            continue;
        }
        let other = (0..count)
            .filter(|&other| {
                let one = &found.deeds[other];
                one.hand != deed.hand && one.with.is_empty() && overlap(one, deed) >= OVERLAP
            })
            .max_by(|&one, &other| {
                overlap(&found.deeds[one], deed).total_cmp(&overlap(&found.deeds[other], deed))
            });
        if let Some(other) = other {
            found.deeds[place].with.push(other);
            found.deeds[other].with.push(place);
        } else if let Some(grip) = holding(&grips, deed) {
            let number = count + holds.len();
            holds.push(Deed {
                verb: Verb::Hold,
                hand: grip.hand,
                object: Some(grip.object),
                changes: Vec::new(),
                also: deed.object.into_iter().collect(),
                with: vec![place],
                ..deed.clone()
            });
            found.deeds[place].with.push(number);
        }
    }
    found.deeds.extend(holds);
    super::deed::sequence(&mut found.deeds);
}

/// How much of the shorter of two deeds is in the other, from 0 to 1.
fn overlap(one: &Deed, other: &Deed) -> f64 {
    let common = one.to.min(other.to) - one.from.max(other.from);
    let shorter = (one.to - one.from).min(other.to - other.from);
    if shorter <= 0.0 { 0.0 } else { (common / shorter).max(0.0) }
}

/// What another hand held all through a deed.
fn holding<'g>(grips: &'g [Grip], deed: &Deed) -> Option<&'g Grip> {
    grips.iter().find(|grip| grip.hand != deed.hand && grip.from <= deed.from && grip.to >= deed.to)
}

/// Whether all hands but idle ones were in teach mode in the middle of a deed, and more than one was.
fn taught(record: &Record, deed: &Deed) -> bool {
    let middle = f64::midpoint(deed.from, deed.to);
    let on = record
        .hands
        .iter()
        .filter(|runs| runs.iter().any(|run| run.teach && run.from <= middle && middle <= run.to))
        .count();
    on > 1
}

/// How often two actions were tied together, and the arguments of the second in terms of the first, where they always were the same.
type Tie = (u32, Vec<Option<Term>>);

/// Writes down which actions demand one another: those that were tied together whenever one of them was seen.
pub fn partners(lines: &[(&Deeds, &Line)], learned: &mut Learned) {
    let mut seen: BTreeMap<ActionId, u32> = BTreeMap::new();
    let mut tied: BTreeMap<(ActionId, ActionId), Tie> = BTreeMap::new();
    for (deeds, line) in lines {
        for instance in &line.instances {
            *seen.entry(instance.action).or_default() += 1;
            for &with in &deeds.deeds[instance.deed].with {
                let Some(other) = line.instances.iter().find(|other| other.deed == with) else {
                    continue;
                };
                let arguments = in_terms_of(&instance.arguments, &other.arguments);
                let entry = tied
                    .entry((instance.action, other.action))
                    .or_insert_with(|| (0, arguments.clone()));
                entry.0 += 1;
                for (common, argument) in entry.1.iter_mut().zip(arguments) {
                    if *common != argument {
                        *common = None;
                    }
                }
            }
        }
    }
    for ((action, other), (count, arguments)) in tied {
        if count < seen[&action] {
            continue;
        }
        let known = learned.actions.iter().any(|one| one.action == other);
        if let Some(one) = learned.actions.iter_mut().find(|one| one.action == action && known) {
            one.partners.push(Partner { action: other, arguments });
        }
    }
}

/// The arguments of the one in terms of the parameters of the other.
fn in_terms_of(own: &[ObjectId], other: &[ObjectId]) -> Vec<Option<Term>> {
    let term = |object: &ObjectId| {
        let place = own.iter().position(|one| one == object)?;
        Some(Term::Variable(VariableId(place as u32)))
    };
    other.iter().map(term).collect()
}
