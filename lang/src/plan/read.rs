//! The text of a plan file goes in; the plan comes out, with every line that is not a step as a diagnostic.
//!
//! A step is `(name object …)`, with `0.000:` before it and `[1.0]` after it if need be.
//! Steps may share a line, names are compared without case, and `;` begins a comment.

use rustc_hash::FxHashMap;

use super::{Plan, Step};
use crate::diagnostic::{Diagnostic, Diagnostics, Fix, Label, Severity};
use crate::model::{ActionId, Domain, Name, ObjectId, Problem, TypeId, Variable};
use crate::source::{SourceId, Sources, Span};

/// A plan as it was read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// The steps that could be understood.
    pub plan: Plan,
    /// Where each of these steps stands.
    pub spans: Vec<Span>,
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
                    self.report_syntax(
                        "unexpected `)`",
                        self.span(token),
                        "no step is open here",
                        Some(("remove it", String::new())),
                    );
                }
                Kind::Duration => {
                    self.at += 1;
                    self.report_syntax(
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
            self.report_syntax("a time without a step", span, "no `(` follows", None);
        }
        if let Some((last, before)) = self.last_time.filter(|&(last, _)| time < last) {
            self.diagnostics.push(Diagnostic {
                code: "E0715",
                name: "plan-step-order",
                severity: Severity::Error,
                message: "this step comes before the one above it".to_owned(),
                primary: Label { span, text: format!("at time {time}") },
                secondary: vec![Label { span: before, text: format!("at time {last}") }],
                help: Some("write the steps in the order of their times".to_owned()),
                fixes: Vec::new(),
            });
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
        self.report_syntax(
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
            self.report_syntax("a step that is not closed", span, "this `(` has no `)`", None);
            let fix = Fix { title: "add the `)`".to_owned(), edits: vec![(after, ")".to_owned())] };
            self.diagnostics.list.last_mut().expect("it was pushed above").fixes.push(fix);
        }
        self.skip_duration();
        let span = self.span(open).to(self.span(closed.unwrap_or(last)));
        let Some((&name, arguments)) = words.split_first() else {
            self.report_syntax(
                "a step without a name",
                span,
                "an action's name belongs here",
                None,
            );
            return;
        };
        let named = |token: Token| (self.word(token), self.span(token));
        let arguments: Vec<_> = arguments.iter().map(|&token| named(token)).collect();
        if let Some(step) = self.resolver.step(named(name), &arguments, span, &mut self.diagnostics)
        {
            self.listing.plan.steps.push(step);
            self.listing.spans.push(span);
        }
    }

    fn skip_duration(&mut self) {
        self.at += usize::from(self.peek().is_some_and(|token| token.kind == Kind::Duration));
    }

    fn report_syntax(
        &mut self,
        message: &str,
        span: Span,
        label: &str,
        fix: Option<(&str, String)>,
    ) {
        self.diagnostics.push(Diagnostic {
            code: "E0710",
            name: "plan-syntax",
            severity: Severity::Error,
            message: message.to_owned(),
            primary: Label { span, text: label.to_owned() },
            secondary: Vec::new(),
            help: Some("a plan file has one `(action object …)` for each step".to_owned()),
            fixes: fix
                .map(|(title, text)| Fix { title: title.to_owned(), edits: vec![(span, text)] })
                .into_iter()
                .collect(),
        });
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
            let names = self.domain.actions.iter().map(|action| &action.name);
            out.push(unknown(("E0711", "plan-unknown-action"), "action", (name, at), names));
            return None;
        };
        let mut arguments = Some(Vec::with_capacity(words.len()));
        for &(name, at) in words {
            let object = self.objects.get(&name.to_lowercase()).copied();
            if object.is_none() {
                let names = self.problem.objects.iter().map(|object| &object.name);
                out.push(unknown(("E0713", "plan-unknown-object"), "object", (name, at), names));
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
            out.push(error(
                ("E0712", "plan-wrong-arity"),
                format!(
                    "`{}` takes {}, not {}",
                    action.name.text,
                    arguments(parameters.len()),
                    words.len()
                ),
                Label { span, text: format!("{} here", arguments(words.len())) },
                vec![Label { span: action.name.span, text: "declared here".to_owned() }],
                (!each.is_empty()).then(|| format!("its parameters are `{}`", each.join(" "))),
            ));
            return false;
        }
        let mut fits = true;
        for ((&object, parameter), &(_, at)) in step.arguments.iter().zip(parameters).zip(words) {
            let object = &self.problem.objects[object.index()];
            if self.domain.has_type(object, &parameter.types) {
                continue;
            }
            fits = false;
            out.push(error(
                ("E0714", "plan-type-mismatch"),
                format!("`{}` is not of type `{}`", object.name.text, self.types(&parameter.types)),
                Label {
                    span: at,
                    text: format!("this is of type `{}`", self.types(&object.types)),
                },
                vec![Label {
                    span: parameter.name.span,
                    text: format!("`{}` is declared here", parameter.name.text),
                }],
                None,
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

fn arguments(count: usize) -> String {
    match count {
        0 => "no arguments".to_owned(),
        1 => "1 argument".to_owned(),
        _ => format!("{count} arguments"),
    }
}

fn error(
    (code, name): (&'static str, &'static str),
    message: String,
    primary: Label,
    secondary: Vec<Label>,
    help: Option<String>,
) -> Diagnostic {
    Diagnostic {
        code,
        name,
        severity: Severity::Error,
        message,
        primary,
        secondary,
        help,
        fixes: Vec::new(),
    }
}

fn unknown<'n>(
    kind: (&'static str, &'static str),
    what: &str,
    (word, span): Word<'_>,
    names: impl Iterator<Item = &'n Name>,
) -> Diagnostic {
    let label = Label { span, text: format!("no {what} has this name") };
    let mut diagnostic = error(kind, format!("unknown {what} `{word}`"), label, Vec::new(), None);
    if let Some(name) = nearest(word, names) {
        diagnostic.help = Some(format!("did you mean `{}`?", name.text));
        diagnostic.secondary.push(Label { span: name.span, text: "declared here".to_owned() });
        let text = name.text.to_lowercase();
        diagnostic
            .fixes
            .push(Fix { title: format!("replace with `{text}`"), edits: vec![(span, text)] });
    }
    diagnostic
}

/// The name that `word` is most likely meant to be: at most a third of it differs; the first of equally near ones.
fn nearest<'n>(word: &str, names: impl Iterator<Item = &'n Name>) -> Option<&'n Name> {
    let word = word.to_lowercase();
    let limit = (word.chars().count() / 3).max(1);
    names
        .filter(|name| name.text.len().abs_diff(word.len()) <= limit * 4)
        .map(|name| (strsim::osa_distance(&word, &name.text.to_lowercase()), name))
        .filter(|&(distance, _)| distance <= limit)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, name)| name)
}
