//! How messages look, apart from what they say.

use lang::diagnostic::{Diagnostics, not_utf8};
use lang::render;
use lang::source::{Sources, Span};

fn domain(text: &str) -> (Diagnostics, Sources) {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (_, diagnostics) = lang::read_domain(&sources, id);
    (diagnostics, sources)
}

#[test]
fn long_lines_are_cut_around_the_mark() {
    let actions = |name: &str| {
        let each: Vec<String> =
            (0..20).map(|n| format!(" (:action {name}{n} :effect (lit))")).collect();
        each.concat()
    };
    let (before, after) = (actions("a"), actions("b"));
    let text = format!(
        "(define (domain d) (:predicates (lit)){before} (:action wash :effect (wet)){after})"
    );
    let (diagnostics, sources) = domain(&text);
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn distant_lines_are_shown_apart() {
    let (first, rest) = ("(define (domain d)\n  (:predicates (p)\n", "\n; nothing".repeat(400));
    let (diagnostics, sources) = domain(&format!("{first}{rest}\n    (p ?x)))\n"));
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn marks_of_several_lines_end_with_the_first() {
    let (diagnostics, sources) = domain(
        "(define (domain d)\r\n  (:predicates (p))\r\n  (:action a :effect (not (p)\r\n    (p))))\r\n",
    );
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn columns_count_characters() {
    let (diagnostics, sources) =
        domain("\u{feff}(define (domain d) ; é\n (:predicates (p)) (:action äö :effect (q)))\n");
    insta::assert_snapshot!(render::concise(&diagnostics, &sources), @r"
    domain.pddl:2:29: error[E0006] invalid-character: invalid character `ä` (U+00E4)
    domain.pddl:2:30: error[E0006] invalid-character: invalid character `ö` (U+00F6)
    domain.pddl:2:41: error[E0101] unknown-predicate: unknown predicate `q`
    ");
}

#[test]
fn color_is_only_for_terminals() {
    let (diagnostics, sources) = domain("(define (domain d) (:action a :effect (q)))\n");
    assert!(!render::full(&diagnostics, &sources, false).contains('\u{1b}'));
    assert!(render::full(&diagnostics, &sources, true).contains('\u{1b}'));
}

#[test]
fn summaries_count() {
    let (mut diagnostics, _) = domain(
        "(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :effect (q)))\n",
    );
    assert_eq!(render::summary(&diagnostics).as_deref(), Some("1 error, 1 warning"));
    diagnostics.append(diagnostics.clone());
    assert_eq!(render::summary(&diagnostics).as_deref(), Some("2 errors, 2 warnings"));
    assert_eq!(render::summary(&Diagnostics::default()), None);
}

#[test]
fn nobody_reads_a_thousand_messages() {
    let uses: Vec<String> = (0..1000).map(|n| format!("(p{n})")).collect();
    let uses = uses.join("\n");
    let (diagnostics, sources) =
        domain(&format!("(define (domain d) (:action a :effect (and {uses})))\n"));
    let text = render::full(&diagnostics, &sources, false);
    assert!(text.ends_with("… and 900 more like these\n"), "{}", &text[text.len() - 200..]);
    assert_eq!(render::concise(&diagnostics, &sources).lines().count(), 1000);
}

#[test]
fn bytes_that_are_no_text_are_reported_where_they_are() {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", "(define (domain caf");
    let list = vec![not_utf8::not_utf8(19, Span::new(id, 19, 19))];
    insta::assert_snapshot!(render::full(&Diagnostics { list }, &sources, false));
}
