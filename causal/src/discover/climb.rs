//! Hill climbing over graphs: the arc that is best to add, take away or turn is, until none is; and tabu search, which goes on
//! downhill for a while and never back to a graph that it saw lately (Glover 1989).

use std::collections::VecDeque;

use super::Job;
use crate::graph::Dag;
use crate::set::Set;
use crate::variable::VariableId;

/// Gains below this are rounding.
const NOTHING: f64 = 1e-9;

/// As many graphs as a tabu search remembers, and as many moves as it makes without a better graph than the best.
const MEMORY: usize = 100;
const PATIENCE: usize = 15;

/// For each variable what its parents are chosen among.
pub struct Candidates(pub Vec<Set>);

impl Candidates {
    /// All that knowledge allows.
    pub fn all(job: &Job) -> Self {
        Self((0..job.scorer.len() as u16).map(|id| job.rules.allowed(VariableId(id))).collect())
    }
}

/// A change of one arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Move {
    Add(VariableId, VariableId),
    Remove(VariableId, VariableId),
    Turn(VariableId, VariableId),
}

/// A graph on the way.
struct Walk<'a> {
    job: &'a Job<'a>,
    candidates: &'a Candidates,
    parents: Vec<Set>,
    /// What adding or removing each parent of a variable gains.
    gains: Vec<Vec<f64>>,
}

/// Climbs from the graph of the required arcs.
pub fn search(job: &Job, candidates: &Candidates, tabu: bool) -> Dag {
    let many = job.scorer.len();
    let parents: Vec<Set> = (0..many as u16).map(|id| job.rules.required(VariableId(id))).collect();
    let mut walk = Walk { job, candidates, parents, gains: vec![Vec::new(); many] };
    let all: Vec<usize> = (0..many).collect();
    walk.weigh(&all);
    let (mut ahead, mut best, mut patience) = (0.0, (0.0, walk.parents.clone()), PATIENCE);
    let mut seen: VecDeque<Vec<Set>> = VecDeque::from([walk.parents.clone()]);
    loop {
        let mut moves = walk.moves();
        moves.sort_by(|one, other| other.0.total_cmp(&one.0).then_with(|| one.1.cmp(&other.1)));
        let next = moves.into_iter().find(|&(gain, step)| {
            if tabu { !seen.contains(&walk.after(step)) } else { gain > NOTHING }
        });
        let Some((gain, step)) = next else { break };
        let changed = walk.take(step);
        walk.weigh(&changed);
        ahead += gain;
        if ahead > best.0 + NOTHING {
            (best, patience) = ((ahead, walk.parents.clone()), PATIENCE);
        } else {
            patience -= 1;
            if patience == 0 {
                break;
            }
        }
        seen.push_back(walk.parents.clone());
        if seen.len() > MEMORY {
            seen.pop_front();
        }
    }
    Dag::new(best.1.iter().map(|set| set.list()).collect()).expect("no move closes a cycle")
}

impl Walk<'_> {
    /// What changes of the parents of some variables gain.
    fn weigh(&mut self, children: &[usize]) {
        let mut families = Vec::new();
        for &child in children {
            let id = VariableId(child as u16);
            let parents = self.parents[child];
            families.push((id, parents));
            families.extend(self.changes(child).map(|parent| (id, toggled(parents, parent))));
        }
        self.job.scorer.prepare(&families);
        for &child in children {
            let id = VariableId(child as u16);
            let now = self.job.scorer.local(id, self.parents[child]);
            let mut gains = vec![f64::NEG_INFINITY; self.parents.len()];
            for parent in self.changes(child) {
                let other = self.job.scorer.local(id, toggled(self.parents[child], parent));
                gains[parent.index()] = other - now;
            }
            self.gains[child] = gains;
        }
    }

    /// The parents of a variable that may come or go.
    fn changes(&self, child: usize) -> impl Iterator<Item = VariableId> + use<> {
        let id = VariableId(child as u16);
        let parents = self.parents[child];
        let full = parents.len() >= self.job.max_parents;
        let required = self.job.rules.required(id);
        self.candidates.0[child]
            .union(parents)
            .minus(required)
            .iter()
            .filter(move |&parent| parents.contains(parent) || !full)
    }

    /// All moves that lead to a graph, with their gains.
    fn moves(&self) -> Vec<(f64, Move)> {
        let above = self.ancestors();
        let mut moves = Vec::new();
        for child in 0..self.parents.len() {
            let to = VariableId(child as u16);
            for from in self.changes(child) {
                let gain = self.gains[child][from.index()];
                if !self.parents[child].contains(from) {
                    if !above[from.index()].contains(to) {
                        moves.push((gain, Move::Add(from, to)));
                    }
                    continue;
                }
                moves.push((gain, Move::Remove(from, to)));
                // Turned, the arc closes a cycle where another way leads from its parent to its child.
                let other_way = self.parents[child]
                    .without(from)
                    .iter()
                    .any(|other| above[other.index()].contains(from));
                let back = self.gains[from.index()][to.index()];
                if !other_way && back > f64::NEG_INFINITY {
                    moves.push((gain + back, Move::Turn(from, to)));
                }
            }
        }
        moves
    }

    /// What leads to each variable.
    fn ancestors(&self) -> Vec<Set> {
        let mut above = self.parents.clone();
        loop {
            let mut changed = false;
            for at in 0..above.len() {
                let more = above[at].iter().fold(above[at], |set, id| set.union(above[id.index()]));
                changed |= more != above[at];
                above[at] = more;
            }
            if !changed {
                return above;
            }
        }
    }

    fn after(&self, step: Move) -> Vec<Set> {
        let mut parents = self.parents.clone();
        change(&mut parents, step);
        parents
    }

    /// Makes a move, and says whose parents changed.
    fn take(&mut self, step: Move) -> Vec<usize> {
        change(&mut self.parents, step);
        match step {
            Move::Add(_, to) | Move::Remove(_, to) => vec![to.index()],
            Move::Turn(from, to) => vec![from.index(), to.index()],
        }
    }
}

fn change(parents: &mut [Set], step: Move) {
    match step {
        Move::Add(from, to) | Move::Remove(from, to) => {
            parents[to.index()] = toggled(parents[to.index()], from);
        }
        Move::Turn(from, to) => {
            parents[to.index()] = parents[to.index()].without(from);
            parents[from.index()] = parents[from.index()].with(to);
        }
    }
}

fn toggled(set: Set, id: VariableId) -> Set {
    Set(set.0 ^ Set::of(id).0)
}
