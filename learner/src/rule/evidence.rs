//! Examples go in; counts come out of which everything that can be learned follows, and to which more examples can be added.
//!
//! For each atom that an action may be about it is counted how often it held before, and how often its change is or is not the action's doing.
//! Where a change can be the doing of several atoms, of one action bound to one object twice or of several parts of a joint step,
//! they are kept together as a [`Clause`]: one of them at least is an effect.

use std::collections::BTreeMap;

use lang::model::{ActionId, Atom, Domain, Fact, ObjectId, Term};
use lang::plan::Step;

use super::candidate;
use super::conclude;
use super::schema::Schema;
use super::{Learned, Options, Usual};
use crate::trace::{FactId, Joint, State, Trace, vocabulary};

/// Names an atom of an action, counted over all actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct LiteralId(pub u32);

impl LiteralId {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a [`Clause`] says of its literals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Claim {
    /// One of them is added.
    Adds,
    /// One of them is deleted.
    Deletes,
    /// One of them is added, or none is deleted.
    Keeps,
}

/// Several literals of which an example says something together.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Clause {
    pub(super) claim: Claim,
    /// Sorted; two at least.
    pub(super) literals: Box<[LiteralId]>,
}

/// What was seen of an atom.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Count {
    /// It held before.
    pub(super) held: u32,
    /// It came to hold, and nothing else can have been the cause.
    pub(super) added: u32,
    /// It ceased to hold, and nothing else can have been the cause.
    pub(super) deleted: u32,
    /// It did not hold afterwards: it is not added.
    pub(super) unadded: u32,
    /// It held before and afterwards, and nothing else can have seen to that: it is not deleted.
    pub(super) undeleted: u32,
    /// It changed, and no other part of the joint step can be about it.
    pub(super) alone: u32,
    /// It changed, and no other part of the joint step is about any object of it.
    pub(super) apart: u32,
}

/// What was seen of an action.
#[derive(Debug, Clone)]
pub(super) struct Record {
    /// The atoms that it can be about.
    pub(super) atoms: Vec<Atom>,
    /// One for each atom.
    pub(super) counts: Vec<Count>,
    /// The first of its literals.
    pub(super) first: u32,
    /// How often it was taken.
    pub(super) seen: u32,
    /// How often it was taken and everything that was done is known.
    pub(super) whole: u32,
    pub(super) sources: Vec<(String, u32)>,
    /// Terms that were the same object in some example.
    pub(super) alike: Vec<(Term, Term)>,
    terms: Vec<Term>,
}

/// Another part of a joint step that can be about the same change: for each of its arguments, the term of the first action that was the same object.
pub(super) type Tie = (ActionId, Vec<Option<Term>>);

/// What a set of examples says about the actions of a domain.
#[derive(Debug, Clone)]
pub struct Evidence {
    pub(super) domain: Domain,
    pub(super) records: Vec<Record>,
    pub(super) clauses: BTreeMap<Clause, u32>,
    /// For a literal that changed while another part could be about it: which part, and how often.
    pub(super) company: BTreeMap<LiteralId, BTreeMap<Tie, u32>>,
    /// The same for parts that some object of the change is an argument of.
    pub(super) contact: BTreeMap<LiteralId, BTreeMap<Tie, u32>>,
    pub(super) usual: Vec<Usual>,
    pub(super) strays: u32,
}

impl Evidence {
    /// No examples of the actions of `domain`.
    pub fn new(domain: &Domain) -> Self {
        let domain = vocabulary::of(domain);
        let mut first = 0;
        let record = |action| {
            let atoms = candidate::atoms(&domain, action);
            let counts = vec![Count::default(); atoms.len()];
            let terms = candidate::terms(&domain, action);
            let begin = first;
            first += atoms.len() as u32;
            Record {
                atoms,
                counts,
                first: begin,
                seen: 0,
                whole: 0,
                sources: Vec::new(),
                alike: Vec::new(),
                terms,
            }
        };
        let records = domain.actions.iter().map(record).collect();
        let usual = vec![Usual::default(); domain.predicates.len()];
        Self {
            domain,
            records,
            clauses: BTreeMap::new(),
            company: BTreeMap::new(),
            contact: BTreeMap::new(),
            usual,
            strays: 0,
        }
    }

    /// The domain that this is about, with bare actions.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// How often an action was seen.
    pub fn seen(&self, action: ActionId) -> u32 {
        self.records[action.index()].seen
    }

    /// Adds all examples of a trace in the words of the same domain.
    pub fn add(&mut self, trace: &Trace) {
        let mut found = Found::default();
        for (before, joint, after) in trace.transitions() {
            self.example(trace, [before, after], joint, &mut found);
        }
        self.count_usual(trace);
    }

    /// Adds what other evidence about the same domain says.
    ///
    /// # Panics
    /// If the domains have other actions or predicates.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(self.records.len(), other.records.len(), "both are about the same domain");
        for (record, more) in self.records.iter_mut().zip(&other.records) {
            assert_eq!(record.atoms, more.atoms, "both are about the same domain");
            record.seen += more.seen;
            record.whole += more.whole;
            for (name, count) in &more.sources {
                record.source(name, *count);
            }
            for pair in &more.alike {
                record.note_alike(*pair);
            }
            for (count, more) in record.counts.iter_mut().zip(&more.counts) {
                count.held += more.held;
                count.added += more.added;
                count.deleted += more.deleted;
                count.unadded += more.unadded;
                count.undeleted += more.undeleted;
                count.alone += more.alone;
                count.apart += more.apart;
            }
        }
        for (clause, weight) in &other.clauses {
            *self.clauses.entry(clause.clone()).or_default() += weight;
        }
        for (mine, theirs) in
            [(&mut self.company, &other.company), (&mut self.contact, &other.contact)]
        {
            for (literal, ties) in theirs {
                let known = mine.entry(*literal).or_default();
                for (tie, weight) in ties {
                    *known.entry(tie.clone()).or_default() += weight;
                }
            }
        }
        for (usual, more) in self.usual.iter_mut().zip(&other.usual) {
            usual.held += more.held;
            usual.possible += more.possible;
        }
        self.strays += other.strays;
    }

    /// Adds what is known of an action from its definition, as if it had been seen `count` times with exactly its precondition true.
    ///
    /// So an action that was learned before is refined by new examples: what they contradict goes.
    pub fn assume(&mut self, action: ActionId, schema: &Schema, count: u32, source: &str) {
        let record = &mut self.records[action.index()];
        record.seen += count;
        record.whole += count;
        record.source(source, count);
        for (atom, counted) in record.atoms.iter().zip(&mut record.counts) {
            let held = schema.required.contains(atom) || schema.deletes.contains(atom);
            let after = schema.adds.contains(atom) || (held && !schema.deletes.contains(atom));
            counted.held += if schema.required.contains(atom) { count } else { 0 };
            let (adds, deletes) = (schema.adds.contains(atom), schema.deletes.contains(atom));
            counted.added += if adds { count } else { 0 };
            counted.deleted += if deletes && !adds { count } else { 0 };
            counted.alone += if adds || deletes { count } else { 0 };
            counted.apart += if adds || deletes { count } else { 0 };
            counted.unadded += if after { 0 } else { count };
            counted.undeleted += if held && after { count } else { 0 };
        }
    }

    /// What follows.
    pub fn conclude(&self, options: &Options) -> Learned {
        conclude::conclude(self, options)
    }

    /// The action that a literal belongs to, and which of its atoms it is.
    pub(super) fn literal(&self, id: LiteralId) -> (ActionId, usize) {
        let action = self.records.partition_point(|record| record.first <= id.0) - 1;
        // An action without atoms has no literals and the same first one as the next.
        let at = (id.0 - self.records[action].first) as usize;
        (ActionId(action as u32), at)
    }

    fn example(&mut self, trace: &Trace, states: [&State; 2], joint: &Joint, found: &mut Found) {
        let [before, after] = states;
        found.list.clear();
        for (slot, part) in joint.parts.iter().enumerate() {
            let Some(part) = part else { continue };
            let record = &mut self.records[part.action.index()];
            record.seen += 1;
            record.whole += u32::from(joint.whole);
            record.source(&trace.name, 1);
            record.note_repetitions(part);
            for (at, atom) in record.atoms.iter().enumerate() {
                let objects = atom.arguments.iter().map(|term| value(*term, part));
                let fact = trace.look_up(atom.predicate, objects, &mut found.scratch);
                let held = fact.is_some_and(|fact| before.holds(fact));
                record.counts[at].held += u32::from(held);
                match fact {
                    Some(fact) if joint.whole => {
                        let literal = LiteralId(record.first + at as u32);
                        found.list.push((fact, slot as u32, literal));
                    }
                    // It never holds, and so not afterwards.
                    None if joint.whole => record.counts[at].unadded += 1,
                    _ => {}
                }
            }
        }
        if joint.whole {
            self.effects(trace, states, joint, found);
            self.strays += strays(before, after, &found.list);
        }
    }

    /// What an example says about effects, one fact after the other.
    fn effects(
        &mut self,
        trace: &Trace,
        [before, after]: [&State; 2],
        joint: &Joint,
        found: &mut Found,
    ) {
        found.list.sort_unstable();
        for group in found.list.chunk_by(|one, other| one.0 == other.0) {
            let fact = group[0].0;
            let (held, holds) = (before.holds(fact), after.holds(fact));
            let literals = distinct(group);
            if !holds {
                for literal in &literals {
                    self.count(*literal).unadded += 1;
                }
                if held {
                    self.change(Claim::Deletes, &literals);
                }
            } else if !held {
                self.change(Claim::Adds, &literals);
            }
            if holds {
                // What one part adds another does not delete; one part may do both to it, by different atoms.
                for part in group.chunk_by(|one, other| one.1 == other.1) {
                    match part {
                        [(_, _, literal)] => self.count(*literal).undeleted += 1,
                        _ if held => self.clause(Claim::Keeps, &distinct(part)),
                        _ => {}
                    }
                }
            }
            if held != holds {
                self.note_company(group, joint, &trace.facts[fact.index()]);
            }
        }
    }

    fn change(&mut self, claim: Claim, literals: &[LiteralId]) {
        match literals {
            [literal] => {
                let count = self.count(*literal);
                let cause =
                    if claim == Claim::Adds { &mut count.added } else { &mut count.deleted };
                *cause += 1;
            }
            _ => self.clause(claim, literals),
        }
    }

    fn clause(&mut self, claim: Claim, literals: &[LiteralId]) {
        let clause = Clause { claim, literals: literals.into() };
        *self.clauses.entry(clause).or_default() += 1;
    }

    fn count(&mut self, literal: LiteralId) -> &mut Count {
        let (action, at) = self.literal(literal);
        &mut self.records[action.index()].counts[at]
    }

    /// Notes with whom each literal of a change was.
    fn note_company(&mut self, group: &[(FactId, u32, LiteralId)], joint: &Joint, fact: &Fact) {
        for (_, slot, literal) in group {
            let Some(part) = &joint.parts[*slot as usize] else { continue };
            let (mut alone, mut apart) = (true, true);
            for (other, companion) in joint.parts.iter().enumerate() {
                let Some(companion) = companion.as_ref().filter(|_| other as u32 != *slot) else {
                    continue;
                };
                let about = |object| companion.arguments.contains(object);
                if group.iter().any(|one| one.1 == other as u32) {
                    alone = false;
                    let ties = self.company.entry(*literal).or_default();
                    *ties.entry(tie(part, companion)).or_default() += 1;
                }
                if fact.arguments.iter().any(about) {
                    apart = false;
                    let ties = self.contact.entry(*literal).or_default();
                    *ties.entry(tie(part, companion)).or_default() += 1;
                }
            }
            let count = self.count(*literal);
            count.alone += u32::from(alone);
            count.apart += u32::from(apart);
        }
    }

    fn count_usual(&mut self, trace: &Trace) {
        let domain = &self.domain;
        let steps = trace.steps.len().min(trace.states.len());
        for (usual, predicate) in self.usual.iter_mut().zip(&domain.predicates) {
            let fits = |types: &Vec<_>| {
                let of = trace.objects.iter().filter(|object| domain.has_type(object, types));
                of.count() as u64
            };
            let possible = predicate.parameters.iter().map(|position| fits(&position.types));
            usual.possible += possible.product::<u64>() * steps as u64;
        }
        for state in &trace.states[..steps] {
            for fact in state.facts() {
                self.usual[trace.facts[fact.index()].predicate.index()].held += 1;
            }
        }
    }
}

impl Record {
    fn source(&mut self, name: &str, count: u32) {
        match self.sources.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known += count,
            None => self.sources.push((name.to_owned(), count)),
        }
    }

    fn note_alike(&mut self, pair: (Term, Term)) {
        if !self.alike.contains(&pair) {
            self.alike.push(pair);
        }
    }

    /// Notes which terms are the same object in a step.
    fn note_repetitions(&mut self, part: &Step) {
        for (at, &argument) in part.arguments.iter().enumerate() {
            for other in at + 1..self.terms.len() {
                if value(self.terms[other], part) == argument {
                    self.note_alike((self.terms[at], self.terms[other]));
                }
            }
        }
    }
}

/// The candidates of one example; kept to save memory from being made again and again.
#[derive(Default)]
struct Found {
    /// Which fact a literal of the part in a slot is.
    list: Vec<(FactId, u32, LiteralId)>,
    scratch: Vec<u32>,
}

/// The object that a term is in a step.
fn value(term: Term, part: &Step) -> ObjectId {
    match term {
        Term::Variable(variable) => part.arguments[variable.index()],
        // The constants are the first objects of each trace.
        Term::Object(object) => object,
    }
}

/// The literals of a group, sorted, each once.
fn distinct(group: &[(FactId, u32, LiteralId)]) -> Vec<LiteralId> {
    let mut literals: Vec<LiteralId> = group.iter().map(|(_, _, literal)| *literal).collect();
    literals.sort_unstable();
    literals.dedup();
    literals
}

fn tie(part: &Step, other: &Step) -> Tie {
    let find = |object: &ObjectId| {
        let at = part.arguments.iter().position(|argument| argument == object);
        at.map(|at| Term::Variable(lang::model::VariableId(at as u32)))
    };
    (other.action, other.arguments.iter().map(find).collect())
}

/// How many facts changed that no candidate is about. The candidates are sorted.
fn strays(before: &State, after: &State, list: &[(FactId, u32, LiteralId)]) -> u32 {
    let known = |fact: FactId| list.binary_search_by_key(&fact, |one| one.0).is_ok();
    let (mut left, mut right) = (before.facts(), after.facts());
    let mut strays = 0;
    loop {
        let changed = match (left, right) {
            ([one, ..], [other, ..]) if one == other => {
                (left, right) = (&left[1..], &right[1..]);
                continue;
            }
            ([one, ..], [other, ..]) if one < other => {
                left = &left[1..];
                *one
            }
            (_, [other, ..]) => {
                right = &right[1..];
                *other
            }
            ([one, ..], []) => {
                left = &left[1..];
                *one
            }
            ([], []) => return strays,
        };
        strays += u32::from(!known(changed));
    }
}
