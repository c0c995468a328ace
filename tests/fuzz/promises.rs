//! Bytes of any kind go in; nothing comes out, and a panic says which promise about such a text is broken.
//!
//! Fuzzing (`tests/fuzz/targets`, `tests/fuzz/random.rs`) and the tests that run on every change share this one file.

use std::sync::Once;

use lang::diagnostic::{Diagnostics, Fix, Label, RULES};
use lang::execute::Executor;
use lang::lexer::{self, TokenKind, lex};
use lang::model::{Domain, Problem};
use lang::source::{SourceId, Sources, Span};
use lang::symbol::Occurrences;
use lang::tree::{self, NodeKind};
use lang::validate::{self, Verdict};
use lang::{allow, annotation, format, lint, mend, plan, print, render};

/// A name and what is promised under it.
pub type Target = (&'static str, fn(&str));

/// What is fuzzed, each under the name of its folder of kept texts.
pub const TARGETS: [Target; 6] = [
    ("lexer", lexer),
    ("tree", tree),
    ("domain", domain),
    ("problem", problem),
    ("format", format),
    ("plan", plan),
];

/// A domain that can be run, and a problem of it.
const RUN: [&str; 2] = [include_str!("fixed/domain.pddl"), include_str!("fixed/problem.pddl")];

/// A domain that uses what the language has, whether or not it can be run.
const WIDE: &str = include_str!("fixed/wide.pddl");

/// Checks what is promised of `bytes` under the name `target`.
pub fn keep(target: &str, bytes: &[u8]) {
    static FIXED: Once = Once::new();
    FIXED.call_once(fixed_texts_are_sound);
    let (_, promise) =
        TARGETS.iter().find(|(name, _)| *name == target).expect("the target is one of these");
    promise(&String::from_utf8_lossy(bytes));
}

/// The fixed texts are sound, so that what is said beside them is about the text at hand.
fn fixed_texts_are_sound() {
    for text in [RUN[0], WIDE] {
        let mut sources = Sources::default();
        let id = sources.add("domain.pddl", text);
        let (domain, found) = lang::read_domain(&sources, id);
        assert_eq!(render::concise(&found, &sources), "");
        if text == RUN[0] {
            let id = sources.add("problem.pddl", RUN[1]);
            let (problem, found) = lang::read_problem(&sources, id, &domain);
            assert_eq!(render::concise(&found, &sources), "");
            assert_eq!(lang::refusals(domain.uses.iter().chain(&problem.uses)).list, []);
        }
    }
}

/// Tokens cover the text without a gap and are what they say.
fn lexer(text: &str) {
    let tokens = lex(text);
    let mut at = 0;
    for token in &tokens {
        assert_eq!(token.start, at, "tokens follow each other");
        let word = &text[token.start as usize..token.end as usize];
        let fits = match token.kind {
            TokenKind::Open => word == "(",
            TokenKind::Close => word == ")",
            TokenKind::Atom => !word.is_empty() && !word.contains(['(', ')', ';', ' ', '\n']),
            TokenKind::Space => !word.is_empty() && !word.contains(['(', ')', ';', '?']),
            TokenKind::Comment => word.starts_with(';') && !word.contains('\n'),
        };
        assert!(fits, "{:?}: {word:?}", token.kind);
        at = token.end;
    }
    assert_eq!(at as usize, text.len(), "tokens reach the end");
    let mut sources = Sources::default();
    let id = sources.add("text", text);
    let mut found = Diagnostics::default();
    lexer::check_characters(id, text, &tokens, &mut found);
    sound(&found, &sources);
}

/// The tree keeps every byte, and each node lies in its list.
fn tree(text: &str) {
    let mut sources = Sources::default();
    let id = sources.add("text", text);
    let mut found = Diagnostics::default();
    let tree = tree::parse(id, text, &mut found);
    assert_eq!(tree.text(), text, "the tree keeps every byte");
    let mut lists = vec![(tree.nodes().len() as u32, 0, text.len() as u32)];
    for (index, node) in tree.nodes().iter().enumerate() {
        while lists.last().is_some_and(|&(next, ..)| next as usize == index) {
            lists.pop();
        }
        let &(next, start, end) = lists.last().expect("every node but the last has one after it");
        assert!(node.next as usize > index && node.next <= next, "a node ends with its list");
        assert!(
            start <= node.start && node.start <= node.end && node.end <= end,
            "a node lies in its list"
        );
        // Where a `(` and a `)` are missing, a blank without a text is left of their list.
        assert!(node.start < node.end || node.kind == NodeKind::Space, "a node has a text");
        within(Span::new(id, node.start, node.end), &sources);
        if matches!(node.kind, NodeKind::List | NodeKind::OpenList) {
            lists.push((node.next, node.start, node.end));
        } else {
            assert_eq!(node.next as usize, index + 1, "what is no list contains nothing");
        }
    }
    sound(&found, &sources);
}

/// A domain is read, whatever it is; what is sound is printed as it reads, and fixes come to an end.
fn domain(text: &str) {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    checked_domain(&mut sources, id);
    let mut syntax = Diagnostics::default();
    let ast = lang::parse_domain(&sources, id, &mut syntax);
    let mut copies = Sources::default();
    let copy = copies.add("printed.pddl", print::domain(&ast));
    let mut again = Diagnostics::default();
    let read = lang::parse_domain(&copies, copy, &mut again);
    if syntax.list.is_empty() && in_place(text) {
        assert_eq!(again.list, [], "what is printed is sound:\n{}", copies.get(copy).text);
        assert_eq!(read, ast, "what is printed reads as the same:\n{}", copies.get(copy).text);
    }
    mended(text, |sources, id| checked_domain(sources, id).1);
}

/// A problem is read beside each of the fixed domains.
fn problem(text: &str) {
    pair(RUN[0], text);
    pair(WIDE, text);
}

/// A problem is read beside a domain, whatever both are.
pub fn pair(domain: &str, text: &str) {
    let mut sources = Sources::default();
    let first = sources.add("domain.pddl", domain);
    let (domain, _) = lang::read_domain(&sources, first);
    let second = sources.add("problem.pddl", text);
    checked_problem(&mut sources, second, &domain);
    let mut syntax = Diagnostics::default();
    let ast = lang::parse_problem(&sources, second, &mut syntax);
    let mut copies = Sources::default();
    let copy = copies.add("printed.pddl", print::problem(&ast));
    let mut again = Diagnostics::default();
    let read = lang::parse_problem(&copies, copy, &mut again);
    if syntax.list.is_empty() && in_place(text) {
        assert_eq!(again.list, [], "what is printed is sound:\n{}", copies.get(copy).text);
        assert_eq!(read, ast, "what is printed reads as the same:\n{}", copies.get(copy).text);
    }
}

/// Whether all of a text is printed in the order in which it stands. What is private is printed behind what is not.
fn in_place(text: &str) -> bool {
    !text.to_ascii_lowercase().contains(":private")
}

/// Layout keeps every word and comment, and lays out its own result the same way.
fn format(text: &str) {
    fn words(text: &str) -> Vec<&str> {
        let kept = |token: &lexer::Token| token.kind != TokenKind::Space;
        let word = |token: lexer::Token| text[token.start as usize..token.end as usize].trim_end();
        // The lines of annotations are cut anew, so what stands in them counts.
        let within = |word| annotation::words(word).unwrap_or_else(|| vec![word]);
        lex(text).into_iter().filter(kept).map(word).flat_map(within).collect()
    }
    let said = |text: &str| -> Vec<String> {
        let mut sources = Sources::default();
        let id = sources.add("text", text);
        let (annotations, found) = lang::annotations(&sources, id);
        sound(&found, &sources);
        annotations.iter().map(|one| format!("{} in {}", one.expression, one.place)).collect()
    };
    let annotations = said(text);
    let Some(once) = format::format(text) else { return };
    assert_eq!(words(&once), words(text), "layout keeps every word and comment:\n{once}");
    match format::format(&once) {
        Some(twice) => {
            assert_eq!(said(&once), annotations, "layout keeps every annotation:\n{once}");
            assert_eq!(twice, once, "layout of a layout changes nothing");
        }
        // Where sections stand in odd places, missing parentheses are looked for by indentation, which layout has changed.
        None => assert!(!is_well_formed(text), "what was laid out has its parentheses:\n{once}"),
    }
}

/// Whether a text has the sections and fields of a domain or of a problem in their places.
fn is_well_formed(text: &str) -> bool {
    let mut sources = Sources::default();
    let id = sources.add("text", text);
    let (mut domain, mut problem) = (Diagnostics::default(), Diagnostics::default());
    lang::parse_domain(&sources, id, &mut domain);
    lang::parse_problem(&sources, id, &mut problem);
    domain.list.is_empty() || problem.list.is_empty()
}

/// A plan file is read, judged and told, whatever it is; what was understood is written as it reads.
fn plan(text: &str) {
    let mut sources = Sources::default();
    let [domain, problem] = RUN;
    let domain = sources.add("domain.pddl", domain);
    let problem = sources.add("problem.pddl", problem);
    let (domain, _) = lang::read_domain(&sources, domain);
    let (problem, _) = lang::read_problem(&sources, problem, &domain);
    let id = sources.add("plan", text);
    let (listing, mut found) = plan::read(&sources, id, &domain, &problem);
    assert_eq!(listing.plan.steps.len(), listing.spans.len(), "each step has a place");
    listing.spans.iter().for_each(|&span| within(span, &sources));
    let executor = Executor::new(&domain, &problem).expect("the fixed domain has a meaning");
    let verdict = validate::judge(&executor, &listing.plan);
    let valid = validate::is_valid(&executor, &listing.plan);
    assert_eq!(matches!(verdict, Verdict::Valid(_)), valid, "there is one verdict");
    validate::lines(&verdict);
    validate::story(&verdict, &domain, &problem, &listing.plan);
    if let Verdict::Invalid(failure) = &verdict {
        found.push(failure.diagnostic(&domain, &problem, &listing.plan, &listing.spans));
    }
    sound(&found, &sources);
    let written = plan::write(&listing.plan, &domain, &problem, 1.into(), false);
    let copy = sources.add("written", written);
    let (again, found) = plan::read(&sources, copy, &domain, &problem);
    assert_eq!(found.list, [], "what is written is sound");
    assert_eq!(again.plan, listing.plan, "what is written reads as the same");
    mended(text, |sources, id| plan::read(sources, id, &domain, &problem).1);
}

/// Reads a domain in every way and looks at all that is said.
fn checked_domain(sources: &mut Sources, id: SourceId) -> (Domain, Diagnostics) {
    lang::detect(sources, id);
    let (domain, mut found) = lang::read_domain(sources, id);
    let (_, same, names) = lang::index_domain(sources, id);
    assert_eq!(same, found, "listing names changes nothing");
    ordered(&names, id, sources);
    if !found.has_errors() {
        found.append(lint::domain(&domain));
    }
    found.append(lang::refusals(&domain.uses));
    allow::apply(&mut found, sources);
    sound(&found, sources);
    (domain, found)
}

/// Reads a problem in every way and looks at all that is said.
fn checked_problem(sources: &mut Sources, id: SourceId, domain: &Domain) -> Problem {
    lang::detect(sources, id);
    let (problem, mut found) = lang::read_problem(sources, id, domain);
    let (_, same, names) = lang::index_problem(sources, id, domain);
    assert_eq!(same, found, "listing names changes nothing");
    ordered(&names, id, sources);
    if !found.has_errors() {
        found.append(lint::problem(domain, &problem));
    }
    found.append(lang::refusals(&problem.uses));
    allow::apply(&mut found, sources);
    sound(&found, sources);
    problem
}

/// Applies safe fixes again and again; each round is read, and soon there is none left.
fn mended(text: &str, check: impl Fn(&mut Sources, SourceId) -> Diagnostics) {
    let mut text = text.to_owned();
    for _ in 0..ROUNDS {
        let mut sources = Sources::default();
        let id = sources.add("text", text);
        let found = check(&mut sources, id);
        let (next, count) = mend::safely(&found, &sources, id);
        if count == 0 {
            return;
        }
        text = next;
    }
}

/// How many rounds of fixes are made, as in `caveat check --fix`.
const ROUNDS: usize = 8;

/// Names stand in the order of the text, in the text, and apart.
fn ordered(names: &Occurrences, id: SourceId, sources: &Sources) {
    let mut end = 0;
    for occurrence in &names.list {
        assert_eq!(occurrence.span.source, id, "names stand in this text");
        within(occurrence.span, sources);
        assert!(end <= occurrence.span.start, "names stand apart and in order: {occurrence:?}");
        end = occurrence.span.end;
    }
    names.variables.iter().for_each(|variable| within(variable.name.span, sources));
}

/// Every diagnostic is of its kind and can be shown, its places lie in the texts, and its fixes change something.
fn sound(found: &Diagnostics, sources: &Sources) {
    for one in &found.list {
        let rule = RULES.iter().find(|rule| rule.code == one.code).expect("every kind is listed");
        assert_eq!((rule.name, rule.severity), (one.name, one.severity), "it is of its kind");
        assert!(!one.message.is_empty() && !one.message.ends_with('.'), "{}", one.message);
        let labels = std::iter::once(&one.primary).chain(&one.secondary);
        for Label { span, text } in labels {
            within(*span, sources);
            assert!(!text.contains('\n'), "a label is one line: {text}");
        }
        one.fixes.iter().for_each(|fix| changes(fix, sources));
    }
    render::full(found, sources, true);
    render::full(found, sources, false);
    let lines = render::concise(found, sources);
    assert_eq!(lines.lines().count(), found.list.len(), "one line each:\n{lines}");
    render::json(found, sources);
    render::sarif(found, sources);
    render::github(found, sources);
    assert_eq!(render::summary(found).is_none(), found.list.is_empty());
}

/// A fix replaces pieces of the text that do not overlap, and by something else.
fn changes(fix: &Fix, sources: &Sources) {
    let changes = |(span, new): &(Span, String)| sources.text(*span) != new;
    let mut edits: Vec<&(Span, String)> = fix.edits.iter().collect();
    edits.sort_by_key(|(span, _)| *span);
    let mut last: Option<Span> = None;
    for (span, _) in edits {
        within(*span, sources);
        let apart = last.is_none_or(|last| last.source != span.source || last.end <= span.start);
        assert!(apart, "edits do not overlap: {fix:?}");
        last = Some(*span);
    }
    assert!(fix.edits.iter().any(changes), "a fix changes something: {fix:?}");
}

/// A place lies within its text and between characters.
fn within(Span { source, start, end }: Span, sources: &Sources) {
    let text = &sources.get(source).text;
    assert!(start <= end, "{start}..{end} ends after it starts");
    let piece = text.get(start as usize..end as usize);
    assert!(piece.is_some(), "{start}..{end} lies within {} bytes", text.len());
}
