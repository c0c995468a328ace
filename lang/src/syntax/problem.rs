//! The sections of a problem.

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{Entry, EntryKind, Feature, Goal, Init, Metric, Name, Problem, ProblemSection};
use crate::diagnostic::{Diagnostics, connective_in_init, unexpected_item};
use crate::tree::{NodeId, NodeKind, Tree};

/// The fields of a goal that belongs to an agent.
const GOAL: [&str; 2] = [":agent", ":condition"];

/// The fields of a metric that belongs to an agent.
const METRIC: [&str; 2] = [":agent", ":utility"];

/// What can stand directly in a problem.
const SECTIONS: [&str; 10] = [
    ":domain",
    ":requirements",
    ":objects",
    ":init",
    ":goal",
    ":metric",
    ":constraints",
    ":htn",
    ":htnti",
    ":length",
];

/// Reads a problem.
pub fn problem<'a>(tree: &Tree<'a>, diagnostics: &mut Diagnostics) -> Problem<'a> {
    let mut reader = Reader { tree, diagnostics, lost: false };
    let (name, items) = reader.definition("problem");
    let mut sections = Vec::with_capacity(items.len());
    for item in items {
        reader.problem_section(item, &mut sections);
    }
    Problem { name, sections }
}

impl<'a> Reader<'a, '_> {
    fn problem_section(&mut self, item: NodeId, sections: &mut Vec<ProblemSection<'a>>) {
        let tree = self.tree;
        let Some((head, section)) = self.section(item, "problem", &SECTIONS) else { return };
        let mut content = tree.children(item).skip(1);
        let read = match section {
            ":domain" => match content.next().filter(|&name| !tree.is_list(name)) {
                Some(name) => ProblemSection::Domain(self.name(name)),
                None => return self.unexpected("`(:domain NAME)`", item),
            },
            ":requirements" => ProblemSection::Requirements(self.words(item)),
            ":objects" => ProblemSection::Objects(self.typed_list(content, Names::Words)),
            ":init" => ProblemSection::Init(self.init(item)),
            ":goal" => ProblemSection::Goal(self.goal(item)),
            ":metric" => ProblemSection::Metric(self.metric(head, item)),
            ":constraints" => ProblemSection::Constraints(head, self.all_formulas(section, item)),
            ":htn" | ":htnti" => ProblemSection::Network(self.initial_network(head, item)),
            // `:length` was in PDDL 1.2 and says nothing about the plan.
            _ => return,
        };
        sections.push(read);
    }

    /// Whether the content of a list starts with a field.
    fn has_fields(&self, item: NodeId) -> bool {
        let first = self.tree.children(item).nth(1);
        first.is_some_and(|first| {
            !self.tree.is_list(first) && self.tree.slice(first).starts_with(':')
        })
    }

    fn goal(&mut self, item: NodeId) -> Goal<'a> {
        if !self.has_fields(item) {
            return Goal { agent: None, formulas: self.all_formulas(":goal", item) };
        }
        let mut fields = self.fields(item, 1, "the goal".to_owned(), &GOAL);
        let mut goal = Goal { agent: None, formulas: Vec::new() };
        while let Some((field, keyword, values)) = self.next_field(&mut fields) {
            if field == ":agent" {
                goal.agent = self.agent(keyword, &values);
            } else {
                self.formulas(field, &values, &mut goal.formulas);
            }
        }
        goal
    }

    fn metric(&mut self, keyword: Name<'a>, item: NodeId) -> Metric<'a> {
        let mut agent = None;
        let mut content: Vec<NodeId> = self.tree.children(item).skip(1).collect();
        if self.has_fields(item) {
            let mut fields = self.fields(item, 1, "the metric".to_owned(), &METRIC);
            content.clear();
            while let Some((field, keyword, values)) = self.next_field(&mut fields) {
                if field == ":agent" {
                    agent = self.agent(keyword, &values);
                } else {
                    content = values;
                }
            }
        }
        let mut content = content.into_iter();
        let direction = content.next().filter(|&direction| !self.tree.is_list(direction));
        let direction = match direction.map(|direction| self.name(direction)) {
            Some(direction) => direction,
            None => Name { text: "", span: keyword.span },
        };
        if !direction.is("minimize") && !direction.is("maximize") {
            self.diagnostics
                .push(unexpected_item::unexpected_item("`minimize` or `maximize`", direction.span));
        }
        let value = content.next().map(|value| self.expression(value));
        if value.is_none() && !direction.text.is_empty() {
            let expected = "an expression such as `(total-cost)`";
            self.diagnostics.push(unexpected_item::missing_item(expected, direction.span));
        }
        if let Some(extra) = content.next() {
            self.unexpected("one expression in `:metric`", extra);
        }
        Metric { keyword, agent, direction, value }
    }

    /// The content of `(:init …)`. An `and` around facts is reported and taken away.
    fn init(&mut self, item: NodeId) -> Init<'a> {
        let tree = self.tree;
        let mut init = Init::default();
        let end = tree.node(item).next;
        let mut at = tree.children(item).next().map_or(end, |keyword| tree.node(keyword).next);
        let mut reported = false;
        while at < end {
            let id = NodeId(at);
            let node = tree.node(id);
            at = node.next;
            match node.kind {
                NodeKind::List | NodeKind::OpenList => {}
                NodeKind::Atom => {
                    self.stray("a fact in parentheses", id);
                    continue;
                }
                _ => continue,
            }
            let Some(head) = self.head(id) else {
                self.unexpected("a fact", id);
                continue;
            };
            match lower(head.text, &mut [0; 24]) {
                "and" => {
                    if !std::mem::replace(&mut reported, true) {
                        self.diagnostics
                            .push(connective_in_init::connective_in_init(head.text, head.span));
                    }
                    at = tree.children(id).next().map_or(at, |keyword| tree.node(keyword).next);
                }
                "or" | "imply" | "forall" | "exists" | "when" => {
                    self.diagnostics
                        .push(connective_in_init::connective_in_init(head.text, head.span));
                }
                word => {
                    if let Some((kind, time)) = self.entry(head, word, id, &mut init.terms) {
                        init.entries.push(Entry { kind, time, place: self.place(id) });
                    }
                }
            }
        }
        init
    }

    /// What one list says, and when.
    fn entry(
        &mut self,
        head: Name<'a>,
        word: &str,
        id: NodeId,
        terms: &mut Vec<Name<'a>>,
    ) -> Option<(EntryKind<'a>, Option<Name<'a>>)> {
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        if word == "at"
            && let (Some(time), Some(literal), None) =
                (operands.next(), operands.next(), operands.next())
            && is_number(tree.slice(time))
            && tree.is_list(literal)
        {
            let Some(head) = self.head(literal) else {
                self.unexpected("a fact", literal);
                return None;
            };
            let kind = self.fact(head, lower(head.text, &mut [0; 24]), literal, terms)?;
            return Some((kind, Some(self.name(time))));
        }
        Some((self.fact(head, word, id, terms)?, None))
    }

    fn fact(
        &mut self,
        head: Name<'a>,
        word: &str,
        id: NodeId,
        terms: &mut Vec<Name<'a>>,
    ) -> Option<EntryKind<'a>> {
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        match word {
            "=" => {
                let (Some(left), Some(right), None) =
                    (operands.next(), operands.next(), operands.next())
                else {
                    self.unexpected("`(= (FUNCTION OBJECT …) NUMBER)`", id);
                    return None;
                };
                if !tree.is_list(right)
                    && let Some(function) = self.application(left, terms)
                {
                    return Some(EntryKind::Value(function, self.name(right)));
                }
                self.unexpected("`(= (FUNCTION OBJECT …) NUMBER)`", id);
                None
            }
            "not" => {
                let (Some(atom), None) =
                    (operands.next().filter(|&atom| tree.is_list(atom)), operands.next())
                else {
                    self.unexpected("`(not (PREDICATE OBJECT …))`", id);
                    return None;
                };
                let Some(atom) = self.application(atom, terms) else {
                    self.unexpected("a fact of a predicate and objects", atom);
                    return None;
                };
                Some(EntryKind::Absent(atom))
            }
            "oneof" | "probabilistic" | "unknown" | "or"
                if operands.clone().any(|operand| tree.is_list(operand)) =>
            {
                Some(EntryKind::Unread(self.unread(Feature::Nondeterminism, head, id)))
            }
            _ => {
                if let Some(fact) = self.application(id, terms) {
                    Some(EntryKind::Fact(fact))
                } else {
                    self.unexpected("a fact of a predicate and objects", id);
                    None
                }
            }
        }
    }
}
