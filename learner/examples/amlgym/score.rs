//! A true domain and a learned one go in; precision and recall as `AMLGym` defines them come out.

use std::collections::BTreeSet;
use std::fmt;

use lang::condition::Condition;
use lang::model::{Action, ActionId, Atom, Domain};
use learner::rule::{Learned, Rule};

/// The kinds of literals that are counted.
const KINDS: usize = 4;

/// Means over the actions of the true domain.
#[derive(Debug, Clone, Copy, Default)]
pub struct Score {
    /// Of positive preconditions, negative ones, adds, deletes, and all together.
    precision: [f64; KINDS + 1],
    recall: [f64; KINDS + 1],
}

/// The literals of an action by kind, as text.
type Literals = [BTreeSet<String>; KINDS];

impl Score {
    /// What the columns are.
    pub const HEADS: &str = "  pre+ P/R    pre- P/R    eff+ P/R    eff- P/R     all P/R ";

    /// The score of what was learned.
    pub fn of(truth: &Domain, learned: &Learned, rule: Rule) -> Self {
        let mut sum = Self::default();
        for (at, action) in truth.actions.iter().enumerate() {
            let wanted = written(action);
            let found = learned.actions.iter().find(|one| one.action == ActionId(at as u32));
            let texts = |atoms: &[Atom]| atoms.iter().map(text).collect::<BTreeSet<String>>();
            let found: Literals = found.map_or_else(Literals::default, |found| {
                let required = texts(found.precondition(rule));
                [required, texts(&found.absent), texts(&found.adds), texts(&found.deletes)]
            });
            let mut all = [0; 3];
            for kind in 0..KINDS {
                let right = wanted[kind].intersection(&found[kind]).count();
                let counts = [right, found[kind].len(), wanted[kind].len()];
                sum.precision[kind] += share(counts[0], counts[1]);
                sum.recall[kind] += share(counts[0], counts[2]);
                all.iter_mut().zip(counts).for_each(|(all, count)| *all += count);
            }
            sum.precision[KINDS] += share(all[0], all[1]);
            sum.recall[KINDS] += share(all[0], all[2]);
        }
        sum.mean(truth.actions.len())
    }

    /// Adds another score, for a mean.
    pub fn add(&mut self, other: &Self) {
        let add = |to: &mut [f64], from: &[f64]| {
            to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
        };
        add(&mut self.precision, &other.precision);
        add(&mut self.recall, &other.recall);
    }

    /// The mean of `count` scores that were added.
    #[must_use]
    pub fn mean(&self, count: usize) -> Self {
        let mean = |list: [f64; KINDS + 1]| list.map(|sum| sum / count as f64);
        Self { precision: mean(self.precision), recall: mean(self.recall) }
    }
}

impl fmt::Display for Score {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (precision, recall) in self.precision.iter().zip(&self.recall) {
            write!(out, " {precision:5.3}/{recall:5.3}")?;
        }
        Ok(())
    }
}

fn share(right: usize, of: usize) -> f64 {
    if of == 0 { 1.0 } else { right as f64 / of as f64 }
}

/// The literals as they are written, an atom that is added and deleted in both kinds.
fn written(action: &Action) -> Literals {
    let mut literals = Literals::default();
    let condition = Condition::new(&action.precondition).expect("it is not deep");
    for part in condition.conjuncts() {
        if let Condition::Atom(atom, holds) = part {
            literals[usize::from(!holds)].insert(text(atom));
        }
    }
    for literal in action.effects.iter().flat_map(|effect| &effect.literals) {
        literals[if literal.positive { 2 } else { 3 }].insert(text(&literal.atom));
    }
    literals
}

fn text(atom: &Atom) -> String {
    format!("{atom:?}")
}
