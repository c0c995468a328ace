//! Conditions, effects and expressions.

use std::ops::Range;

use super::list::Names;
use super::{Reader, is_number, lower};
use crate::ast::{
    Application, Connective, Feature, Formula, Modality, Name, Node, NodeKind, Operator, Place,
    Quantifier, Time, TypedList,
};
use crate::diagnostic::{
    misplaced_parenthesis, unexpected_item, unknown_predicate, unknown_time_specifier,
};
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
    /// Whether formulas stand among its operands.
    some: bool,
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
        let end = self.reach(root);
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
                        let some = self.tree.children(id).any(|part| self.tree.is_list(part));
                        open.push(Open { index, some, end: node.next, operands });
                        at = first;
                    }
                }
                tree::NodeKind::Atom if operands == Operands::Values => {
                    self.push(NodeKind::Word(self.name(id)), id, &mut formula);
                }
                tree::NodeKind::Atom => {
                    if let Some(list) = self.called(id) {
                        let index = formula.nodes.len();
                        let list_end = self.tree.node(list).next;
                        at = list_end;
                        if let Step::Into(first, operands) = self.call(id, list, &mut formula) {
                            open.push(Open { index, some: true, end: list_end, operands });
                            at = first;
                        }
                        continue;
                    }
                    self.stray("a formula in parentheses", id);
                    // Where formulas stand beside it, it is too much; where none does, it stands for one.
                    if !open.last().is_some_and(|open| open.some) {
                        self.nothing(id, &mut formula);
                    }
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

    /// The node of the tree after a formula that starts at `root`.
    pub(super) fn reach(&self, root: NodeId) -> u32 {
        let atom = self.tree.node(root).kind == tree::NodeKind::Atom;
        let last = self.called(root).filter(|_| atom).unwrap_or(root);
        self.tree.node(last).next
    }

    /// The list that follows a word which should stand in it: `not (p)`, `p(?x)`.
    fn called(&self, id: NodeId) -> Option<NodeId> {
        let tree = self.tree;
        let word = tree.slice(id);
        let mut at = id.0 + 1;
        let end = tree.nodes().len() as u32;
        let negation = word.eq_ignore_ascii_case("not");
        while negation && at < end && tree.node(NodeId(at)).kind == tree::NodeKind::Space {
            at += 1;
        }
        let named = !word.starts_with(['?', ':', '-']) && !is_number(word);
        (at < end && named && tree.is_list(NodeId(at))).then_some(NodeId(at))
    }

    /// Whether a comment stands right before a node.
    fn after_comment(&self, id: NodeId) -> bool {
        let before = &self.tree.nodes()[..id.0 as usize];
        let last = before.iter().rev().find(|node| node.kind != tree::NodeKind::Space);
        last.is_some_and(|node| node.kind == tree::NodeKind::Comment)
    }

    /// Reads `not (p)` as `(not (p))` and `p(?x)` as `(p ?x)`, after the report.
    fn call(&mut self, word: NodeId, list: NodeId, formula: &mut Formula<'a>) -> Step {
        let tree = self.tree;
        let name = self.name(word);
        let (before, after) = (tree.span(word), tree.span(list));
        let index = formula.nodes.len();
        let step = if name.is("not") {
            self.diagnostics.push(misplaced_parenthesis::before_list(name.text, before, after));
            self.push(NodeKind::Connective(Connective::Not), word, formula);
            Step::Into(list.0, Operands::Formulas)
        } else {
            self.diagnostics.push(misplaced_parenthesis::call(name.text, before, after));
            let arguments = self.arguments(list, &mut formula.terms);
            self.push(NodeKind::Apply(Application { name, arguments }), word, formula);
            Step::Over
        };
        formula.nodes[index].place = Place(before.to(after));
        step
    }

    /// The words in a list as arguments.
    fn arguments(&self, list: NodeId, terms: &mut Vec<Name<'a>>) -> Range<u32> {
        let start = terms.len() as u32;
        let words = self.tree.children(list).filter(|&word| !self.tree.is_list(word));
        terms.extend(words.map(|word| self.name(word)));
        start..terms.len() as u32
    }

    /// Whether a list that starts like an assignment is one, and no predicate of that name.
    fn changes(&self, id: NodeId) -> bool {
        let tree = self.tree;
        let operands: Vec<NodeId> = tree.children(id).skip(1).collect();
        let valued = |operand: NodeId| tree.is_list(operand) || is_number(tree.slice(operand));
        match operands.as_slice() {
            [target, amount] if !tree.is_list(*target) && !valued(*amount) => {
                !self.head(id).is_some_and(|head| self.declares(head))
            }
            [_, amount] if valued(*amount) => true,
            [target, ..] => tree.is_list(*target),
            [] => false,
        }
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
            "atstart" | "at-start" | "atend" | "at-end" | "overall" | "over-all"
                if !worded && operands.next().is_none() =>
            {
                let time = match word.as_bytes()[word.len() - 1] {
                    b't' => Time::AtStart,
                    b'd' => Time::AtEnd,
                    _ => Time::OverAll,
                };
                let head = self.head(id)?;
                self.diagnostics.push(unknown_time_specifier::in_one_word(
                    head.text,
                    head.span,
                    time.words(),
                ));
                self.push(NodeKind::Timed(time), id, formula);
                return Some(Step::Into(first.0, Operands::Formulas));
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
        let parts: Vec<NodeId> = tree.children(id).skip(1).collect();
        let variables = parts.iter().take_while(|&&part| {
            !tree.is_list(part) && self.called(part).is_none() && !self.after_comment(part)
        });
        let words = variables.count();
        let keyword = tree.children(id).next().map_or(tree.span(id), |keyword| tree.span(keyword));
        let word = quantifier.word();
        if words > 0 && parts.len() > words {
            // `(forall ?x - t FORMULA)`
            let span = tree.span(parts[0]).to(tree.span(parts[words - 1]));
            self.diagnostics.push(misplaced_parenthesis::variables(word, span));
            let variables = self.typed_list(parts[..words].iter().copied(), Names::Variables);
            self.push(NodeKind::Quantifier(quantifier, variables), id, formula);
            return Step::Into(parts[words].0, Operands::Formulas);
        }
        let Some(&list) = parts.first().filter(|&&list| tree.is_list(list)) else {
            self.unexpected(&format!("`({word} (?x - TYPE) FORMULA)`"), id);
            self.nothing(id, formula);
            return Step::Over;
        };
        if parts.len() == 1 && self.head(list).is_some_and(|head| !head.is_variable()) {
            // `(exists FORMULA)`
            let expected = format!("a list of variables such as `(?x - TYPE)` after `{word}`");
            self.diagnostics.push(unexpected_item::missing_item(&expected, keyword));
            self.push(NodeKind::Quantifier(quantifier, TypedList::default()), id, formula);
            return Step::Into(list.0, Operands::Formulas);
        }
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
        let operands: Vec<NodeId> = self.tree.children(id).skip(1).collect();
        if let &[list] = operands.as_slice()
            && self.head(list).is_some_and(|first| first.is_variable())
        {
            // `(p(?x ?y))`: no function has the name of a variable.
            let span = self.tree.span(list);
            self.diagnostics.push(misplaced_parenthesis::around_arguments(head.text, span));
            let arguments = self.arguments(list, &mut formula.terms);
            self.push(NodeKind::Apply(Application { name: head, arguments }), id, formula);
            return Step::Over;
        }
        self.push(NodeKind::Nested(head), id, formula);
        let first = self.tree.children(id).nth(1).expect("it has an argument that is a list");
        Step::Into(first.0, Operands::Values)
    }

    /// The word of the language that is probably meant in front of formulas or values, after the report.
    fn misspelt(&mut self, head: Name<'a>, id: NodeId) -> Option<&'static str> {
        const CONNECTIVES: [&str; 7] = ["and", "or", "not", "imply", "when", "forall", "exists"];
        const CHANGES: [&str; 5] = ["increase", "decrease", "assign", "scale-up", "scale-down"];
        let tree = self.tree;
        let operands: Vec<NodeId> = tree.children(id).skip(1).collect();
        if operands.is_empty() || head.text.len() < 3 {
            return None;
        }
        let lists = operands.iter().all(|&part| tree.is_list(part));
        let change = tree.is_list(operands[0]) && operands.len() == 2;
        let known = CONNECTIVES.into_iter().filter(|_| lists);
        let known: Vec<&str> = known.chain(CHANGES.into_iter().filter(|_| change)).collect();
        let near = nearest(head.text, known.iter().copied()).filter(|_| !self.declares(head))?;
        let meant = known.into_iter().find(|&word| word == near)?;
        let unknown = unknown_predicate::unknown_predicate(head.text, head.span, Some(meant));
        self.diagnostics.push(unknown.safely());
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
