//! Texts of traces go in; a [`Domain`] comes out that declares the predicates, the actions and the types that they show.
//!
//! Objects that ever stand in the same position of a predicate or an action are of one type, and so are, step by step, all that hang together in this way.
//! That is the coarsest typing that no text contradicts: types of which one lies above another cannot be told from a single one.
//! A type is called after what the names of its objects begin with (`block` for `block1` and `block2`), else `type-1` and so on;
//! if all objects are of one type, there are no types.

use lang::model::{Domain, TypeId};
use rustc_hash::FxHashMap;

use super::fault::Fault;
use super::scan::{Item, Scanner};
use super::vocabulary;

/// Infers a domain from texts. Heads that stand with different numbers of arguments are faults, one list for each text.
pub fn infer(title: &str, texts: &[&str]) -> (Domain, Vec<Vec<Fault>>) {
    let mut found = Found::default();
    let faults = texts.iter().map(|text| found.text(text)).collect();
    (found.domain(title), faults)
}

/// What is said of things: a predicate or an action, with where its positions stand among all.
struct Head<'t> {
    name: &'t str,
    first: usize,
    arity: usize,
}

#[derive(Default)]
struct Found<'t> {
    predicates: Vec<Head<'t>>,
    actions: Vec<Head<'t>>,
    numbers: FxHashMap<(bool, String), usize>,
    objects: FxHashMap<String, usize>,
    /// What an object is called and where it stands among the nodes.
    names: Vec<(&'t str, usize)>,
    /// Positions and objects, each with one that it is of one type with: a forest of disjoint sets.
    parents: Vec<usize>,
}

impl<'t> Found<'t> {
    fn node(&mut self) -> usize {
        self.parents.push(self.parents.len());
        self.parents.len() - 1
    }

    fn root(&mut self, mut node: usize) -> usize {
        while self.parents[node] != node {
            self.parents[node] = self.parents[self.parents[node]];
            node = self.parents[node];
        }
        node
    }

    fn text(&mut self, text: &'t str) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut scanner = Scanner::new(text);
        let mut heads: Vec<&str> = Vec::new();
        loop {
            let place = scanner.place();
            match scanner.next() {
                Some(Item::Open) => {
                    let section = heads.iter().rev().find(|head| !head.is_empty()).copied();
                    let section = section.unwrap_or_default().trim_matches(':');
                    let fact = matches!(section, "state" | "init");
                    let step = matches!(section, "action" | "actions" | "operator" | "operators");
                    if (fact || step)
                        && let Some(flat) = scanner.flat()
                    {
                        faults.extend(
                            self.saying(flat, fact).map(|wrong| Fault::at(text, place, wrong)),
                        );
                        continue;
                    }
                    match scanner.peek() {
                        Some(Item::Word(word)) => {
                            scanner.next();
                            heads.push(word);
                        }
                        _ => heads.push(""),
                    }
                }
                Some(Item::Close) => {
                    heads.pop();
                }
                Some(Item::Word(_)) => {}
                None => return faults,
            }
        }
    }

    /// Takes in a fact or an action; a message if it cannot be the one it was before.
    fn saying(&mut self, flat: &'t str, fact: bool) -> Option<String> {
        let mut words = flat.split_ascii_whitespace();
        let name = words.next().filter(|name| !matches!(*name, "nop" | "no-op" | "noop" | "="))?;
        let words: Vec<&str> = words.collect();
        let list = if fact { &self.predicates } else { &self.actions };
        let key = (fact, name.to_ascii_lowercase());
        let number = self.numbers.get(&key).copied().unwrap_or(list.len());
        if number == list.len() {
            let first = self.parents.len();
            self.parents.extend(first..first + words.len());
            let head = Head { name, first, arity: words.len() };
            if fact {
                self.predicates.push(head);
            } else {
                self.actions.push(head);
            }
            self.numbers.insert(key, number);
        }
        let head = if fact { &self.predicates[number] } else { &self.actions[number] };
        let (first, arity) = (head.first, head.arity);
        if arity != words.len() {
            let found = words.len();
            return Some(format!("`{name}` took {arity} arguments before, and here are {found}"));
        }
        for (at, word) in words.into_iter().enumerate() {
            let known = self.objects.get(&word.to_ascii_lowercase()).copied();
            let object = known.unwrap_or_else(|| {
                let node = self.node();
                self.objects.insert(word.to_ascii_lowercase(), node);
                self.names.push((word, node));
                node
            });
            let (one, other) = (self.root(first + at), self.root(object));
            self.parents[one.max(other)] = one.min(other);
        }
        None
    }

    fn domain(mut self, title: &str) -> Domain {
        let mut domain = vocabulary::empty(title);
        let mut groups: Vec<(usize, Vec<&str>)> = Vec::new();
        for (name, node) in std::mem::take(&mut self.names) {
            let root = self.root(node);
            match groups.iter_mut().find(|(known, _)| *known == root) {
                Some((_, names)) => names.push(name),
                None => groups.push((root, vec![name])),
            }
        }
        let mut types: FxHashMap<usize, TypeId> = FxHashMap::default();
        if groups.len() > 1 {
            let stems: Vec<String> = groups.iter().map(|(_, names)| stem(names)).collect();
            for (at, (root, _)) in groups.iter().enumerate() {
                let alone = stems.iter().filter(|stem| **stem == stems[at]).count() == 1;
                let fits = alone && !stems[at].is_empty() && stems[at] != "object";
                let name = if fits { stems[at].clone() } else { format!("type-{}", at + 1) };
                types.insert(*root, vocabulary::declare_type(&mut domain, &name, None));
            }
        }
        for head in std::mem::take(&mut self.predicates) {
            let positions = self.positions(&head, &types);
            vocabulary::declare_predicate(&mut domain, head.name, &positions);
        }
        for head in std::mem::take(&mut self.actions) {
            let positions = self.positions(&head, &types);
            vocabulary::declare_action(&mut domain, head.name, &positions, false);
        }
        domain
    }

    fn positions(&mut self, head: &Head<'_>, types: &FxHashMap<usize, TypeId>) -> Vec<Vec<TypeId>> {
        (head.first..head.first + head.arity)
            .map(|node| {
                let root = self.root(node);
                vec![types.get(&root).copied().unwrap_or(TypeId(0))]
            })
            .collect()
    }
}

/// The letters that all names begin with, without what separates them from a number.
fn stem(names: &[&str]) -> String {
    let mut stem = names[0].to_ascii_lowercase();
    for name in &names[1..] {
        let name = name.to_ascii_lowercase();
        let alike = stem.chars().zip(name.chars()).take_while(|(one, other)| one == other).count();
        stem.truncate(stem.char_indices().nth(alike).map_or(stem.len(), |(at, _)| at));
    }
    let end = stem.find(|letter: char| !letter.is_ascii_alphabetic() && !"-_".contains(letter));
    stem.truncate(end.unwrap_or(stem.len()));
    let stem = stem.trim_end_matches(['-', '_']);
    let starts = stem.starts_with(|letter: char| letter.is_ascii_alphabetic());
    if starts { stem.to_owned() } else { String::new() }
}
