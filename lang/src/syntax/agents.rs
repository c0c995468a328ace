//! What MA-PDDL adds: agents, private predicates and concurrency constraints.

use super::Reader;
use super::list::Names;
use crate::ast::{Agent, Concurrency, Name, Participant, Predicates, TypedList};
use crate::diagnostic::unexpected_item;
use crate::lexer;
use crate::tree::NodeId;

/// The fields of a concurrency constraint.
const CONCURRENCY: [&str; 3] = [":parameters", ":bounds", ":actions"];

impl<'a> Reader<'a, '_> {
    /// What follows `:agent`: `?a - t`, `?a`, a type or an object; in parentheses or not.
    pub(super) fn agent(&mut self, keyword: Name<'a>, values: &[NodeId]) -> Option<Agent<'a>> {
        let tree = self.tree;
        let inner: Vec<NodeId> = match values {
            &[list] if tree.is_list(list) => tree.children(list).collect(),
            _ => values.to_vec(),
        };
        let mut words = inner.into_iter();
        let Some(first) = words.next() else {
            let expected = "an agent such as `?a - agent` after `:agent`";
            self.diagnostics.push(unexpected_item::missing_item(expected, keyword.span));
            return None;
        };
        if tree.is_list(first) {
            self.unexpected("an agent such as `?a - agent`", first);
            return None;
        }
        let name = self.name(first);
        let mut types = None;
        if let Some(dash) = words.next() {
            let word = self.name(dash);
            if lexer::is_dash(word.text) {
                types = self.type_reference(words.next(), word.span);
            } else if let Some(glued) = self.glued_type(word) {
                types = Some(glued);
            } else {
                self.unexpected("`- TYPE` after the agent", dash);
            }
        }
        if let Some(extra) = words.next() {
            self.unexpected("one agent", extra);
        }
        Some(Agent { keyword, name, types })
    }

    /// The content of `(:predicates …)`.
    pub(super) fn predicates(
        &mut self,
        items: impl Iterator<Item = NodeId>,
    ) -> Vec<Predicates<'a>> {
        let mut all: Vec<Predicates<'a>> = Vec::new();
        for item in items {
            if let Some(keyword) = self.head(item).filter(|head| head.is(":private")) {
                let private = self.private(keyword, item);
                all.push(private);
                continue;
            }
            let Some(head) = self.declaration(item, "a predicate") else { continue };
            match all.last_mut().filter(|last| last.private.is_none()) {
                Some(last) => last.heads.push(head),
                None => all.push(Predicates {
                    private: None,
                    owner: TypedList::default(),
                    heads: vec![head],
                }),
            }
        }
        all
    }

    /// `(:private ?agent - t (PREDICATE …) …)`
    fn private(&mut self, keyword: Name<'a>, item: NodeId) -> Predicates<'a> {
        let tree = self.tree;
        let content: Vec<NodeId> = tree.children(item).skip(1).collect();
        // The type of the owner may be a list: `?a - (either t u) (p ?a)`.
        let mut owner = 0;
        while owner < content.len() {
            let typed = owner > 0 && lexer::is_dash(tree.slice(content[owner - 1]));
            if tree.is_list(content[owner]) && !typed {
                break;
            }
            owner += 1;
        }
        let list = self.typed_list(content[..owner].iter().copied(), Names::Variables);
        let heads = content[owner..]
            .iter()
            .filter_map(|&head| self.declaration(head, "a predicate"))
            .collect();
        Predicates { private: Some(keyword), owner: list, heads }
    }

    /// `(:concurrency-constraint NAME :parameters (…) :bounds (LEAST MOST) :actions (…))`
    pub(super) fn concurrency(&mut self, item: NodeId) -> Concurrency<'a> {
        let tree = self.tree;
        let (name, skip) = self.title_of(item, "concurrency constraint");
        let owner = format!("concurrency constraint `{name}`");
        let mut fields = self.fields(item, skip, owner, &CONCURRENCY);
        let mut read = Concurrency {
            name,
            parameters: TypedList::default(),
            bounds: Vec::new(),
            actions: Vec::new(),
            place: self.place(item),
        };
        while let Some((field, keyword, values)) = self.next_field(&mut fields) {
            let &[value] = values.as_slice() else {
                let expected = format!("one list after `{field}`");
                self.diagnostics.push(unexpected_item::missing_item(&expected, keyword.span));
                continue;
            };
            match field {
                ":parameters" => self.parameters(&values, &mut read.parameters),
                ":bounds" => {
                    let words = tree.children(value).filter(|&word| !tree.is_list(word));
                    read.bounds = words.map(|word| self.name(word)).collect();
                    if !tree.is_list(value) || read.bounds.len() != 2 {
                        self.unexpected("two bounds such as `(1 inf)`", value);
                    }
                }
                _ => {
                    for action in tree.children(value) {
                        read.actions.extend(self.participant(action));
                    }
                }
            }
        }
        read
    }

    /// `(ACTION POSITION …)`
    fn participant(&mut self, item: NodeId) -> Option<Participant<'a>> {
        let Some(action) = self.head(item) else {
            self.unexpected("an action with positions such as `(move 1)`", item);
            return None;
        };
        let positions = self.words(item);
        Some(Participant { action, positions, place: self.place(item) })
    }
}
