//! A list goes in; what some tools do not read or plan with comes out: its place, its fields and its meaning.

use super::{Feature, Frame, Part, Survey};
use crate::lexer::is_dash;
use crate::source::Span;
use crate::tree::NodeId;

/// The sections of a domain in the order in which many parsers want them; what follows them has none.
const DOMAIN: [&str; 5] = [":requirements", ":types", ":constants", ":predicates", ":functions"];

/// The sections of a problem in that order.
const PROBLEM: [&str; 7] =
    [":domain", ":requirements", ":objects", ":init", ":goal", ":constraints", ":metric"];

/// The sections that say what changes.
const ACTIONS: [&str; 5] = [":action", ":durative-action", ":process", ":event", ":derived"];

/// The fields of an action in that order.
const FIELDS: [&str; 6] =
    [":agent", ":parameters", ":duration", ":precondition", ":condition", ":effect"];

/// How far around an effect is looked, so that deep nonsense takes no time.
const NEAR: usize = 64;

impl Survey<'_, '_> {
    /// Notes what is special about the list `id`, which begins with `head` and is `part` of something.
    pub(super) fn form(&mut self, id: NodeId, head: &str, part: Part) {
        let opening = self.opening(id);
        match (part, head) {
            (Part::Section, _) => self.enter(id, head, opening),
            (_, "either") if self.after_dash() => self.either(opening),
            (_, ":private") => self.note(Feature::Privacy, opening),
            (Part::Condition, _) => self.condition(id, head, opening),
            (Part::Effect, _) => self.effect(id, head, opening),
            (Part::Init, "at") => self.timed(id, opening),
            _ => {}
        }
        if head == "-" && self.tree.children(id).nth(2).is_none() {
            self.note(Feature::UnaryMinus, opening);
        }
        self.specifier(id, head);
    }

    /// Whether the last thing in the list at hand is the `-` before a type.
    fn after_dash(&self) -> bool {
        let word = self.open.last().and_then(|frame| frame.before);
        word.is_some_and(|word| is_dash(self.tree.slice(word)))
    }

    fn either(&mut self, opening: Span) {
        let feature = match self.section() {
            ":predicates" => Feature::EitherInPredicate,
            ":types" | ":objects" | ":constants" => Feature::EitherInObjects,
            _ => Feature::Either,
        };
        self.note(feature, opening);
    }

    /// A section begins.
    fn enter(&mut self, id: NodeId, head: &str, opening: Span) {
        self.note_as(Feature::Section, head, opening);
        let order: &[&'static str] = if self.problem { &PROBLEM } else { &DOMAIN };
        let now = order.iter().position(|one| *one == head);
        let later = |one: &&'static str| match order.iter().position(|known| known == one) {
            Some(before) => now.is_some_and(|now| before > now),
            // In a domain all that is not declared first comes last.
            None => !self.problem && now.is_some(),
        };
        let late = self.sections.iter().any(later);
        if late && self.problem {
            self.note(Feature::ProblemOrder, opening);
        } else if late {
            self.note(Feature::DeclarationOrder, opening);
        }
        let acts = ACTIONS.iter().any(|one| self.sections.contains(one));
        if !self.problem && now.is_some() && acts {
            self.note(Feature::DeclarationAfterAction, opening);
        }
        let process = self.sections.contains(":process") || self.sections.contains(":event");
        if matches!(head, ":action" | ":durative-action") && process {
            self.note(Feature::ActionAfterProcess, opening);
        }
        if now.is_some() && self.sections.contains(head) {
            self.note_as(Feature::RepeatedSection, head, opening);
        }
        if !self.problem && head == ":constraints" {
            self.note(Feature::DomainConstraints, opening);
        }
        let known = order.iter().chain(&ACTIONS).copied().find(|one| *one == head);
        self.sections.insert(known.unwrap_or(""));
        self.fields.clear();
        match head {
            ":requirements" => self.requirements(id, opening),
            ":metric" => self.metric(id, opening),
            ":types" => {
                let mut parts = self.tree.children(id);
                if let Some(dash) = parts.find(|&part| is_dash(self.tree.slice(part))) {
                    let end = parts.next().map_or(dash, |of| of);
                    let span = self.tree.span(dash).to(self.tree.span(end));
                    self.note(Feature::Supertype, span);
                }
            }
            ":functions" => self.functions(id),
            _ => {}
        }
    }

    fn requirements(&mut self, id: NodeId, opening: Span) {
        let flags: Vec<NodeId> = self.tree.children(id).skip(1).collect();
        if flags.is_empty() {
            self.note(Feature::EmptyRequirements, opening);
        }
        for flag in flags {
            let text = self.lower(flag);
            self.note_as(Feature::Requirement, &text, self.tree.span(flag));
        }
    }

    fn metric(&mut self, id: NodeId, opening: Span) {
        self.note(Feature::Metric, opening);
        let parts: Vec<NodeId> = self.tree.children(id).skip(1).collect();
        let usual = match parts.as_slice() {
            [sense, value] => {
                self.lower(*sense) == "minimize"
                    && self.tree.is_list(*value)
                    && self.head(*value) == "total-cost"
            }
            _ => false,
        };
        if !usual {
            self.note(Feature::OddMetric, opening);
        }
    }

    /// Functions of another type than `number`.
    fn functions(&mut self, id: NodeId) {
        let parts: Vec<NodeId> = self.tree.children(id).skip(1).collect();
        let typed = parts.windows(2).filter(|pair| is_dash(self.tree.slice(pair[0])));
        let of = typed.map(|pair| pair[1]).find(|&of| self.lower(of) != "number");
        if let Some(of) = of {
            self.note(Feature::ObjectFluent, self.tree.span(of));
        }
    }

    /// A field of an action begins.
    pub(super) fn field(&mut self, keyword: &str, span: Span) {
        if matches!(keyword, ":agent" | ":vars") {
            self.note_as(Feature::Field, keyword, span);
        }
        let Some(rank) = FIELDS.iter().position(|one| *one == keyword) else { return };
        let late = self.fields.last().is_some_and(|last| *last > rank);
        if late && self.section().ends_with("action") {
            self.note(Feature::FieldOrder, span);
        }
        self.fields.insert(rank);
    }

    /// A section ends.
    pub(super) fn leave(&mut self, frame: &Frame) {
        if frame.head != ":action" {
            return;
        }
        let span = self.opening(frame.id);
        let missing = [
            (":parameters", Feature::MissingParameters),
            (":precondition", Feature::MissingPrecondition),
            (":effect", Feature::MissingEffect),
        ];
        for (field, feature) in missing {
            if !self.fields.iter().any(|&one| FIELDS[one] == field) {
                self.note(feature, span);
            }
        }
    }

    fn condition(&mut self, id: NodeId, head: &str, opening: Span) {
        let operand = |at: usize| self.tree.children(id).nth(at);
        let numeric = |at: usize| {
            operand(at).is_some_and(|one| {
                self.tree.is_list(one) || self.tree.slice(one).parse::<f64>().is_ok()
            })
        };
        match head {
            "or" | "imply" => self.note(Feature::Disjunction, opening),
            "exists" => self.note(Feature::Existential, opening),
            "forall" => self.note(Feature::Universal, opening),
            "preference" if self.tree.children(id).any(|part| self.tree.is_list(part)) => {
                self.note(Feature::Preference, opening);
            }
            ">" | ">=" | "<" | "<=" => self.note(Feature::NumericCondition, opening),
            "=" if numeric(1) || numeric(2) => self.note(Feature::NumericCondition, opening),
            "not" => {
                if let Some(inner) = operand(1).filter(|&inner| self.tree.is_list(inner)) {
                    self.negated.push((self.head(inner), opening));
                }
            }
            _ => {}
        }
    }

    fn effect(&mut self, id: NodeId, head: &str, opening: Span) {
        match head {
            "when" => {
                self.note(Feature::ConditionalEffect, opening);
                let inner = self.tree.children(id).nth(2).filter(|&inner| self.tree.is_list(inner));
                if inner.is_some_and(|inner| matches!(&*self.head(inner), "when" | "forall")) {
                    self.note(Feature::NestedCondition, opening);
                }
            }
            "forall" => self.note(Feature::UniversalEffect, opening),
            "oneof" | "probabilistic" => self.note(Feature::Nondeterminism, opening),
            "increase" => self.increase(id, opening),
            "assign" | "decrease" => self.note(Feature::NumericEffect, opening),
            "scale-up" | "scale-down" => {
                self.note(Feature::NumericEffect, opening);
                self.note(Feature::ScaleEffect, opening);
            }
            "and" | "not" | "at" | "over" => {}
            _ => {
                self.effects.insert(head.to_owned());
            }
        }
    }

    fn increase(&mut self, id: NodeId, opening: Span) {
        let parts: Vec<NodeId> = self.tree.children(id).skip(1).take(2).collect();
        let [function, amount] = parts.as_slice() else { return };
        let within = self
            .open
            .iter()
            .rev()
            .take(NEAR)
            .any(|frame| matches!(&*frame.head, "when" | "forall"));
        let list = self.tree.is_list(*amount);
        let sum = list && matches!(&*self.head(*amount), "+" | "-" | "*" | "/");
        let inner = (id.0..self.tree.node(id).next).map(NodeId).take(NEAR);
        if inner.into_iter().any(|node| self.tree.slice(node).eq_ignore_ascii_case("#t")) {
            self.note(Feature::ContinuousEffect, opening);
        } else if !self.tree.is_list(*function) || self.head(*function) != "total-cost" {
            self.note(Feature::NumericEffect, opening);
        } else if sum {
            self.note(Feature::CostExpression, opening);
        } else if within {
            self.note(Feature::ConditionalCost, opening);
        }
    }

    /// `(at 5 (p))` and `(at 5 (= (f) 3))` in the initial state.
    fn timed(&mut self, id: NodeId, opening: Span) {
        let parts: Vec<NodeId> = self.tree.children(id).skip(1).take(2).collect();
        let [time, fact] = parts.as_slice() else { return };
        if self.tree.is_list(*time)
            || self.tree.slice(*time).parse::<f64>().is_err()
            || !self.tree.is_list(*fact)
        {
            return;
        }
        self.note(Feature::TimedLiteral, opening);
        if self.head(*fact) == "=" {
            self.note(Feature::TimedFluent, opening);
        }
    }

    /// `at start` with something else than one blank between its words.
    fn specifier(&mut self, id: NodeId, head: &str) {
        let second = self.tree.children(id).nth(1).filter(|&second| !self.tree.is_list(second));
        let (Some(first), Some(second)) = (self.tree.children(id).next(), second) else { return };
        let pair = (head, &*self.lower(second));
        if !matches!(pair, ("at", "start" | "end") | ("over", "all")) {
            return;
        }
        let span = self.tree.span(first).to(self.tree.span(second));
        let blanks = &self.tree.input()
            [self.tree.node(first).end as usize..self.tree.node(second).start as usize];
        let timed = self.tree.children(id).nth(2).is_some_and(|third| self.tree.is_list(third));
        if timed && blanks != " " {
            self.note(Feature::WideSpecifier, span);
        }
    }
}
