//! What may be changed goes in; the same comes out without changes that always break a group, and with the groups that still can be broken.

use std::collections::{BTreeMap, BTreeSet};

use lang::model::Fact;

use crate::excuse::{Catalogue, Choice};

/// What may be changed.
pub(super) struct Choices {
    /// The variables that can be changed.
    pub(super) variables: Vec<Choice>,
    /// The groups that changes of several variables can break.
    pub(super) groups: Vec<Shared>,
    /// The groups of each fact that may hold.
    memberships: BTreeMap<Fact, Vec<usize>>,
    /// Which facts some change touches.
    touched: BTreeSet<Fact>,
}

/// A group of which several variables have facts.
pub(super) struct Shared {
    /// Those that may hold after changes.
    pub(super) facts: Vec<Fact>,
    /// Whether one of them must.
    pub(super) exactly: bool,
    /// Whether one of them holds initially.
    pub(super) held: bool,
}

impl Choices {
    pub(super) fn new(catalogue: Catalogue, init: &[Fact]) -> Self {
        let Catalogue { mut variables, groups } = catalogue;
        let init: BTreeSet<&Fact> = init.iter().collect();
        while leave_out(&mut variables, &groups, &init) {}
        let home = homes(&variables);
        let shared = groups.iter().filter_map(|(facts, exactly)| {
            let mut facts: Vec<Fact> =
                facts.iter().filter(|fact| home.contains_key(*fact)).cloned().collect();
            facts.sort();
            let several = facts.iter().any(|fact| home[fact] != home[&facts[0]]);
            let held = facts.iter().any(|fact| init.contains(fact));
            several.then_some(Shared { facts, exactly: *exactly, held })
        });
        let groups = independent(shared.collect());
        let mut memberships: BTreeMap<Fact, Vec<usize>> = BTreeMap::new();
        for (number, group) in groups.iter().enumerate() {
            for fact in &group.facts {
                memberships.entry(fact.clone()).or_default().push(number);
            }
        }
        let touched = home.into_keys().cloned().collect();
        Self { variables, groups, memberships, touched }
    }

    /// The groups of a fact, by number.
    pub(super) fn groups(&self, fact: &Fact) -> &[usize] {
        self.memberships.get(fact).map_or(&[], Vec::as_slice)
    }

    /// Whether some change makes a fact true or false.
    pub(super) fn touches(&self, fact: &Fact) -> bool {
        self.touched.contains(fact)
    }
}

/// The variable of each fact that a change makes true or false.
fn homes(variables: &[Choice]) -> BTreeMap<&Fact, usize> {
    let facts = variables.iter().enumerate().flat_map(|(number, variable)| {
        let made = variable.to.iter().filter_map(|(to, _)| to.as_ref());
        made.chain(&variable.from).map(move |fact| (fact, number))
    });
    facts.collect()
}

/// Leaves out changes that break a group whatever else is changed; says whether there were any.
fn leave_out(
    variables: &mut Vec<Choice>,
    groups: &[(Vec<Fact>, bool)],
    init: &BTreeSet<&Fact>,
) -> bool {
    let home = homes(variables);
    // Facts that may not come to hold, and variables with the facts of which they must keep one.
    let mut barred: BTreeSet<Fact> = BTreeSet::new();
    let mut bound: BTreeMap<usize, Vec<&[Fact]>> = BTreeMap::new();
    for (facts, exactly) in groups {
        let stays = |fact: &Fact| init.contains(fact) && !home.contains_key(fact);
        let known: Vec<&Fact> = facts.iter().filter(|fact| home.contains_key(fact)).collect();
        if facts.iter().any(stays) {
            barred.extend(known.into_iter().cloned());
        } else if let Some((first, others)) = known.split_first()
            && *exactly
            && others.iter().all(|other| home[other] == home[first])
        {
            bound.entry(home[first]).or_default().push(facts);
        }
    }
    let before: usize = variables.iter().map(|variable| variable.to.len()).sum();
    for (number, variable) in variables.iter_mut().enumerate() {
        let kept = bound.get(&number).map_or(&[][..], Vec::as_slice);
        variable.to.retain(|(to, _)| match to {
            Some(fact) => !barred.contains(fact) && kept.iter().all(|facts| facts.contains(fact)),
            None => kept.is_empty(),
        });
    }
    variables.retain(|variable| !variable.to.is_empty());
    before != variables.iter().map(|variable| variable.to.len()).sum::<usize>()
}

/// Leaves out groups that others imply.
fn independent(mut groups: Vec<Shared>) -> Vec<Shared> {
    let mut memberships: BTreeMap<&Fact, Vec<usize>> = BTreeMap::new();
    for (number, group) in groups.iter().enumerate() {
        for fact in &group.facts {
            memberships.entry(fact).or_default().push(number);
        }
    }
    let implied = |number: usize, group: &Shared| {
        memberships[&group.facts[0]].iter().any(|&other| {
            let same = groups[other].facts == group.facts;
            let within = group.facts.iter().all(|fact| memberships[fact].contains(&other));
            let exactly = groups[other].exactly;
            // Of those that say the same, the first is kept.
            if same {
                (exactly && !group.exactly) || (exactly == group.exactly && other < number)
            } else {
                within && !group.exactly
            }
        })
    };
    let mut implied: Vec<bool> =
        groups.iter().enumerate().map(|(number, group)| implied(number, group)).collect();
    implied.reverse();
    groups.retain(|_| implied.pop() == Some(false));
    groups
}
