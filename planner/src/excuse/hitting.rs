//! Clauses go in, one after another; sets of edits that satisfy all of them come out, the cheapest first (an implicit hitting set, after Moreno-Centeno and
//! Karp, "The implicit hitting set approach", Operations Research 2013, where a variable has one value and groups are never broken).
//!
//! Best-first over partial sets of edits: a set that breaks a clause is branched over the edits that mend it, and each branch leaves out those before it, so
//! that no set is met twice. The bound is what clauses that share no edit cost at least together.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::normality::{self, Oddness};
use super::relaxed::number;
use super::vocabulary::{NONE, Vocabulary};
use crate::grounded::FactId;
use crate::limits::{Limits, Stop};

/// Literals of which at least one must hold in the changed initial state.
#[derive(Debug, Clone)]
pub struct Clause {
    /// In the order in which they are tried.
    literals: Vec<u32>,
    /// The same as a set.
    has: Vec<u64>,
    /// Those that hold initially.
    initially: Vec<u32>,
}

/// Indexes the nodes of a [`Hitting`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NodeId(u32);

/// A partial set of edits: that of its parent and one more.
#[derive(Debug)]
struct Node {
    parent: u32,
    edit: u32,
    cost: u32,
    /// Where it stands among the edits that its parent was branched over.
    position: u32,
    /// What it was branched over.
    branches: Box<[u32]>,
}

/// What is next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Next {
    /// These edits satisfy all clauses and break no group; nothing cheaper does.
    Edits(NodeId, Vec<u32>),
    /// Nothing within the bounds satisfies all clauses.
    Nothing,
    /// It was told to stop.
    Stopped(Stop),
}

/// The sets of edits that are still to be looked at.
#[derive(Debug)]
pub struct Hitting<'a> {
    vocabulary: &'a Vocabulary,
    clauses: Vec<Clause>,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<Key>>,
    most_edits: usize,
    /// How odd each edit is.
    oddness: &'a [Oddness],
    /// Which variables a node has decided, and with which edit; only while it is looked at.
    decided: Vec<u32>,
    forbidden: Vec<bool>,
    /// What is left of the cost of each edit while a bound is computed, and for which computation that is.
    rest: Vec<(u32, u32)>,
    round: u32,
}

/// Lowest bound first; then what was tried less; then what is less odd; then what has more edits; then what came last.
type Key = (u32, u32, i32, Reverse<u32>, Reverse<u32>);

impl<'a> Hitting<'a> {
    /// Begins with no edits and no clauses. No set has more than `most_edits`.
    pub fn new(vocabulary: &'a Vocabulary, most_edits: usize, oddness: &'a [Oddness]) -> Self {
        let root =
            Node { parent: NONE, edit: NONE, cost: 0, position: 0, branches: Box::default() };
        Self {
            vocabulary,
            clauses: Vec::new(),
            nodes: vec![root],
            open: BinaryHeap::from([Reverse((0, 0, 0, Reverse(0), Reverse(0)))]),
            most_edits,
            oddness,
            decided: vec![NONE; vocabulary.variables.len()],
            forbidden: vec![false; vocabulary.edits.len()],
            rest: vec![(0, 0); vocabulary.edits.len()],
            round: 0,
        }
    }

    /// Demands that one of these literals holds.
    pub fn demand(&mut self, literals: Vec<u32>) {
        let mut has = vec![0_u64; (self.vocabulary.homes.len() * 2).div_ceil(64)];
        for &literal in &literals {
            has[literal as usize / 64] |= 1 << (literal % 64);
        }
        let initially = literals.iter().copied().filter(|&one| self.holds_initially(one)).collect();
        self.clauses.push(Clause { literals, has, initially });
    }

    /// Puts a set back that could not be judged yet; it is next when those are done that were tried less.
    pub fn postpone(&mut self, node: NodeId, cost: u32, tried: u32, edits: usize) {
        let odd = normality::of(self.oddness, &self.chosen(node.0));
        self.open.push(Reverse((cost, tried, odd, Reverse(edits as u32), Reverse(node.0))));
    }

    /// The next set that satisfies all clauses and costs `most` at most; with how often it was tried before.
    pub fn next(&mut self, most: u32, limits: &Limits) -> (Next, u32) {
        while let Some(&Reverse((bound, tried, odd, edits, Reverse(id)))) = self.open.peek() {
            if bound > most {
                break;
            }
            if let Some(stop) = limits.stopped() {
                return (Next::Stopped(stop), 0);
            }
            self.open.pop();
            let chosen = self.chosen(id);
            self.enter(id);
            let found = self.look(&chosen);
            let node = &self.nodes[id as usize];
            let (cost, look_again) = (node.cost, bound);
            let result = match found {
                Look::Fine => Some((Next::Edits(NodeId(id), chosen.clone()), tried)),
                Look::Dead => None,
                Look::Broken { more, branches } => {
                    let bound = cost.saturating_add(more);
                    if bound > look_again {
                        self.open.push(Reverse((bound, tried, odd, edits, Reverse(id))));
                    } else if chosen.len() < self.most_edits {
                        self.branch(id, &chosen, branches, bound);
                    }
                    None
                }
            };
            self.leave(id);
            if let Some(result) = result {
                return result;
            }
        }
        (Next::Nothing, 0)
    }

    /// Adds edits to a set until it satisfies all clauses and breaks no group, the first that mends each; false if that leads nowhere.
    pub fn complete(&mut self, chosen: &mut Vec<u32>) -> bool {
        loop {
            self.decide(chosen, true);
            let found = self.look(chosen);
            self.decide(chosen, false);
            match found {
                Look::Fine => return true,
                Look::Dead => return false,
                Look::Broken { branches, .. } => chosen.push(branches[0]),
            }
        }
    }

    fn decide(&mut self, chosen: &[u32], on: bool) {
        for &edit in chosen {
            let variable = self.vocabulary.edits[edit as usize].variable;
            self.decided[variable as usize] = if on { edit } else { NONE };
        }
    }

    /// Whether a set satisfies all clauses and breaks no group.
    pub fn is_complete(&mut self, chosen: &[u32]) -> bool {
        self.decide(chosen, true);
        let found = self.look(chosen);
        self.decide(chosen, false);
        matches!(found, Look::Fine)
    }

    /// A lower bound on what any set costs that is still to be looked at.
    pub fn bound(&self) -> Option<u32> {
        self.open.peek().map(|Reverse(key)| key.0)
    }

    fn branch(&mut self, id: u32, chosen: &[u32], branches: Vec<u32>, bound: u32) {
        let (parent_cost, depth) = (self.nodes[id as usize].cost, chosen.len() as u32 + 1);
        let mut set = chosen.to_vec();
        // The last pushed is the first to be looked at among equals.
        for (position, &edit) in branches.iter().enumerate().rev() {
            let cost = parent_cost.saturating_add(self.vocabulary.edits[edit as usize].cost);
            let number = self.nodes.len() as u32;
            self.nodes.push(Node {
                parent: id,
                edit,
                cost,
                position: position as u32,
                branches: Box::default(),
            });
            set.push(edit);
            let odd = normality::of(self.oddness, &set);
            set.pop();
            self.open.push(Reverse((cost.max(bound), 0, odd, Reverse(depth), Reverse(number))));
        }
        self.nodes[id as usize].branches = branches.into();
    }

    /// The edits of a node, in the order of their variables.
    fn chosen(&self, mut id: u32) -> Vec<u32> {
        let mut chosen = Vec::new();
        while self.nodes[id as usize].parent != NONE {
            chosen.push(self.nodes[id as usize].edit);
            id = self.nodes[id as usize].parent;
        }
        chosen.sort_unstable();
        chosen
    }

    fn enter(&mut self, id: u32) {
        self.mark(id, true);
    }

    fn leave(&mut self, id: u32) {
        self.mark(id, false);
    }

    fn mark(&mut self, mut id: u32, on: bool) {
        while self.nodes[id as usize].parent != NONE {
            let Node { parent, edit, position, .. } = self.nodes[id as usize];
            let variable = self.vocabulary.edits[edit as usize].variable;
            self.decided[variable as usize] = if on { edit } else { NONE };
            for &before in &self.nodes[parent as usize].branches[..position as usize] {
                self.forbidden[before as usize] = on;
            }
            id = parent;
        }
    }

    fn holds_initially(&self, literal: u32) -> bool {
        let fact = literal / 2;
        let home = self.vocabulary.homes[fact as usize];
        let initial =
            home != NONE && self.vocabulary.variables[home as usize].initial == Some(FactId(fact));
        initial == literal.is_multiple_of(2)
    }

    /// Whether an edit may be added to the node that is looked at.
    fn is_free(&self, edit: u32) -> bool {
        let variable = self.vocabulary.edits[edit as usize].variable;
        self.decided[variable as usize] == NONE && !self.forbidden[edit as usize]
    }

    /// The edits that make a literal hold, as far as they may be added.
    fn ways(&self, literal: u32, ways: &mut Vec<u32>) {
        let fact = (literal / 2) as usize;
        if literal.is_multiple_of(2) {
            let maker = self.vocabulary.makers[fact];
            if maker != NONE && self.is_free(maker) {
                ways.push(maker);
            }
        } else if self.vocabulary.homes[fact] != NONE {
            let variable = &self.vocabulary.variables[self.vocabulary.homes[fact] as usize];
            if variable.initial == Some(FactId(fact as u32)) {
                ways.extend(variable.edits.iter().copied().filter(|&edit| self.is_free(edit)));
            }
        }
    }

    fn satisfied(&self, clause: &Clause, chosen: &[u32]) -> bool {
        let has = |literal: u32| clause.has[literal as usize / 64] >> (literal % 64) & 1 == 1;
        let made = |&edit: &u32| {
            let edit = &self.vocabulary.edits[edit as usize];
            edit.to.is_some_and(|fact| has(number(fact, true)))
                || edit.from.is_some_and(|fact| has(number(fact, false)))
        };
        let still = |&literal: &u32| {
            let home = self.vocabulary.homes[literal as usize / 2];
            let edit = if home == NONE { NONE } else { self.decided[home as usize] };
            if edit == NONE {
                return true;
            }
            // What does not hold initially still does not, unless this edit makes it so.
            let fact = FactId(literal / 2);
            !literal.is_multiple_of(2) && self.vocabulary.edits[edit as usize].to != Some(fact)
        };
        chosen.iter().any(made) || clause.initially.iter().any(still)
    }

    /// What the edits of a group conflict would be: some edit of the groups that `chosen` touches, for each of which one is broken.
    fn broken_group(&self, chosen: &[u32]) -> Option<Vec<u32>> {
        let holds = |fact: FactId| {
            let home = self.vocabulary.homes[fact.index()];
            if home == NONE {
                return false;
            }
            let edit = self.decided[home as usize];
            if edit == NONE {
                self.vocabulary.variables[home as usize].initial == Some(fact)
            } else {
                self.vocabulary.edits[edit as usize].to == Some(fact)
            }
        };
        for &edit in chosen {
            let edit = &self.vocabulary.edits[edit as usize];
            for &need in &edit.needs {
                let variable = self.vocabulary.edits[need as usize].variable;
                if self.decided[variable as usize] == NONE {
                    return Some(if self.is_free(need) { vec![need] } else { Vec::new() });
                }
            }
            if let Some(fact) = edit.to {
                for &group in &self.vocabulary.memberships[fact.index()] {
                    let group = &self.vocabulary.groups[group as usize];
                    let mut others = group.facts.iter().filter(|&&one| one != fact && holds(one));
                    if let Some(&other) = others.next() {
                        let mut ways = Vec::new();
                        self.ways(number(other, false), &mut ways);
                        return Some(ways);
                    }
                }
            }
            if let Some(fact) = edit.from {
                for &group in &self.vocabulary.memberships[fact.index()] {
                    let group = &self.vocabulary.groups[group as usize];
                    if group.exactly && !group.facts.iter().any(|&one| holds(one)) {
                        let mut ways = Vec::new();
                        for &one in &group.facts {
                            self.ways(number(one, true), &mut ways);
                        }
                        return Some(ways);
                    }
                }
            }
        }
        None
    }

    /// What is wrong with a set, if anything, and what clauses that it breaks cost at least.
    fn look(&mut self, chosen: &[u32]) -> Look {
        let mut broken: Vec<Vec<u32>> = Vec::new();
        if let Some(ways) = self.broken_group(chosen) {
            if ways.is_empty() {
                return Look::Dead;
            }
            broken.push(ways);
        }
        let mut round = self.round;
        for clause in &self.clauses {
            if !self.satisfied(clause, chosen) {
                let mut ways = Vec::new();
                for &literal in &clause.literals {
                    self.ways(literal, &mut ways);
                }
                round += 1;
                let rest = &mut self.rest;
                ways.retain(|&way| std::mem::replace(&mut rest[way as usize].1, round) != round);
                if ways.is_empty() {
                    self.round = round;
                    return Look::Dead;
                }
                broken.push(ways);
            }
        }
        self.round = round + 1;
        broken.sort_by_key(Vec::len);
        // A clause takes from the cost of all its edits as much as all of them have left: what they took together is paid by any set that satisfies them all.
        let mut more = 0_u32;
        for ways in &broken {
            let left = |way: u32, rest: &[(u32, u32)]| match rest[way as usize] {
                (rest, round) if round == self.round => rest,
                _ => self.vocabulary.edits[way as usize].cost,
            };
            let share = ways.iter().map(|&way| left(way, &self.rest)).min().unwrap_or(0);
            if share > 0 {
                more = more.saturating_add(share);
                for &way in ways {
                    self.rest[way as usize] = (left(way, &self.rest) - share, self.round);
                }
            }
        }
        match broken.into_iter().next() {
            Some(branches) => Look::Broken { more, branches },
            None => Look::Fine,
        }
    }
}

/// What is wrong with a set.
enum Look {
    /// Nothing.
    Fine,
    /// Something that no further edit can mend.
    Dead,
    /// One of these edits has to be added, and all that is missing costs at least `more`.
    Broken { more: u32, branches: Vec<u32> },
}
