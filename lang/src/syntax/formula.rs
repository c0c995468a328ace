//! Conditions, effects and expressions.

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{
    Connective, Feature, Formula, Modality, Name, Node, NodeKind, Operator, Place, Quantifier, Time,
};
use crate::diagnostic::{unknown_predicate, unknown_time_specifier};
use crate::near::nearest;
use crate::tree::{self, NodeId};

/// What the operands of a list are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Operands {
    /// Conditions or effects.
    Formulas,
    /// Numbers or objects, and what has one as value.
    Values,
}

/// How the loop goes on after a node.
enum Step {
    /// Its operands start at this node of the tree.
    Into(u32, Operands),
    /// It has none.
    Over,
}

/// A node whose operands are being read.
struct Open {
    index: usize,
    /// The node of the tree after its list.
    end: u32,
    operands: Operands,
}

impl<'a> Reader<'a, '_> {
    /// Reads the node and everything in it as a condition or an effect.
    pub(super) fn formula(&mut self, root: NodeId) -> Formula<'a> {
        self.read(root, Operands::Formulas)
    }

    /// Reads the node and everything in it as something that has a value.
    pub(super) fn expression(&mut self, root: NodeId) -> Formula<'a> {
        self.read(root, Operands::Values)
    }

    fn read(&mut self, root: NodeId, wanted: Operands) -> Formula<'a> {
        let mut formula = Formula::default();
        let mut open: Vec<Open> = Vec::new();
        let end = self.tree.node(root).next;
        let mut at = root.0;
        while at < end {
            close(&mut formula, &mut open, at);
            let operands = open.last().map_or(wanted, |open| open.operands);
            let id = NodeId(at);
            let node = self.tree.node(id);
            at = node.next;
            match node.kind {
                tree::NodeKind::List | tree::NodeKind::OpenList => {
                    let index = formula.nodes.len();
                    if let Step::Into(first, operands) = self.node(id, operands, &mut formula) {
                        open.push(Open { index, end: node.next, operands });
                        at = first;
                    }
                }
                tree::NodeKind::Atom if operands == Operands::Values => {
                    self.push(NodeKind::Word(self.name(id)), id, &mut formula);
                }
                tree::NodeKind::Atom => {
                    self.unexpected("a formula in parentheses", id);
                    self.nothing(id, &mut formula);
                }
                _ => {}
            }
        }
        close(&mut formula, &mut open, end);
        formula
    }

    fn push(&self, kind: NodeKind<'a>, id: NodeId, formula: &mut Formula<'a>) {
        let place = self.place(id);
        let keyword = self.head(id).map_or(place, |head| Place(head.span));
        let next = formula.nodes.len() as u32 + 1;
        formula.nodes.push(Node { kind, next, place, keyword });
    }

    /// What stands for `()`, and for what has been reported.
    fn nothing(&self, id: NodeId, formula: &mut Formula<'a>) {
        self.push(NodeKind::Connective(Connective::And), id, formula);
    }

    /// Reads the first word of a list, and all of it if only words follow.
    fn node(&mut self, id: NodeId, wanted: Operands, formula: &mut Formula<'a>) -> Step {
        let Some(first) = self.tree.children(id).next() else {
            self.nothing(id, formula);
            return Step::Over;
        };
        if self.tree.is_list(first) {
            let expected = match wanted {
                Operands::Formulas => "a predicate or a connective after `(`",
                Operands::Values => "a function or an operator after `(`",
            };
            self.unexpected(expected, id);
            self.nothing(id, formula);
            return Step::Over;
        }
        let head = self.name(first);
        let after = self.tree.node(first).next;
        let mut buffer = [0; 24];
        let word = lower(head.text, &mut buffer);
        if wanted == Operands::Values {
            return match Operator::of(word).filter(|operator| operator.computes()) {
                Some(operator) => {
                    self.push(NodeKind::Operator(operator), id, formula);
                    Step::Into(after, Operands::Values)
                }
                None => self.application_or_nested(head, id, formula),
            };
        }
        if let Some(step) = self.keyword(word, id, after, formula) {
            return step;
        }
        match self.misspelt(head, id) {
            Some(meant) => self
                .keyword(meant, id, after, formula)
                .unwrap_or_else(|| self.application_or_nested(head, id, formula)),
            None => self.application_or_nested(head, id, formula),
        }
    }

    /// A list that starts with a word of the language, which follow at `after`.
    fn keyword(
        &mut self,
        word: &str,
        id: NodeId,
        after: u32,
        formula: &mut Formula<'a>,
    ) -> Option<Step> {
        let connective = match word {
            "and" => Connective::And,
            "or" => Connective::Or,
            "not" => Connective::Not,
            "imply" => Connective::Imply,
            "when" => Connective::When,
            "forall" => return Some(self.quantifier(Quantifier::Forall, id, formula)),
            "exists" => return Some(self.quantifier(Quantifier::Exists, id, formula)),
            _ => {
                return match Operator::of(word) {
                    Some(operator) if !operator.changes() || self.changes(id) => {
                        self.push(NodeKind::Operator(operator), id, formula);
                        Some(Step::Into(after, Operands::Values))
                    }
                    _ => self.wrapper(word, id, formula),
                };
            }
        };
        self.push(NodeKind::Connective(connective), id, formula);
        Some(Step::Into(after, Operands::Formulas))
    }

    /// Whether a list that starts like an assignment is one, and no predicate of that name.
    fn changes(&self, id: NodeId) -> bool {
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        let target = operands.next();
        let valued = |operand: NodeId| tree.is_list(operand) || is_number(tree.slice(operand));
        target.is_some_and(|target| tree.is_list(target)) || operands.next().is_some_and(valued)
    }

    /// What stands around formulas: time specifiers, preferences, modalities.
    fn wrapper(&mut self, word: &str, id: NodeId, formula: &mut Formula<'a>) -> Option<Step> {
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        if operands.clone().all(|operand| !tree.is_list(operand)) {
            return None;
        }
        let first = operands.next()?;
        let worded = !tree.is_list(first);
        let after = tree.node(first).next;
        let kind = match word {
            "at" | "over" if worded => {
                let alone = operands.next().is_some() && operands.next().is_none();
                let time = self.time(word, self.name(first), alone)?;
                self.push(NodeKind::Timed(time), id, formula);
                let both = self.head(id).map(|head| head.span.to(tree.span(first)));
                if let (Some(node), Some(both)) = (formula.nodes.last_mut(), both) {
                    node.keyword = Place(both);
                }
                return Some(Step::Into(after, Operands::Formulas));
            }
            "preference" => {
                let name = worded.then(|| self.name(first));
                self.push(NodeKind::Preference(name), id, formula);
                let into = if worded { after } else { first.0 };
                return Some(Step::Into(into, Operands::Formulas));
            }
            "oneof" | "probabilistic" => {
                let keyword = self.head(id)?;
                NodeKind::Unread(self.unread(Feature::Nondeterminism, keyword, id))
            }
            _ => {
                let modality = Modality::of(word)?;
                let (times, _) = modality.operands();
                let words = tree.children(id).skip(1).take_while(|&part| !tree.is_list(part));
                let times: Vec<NodeId> = words.take(times).collect();
                let into = times.last().map_or(first.0, |&last| tree.node(last).next);
                let times = times.into_iter().map(|time| self.name(time)).collect();
                self.push(NodeKind::Trajectory(modality, times), id, formula);
                return Some(Step::Into(into, Operands::Formulas));
            }
        };
        self.push(kind, id, formula);
        Some(Step::Over)
    }

    /// What `at` or `over` and the next word say; `alone` if they stand around one thing.
    fn time(&mut self, word: &str, name: Name<'a>, alone: bool) -> Option<Time> {
        if word == "at" && name.is("start") {
            return Some(Time::AtStart);
        }
        if word == "at" && name.is("end") {
            return Some(Time::AtEnd);
        }
        if word == "over" && name.is("all") {
            return Some(Time::OverAll);
        }
        // `(at home (owner house))` is a predicate with a function as argument.
        if !alone || name.is_variable() || is_number(name.text) {
            return None;
        }
        let (near, time) = match nearest(name.text, ["start", "end", "all"])? {
            "start" => ("start", Time::AtStart),
            "end" => ("end", Time::AtEnd),
            _ => ("all", Time::OverAll),
        };
        let meant = if word == "at" && near == "all" || word == "over" && near != "all" {
            time.words()
        } else {
            near
        };
        self.diagnostics.push(unknown_time_specifier::unknown_time_specifier(
            word, name.text, name.span, meant,
        ));
        Some(time)
    }

    fn quantifier(
        &mut self,
        quantifier: Quantifier,
        id: NodeId,
        formula: &mut Formula<'a>,
    ) -> Step {
        let tree = self.tree;
        let Some(list) = tree.children(id).nth(1).filter(|&list| tree.is_list(list)) else {
            self.unexpected(&format!("`({} (?x - TYPE) FORMULA)`", quantifier.word()), id);
            self.nothing(id, formula);
            return Step::Over;
        };
        let variables = self.typed_list(tree.children(list), Names::Variables);
        self.push(NodeKind::Quantifier(quantifier, variables), id, formula);
        Step::Into(tree.node(list).next, Operands::Formulas)
    }

    /// `(NAME ARGUMENT …)`
    fn application_or_nested(
        &mut self,
        head: Name<'a>,
        id: NodeId,
        formula: &mut Formula<'a>,
    ) -> Step {
        if let Some(application) = self.application(id, &mut formula.terms) {
            self.push(NodeKind::Apply(application), id, formula);
            return Step::Over;
        }
        self.push(NodeKind::Nested(head), id, formula);
        let first = self.tree.children(id).nth(1).expect("it has an argument that is a list");
        Step::Into(first.0, Operands::Values)
    }

    /// The connective that is probably meant by a word in front of formulas, after the report.
    fn misspelt(&mut self, head: Name<'a>, id: NodeId) -> Option<&'static str> {
        const WORDS: [&str; 7] = ["and", "or", "not", "imply", "when", "forall", "exists"];
        let tree = self.tree;
        let mut operands = tree.children(id).skip(1);
        let lists = operands.clone().next().is_some() && operands.all(|part| tree.is_list(part));
        if !lists || head.text.len() < 3 || self.declares(head) {
            return None;
        }
        let near = nearest(head.text, WORDS)?;
        let meant = WORDS.into_iter().find(|&word| word == near)?;
        self.diagnostics
            .push(unknown_predicate::unknown_predicate(head.text, head.span, Some(meant)).safely());
        Some(meant)
    }

    /// Whether this text declares a predicate of this name.
    fn declares(&self, name: Name<'a>) -> bool {
        let tree = self.tree;
        let Some(definition) = tree.roots().next() else { return false };
        tree.children(definition)
            .filter(|&section| self.head(section).is_some_and(|head| head.is(":predicates")))
            .flat_map(|section| tree.children(section))
            .any(|predicate| self.head(predicate).is_some_and(|head| head.is(name.text)))
    }
}

/// Ends the nodes whose lists end at `at` or before.
fn close(formula: &mut Formula<'_>, open: &mut Vec<Open>, at: u32) {
    let next = formula.nodes.len() as u32;
    while let Some(open) = open.pop_if(|open| open.end <= at) {
        formula.nodes[open.index].next = next;
    }
}
