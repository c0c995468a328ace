//! A text and a cursor go in, however unfinished the text; the lists that are open there come out, and what is expected in them.

use super::{Workspace, assist, glossary};
use crate::diagnostic::Diagnostics;
use crate::lexer::{self, Token, TokenKind};
use crate::model::{Domain, TypeId, Variable};
use crate::source::{SourceId, Span};
use crate::tree::{self, NodeId, Tree};

/// Where the cursor stands.
pub(super) struct Context<'w> {
    pub(super) workspace: &'w Workspace,
    pub(super) id: SourceId,
    /// The lists that are open at the cursor, the outermost first.
    pub(super) levels: Vec<Level<'w>>,
    /// The word at the cursor, to be replaced.
    pub(super) word: Span,
    /// The part of it before the cursor.
    pub(super) typed: &'w str,
}

/// A list that is open.
pub(super) struct Level<'w> {
    /// Its parenthesis.
    pub(super) start: u32,
    /// What is finished of it: words and lists.
    pub(super) parts: Vec<&'w str>,
}

/// What a list, or what stands in one, is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Nothing is known of it.
    Unknown,
    /// A section of the definition, or its title.
    Section,
    /// A condition or a goal.
    Condition,
    /// A condition with the times of a durative action.
    TimedCondition,
    /// A constraint on the whole plan.
    Constraint,
    /// An effect.
    Effect,
    /// An effect with the times of a durative action.
    TimedEffect,
    /// An entry of the initial state.
    Entry,
    /// A number.
    Number,
    /// A function and its arguments.
    Function,
    /// One side of `=`: a term or a number.
    Side,
    /// An argument: the first, the second and so on.
    Argument(usize),
    /// A name or a type of a typed list.
    Typed,
    /// A type.
    Type,
    /// A predicate as it is declared, or a head of a rule.
    Head,
    /// A task or an action in a task network.
    Task,
}

impl<'w> Context<'w> {
    /// Nothing in a comment.
    pub(super) fn new(workspace: &'w Workspace, id: SourceId, offset: u32) -> Option<Self> {
        let text = workspace.text(id);
        let at = offset as usize;
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        if text[line..at].contains(';') {
            return None;
        }
        // The word goes on behind the cursor, to the end of the line at most.
        let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
        let tokens = lexer::lex(&text[..end]);
        let word = tokens.iter().rev().find(|token| {
            token.kind == TokenKind::Atom && token.start < offset && offset <= token.end
        });
        let (start, end) = word.map_or((offset, offset), |word| (word.start, word.end));
        let finished = tokens.iter().take_while(|token| token.end <= start);
        let levels = open(text, finished.copied());
        let typed = &text[start as usize..at];
        Some(Self { workspace, id, levels, word: Span::new(id, start, end), typed })
    }

    pub(super) fn domain(&self) -> &'w Domain {
        self.workspace.domain(self.id)
    }

    /// The first word of an open list in lower case; empty if the cursor stands where it would be.
    pub(super) fn head(&self, level: usize) -> String {
        let first = self.levels.get(level).and_then(|level| level.parts.first());
        first.filter(|first| !first.starts_with('(')).unwrap_or(&"").to_ascii_lowercase()
    }

    /// How many parts of an open list are finished.
    pub(super) fn written(&self, level: usize) -> usize {
        self.levels[level].parts.len()
    }

    /// The last part of the innermost list before the cursor.
    pub(super) fn before(&self) -> &'w str {
        self.levels.last().and_then(|level| level.parts.last()).copied().unwrap_or("")
    }

    /// The last field of a section before the cursor.
    pub(super) fn field(&self) -> String {
        let words = self.levels.get(1).map_or(&[][..], |level| &level.parts);
        let field = words.iter().skip(1).rfind(|word| word.starts_with(':'));
        field.map_or(String::new(), |field| field.to_ascii_lowercase())
    }

    /// What is expected at the cursor, directly in the innermost list.
    pub(super) fn part(&self) -> Part {
        if self.levels.is_empty() {
            return Part::Unknown;
        }
        let mut part = Part::Unknown;
        for level in 0..self.levels.len() {
            part = self.inside(level, part);
        }
        part
    }

    /// What each open list is, the outermost first.
    pub(super) fn parts(&self) -> Vec<Part> {
        let mut parts = vec![Part::Unknown];
        for level in 0..self.levels.len().saturating_sub(1) {
            parts.push(self.inside(level, parts[level]));
        }
        parts
    }

    /// What stands in an open list behind what is finished, if the list itself is `part`.
    fn inside(&self, level: usize, part: Part) -> Part {
        if self.workspace.is_plan(self.id) {
            return self.written(level).checked_sub(1).map_or(Part::Task, Part::Argument);
        }
        let written = self.written(level);
        match level {
            0 => Part::Section,
            1 => self.in_section(written),
            _ if written == 0 => part,
            _ => self.in_list(&self.head(level), written, part),
        }
    }

    fn in_section(&self, written: usize) -> Part {
        let timed = self.head(1) == ":durative-action";
        match self.head(1).as_str() {
            "" => Part::Section,
            ":types" | ":constants" | ":objects" => Part::Typed,
            ":predicates" | ":functions" => Part::Head,
            ":init" => Part::Entry,
            ":constraints" => Part::Constraint,
            ":metric" if written >= 2 => Part::Number,
            ":derived" if written == 1 => Part::Head,
            ":goal" | ":derived" => Part::Condition,
            _ => match self.field().as_str() {
                ":parameters" | ":vars" | ":agent" => Part::Typed,
                ":condition" if timed => Part::TimedCondition,
                ":precondition" | ":condition" | ":constraints" | ":duration" => Part::Condition,
                ":effect" if timed => Part::TimedEffect,
                ":effect" | ":observe" => Part::Effect,
                ":task" | ":tasks" | ":subtasks" | ":ordered-tasks" | ":ordered-subtasks" => {
                    Part::Task
                }
                _ => Part::Unknown,
            },
        }
    }

    fn in_list(&self, head: &str, written: usize, part: Part) -> Part {
        use Part::{Argument, Condition, Constraint, Effect, Entry, Function, Number, Side, Task};
        let first = written == 1;
        match (part, head) {
            (Part::Typed | Part::Type, _) => {
                if head == "either" {
                    Part::Type
                } else {
                    Part::Typed
                }
            }
            (Part::Head, _) => Part::Typed,
            (Effect | Part::TimedEffect, "when") if first => match part {
                Effect => Condition,
                _ => Part::TimedCondition,
            },
            (
                Effect | Part::TimedEffect,
                "increase" | "decrease" | "assign" | "scale-up" | "scale-down",
            ) => {
                if first {
                    Function
                } else {
                    Number
                }
            }
            (
                Condition | Part::TimedCondition | Constraint | Effect | Part::TimedEffect,
                "forall" | "exists",
            ) if first => Part::Typed,
            (Part::TimedEffect, "at") => Effect,
            (Condition, "=") => Side,
            (Condition, ">" | "<" | ">=" | "<=") | (Number, "+" | "-" | "*" | "/") => Number,
            (Entry, "=") => {
                if first {
                    Function
                } else {
                    Part::Unknown
                }
            }
            (Part::TimedCondition, "at" | "over")
            | (
                Constraint,
                "always" | "sometime" | "at-most-once" | "at" | "within" | "sometime-after"
                | "sometime-before" | "always-within" | "hold-after" | "hold-during",
            ) => Condition,
            (Entry, "at") if !self.is_predicate("at") || self.is_number() => Entry,
            (Task, "and") => Task,
            (
                Condition | Part::TimedCondition | Constraint | Effect | Part::TimedEffect | Entry,
                "and" | "or" | "not" | "imply" | "forall" | "exists" | "when" | "preference"
                | "oneof",
            ) => part,
            (Part::Unknown | Part::Section, _) => Part::Unknown,
            _ => Argument(written - 1),
        }
    }

    fn is_predicate(&self, name: &str) -> bool {
        self.domain().predicates.iter().any(|one| one.name.text.eq_ignore_ascii_case(name))
    }

    /// Whether the first argument of the innermost list is a number.
    fn is_number(&self) -> bool {
        let second = self.levels.last().and_then(|level| level.parts.get(1));
        second.is_some_and(|second| second.starts_with(|one: char| one.is_ascii_digit()))
    }

    /// The parameters of what stands at the head of an open list that is `part`.
    pub(super) fn callee(&self, level: usize, part: Part) -> Option<(&'w str, &'w [Variable])> {
        let domain = self.domain();
        let head = self.head(level);
        let same = |name: &str| name.eq_ignore_ascii_case(&head);
        let predicate = || {
            let found = domain.predicates.iter().find(|one| same(&one.name.text))?;
            Some((found.name.text.as_str(), found.parameters.as_slice()))
        };
        let function = || {
            let found = domain.functions.iter().find(|one| same(&one.name.text))?;
            Some((found.name.text.as_str(), found.parameters.as_slice()))
        };
        let signature = || {
            let found = domain.signatures.iter().find(|one| same(&one.name.text))?;
            Some((found.name.text.as_str(), found.parameters.as_slice()))
        };
        match part {
            Part::Task => signature(),
            Part::Number | Part::Function => function(),
            Part::Side => function().or_else(predicate),
            Part::Condition
            | Part::TimedCondition
            | Part::Effect
            | Part::TimedEffect
            | Part::Entry
            | Part::Constraint => predicate().or_else(function).or_else(signature),
            _ if self.workspace.is_plan(self.id) => signature(),
            _ => None,
        }
    }

    /// The variables that can be seen at the cursor, the innermost first, with their types.
    pub(super) fn variables(&self) -> Vec<(String, Vec<TypeId>)> {
        let mut found: Vec<(String, Vec<TypeId>)> = Vec::new();
        for level in (1..self.levels.len()).rev() {
            let binds = matches!(self.head(level).as_str(), "forall" | "exists" | ":derived");
            let binder =
                self.levels[level].parts.get(1).filter(|part| binds && part.starts_with('('));
            if let Some(binder) = binder {
                let tree = tree::parse(self.id, binder, &mut Diagnostics::default());
                self.typed_list(&tree, NodeId(0), &mut found);
            }
        }
        // The parameters of the section, which may stand behind the cursor.
        let Some(start) = self.levels.get(1).map(|section| section.start) else { return found };
        let whole = self.workspace.tree(self.id);
        let at = whole.nodes().partition_point(|node| node.start < start);
        let at = NodeId(at as u32);
        if whole.nodes().get(at.0 as usize).is_some_and(|node| node.start == start) {
            for field in [":parameters", ":vars"] {
                if let Some(list) = assist::field(&whole, at, field) {
                    self.typed_list(&whole, list, &mut found);
                }
            }
            let mut parts = whole.children(at);
            if parts.any(|part| whole.slice(part).eq_ignore_ascii_case(":agent"))
                && let Some(agent) = parts.next()
            {
                let of: Vec<TypeId> =
                    parts.nth(1).and_then(|of| self.type_of(whole.slice(of))).into_iter().collect();
                found.push((whole.slice(agent).to_owned(), of));
            }
        }
        found.retain(|(name, _)| name.len() > 1 && name.starts_with('?'));
        found
    }

    fn typed_list(&self, tree: &Tree<'_>, list: NodeId, found: &mut Vec<(String, Vec<TypeId>)>) {
        let first = found.len();
        let mut parts = tree.children(list);
        let mut open = first;
        while let Some(part) = parts.next() {
            if tree.slice(part) != "-" {
                let name = tree.slice(part);
                // What is bound further in hides this one.
                if found[..first].iter().all(|(hidden, _)| !hidden.eq_ignore_ascii_case(name)) {
                    found.push((name.to_owned(), Vec::new()));
                }
                continue;
            }
            let Some(of) = parts.next() else { break };
            let types: Vec<TypeId> = if tree.is_list(of) {
                tree.children(of).skip(1).filter_map(|one| self.type_of(tree.slice(one))).collect()
            } else {
                self.type_of(tree.slice(of)).into_iter().collect()
            };
            for (_, known) in &mut found[open..] {
                known.clone_from(&types);
            }
            open = found.len();
        }
    }

    fn type_of(&self, name: &str) -> Option<TypeId> {
        let types = &self.domain().types;
        let at = types.iter().position(|of| of.name.text.eq_ignore_ascii_case(name))?;
        Some(TypeId(at as u32))
    }
}

/// The lists that are open behind `tokens`. Where a section starts, all lists but the definition are at their end, closed or not.
fn open<'t>(text: &'t str, tokens: impl Iterator<Item = Token>) -> Vec<Level<'t>> {
    let trivia = |token: &Token| matches!(token.kind, TokenKind::Space | TokenKind::Comment);
    let mut tokens = tokens.filter(|token| !trivia(token)).peekable();
    let mut levels: Vec<Level<'t>> = Vec::new();
    let close = |levels: &mut Vec<Level<'t>>, end: u32| {
        let Some(level) = levels.pop() else { return };
        if let Some(outer) = levels.last_mut() {
            outer.parts.push(&text[level.start as usize..end as usize]);
        }
    };
    while let Some(token) = tokens.next() {
        match token.kind {
            TokenKind::Open => {
                let word = tokens.peek().map(|word| &text[word.start as usize..word.end as usize]);
                if word.is_some_and(is_section) {
                    while levels.len() > 1 {
                        close(&mut levels, token.start);
                    }
                }
                levels.push(Level { start: token.start, parts: Vec::new() });
            }
            TokenKind::Close => close(&mut levels, token.end),
            _ => {
                if let Some(level) = levels.last_mut() {
                    level.parts.push(&text[token.start as usize..token.end as usize]);
                }
            }
        }
    }
    levels
}

fn is_section(word: &str) -> bool {
    let words = glossary::DOMAIN.iter().chain(&glossary::PROBLEM);
    word.starts_with(':') && words.into_iter().any(|one| one.text.eq_ignore_ascii_case(word))
}
