//! Greedy equivalence search: from class to class of graphs, by the arc that is best to insert or delete (Chickering 2002, "Optimal
//! structure identification with greedy search").
//!
//! A deletion that gains comes before any insertion (as in XGES; Nazaret and Blei 2024), so that arcs which later ones made needless
//! go before they mislead.

use rustc_hash::FxHashMap;

use super::Job;
use crate::graph::Dag;
use crate::pattern::Pattern;
use crate::set::Set;
use crate::variable::VariableId;

/// Gains below this are rounding.
const NOTHING: f64 = 1e-9;

/// As many neighbours as are taken along in one insertion or deletion, by all their subsets.
const MOST_SUBSETS_OF: usize = 10;

/// A step from one class to another.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Operator {
    gain: f64,
    from: VariableId,
    to: VariableId,
    /// The neighbours of `to` that come to point to it, or that stop doing so.
    with: Set,
    deletes: bool,
}

/// Finds a class that no step improves, and one of its graphs.
pub fn search(job: &Job) -> Dag {
    let many = job.scorer.len();
    let required = (0..many as u16).map(|id| job.rules.required(VariableId(id)).list()).collect();
    let start = Dag::new(required).expect("required arcs have no cycle");
    let score = job.scorer.total(&start);
    let pattern = Pattern::of(&start);
    let mut search = Search { job, pattern, graph: start, score, operators: FxHashMap::default() };
    let all: Vec<(VariableId, VariableId)> = search.pairs(|_, _| true);
    search.consider(&all);
    while search.step() {}
    search.graph
}

struct Search<'a> {
    job: &'a Job<'a>,
    pattern: Pattern,
    /// A graph of the class that knowledge allows, and its score.
    graph: Dag,
    score: f64,
    operators: FxHashMap<(VariableId, VariableId), Vec<Operator>>,
}

impl Search<'_> {
    fn pairs(
        &self,
        keep: impl Fn(VariableId, VariableId) -> bool,
    ) -> Vec<(VariableId, VariableId)> {
        let ids: Vec<VariableId> = self.pattern.ids().collect();
        let mut pairs = Vec::new();
        for &from in &ids {
            pairs.extend(
                ids.iter().filter(|&&to| from != to && keep(from, to)).map(|&to| (from, to)),
            );
        }
        pairs
    }

    /// Takes the best step that is one; false where there is none.
    fn step(&mut self) -> bool {
        let mut operators: Vec<Operator> =
            self.operators.values().flatten().filter(|one| one.gain > NOTHING).copied().collect();
        operators.sort_by(|one, other| {
            other
                .deletes
                .cmp(&one.deletes)
                .then_with(|| other.gain.total_cmp(&one.gain))
                .then_with(|| (one.from, one.to, one.with).cmp(&(other.from, other.to, other.with)))
        });
        for operator in operators {
            let Some((pattern, graph)) = self.apply(operator) else { continue };
            // Under a score that is not the same for all graphs of a class (K2) a step can gain by its own account, and lose in all;
            // such steps could go round for ever.
            let score = self.job.scorer.total(&graph);
            if score > self.score + NOTHING {
                self.score = score;
                let before = std::mem::replace(&mut self.pattern, pattern);
                self.graph = graph;
                self.refresh(&before);
                return true;
            }
        }
        false
    }

    /// The class after a step, and a graph of it; none where the step leads nowhere.
    fn apply(&self, operator: Operator) -> Option<(Pattern, Dag)> {
        let Operator { from, to, with, deletes, .. } = operator;
        let mut next = self.pattern.clone();
        if deletes {
            next.part(from, to);
            for other in with.iter() {
                next.direct(to, other);
                if self.pattern.neighbours(from).contains(other) {
                    next.direct(from, other);
                }
            }
        } else {
            let shared = self.pattern.neighbours(to).and(self.pattern.adjacent(from));
            if self.reaches(to, from, shared.union(with)) {
                return None;
            }
            next.direct(from, to);
            for other in with.iter() {
                next.direct(other, to);
            }
        }
        let graph = next.extension()?;
        let pattern = Pattern::of(&graph);
        if self.job.rules.is_free() {
            return Some((pattern, graph));
        }
        let graph = self.obedient(&pattern)?;
        Some((pattern, graph))
    }

    /// A graph of a class that knowledge allows.
    fn obedient(&self, class: &Pattern) -> Option<Dag> {
        let rules = self.job.rules;
        let mut pattern = class.clone();
        for (one, other) in class.undirected() {
            match (rules.allows(one, other), rules.allows(other, one)) {
                (true, true) => {}
                (true, false) => pattern.direct(one, other),
                (false, true) => pattern.direct(other, one),
                (false, false) => return None,
            }
        }
        pattern.close();
        let graph = pattern.extension()?;
        let obeys = graph.arcs().all(|(from, to)| rules.allows(from, to));
        let has = |to: VariableId| {
            rules.required(to).iter().all(|from| graph.parents(to).contains(&from))
        };
        (obeys && pattern.ids().all(has)).then_some(graph)
    }

    /// Whether a way along arcs, none against its direction, leads from one variable to another around some.
    fn reaches(&self, from: VariableId, to: VariableId, around: Set) -> bool {
        let (mut seen, mut open) = (Set::of(from), vec![from]);
        while let Some(at) = open.pop() {
            if at == to {
                return true;
            }
            let next = self
                .pattern
                .children(at)
                .union(self.pattern.neighbours(at))
                .minus(around)
                .minus(seen);
            seen = seen.union(next);
            open.extend(next.iter());
        }
        false
    }

    fn is_clique(&self, set: Set) -> bool {
        set.iter().all(|id| set.without(id).is_within(self.pattern.adjacent(id)))
    }

    /// Looks again at the pairs whose surroundings a step changed.
    fn refresh(&mut self, before: &Pattern) {
        let now = &self.pattern;
        let moved: Set = now
            .ids()
            .filter(|&id| {
                now.parents(id) != before.parents(id) || now.neighbours(id) != before.neighbours(id)
            })
            .collect();
        let met: Set = now.ids().filter(|&id| now.adjacent(id) != before.adjacent(id)).collect();
        let pairs = self.pairs(|from, to| {
            moved.contains(to) || met.contains(from) || !now.neighbours(to).and(met).is_empty()
        });
        self.consider(&pairs);
    }

    /// Finds the operators of some pairs, and what they gain.
    fn consider(&mut self, pairs: &[(VariableId, VariableId)]) {
        let mut found: Vec<(Operator, Set, Set)> = Vec::new();
        for &(from, to) in pairs {
            self.operators.remove(&(from, to));
            if self.pattern.joined(from, to) {
                self.deletions(from, to, &mut found);
            } else if self.job.rules.allows(from, to) {
                self.insertions(from, to, &mut found);
            }
        }
        let families: Vec<(VariableId, Set)> = found
            .iter()
            .flat_map(|(operator, less, more)| [(operator.to, *less), (operator.to, *more)])
            .collect();
        self.job.scorer.prepare(&families);
        for (mut operator, less, more) in found {
            let gain =
                self.job.scorer.local(operator.to, more) - self.job.scorer.local(operator.to, less);
            operator.gain = if operator.deletes { -gain } else { gain };
            if operator.gain > NOTHING {
                self.operators.entry((operator.from, operator.to)).or_default().push(operator);
            }
        }
    }

    /// Chickering's Insert(from, to, with): the neighbours of both and those taken along are a clique.
    fn insertions(&self, from: VariableId, to: VariableId, found: &mut Vec<(Operator, Set, Set)>) {
        let neighbours = self.pattern.neighbours(to);
        let shared = neighbours.and(self.pattern.adjacent(from));
        if !self.is_clique(shared) {
            return;
        }
        let free: Set = neighbours
            .minus(self.pattern.adjacent(from))
            .iter()
            .filter(|&other| self.job.rules.allows(other, to))
            .collect();
        for with in some_subsets(free) {
            if !self.is_clique(shared.union(with)) {
                continue;
            }
            let less = shared.union(with).union(self.pattern.parents(to));
            if less.len() < self.job.max_parents {
                let operator = Operator { gain: 0.0, from, to, with, deletes: false };
                found.push((operator, less, less.with(from)));
            }
        }
    }

    /// Chickering's Delete(from, to, with): the neighbours of both, without those turned away, are a clique.
    fn deletions(&self, from: VariableId, to: VariableId, found: &mut Vec<(Operator, Set, Set)>) {
        let rules = self.job.rules;
        let required = rules.required(to).contains(from) || rules.required(from).contains(to);
        if self.pattern.children(to).contains(from) || required {
            return;
        }
        let shared = self.pattern.neighbours(to).and(self.pattern.adjacent(from));
        for with in some_subsets(shared) {
            let left = shared.minus(with);
            if self.is_clique(left) {
                let less = left.union(self.pattern.parents(to)).without(from);
                let operator = Operator { gain: 0.0, from, to, with, deletes: true };
                found.push((operator, less, less.with(from)));
            }
        }
    }
}

/// The subsets of a set, the smaller first; of a large one only the small.
fn some_subsets(set: Set) -> Vec<Set> {
    let most = if set.len() <= MOST_SUBSETS_OF { set.len() } else { 2 };
    (0..=most).flat_map(|size| set.subsets(size)).collect()
}
