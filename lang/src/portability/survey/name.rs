//! A word goes in; what some tools do not read in it comes out: how it is written, and what it may clash with.

use super::{Feature, Part, Survey};
use crate::lexer::is_dash;
use crate::source::Span;
use crate::tree::{NodeId, NodeKind};

/// The words that some tools want in lower case, beside all that begin with `:`.
const WORDS: [&str; 12] = [
    "define", "domain", "problem", "and", "or", "not", "when", "forall", "exists", "imply",
    "either", "minimize",
];

impl Survey<'_, '_> {
    pub(super) fn atom(&mut self, id: NodeId) {
        let (text, span) = (self.tree.slice(id), self.tree.span(id));
        let (part, seen, depth) = match self.open.last() {
            Some(frame) => (frame.part, frame.seen, self.open.len()),
            None => return,
        };
        let lower = text.to_ascii_lowercase();
        let keyword = lower.starts_with(':') || (seen == 0 && WORDS.contains(&lower.as_str()));
        if keyword && *text != lower {
            self.note(Feature::UpperCaseKeyword, span);
        }
        self.glued(id, text, span);
        if depth == 2 && part == Part::Section && lower.starts_with(':') && seen > 0 {
            self.field(&lower, span);
        }
        if !lower.starts_with(':') && !is_dash(text) {
            if let Some(name) = lower.strip_prefix('?') {
                // `?duration` is a keyword itself where the duration of an action stands.
                if part == Part::Parameters || self.section() == ":predicates" {
                    self.note_as(Feature::Variable, name, span);
                }
                self.spelling(name, span);
            } else if let Some(kind) = self.declared(part, seen, depth) {
                self.declare(kind, &lower, span);
            } else {
                self.number(text, span);
            }
        }
        if let Some(frame) = self.open.last_mut() {
            frame.seen += 1;
            frame.word = Some(id);
        }
    }

    /// What the word declares that is read next in the list at hand, if it does.
    fn declared(&self, part: Part, seen: usize, depth: usize) -> Option<&'static str> {
        let list = self.open.last()?;
        let after_dash = list.word.is_some_and(|word| is_dash(self.tree.slice(word)));
        match (depth, part, self.section()) {
            (2, Part::Definition, _) if seen == 1 => Some("title"),
            (2, Part::Section, ":types") if seen > 0 && !after_dash => Some("type"),
            (2, Part::Section, ":objects" | ":constants") if seen > 0 && !after_dash => {
                Some("object")
            }
            (2, Part::Section, ":action" | ":durative-action" | ":process" | ":event")
                if seen == 1 =>
            {
                Some("action")
            }
            (3, Part::Other, ":predicates") if seen == 0 => Some("predicate"),
            (3, Part::Other, ":functions") if seen == 0 => Some("function"),
            _ => None,
        }
    }

    fn declare(&mut self, kind: &'static str, name: &str, span: Span) {
        if self.section() == ":types" {
            if name == "number" {
                self.note(Feature::TypeNumber, span);
            }
            if !self.types.insert(name.to_owned()) {
                self.note_as(Feature::SeveralSupertypes, name, span);
            }
        }
        self.spelling(name, span);
        if kind == "title" {
            return;
        }
        self.note_as(Feature::Name, name, span);
        if kind == "predicate" {
            self.note_as(Feature::PredicateName, name, span);
        }
        let first = self.names.entry(name.to_owned()).or_insert(kind);
        if *first != kind {
            let detail = format!("{first} and {kind}");
            self.note_as(Feature::SharedName, &detail, span);
        }
    }

    /// Notes what is unusual about the letters of a name.
    fn spelling(&mut self, name: &str, span: Span) {
        let first = name.as_bytes().first().copied().unwrap_or(b'a');
        let usual = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
        if first.is_ascii_digit() {
            self.note(Feature::DigitName, span);
        } else if first == b'_' {
            self.note(Feature::UnderscoreName, span);
        } else if !name.bytes().all(usual) {
            self.note(Feature::OddName, span);
        }
    }

    /// Notes a variable right behind a word, and a dash right before one.
    fn glued(&mut self, id: NodeId, text: &str, span: Span) {
        let before = id.0.checked_sub(1).map(NodeId);
        let touches = before.filter(|&before| self.tree.span(before).end == span.start);
        let word = touches.filter(|&before| self.tree.node(before).kind == NodeKind::Atom);
        if text.starts_with('?')
            && let Some(word) = word
        {
            self.note(Feature::GluedVariable, self.tree.span(word).to(span));
        }
        let mut letters = text.chars();
        let dash = letters.next() == Some('-') && letters.next().is_some_and(char::is_alphabetic);
        if dash && self.open.last().is_some_and(|frame| frame.seen > 0) {
            self.note(Feature::GluedDash, span);
        }
    }

    /// Notes how a number is written.
    fn number(&mut self, text: &str, span: Span) {
        let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
        let digit = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (unsigned, None),
        };
        if let Some((above, below)) = unsigned.split_once('/') {
            if digit(above) && digit(below) {
                self.note(Feature::FractionNumber, span);
            }
            return;
        }
        let (whole, part) = match mantissa.split_once('.') {
            Some((whole, part)) => (whole, Some(part)),
            None => (mantissa, None),
        };
        let sound = (digit(whole) || (whole.is_empty() && part.is_some_and(digit)))
            && part.is_none_or(|part| part.is_empty() || digit(part))
            && exponent.is_none_or(|exponent| digit(exponent.trim_start_matches(['-', '+'])));
        if !sound {
            return;
        }
        if exponent.is_some() {
            self.note(Feature::ExponentNumber, span);
        }
        match part {
            Some(_) if whole.is_empty() => self.note(Feature::OpenDecimal, span),
            Some("") => self.note(Feature::ClosedDecimal, span),
            _ => {}
        }
        if part.is_some() {
            self.note(Feature::DecimalNumber, span);
        }
        match text.as_bytes()[0] {
            b'-' => self.note(Feature::NegativeNumber, span),
            b'+' => self.note(Feature::PlusNumber, span),
            _ => {}
        }
    }
}
