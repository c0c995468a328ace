//! A ground problem with everything open goes in; what may be changed of its initial state comes out: variables, their edits, and the groups that
//! no state may break.

use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use lang::model::{self, Domain, ObjectId, PredicateId};
use rustc_hash::FxHashMap;

use super::open::Open;
use super::policy::Policy;
use super::presume;
use crate::grounded::FactId;
use crate::invariants::Candidate;

/// No variable, no edit.
pub const NONE: u32 = u32::MAX;

/// From where it is known that some facts exclude each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Origin {
    /// The domain, or whoever asks, declares it.
    Declared,
    /// The actions keep it so.
    Actions,
    /// The initial state looks like it, and no action changes these facts.
    Presumed,
    /// It is not known: the atom stands alone.
    Bare,
}

/// Facts of which at most one holds in any possible state.
#[derive(Debug, Clone)]
pub struct Group {
    /// Sorted.
    pub facts: Vec<FactId>,
    /// Whether one of them holds in any possible state.
    pub exactly: bool,
    /// How that is known.
    pub origin: Origin,
}

/// What an edit changes: facts of which at most one holds. A new object is a variable of its own.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its facts, sorted; each fact is in at most one variable.
    pub facts: Vec<FactId>,
    /// Which of them holds initially.
    pub initial: Option<FactId>,
    /// How it is known that they exclude each other.
    pub origin: Origin,
    /// Its edits, by number.
    pub edits: Vec<u32>,
}

/// A change of one variable in the initial state.
#[derive(Debug, Clone)]
pub struct Edit {
    /// Of which variable.
    pub variable: u32,
    /// What holds initially and will not.
    pub from: Option<FactId>,
    /// What will hold.
    pub to: Option<FactId>,
    /// What it costs, at least 1.
    pub cost: u32,
    /// The new object that it makes.
    pub object: Option<ObjectId>,
    /// The edits without which it makes no sense: those that make the objects that it is about.
    pub needs: Vec<u32>,
}

/// All that may be changed.
#[derive(Debug, Clone)]
pub struct Vocabulary {
    /// The variables.
    pub variables: Vec<Variable>,
    /// The edits of all variables.
    pub edits: Vec<Edit>,
    /// The groups that hold for the initial state.
    pub groups: Vec<Group>,
    /// The variable of each fact.
    pub homes: Vec<u32>,
    /// The edit that makes each fact true.
    pub makers: Vec<u32>,
    /// For each fact the groups that it is in.
    pub memberships: Vec<Vec<u32>>,
}

impl Vocabulary {
    /// What `policy` allows to be changed of `open`, of which `invariants` are known.
    pub fn new(open: &Open, domain: &Domain, invariants: &[Candidate], policy: &Policy) -> Self {
        let mut groups = declared(open, &policy.declared);
        groups.extend(lifted(open, invariants));
        if policy.presume {
            let presumed = presume::groups(open, domain, &groups);
            groups.extend(presumed);
        }
        let holding =
            |group: &Group| group.facts.iter().filter(|fact| open.initial[fact.index()]).count();
        // A group that is broken already says nothing, and where none of its facts holds none has to.
        groups.retain(|group| (group.facts.len() > 1 || group.exactly) && holding(group) <= 1);
        for group in &mut groups {
            group.exactly &= holding(group) == 1;
        }
        let mut seen = BTreeSet::new();
        groups.retain(|group| seen.insert(group.facts.clone()));
        let mut vocabulary = Self {
            variables: Vec::new(),
            edits: Vec::new(),
            memberships: vec![Vec::new(); open.count()],
            homes: vec![NONE; open.count()],
            makers: vec![NONE; open.count()],
            groups,
        };
        for (number, group) in vocabulary.groups.iter().enumerate() {
            for fact in &group.facts {
                vocabulary.memberships[fact.index()].push(number as u32);
            }
        }
        vocabulary.cover(open);
        vocabulary.objects(open, policy);
        for variable in 0..vocabulary.variables.len() as u32 {
            vocabulary.edit(open, variable);
        }
        vocabulary.leave_out_impossible();
        vocabulary
    }

    /// Makes variables of groups, declared ones first and large ones before small ones, and of what is left.
    fn cover(&mut self, open: &Open) {
        let rank = |origin: Origin| match origin {
            Origin::Declared => 2,
            Origin::Actions => 1,
            Origin::Presumed | Origin::Bare => 0,
        };
        let mut heap: BinaryHeap<(u32, usize, std::cmp::Reverse<usize>)> = self
            .groups
            .iter()
            .enumerate()
            .map(|(number, group)| {
                (rank(group.origin), group.facts.len(), std::cmp::Reverse(number))
            })
            .collect();
        while let Some((rank, size, std::cmp::Reverse(number))) = heap.pop() {
            let free: Vec<FactId> = self.groups[number]
                .facts
                .iter()
                .copied()
                .filter(|fact| self.homes[fact.index()] == NONE)
                .collect();
            if free.len() < size {
                if free.len() > 1 {
                    heap.push((rank, free.len(), std::cmp::Reverse(number)));
                }
                continue;
            }
            self.variable(open, free, self.groups[number].origin);
        }
        for fact in 0..open.grounded.facts.len() as u32 {
            let known = !self.memberships[fact as usize].is_empty();
            if self.homes[fact as usize] == NONE && (known || open.editable[fact as usize] != 0) {
                let origin = match self.memberships[fact as usize].first() {
                    Some(&group) => self.groups[group as usize].origin,
                    None => Origin::Bare,
                };
                self.variable(open, vec![FactId(fact)], origin);
            }
        }
    }

    fn variable(&mut self, open: &Open, facts: Vec<FactId>, origin: Origin) {
        let number = self.variables.len() as u32;
        for fact in &facts {
            self.homes[fact.index()] = number;
        }
        let initial = facts.iter().copied().find(|fact| open.initial[fact.index()]);
        self.variables.push(Variable { facts, initial, origin, edits: Vec::new() });
    }

    /// Makes a variable and an edit of each new object; the second of a type needs the first.
    fn objects(&mut self, open: &Open, policy: &Policy) {
        for (number, object) in open.objects.iter().enumerate() {
            let fact = FactId((open.grounded.facts.len() + number) as u32);
            self.variable(open, vec![fact], Origin::Bare);
            let edit = self.edits.len() as u32;
            let needs = object.after.map(|before| vec![before]).unwrap_or_default();
            let variable = self.variables.len() as u32 - 1;
            self.variables[variable as usize].edits.push(edit);
            self.makers[fact.index()] = edit;
            self.edits.push(Edit {
                variable,
                from: None,
                to: Some(fact),
                cost: policy.object_cost,
                object: Some(object.id),
                needs,
            });
        }
    }

    /// Makes the edits of a variable.
    fn edit(&mut self, open: &Open, number: u32) {
        let variable = &self.variables[number as usize];
        let from = variable.initial;
        if !variable.edits.is_empty() || from.is_some_and(|fact| open.locked[fact.index()]) {
            return;
        }
        let mut edits = Vec::new();
        for &fact in &variable.facts {
            let cost = open.editable[fact.index()];
            if Some(fact) != from && cost != 0 && !open.locked[fact.index()] {
                edits.push(Edit {
                    variable: number,
                    from,
                    to: Some(fact),
                    cost,
                    object: None,
                    needs: open.needs(fact),
                });
            }
        }
        if let Some(fact) = from
            && open.editable[fact.index()] != 0
        {
            edits.push(Edit {
                variable: number,
                from,
                to: None,
                cost: open.editable[fact.index()],
                object: None,
                needs: Vec::new(),
            });
        }
        for edit in edits {
            let id = self.edits.len() as u32;
            if let Some(fact) = edit.to {
                self.makers[fact.index()] = id;
            }
            self.variables[number as usize].edits.push(id);
            self.edits.push(edit);
        }
    }
}

impl Vocabulary {
    /// Leaves out the edits that break a group whatever else is changed.
    fn leave_out_impossible(&mut self) {
        let mut possible = vec![true; self.edits.len()];
        loop {
            let impossible: Vec<usize> = (0..self.edits.len())
                .filter(|&edit| possible[edit] && !self.is_possible(&self.edits[edit], &possible))
                .collect();
            if impossible.is_empty() {
                break;
            }
            for edit in impossible {
                possible[edit] = false;
            }
        }
        let mut new = vec![NONE; self.edits.len()];
        let kept = (0..possible.len()).filter(|&edit| possible[edit]);
        for (count, edit) in kept.enumerate() {
            new[edit] = count as u32;
        }
        let mut number = 0;
        self.edits.retain(|_| {
            number += 1;
            possible[number - 1]
        });
        let renumber = |edits: &mut Vec<u32>| {
            edits.retain_mut(|edit| {
                *edit = new[*edit as usize];
                *edit != NONE
            });
        };
        for edit in &mut self.edits {
            renumber(&mut edit.needs);
        }
        for variable in &mut self.variables {
            renumber(&mut variable.edits);
        }
        for maker in self.makers.iter_mut().filter(|maker| **maker != NONE) {
            *maker = new[*maker as usize];
        }
    }

    /// Whether the groups that an edit touches can be kept whole by some of the `possible` edits of other variables.
    fn is_possible(&self, edit: &Edit, possible: &[bool]) -> bool {
        let groups = |fact: Option<FactId>| {
            let numbers = fact.map_or(&[][..], |fact| &self.memberships[fact.index()]);
            numbers.iter().map(|&group| &self.groups[group as usize])
        };
        let among = |group: &Group, fact: Option<FactId>| {
            fact.is_some_and(|fact| group.facts.binary_search(&fact).is_ok())
        };
        // What holds and is excluded by what will hold has to give way to something else.
        let gives_way = |group: &Group, other: FactId| {
            let home = self.homes[other.index()];
            let variable = (home != NONE).then(|| &self.variables[home as usize]);
            variable.is_none_or(|variable| {
                home == edit.variable
                    || variable.initial != Some(other)
                    || variable.edits.iter().any(|&way| {
                        possible[way as usize] && !among(group, self.edits[way as usize].to)
                    })
            })
        };
        // Where one fact has to hold, another has to take the place of what held.
        let comes = |group: &Group| {
            among(group, edit.to)
                || group.facts.iter().any(|&other| {
                    let maker = self.makers[other.index()];
                    maker != NONE
                        && possible[maker as usize]
                        && self.homes[other.index()] != edit.variable
                })
        };
        groups(edit.to).all(|group| group.facts.iter().all(|&other| gives_way(group, other)))
            && groups(edit.from).all(|group| !group.exactly || comes(group))
    }
}

/// The facts of each predicate.
pub(super) fn by_predicate(open: &Open) -> BTreeMap<PredicateId, Vec<FactId>> {
    let mut facts: BTreeMap<PredicateId, Vec<FactId>> = BTreeMap::new();
    for (number, fact) in open.grounded.facts.iter().enumerate() {
        if !open.grounded.derived[number] {
            facts.entry(fact.predicate).or_default().push(FactId(number as u32));
        }
    }
    facts
}

/// Groups facts by keys; facts of no key are left out.
pub(super) fn gather(keyed: impl Iterator<Item = (Vec<ObjectId>, FactId)>) -> Vec<Vec<FactId>> {
    let mut groups: BTreeMap<Vec<ObjectId>, Vec<FactId>> = BTreeMap::new();
    for (key, fact) in keyed {
        groups.entry(key).or_default().push(fact);
    }
    groups
        .into_values()
        .map(|mut facts| {
            facts.sort_unstable();
            facts.dedup();
            facts
        })
        .collect()
}

/// The instances of invariants that the actions keep.
fn lifted(open: &Open, invariants: &[Candidate]) -> Vec<Group> {
    let facts = by_predicate(open);
    let mut groups = Vec::new();
    for invariant in invariants {
        let keyed = invariant.parts.iter().flat_map(|part| {
            facts.get(&PredicateId(part.predicate)).into_iter().flatten().map(|&fact| {
                let arguments = open.arguments(fact);
                let key = part.order.iter().map(|&position| arguments[position as usize]);
                (key.collect(), fact)
            })
        });
        let instances = gather(keyed);
        let exactly = never_shrink(open, &instances);
        groups.extend(instances.into_iter().map(|facts| Group {
            facts,
            exactly,
            origin: Origin::Actions,
        }));
    }
    groups
}

/// Whether every operator that deletes a fact of a group adds one of the same group.
fn never_shrink(open: &Open, groups: &[Vec<FactId>]) -> bool {
    let mut of = vec![NONE; open.grounded.facts.len()];
    for (number, group) in groups.iter().enumerate() {
        for fact in group {
            of[fact.index()] = number as u32;
        }
    }
    let mut added: FxHashMap<u32, bool> = FxHashMap::default();
    open.grounded.operators.iter().all(|operator| {
        added.clear();
        let effects =
            &open.grounded.effects[operator.effects.start as usize..operator.effects.end as usize];
        for effect in effects {
            let group = of[effect.literal.fact.index()];
            if group != NONE {
                let entry = added.entry(group).or_insert(false);
                *entry |= effect.literal.positive && effect.conditions.is_empty();
            }
        }
        added.values().all(|&adds| adds)
    })
}

/// The instances of what is declared.
fn declared(open: &Open, declared: &[lang::group::Group]) -> Vec<Group> {
    let facts = by_predicate(open);
    let mut groups = Vec::new();
    for one in declared {
        let keyed = one.atoms.iter().flat_map(|atom| {
            facts
                .get(&atom.predicate)
                .into_iter()
                .flatten()
                .filter_map(|&fact| one.key(atom, open.arguments(fact)).map(|key| (key, fact)))
        });
        groups.extend(gather(keyed).into_iter().map(|facts| Group {
            facts,
            exactly: one.exactly,
            origin: Origin::Declared,
        }));
    }
    groups
}

impl Vocabulary {
    /// The facts that hold after `edits`, which change each variable once at most.
    pub fn state(&self, open: &Open, edits: &[u32]) -> Vec<bool> {
        let mut state = open.initial.clone();
        for &edit in edits {
            let edit = &self.edits[edit as usize];
            if let Some(fact) = edit.from {
                state[fact.index()] = false;
            }
            if let Some(fact) = edit.to {
                state[fact.index()] = true;
            }
        }
        state
    }

    /// A fact of the model, unless it stands for a new object.
    pub fn fact(open: &Open, fact: FactId) -> Option<model::Fact> {
        let ground = open.grounded.facts.get(fact.index())?;
        Some(model::Fact { predicate: ground.predicate, arguments: open.arguments(fact).into() })
    }
}
