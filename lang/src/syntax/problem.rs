//! The sections of a problem.

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{Entry, EntryKind, Feature, Init, Name, Problem, ProblemSection};
use crate::diagnostic::{Diagnostics, connective_in_init, several_formulas};
use crate::tree::{NodeId, NodeKind, Tree};

/// What can stand directly in a problem, with what is read later.
const SECTIONS: [&str; 9] = [
    ":domain",
    ":requirements",
    ":objects",
    ":init",
    ":goal",
    ":metric",
    ":constraints",
    ":htn",
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
        let mut unread = Vec::new();
        let read = match section {
            ":domain" => match content.next().filter(|&name| !tree.is_list(name)) {
                Some(name) => ProblemSection::Domain(self.name(name)),
                None => return self.unexpected("`(:domain NAME)`", item),
            },
            ":requirements" => ProblemSection::Requirements(self.words(item)),
            ":objects" => {
                ProblemSection::Objects(self.typed_list(content, Names::Words, &mut unread))
            }
            ":init" => ProblemSection::Init(self.init(item)),
            ":goal" => {
                let mut formulas = Vec::new();
                for part in content {
                    if !formulas.is_empty() {
                        let span = self.opening(part);
                        self.diagnostics.push(several_formulas::several_formulas(":goal", span));
                    }
                    formulas.push(self.formula(part));
                }
                ProblemSection::Goal(formulas)
            }
            ":metric" => self.metric(head, item),
            // It was in PDDL 1.2 and says nothing about the plan.
            ":length" => return,
            _ => {
                let feature =
                    if section == ":htn" { Feature::Hierarchies } else { Feature::Constraints };
                ProblemSection::Unread(self.unread(feature, head, item))
            }
        };
        sections.push(read);
        sections.extend(unread.into_iter().map(ProblemSection::Unread));
    }

    fn metric(&mut self, head: Name<'a>, item: NodeId) -> ProblemSection<'a> {
        let mut content = self.tree.children(item).skip(1);
        let direction = content.next().map(|direction| self.name(direction));
        let value = content.next();
        let function = value.and_then(|value| {
            let mut terms = Vec::new();
            let function = self.application(value, &mut terms)?;
            terms.is_empty().then(|| (function.name, self.place(value)))
        });
        match function {
            Some((function, place))
                if direction.is_some_and(|direction| direction.is("minimize"))
                    && content.next().is_none() =>
            {
                ProblemSection::Metric(function, place)
            }
            _ => ProblemSection::Unread(self.unread(Feature::Metrics, head, item)),
        }
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
                    self.unexpected("a fact in parentheses", id);
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
                    if let Some(kind) = self.entry(head, word, id, &mut init.terms) {
                        init.entries.push(Entry { kind, place: self.place(id) });
                    }
                }
            }
        }
        init
    }

    fn entry(
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
                    && is_number(tree.slice(right))
                    && let Some(function) = self.application(left, terms)
                {
                    return Some(EntryKind::Value(function, self.name(right)));
                }
                Some(EntryKind::Unread(self.unread(Feature::ObjectFluents, head, id)))
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
            "at" if operands.clone().count() == 2
                && operands
                    .next()
                    .is_some_and(|time| !tree.is_list(time) && is_number(tree.slice(time)))
                && operands.next().is_some_and(|literal| tree.is_list(literal)) =>
            {
                Some(EntryKind::Unread(self.unread(Feature::TimedLiterals, head, id)))
            }
            "oneof" | "probabilistic" | "unknown"
                if tree.children(id).skip(1).any(|operand| tree.is_list(operand)) =>
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
