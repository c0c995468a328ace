//! A cursor in a text goes in, however unfinished the text; what may be written there comes out, what fits best first.

use std::fmt::Write;

use super::context::{Context, Part};
use super::glossary::{self, Word};
use super::{Workspace, words};
use crate::model::{Domain, Object, TypeId, Variable};
use crate::reader::Kind;
use crate::source::{SourceId, Span};

/// What kind of thing a [`Completion`] writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each says its name")]
pub enum Item {
    Keyword,
    Predicate,
    Function,
    Type,
    Variable,
    Object,
    Action,
    Domain,
}

/// Something that may be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// What it is called.
    pub label: String,
    /// What it is.
    pub item: Item,
    /// Its declaration, its type or its meaning.
    pub detail: String,
    /// What is written.
    pub text: String,
    /// The same with places to fill in, as editors know them: `at ${1:?t}`.
    pub snippet: Option<String>,
    /// What fits better has less.
    pub rank: u8,
}

/// What may be written at a place.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Completions {
    /// The word that is replaced.
    pub word: Span,
    /// In the order in which to offer it.
    pub list: Vec<Completion>,
    /// Whether there is more, which comes when more has been typed.
    pub more: bool,
}

/// No more is offered at once.
const MANY: usize = 400;

/// What may be written at `offset`.
pub fn complete(workspace: &Workspace, id: SourceId, offset: u32) -> Completions {
    let Some(context) = Context::new(workspace, id, offset) else { return Completions::default() };
    let mut list = Vec::new();
    Completer { context: &context, domain: context.domain(), list: &mut list }.all();
    let typed = context.typed.to_ascii_lowercase();
    let mut more = false;
    if list.len() > MANY {
        list.retain(|one| one.label.to_ascii_lowercase().starts_with(&typed));
        more = list.len() > MANY;
    }
    list.sort_by(|a, b| (a.rank, &a.label).cmp(&(b.rank, &b.label)));
    list.truncate(MANY);
    Completions { word: context.word, list, more }
}

struct Completer<'c, 'w> {
    context: &'c Context<'w>,
    domain: &'w Domain,
    list: &'c mut Vec<Completion>,
}

impl Completer<'_, '_> {
    fn all(&mut self) {
        let context = self.context;
        let depth = context.levels.len();
        if context.workspace.is_plan(context.id) {
            return self.in_plan();
        }
        if depth == 0 {
            return self.skeletons();
        }
        let level = depth - 1;
        let starts = context.written(level) == 0;
        // A parenthesis is there already where a list begins.
        let part = if starts { context.parts()[level] } else { context.part() };
        if starts && (depth == 1 || depth == 2 && part == Part::Section) {
            return self.sections(false);
        }
        if starts && context.typed.starts_with(':') {
            self.sections(false);
        }
        match part {
            Part::Section if depth == 1 => self.sections(true),
            Part::Section | Part::Unknown if depth == 2 => self.in_section(),
            Part::Section | Part::Unknown => {}
            _ if depth == 2 && context.typed.starts_with(':') => self.fields(),
            Part::Argument(at) => self.arguments(level, at),
            Part::Type => self.types(0),
            Part::Head if starts && context.head(1) == ":derived" => self.predicates(false),
            Part::Typed | Part::Head => self.typed(),
            Part::Function => self.functions(!starts),
            Part::Number => self.numbers(!starts),
            Part::Side => {
                if !starts {
                    self.terms(&[]);
                }
                self.numbers(!starts);
            }
            Part::Task => self.tasks(!starts),
            _ => self.formulas(part, !starts),
        }
        if depth == 2 && !starts {
            self.fields();
        }
    }

    fn push(&mut self, label: &str, item: Item, rank: u8, detail: String) {
        let text = label.to_owned();
        let completion =
            Completion { label: text.clone(), item, detail, text, snippet: None, rank };
        self.list.push(completion);
    }

    /// A list with this word at its head; `outside` says that its parentheses are not there yet.
    fn push_list(
        &mut self,
        label: &str,
        item: Item,
        rank: u8,
        outside: bool,
        more: (&str, String),
    ) {
        let (snippet, detail) = more;
        let wrap = |text: &str| if outside { format!("({text})") } else { text.to_owned() };
        self.list.push(Completion {
            label: label.to_owned(),
            item,
            detail,
            text: wrap(label),
            snippet: Some(wrap(snippet)),
            rank,
        });
    }

    fn words(&mut self, words: &[Word], rank: u8, outside: bool) {
        for one in words {
            let more = (one.snippet, one.meaning.to_owned());
            // Words come before signs.
            let sign =
                one.text.starts_with(|letter: char| letter.is_ascii_punctuation() && letter != ':');
            self.push_list(one.text, Item::Keyword, rank + u8::from(sign), outside, more);
        }
    }

    /// A whole domain or problem, where there is nothing yet.
    fn skeletons(&mut self) {
        let domain = "(define (domain ${1:name})\n  (:requirements :strips :typing)\n  (:types $2)\n  (:predicates\n    ($3))\n  (:action ${4:name}\n    :parameters ($5)\n    :precondition (and $6)\n    :effect (and $0)))";
        let problem = "(define (problem ${1:name})\n  (:domain ${2:domain})\n  (:objects $3)\n  (:init\n    ($4))\n  (:goal (and $0)))";
        for (label, text) in [("domain", domain), ("problem", problem)] {
            let plain = format!("(define ({label} name))");
            self.list.push(Completion {
                label: label.to_owned(),
                item: Item::Keyword,
                detail: format!("a new {label}"),
                text: plain,
                snippet: Some(text.to_owned()),
                rank: 0,
            });
        }
    }

    fn sections(&mut self, outside: bool) {
        let context = self.context;
        if context.levels.len() == 1 && context.written(0) == 0 {
            return self.push("define", Item::Keyword, 0, "a domain or a problem".to_owned());
        }
        if context.levels[0].parts.len() == 1 {
            for what in ["domain", "problem"] {
                let snippet = format!("{what} ${{0:name}}");
                let more = (snippet.as_str(), "what this file defines".to_owned());
                self.push_list(what, Item::Keyword, 0, outside, more);
            }
            return;
        }
        let problem = context.workspace.is_problem(context.id);
        let words: &[Word] = if problem { &glossary::PROBLEM } else { &glossary::DOMAIN };
        self.words(words, 0, outside);
    }

    /// Directly in a section, where a formula or a typed list is not expected.
    fn in_section(&mut self) {
        let context = self.context;
        match context.head(1).as_str() {
            ":requirements" => {
                for (flag, meaning) in glossary::REQUIREMENTS {
                    let there =
                        context.levels[1].parts.iter().any(|one| one.eq_ignore_ascii_case(flag));
                    if !there {
                        self.push(flag, Item::Keyword, 0, meaning.to_owned());
                    }
                }
            }
            ":domain" => {
                let sources = context.workspace.sources();
                for id in sources.ids() {
                    if let Some(Kind::Domain { name }) = context.workspace.kind(id)
                        && self.list.iter().all(|one| one.label != *name)
                    {
                        self.push(name, Item::Domain, 0, sources.get(id).name.clone());
                    }
                }
            }
            ":metric" if context.written(1) == 1 => {
                for one in glossary::METRIC {
                    self.push(one.text, Item::Keyword, 0, one.meaning.to_owned());
                }
            }
            _ => {}
        }
    }

    /// The fields that a section may have and does not have yet.
    fn fields(&mut self) {
        let context = self.context;
        let section = context.head(1);
        let parts = &context.levels[1].parts;
        // After a field its value comes first.
        let rank = if context.before().starts_with(':') { 8 } else { 0 };
        for (sections, one) in &glossary::FIELDS {
            let there = parts.iter().any(|part| part.eq_ignore_ascii_case(one.text));
            if sections.contains(&section.as_str()) && !there && parts.len() > 1 {
                let more = (one.snippet, one.meaning.to_owned());
                self.push_list(one.text, Item::Keyword, rank, false, more);
            }
        }
    }

    /// In a typed list: types behind a dash, and before it nothing that is known already.
    fn typed(&mut self) {
        let head = self.context.head(1);
        if self.context.before() == "-" {
            if head == ":functions" {
                self.push("number", Item::Type, 0, "a number".to_owned());
            }
            let more = ("either $0", "one of several types".to_owned());
            self.push_list("either", Item::Keyword, 3, true, more);
            self.types(1);
        }
    }

    fn types(&mut self, rank: u8) {
        for of in &self.domain.types {
            let above = words::types(self.domain, &of.parents);
            let detail = if of.name.text == "object" { "everything".to_owned() } else { above };
            self.push(&of.name.text, Item::Type, rank, detail);
        }
    }

    /// Conditions, effects and entries of the initial state.
    fn formulas(&mut self, part: Part, outside: bool) {
        let timed = matches!(part, Part::TimedCondition | Part::TimedEffect);
        let words: &[Word] = match part {
            Part::Condition | Part::TimedCondition => &glossary::CONDITION,
            Part::Constraint => &glossary::CONSTRAINT,
            Part::Effect | Part::TimedEffect => &glossary::EFFECT,
            Part::Entry => &glossary::INIT,
            _ => return,
        };
        if timed {
            let times = if part == Part::TimedEffect {
                [glossary::TIMES[0], glossary::TIMES[2]].to_vec()
            } else {
                glossary::TIMES.to_vec()
            };
            self.words(&times, 0, outside);
        }
        if part == Part::Constraint {
            self.words(&glossary::CONDITION[..1], 0, outside);
            self.words(&glossary::CONDITION[4..5], 0, outside);
        }
        // An effect names predicates more often, a condition that begins is nearly always a conjunction.
        self.words(words, if outside { 1 } else { 2 }, outside);
        if !timed && part != Part::Constraint {
            self.predicates(outside);
        }
    }

    fn predicates(&mut self, outside: bool) {
        for one in &self.domain.predicates {
            self.applied(&one.name.text, &one.parameters, Item::Predicate, 1, outside);
        }
    }

    fn functions(&mut self, outside: bool) {
        for one in &self.domain.functions {
            self.applied(&one.name.text, &one.parameters, Item::Function, 1, outside);
        }
    }

    fn numbers(&mut self, outside: bool) {
        self.functions(outside);
        self.words(&glossary::NUMBER, 2, outside);
        match self.context.head(1).as_str() {
            ":durative-action" => {
                self.push("?duration", Item::Variable, 1, "how long the action takes".to_owned());
            }
            ":metric" => {
                self.push("total-time", Item::Keyword, 2, "how long the plan takes".to_owned());
            }
            _ => {}
        }
    }

    fn tasks(&mut self, outside: bool) {
        for one in &self.domain.signatures {
            self.applied(&one.name.text, &one.parameters, Item::Action, 1, outside);
        }
        let more = ("and $0", "all of them".to_owned());
        self.push_list("and", Item::Keyword, 2, outside, more);
    }

    fn in_plan(&mut self) {
        match self.context.levels.len() {
            0 => self.plan_steps(true),
            1 if self.context.written(0) == 0 => self.plan_steps(false),
            1 => self.arguments(0, self.context.written(0) - 1),
            _ => {}
        }
    }

    fn plan_steps(&mut self, outside: bool) {
        for one in &self.domain.actions {
            let parameters = &one.scope.variables[..one.scope.parameters as usize];
            self.applied(&one.name.text, parameters, Item::Action, 1, outside);
        }
    }

    /// A name with a place to fill in for each of its parameters.
    fn applied(
        &mut self,
        name: &str,
        parameters: &[Variable],
        item: Item,
        rank: u8,
        outside: bool,
    ) {
        let escaped = |text: &str| text.replace('$', "\\$");
        let mut snippet = escaped(name);
        for (at, parameter) in parameters.iter().enumerate() {
            write!(snippet, " ${{{}:{}}}", at + 1, escaped(&parameter.name.text))
                .expect("a string takes all");
        }
        let detail = words::head(self.domain, name, parameters);
        self.push_list(name, item, rank, outside, (&snippet, detail));
    }

    /// The arguments that fit, then those that do not.
    fn arguments(&mut self, level: usize, at: usize) {
        let part = self.context.parts()[level];
        let callee = self.context.callee(level, part);
        let wanted = match callee {
            Some((_, parameters)) => match parameters.get(at) {
                Some(parameter) => parameter.types.as_slice(),
                // There is nothing more to write.
                None => return,
            },
            None => &[],
        };
        self.terms(wanted);
    }

    fn terms(&mut self, wanted: &[TypeId]) {
        let context = self.context;
        let fits = |types: &[TypeId]| {
            let below =
                |sub: &TypeId| wanted.iter().any(|&above| self.domain.is_subtype(*sub, above));
            wanted.is_empty() || types.is_empty() || types.iter().any(below)
        };
        let initial = context.head(1) == ":init" || context.workspace.is_plan(context.id);
        let mut found = Vec::new();
        if !initial {
            for (name, types) in context.variables() {
                let rank = if fits(&types) { 0 } else { 6 };
                found.push((name, Item::Variable, rank, words::types(self.domain, &types)));
            }
        }
        let problem = context.workspace.problem(context.id);
        let objects: &[Object] = problem.map_or(&self.domain.constants, |problem| &problem.objects);
        for object in objects {
            let rank = if fits(&object.types) { 1 } else { 7 };
            let detail = words::types(self.domain, &object.types);
            found.push((object.name.text.clone(), Item::Object, rank, detail));
        }
        // Among very many only those that fit are of use.
        if found.len() > MANY {
            found.retain(|&(_, _, rank, _)| rank < 6);
        }
        for (name, item, rank, detail) in found {
            self.push(&name, item, rank, detail);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::complete;
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};

    /// The first things that are offered.
    #[track_caller]
    fn offered(texts: &[&str], count: usize) -> Vec<String> {
        let (workspace, id, offset) = workspace(texts);
        let found = complete(&workspace, id, offset).list;
        found.into_iter().take(count).map(|one| one.label).collect()
    }

    #[track_caller]
    fn first(texts: &[&str], wanted: &[&str]) {
        assert_eq!(offered(texts, wanted.len()), wanted);
    }

    #[test]
    fn arguments_by_type() {
        let text = DOMAIN.replace("(and (not (at ?d ?from)) (at ?d ?to))", "(and (at ?d $0");
        first(&[&text], &["?from", "?to", "sink", "?d"]);
        let text = PROBLEM.replace("(at mug shelf)", "(at mug s$0)");
        first(&[DOMAIN, &text], &["shelf", "sink", "mug"]);
        let text = PROBLEM.replace("(at mug shelf)", "(at $0 shelf)");
        first(&[DOMAIN, &text], &["mug", "shelf", "sink"]);
        let text = PROBLEM.replace("(effort mug)", "(effort $0");
        first(&[DOMAIN, &text], &["mug"]);
    }

    #[test]
    fn what_quantifiers_bind_comes_along() {
        let text = DOMAIN.replace("(at ?d sink)", "(forall (?e - cup ?p - place) (at $0");
        first(&[&text], &["?d", "?e", "?p", "sink"]);
        // What is bound further in hides what is bound further out.
        let text = DOMAIN.replace("(at ?d sink)", "(exists (?d - place) (at $0))");
        first(&[&text], &["?d", "sink"]);
    }

    #[test]
    fn parameters_may_come_later() {
        let text = "(define (domain d) (:types a b) (:predicates (p ?x - b))
  (:action act :effect (p $0) :parameters (?one - a ?two - b)))";
        first(&[text], &["?two", "?one"]);
    }

    #[test]
    fn formulas_without_and_with_parentheses() {
        let text = DOMAIN.replace("(and (clean ?d) (increase", "(and ($0) (increase");
        first(&[&text], &["at", "clean", "and", "assign"]);
        let text = DOMAIN.replace(":precondition (at ?d sink)", ":precondition $0");
        let (workspace, id, offset) = workspace(&[&text]);
        let found = complete(&workspace, id, offset).list;
        let at = found.iter().find(|one| one.label == "at").expect("it is declared");
        assert_eq!(at.text, "(at)");
        assert_eq!(at.snippet.as_deref(), Some("(at ${1:?d} ${2:?p})"));
        assert_eq!(at.detail, "(at ?d - dish ?p - place)");
    }

    #[test]
    fn functions_and_numbers() {
        let text = DOMAIN.replace("(increase (total-cost) (effort ?d))", "(increase ($0");
        first(&[&text], &["effort", "total-cost"]);
        let text = DOMAIN.replace("(at ?d sink)", "(>= ($0");
        first(&[&text], &["effort", "total-cost", "*", "+"]);
    }

    #[test]
    fn sections_fields_and_flags() {
        let text = DOMAIN.replace("  ; Water does it.\n", "  (:fun$0\n");
        assert!(offered(&[&text], 99).contains(&":functions".to_owned()));
        let text = PROBLEM.replace("(:goal (clean mug))", "($0");
        assert_eq!(offered(&[DOMAIN, &text], 99).len(), 8);
        let text =
            DOMAIN.replace(":effect (and (clean ?d) (increase (total-cost) (effort ?d)))", "$0");
        first(&[&text], &[":agent", ":effect", ":observe"]);
        let text = DOMAIN.replace(":typing :action-costs", ":typing :$0");
        let all = offered(&[&text], 99);
        assert!(all.contains(&":adl".to_owned()) && !all.contains(&":typing".to_owned()));
        first(&["($0"], &["define"]);
        first(&["(define ($0"], &["domain", "problem"]);
        first(&["$0"], &["domain", "problem"]);
    }

    #[test]
    fn types_behind_a_dash_alone() {
        let text = DOMAIN.replace("(?d - dish ?from", "(?d - $0 ?from");
        first(&[&text], &["cup", "dish", "object", "place", "plate", "either"]);
        let text = DOMAIN.replace("(?d - dish ?from", "(?d $0");
        first(&[&text], &[]);
        let text = PROBLEM.replace("mug - cup", "mug - c$0");
        first(&[DOMAIN, &text], &["cup"]);
    }

    #[test]
    fn domains_by_name() {
        let text = PROBLEM.replace("(:domain kitchen)", "(:domain $0)");
        first(&[DOMAIN, &text], &["kitchen"]);
    }

    #[test]
    fn steps_of_plans() {
        first(&[DOMAIN, PROBLEM, "($0"], &["move", "wash"]);
        first(&[DOMAIN, PROBLEM, "(wash mug)\n(move mug $0"], &["shelf", "sink"]);
    }

    #[test]
    fn nothing_in_comments() {
        first(&[&DOMAIN.replace("Water", "(at $0")], &[]);
    }

    #[test]
    fn durative_actions_and_task_networks() {
        let text = "(define (domain d) (:types t) (:predicates (p ?x - t))
  (:durative-action act :parameters (?x - t) :duration (= ?duration 1) :condition ($0))
  (:task do :parameters (?x - t)))";
        first(&[text], &["at end", "at start", "over all", "and"]);
        let inside = text.replace("($0)", "(at start ($0))");
        assert_eq!(offered(&[&inside], 3), ["p", "and", "exists"]);
        let text = text.replace("$0", "at start (p ?x)");
        let text = text
            .replace("(:task do", "(:method m :parameters (?y - t) :ordered-subtasks (and (act $0");
        assert_eq!(offered(&[&text], 3), ["?y"]);
    }
}
