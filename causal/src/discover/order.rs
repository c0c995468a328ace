//! Best order score search: variables in an order, each with the parents among those before it that explain it best; each variable in
//! turn moves to the place where the whole scores best, until none moves (Andrews et al. 2023, "Fast scalable and accurate discovery
//! of DAGs using the best order score search and grow-shrink trees").

use rustc_hash::FxHashMap;

use super::Job;
use crate::graph::Dag;
use crate::set::Set;
use crate::variable::VariableId;

/// Gains below this are rounding.
const NOTHING: f64 = 1e-9;

/// Finds an order that no move improves, and its graph.
pub fn search(job: &Job) -> Dag {
    let many = job.scorer.len();
    let required = (0..many as u16).map(|id| job.rules.required(VariableId(id)).list()).collect();
    let start = Dag::new(required).expect("required arcs have no cycle");
    let mut order = start.order();
    let mut families = Families { job, known: FxHashMap::default() };
    loop {
        let mut moved = false;
        for id in (0..many as u16).map(VariableId) {
            moved |= settle(&mut order, id, &mut families);
        }
        if !moved {
            break;
        }
    }
    let mut parents = vec![Vec::new(); many];
    let mut before = Set::EMPTY;
    for &id in &order {
        parents[id.index()] = families.best(id, before).1.list();
        before = before.with(id);
    }
    Dag::new(parents).expect("parents come before their children in the order")
}

/// Moves a variable to its best place; false where it is there already.
fn settle(order: &mut Vec<VariableId>, id: VariableId, families: &mut Families) -> bool {
    let now = order.iter().position(|&one| one == id).expect("the order has all variables");
    let others: Vec<VariableId> = order.iter().copied().filter(|&one| one != id).collect();
    // What the others score before it and after it.
    let (mut before, mut prefixes) = (Set::EMPTY, vec![Set::EMPTY]);
    let mut first = vec![0.0];
    let mut second = Vec::with_capacity(others.len());
    for &other in &others {
        first.push(first[first.len() - 1] + families.best(other, before).0);
        second.push(families.best(other, before.with(id)).0);
        before = before.with(other);
        prefixes.push(before);
    }
    let mut behind = 0.0;
    let mut best: Option<(f64, usize)> = None;
    let mut here = f64::NEG_INFINITY;
    for place in (0..=others.len()).rev() {
        let score = first[place] + families.best(id, prefixes[place]).0 + behind;
        if place == now {
            here = score;
        }
        if best.is_none_or(|(highest, _)| score > highest + NOTHING) {
            best = Some((score, place));
        }
        if place > 0 {
            behind += second[place - 1];
        }
    }
    match best {
        Some((score, place)) if score > here + NOTHING => {
            order.remove(now);
            order.insert(place, id);
            true
        }
        _ => false,
    }
}

/// The best parents of variables among those before them.
struct Families<'a> {
    job: &'a Job<'a>,
    known: FxHashMap<(VariableId, Set), (f64, Set)>,
}

impl Families<'_> {
    /// Parents grow one by one, and shrink again.
    fn best(&mut self, child: VariableId, before: Set) -> (f64, Set) {
        let rules = self.job.rules;
        let required = rules.required(child);
        if !required.is_within(before) {
            return (f64::NEG_INFINITY, Set::EMPTY);
        }
        let among = before.and(rules.allowed(child));
        if let Some(&known) = self.known.get(&(child, among)) {
            return known;
        }
        let scorer = self.job.scorer;
        let mut parents = required;
        let mut score = scorer.local(child, parents);
        while parents.len() < self.job.max_parents {
            let more: Vec<Set> = among.minus(parents).iter().map(|id| parents.with(id)).collect();
            if !self.climb(child, &more, &mut parents, &mut score) {
                break;
            }
        }
        loop {
            let less: Vec<Set> =
                parents.minus(required).iter().map(|id| parents.without(id)).collect();
            if !self.climb(child, &less, &mut parents, &mut score) {
                break;
            }
        }
        self.known.insert((child, among), (score, parents));
        (score, parents)
    }

    /// Takes the best of several sets of parents if it is better.
    fn climb(&self, child: VariableId, sets: &[Set], parents: &mut Set, score: &mut f64) -> bool {
        let families: Vec<(VariableId, Set)> = sets.iter().map(|&set| (child, set)).collect();
        self.job.scorer.prepare(&families);
        let before = *score;
        for &set in sets {
            let other = self.job.scorer.local(child, set);
            if other > *score + NOTHING {
                (*score, *parents) = (other, set);
            }
        }
        *score > before
    }
}
