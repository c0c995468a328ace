//! The text of a plan file goes in; the plan comes out, with every line that is not a step as a diagnostic.
//!
//! A step is `(name object …)`, with `0.000:` before it and `[1.0]` after it if need be.
//! Steps may share a line, names are compared without case, and `;` begins a comment.

use rustc_hash::FxHashMap;

use super::{JointPlan, Plan, Step};
use crate::diagnostic::plan_step_order::plan_step_order;
use crate::diagnostic::plan_syntax::plan_syntax;
use crate::diagnostic::plan_type_mismatch::plan_type_mismatch;
use crate::diagnostic::plan_unknown_action::plan_unknown_action;
use crate::diagnostic::plan_unknown_object::plan_unknown_object;
use crate::diagnostic::plan_wrong_arity::plan_wrong_arity;
use crate::diagnostic::{Applicability, Diagnostics, Fix};
use crate::model::{ActionId, Domain, Name, ObjectId, Problem, TypeId, Variable};
use crate::near::nearest;
use crate::source::{SourceId, Sources, Span};

/// A plan as it was read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// The steps that could be understood.
    pub plan: Plan,
    /// Where each of these steps stands.
    pub spans: Vec<Span>,
    /// For each step the number of the moment that it belongs to, counted from 0: steps with the same time, or without times those of one line.
    pub moments: Vec<usize>,
}

impl Listing {
    /// The steps of each moment as one joint step, and their spans.
    pub fn joint(&self) -> (JointPlan, Vec<Vec<Span>>) {
        let count = self.moments.last().map_or(0, |last| last + 1);
        let (mut plan, mut spans) = (JointPlan::default(), vec![Vec::new(); count]);
        plan.steps.resize(count, Vec::new());
        for ((step, &span), &moment) in self.plan.steps.iter().zip(&self.spans).zip(&self.moments) {
            plan.steps[moment].push(step.clone());
            spans[moment].push(span);
        }
        (plan, spans)
    }
}

/// What tells one moment from the next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Moment {
    Time(f64),
    Line(u32),
}

/// Reads the plan file `id`. When a diagnostic is an error, a step is missing from the listing.
pub fn read(
    sources: &Sources,
    id: SourceId,
    domain: &Domain,
    problem: &Problem,
) -> (Listing, Diagnostics) {
    let text = &sources.get(id).text;
    let mut reader = Reader {
        text,
        source: id,
        tokens: tokens(text),
        at: 0,
        resolver: Resolver::new(domain, problem),
        last_time: None,
        last_moment: None,
        listing: Listing::default(),
        diagnostics: Diagnostics::default(),
    };
    reader.run();
    (reader.listing, reader.diagnostics)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Open,
    Close,
    /// `[…]`, up to the end of the line where it is not closed.
    Duration,
    /// A name, a number, or `:`, which is a token of its own.
    Word,
}

#[derive(Debug, Clone, Copy)]
struct Token {
    kind: Kind,
    start: usize,
    end: usize,
    line: u32,
}

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut line = 0;
    let mut characters = text.char_indices().peekable();
    while let Some((start, character)) = characters.next() {
        let mut end = start + character.len_utf8();
        let mut take_while = |wanted: &dyn Fn(char) -> bool| {
            while let Some((at, next)) = characters.next_if(|&(_, next)| wanted(next)) {
                end = at + next.len_utf8();
            }
            end
        };
        let kind = match character {
            '\n' => {
                line += 1;
                continue;
            }
            ';' => {
                take_while(&|next| next != '\n');
                continue;
            }
            // A byte order mark is no part of the text.
            '\u{feff}' => continue,
            _ if character.is_whitespace() => continue,
            '(' => Kind::Open,
            ')' => Kind::Close,
            ':' => Kind::Word,
            '[' => {
                end = take_while(&|next| next != ']' && next != '\n');
                if let Some((at, _)) = characters.next_if(|&(_, next)| next == ']') {
                    end = at + 1;
                }
                Kind::Duration
            }
            _ => {
                end = take_while(&|next| !next.is_whitespace() && !"()[:;".contains(next));
                Kind::Word
            }
        };
        tokens.push(Token { kind, start, end, line });
    }
    tokens
}

struct Reader<'a> {
    text: &'a str,
    source: SourceId,
    tokens: Vec<Token>,
    at: usize,
    resolver: Resolver<'a>,
    last_time: Option<(f64, Span)>,
    last_moment: Option<Moment>,
    listing: Listing,
    diagnostics: Diagnostics,
}

impl<'a> Reader<'a> {
    fn run(&mut self) {
        while let Some(token) = self.peek() {
            match token.kind {
                Kind::Open => self.step(),
                Kind::Word if self.is_time() => self.time(),
                Kind::Word => self.bare(),
                Kind::Close => {
                    self.at += 1;
                    self.report(
                        "unexpected `)`",
                        self.span(token),
                        "no step is open here",
                        Some(("remove it", String::new())),
                    );
                }
                Kind::Duration => {
                    self.at += 1;
                    self.report(
                        "a duration without a step",
                        self.span(token),
                        "it follows no step",
                        None,
                    );
                }
            }
        }
    }

    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    fn span(&self, token: Token) -> Span {
        Span::new(self.source, token.start as u32, token.end as u32)
    }

    fn word(&self, token: Token) -> &'a str {
        &self.text[token.start..token.end]
    }

    /// Whether a number and a colon come next.
    fn is_time(&self) -> bool {
        let number =
            self.tokens.get(self.at).and_then(|&token| self.word(token).parse::<f64>().ok());
        let colon = self.tokens.get(self.at + 1).is_some_and(|&token| self.word(token) == ":");
        number.is_some_and(f64::is_finite) && colon
    }

    fn time(&mut self) {
        let token = self.tokens[self.at];
        let span = self.span(token);
        let time = self.word(token).parse::<f64>().expect("it was parsed to see that it is a time");
        self.at += 2;
        if self.peek().is_none_or(|next| next.kind != Kind::Open) {
            self.report("a time without a step", span, "no `(` follows", None);
        }
        if let Some((last, before)) = self.last_time.filter(|&(last, _)| time < last) {
            self.diagnostics.push(plan_step_order(time, span, last, before));
        }
        self.last_time = Some((time, span));
    }

    /// A step without its opening parenthesis: the rest of the line.
    fn bare(&mut self) {
        let first = self.tokens[self.at];
        let mut words = Vec::new();
        while let Some(token) =
            self.peek().filter(|token| token.kind == Kind::Word && token.line == first.line)
        {
            words.push(token);
            self.at += 1;
        }
        let closed =
            self.peek().filter(|token| token.kind == Kind::Close && token.line == first.line);
        self.at += usize::from(closed.is_some());
        self.skip_duration();
        let last = closed.unwrap_or(*words.last().expect("it begins with a word"));
        let span = self.span(first).to(self.span(last));
        let text = self.text[first.start..last.end].trim_end_matches(')');
        self.report(
            "a step stands in parentheses",
            span,
            "no `(` before it",
            Some(("add the parentheses", format!("({text})"))),
        );
    }

    fn step(&mut self) {
        let open = self.tokens[self.at];
        self.at += 1;
        let mut words = Vec::new();
        while let Some(token) = self.peek().filter(|token| token.kind == Kind::Word) {
            words.push(token);
            self.at += 1;
        }
        let last = words.last().copied().unwrap_or(open);
        let closed = self.peek().filter(|token| token.kind == Kind::Close);
        if closed.is_some() {
            self.at += 1;
        } else {
            let span = self.span(open);
            let after = Span::new(self.source, last.end as u32, last.end as u32);
            self.report("a step that is not closed", span, "this `(` has no `)`", None);
            let applicability = Applicability::Safe;
            let fix = Fix {
                applicability,
                title: "add the `)`".to_owned(),
                edits: vec![(after, ")".to_owned())],
            };
            self.diagnostics.list.last_mut().expect("it was pushed above").fixes.push(fix);
        }
        self.skip_duration();
        let span = self.span(open).to(self.span(closed.unwrap_or(last)));
        let Some((&name, arguments)) = words.split_first() else {
            self.report("a step without a name", span, "an action's name belongs here", None);
            return;
        };
        let named = |token: Token| (self.word(token), self.span(token));
        let arguments: Vec<_> = arguments.iter().map(|&token| named(token)).collect();
        if let Some(step) = self.resolver.step(named(name), &arguments, span, &mut self.diagnostics)
        {
            self.listing.plan.steps.push(step);
            self.listing.spans.push(span);
            let time = self.last_time.map(|(time, _)| Moment::Time(time));
            let moment = time.unwrap_or(Moment::Line(open.line));
            let last = self.listing.moments.last().copied();
            let same = self.last_moment == Some(moment);
            self.listing.moments.push(last.map_or(0, |last| last + usize::from(!same)));
            self.last_moment = Some(moment);
        }
    }

    fn skip_duration(&mut self) {
        self.at += usize::from(self.peek().is_some_and(|token| token.kind == Kind::Duration));
    }

    fn report(&mut self, message: &str, span: Span, label: &str, fix: Option<(&str, String)>) {
        self.diagnostics.push(plan_syntax(message, span, label, fix));
    }
}

/// A word of the plan and where it stands.
type Word<'a> = (&'a str, Span);

/// Finds the actions and objects that words name.
struct Resolver<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    actions: FxHashMap<String, ActionId>,
    objects: FxHashMap<String, ObjectId>,
}

impl<'a> Resolver<'a> {
    fn new(domain: &'a Domain, problem: &'a Problem) -> Self {
        let action = |(at, name): (usize, &Name)| (name.text.to_lowercase(), ActionId(at as u32));
        let object = |(at, name): (usize, &Name)| (name.text.to_lowercase(), ObjectId(at as u32));
        Self {
            domain,
            problem,
            actions: domain.actions.iter().map(|it| &it.name).enumerate().map(action).collect(),
            objects: problem.objects.iter().map(|it| &it.name).enumerate().map(object).collect(),
        }
    }

    fn step(
        &self,
        (name, at): Word<'_>,
        words: &[Word<'_>],
        span: Span,
        out: &mut Diagnostics,
    ) -> Option<Step> {
        let Some(&action) = self.actions.get(&name.to_lowercase()) else {
            let names = self.domain.actions.iter().map(|action| action.name.text.as_str());
            out.push(plan_unknown_action(name, at, nearest(name, names)));
            return None;
        };
        let mut arguments = Some(Vec::with_capacity(words.len()));
        for &(name, at) in words {
            let object = self.objects.get(&name.to_lowercase()).copied();
            if object.is_none() {
                let names = self.problem.objects.iter().map(|object| object.name.text.as_str());
                out.push(plan_unknown_object(name, at, nearest(name, names)));
            }
            arguments = arguments.zip(object).map(|(mut arguments, object)| {
                arguments.push(object);
                arguments
            });
        }
        let step = Step { action, arguments: arguments?.into() };
        self.check(&step, words, span, out).then_some(step)
    }

    /// Whether the arguments are as many as the parameters and of their types.
    fn check(&self, step: &Step, words: &[Word<'_>], span: Span, out: &mut Diagnostics) -> bool {
        let action = &self.domain.actions[step.action.index()];
        let parameters = &action.scope.variables[..action.scope.parameters as usize];
        if parameters.len() != words.len() {
            let each: Vec<_> =
                parameters.iter().map(|parameter| self.parameter(parameter)).collect();
            let counts = (parameters.len(), words.len());
            let name = &action.name;
            out.push(plan_wrong_arity(&name.text, counts, &each.join(" "), span, name.span));
            return false;
        }
        let mut fits = true;
        for ((&object, parameter), &(_, at)) in step.arguments.iter().zip(parameters).zip(words) {
            let object = &self.problem.objects[object.index()];
            if self.domain.has_type(object, &parameter.types) {
                continue;
            }
            fits = false;
            out.push(plan_type_mismatch(
                (&object.name.text, &self.types(&object.types)),
                (&action.name.text, &parameter.name.text, &self.types(&parameter.types)),
                at,
                parameter.name.span,
            ));
        }
        fits
    }

    fn types(&self, types: &[TypeId]) -> String {
        let names: Vec<_> =
            types.iter().map(|id| self.domain.types[id.index()].name.text.as_str()).collect();
        names.join("` or `")
    }

    fn parameter(&self, parameter: &Variable) -> String {
        format!("{} - {}", parameter.name.text, self.types(&parameter.types).replace('`', ""))
    }
}
