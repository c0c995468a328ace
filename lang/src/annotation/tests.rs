//! Where annotations stand, what their items cover, and that no text is lost or too deep.

use proptest::prelude::*;

use super::{Annotation, Expression, Place, annotations};
use crate::source::Sources;

fn read(text: &str) -> Vec<Annotation> {
    let mut sources = Sources::default();
    let id = sources.add("fixture", text);
    annotations(&sources, id).0
}

/// Each annotation on a line of its own, with its place.
fn listed(text: &str) -> Vec<String> {
    read(text).iter().map(|one| format!("{} in {}", one.expression, one.place)).collect()
}

#[test]
fn a_place_is_what_encloses() {
    let text = "
;@ (:a)
(define ;@ (:b)
  (domain d)
  ;@ (:c)
  (:predicates (p) ;@ (:d)
    (q ;@ (:e)
    ))
  (:durative-action ;@ (:f)
    Move ;@ (:g)
    :parameters (?x) ;@ (:h)
    :condition ;@ (:i)
      (and (at start (p)) ;@ (:j)
        (at end (and ;@ (:k)
          (p))))
    :effect (at end (p)))
  (:action :effect (p) ;@ (:l)
  )
) ;@ (:m)
";
    assert_eq!(
        listed(text),
        [
            "(:a) in no definition",
            "(:b) in the domain",
            "(:c) in the domain",
            "(:d) in `:predicates`",
            "(:e) in `:predicates`",
            "(:f) in durative action `Move`",
            "(:g) in durative action `Move`",
            "(:h) in durative action `Move`",
            "(:i) in the condition of durative action `Move`",
            "(:j) in the condition of durative action `Move`",
            "(:k) in the condition of durative action `Move`",
            "(:l) in action `:effect`",
            "(:m) in no definition",
        ]
    );
    let problem = "(define (problem e) (:domain d) (:init (p) ;@ (:a)\n) ;@ (:b)\n)";
    assert_eq!(listed(problem), ["(:a) in `:init`", "(:b) in the problem"]);
}

#[test]
fn the_enclosing_list_is_the_innermost() {
    let text = "(define (domain d) (:action a :effect (and (p) ;@ (:seen 1)\n)))";
    let span = read(text)[0].enclosing;
    assert_eq!(&text[span.start as usize..span.end as usize], "(and (p) ;@ (:seen 1)\n)");
    let outside = ";@ (:seen 1)\n(define (domain d))";
    assert_eq!(read(outside)[0].enclosing.end as usize, outside.len());
}

#[test]
fn items_point_into_the_file() {
    let text = "(define (domain d)\r\n  ;@ (:causal \"my (file).json\" ; which\r\n\t;@   :outcome (= on?x\r\n;@1)) (:b)\r\n)";
    let [first, second] = &read(text)[..] else { panic!("there are two") };
    let slice = |span: crate::source::Span| &text[span.start as usize..span.end as usize];
    let words: Vec<&str> = first.expression.items().iter().map(|item| slice(item.span)).collect();
    assert_eq!(
        words,
        [
            "(:causal \"my (file).json\" ; which\r\n\t;@   :outcome (= on?x\r\n;@1))",
            ":causal",
            "\"my (file).json\"",
            ":outcome",
            "(= on?x\r\n;@1)",
            "=",
            "on",
            "?x",
            "1",
        ]
    );
    assert_eq!(first.expression.to_string(), "(:causal \"my (file).json\" :outcome (= on ?x 1))");
    assert_eq!(second.kind_span(), second.expression.span(super::ItemId(1)));
    let children = first.expression.children(Expression::ROOT);
    assert_eq!(children.map(|id| id.0).collect::<Vec<_>>(), [1, 2, 3, 4]);
}

#[test]
fn a_run_ends_where_something_else_stands() {
    let texts = [
        ("(a) ;@ (:seen\n;@ 1)", 1),
        (";@ (:seen\n\n;@ 1)", 0),
        (";@ (:seen\n; no\n;@ 1)", 0),
        ("(p ;@ (:seen\n) ;@ 1)\n", 0),
        (";@ (:seen\n(p) ;@ 1)", 0),
        (";@ (:seen\r;@ 1)", 1),
        (";@ (:seen\r\n \r\n;@ 1)", 0),
        (";@ (:seen\n;@\n \t;@ 1)", 1),
        (";;@ (:seen 1)\n; @ (:seen 1)", 0),
    ];
    for (text, count) in texts {
        assert_eq!(read(text).len(), count, "{text:?}");
    }
}

#[test]
fn a_kind_is_known_without_case_and_when_it_is_nearly_right() {
    let text = "(define (domain d) ;@ (:MEASURED (weight ?x)) (:mesured (weight ?x)) (:author)\n)";
    let names: Vec<Option<&str>> =
        read(text).iter().map(|one| one.kind.map(|kind| kind.name)).collect();
    assert_eq!(names, [Some(":measured"), Some(":measured"), None]);
    assert_eq!(read(text)[0].place, Place::Domain);
}

#[test]
fn depth_takes_no_stack_and_many_runs_take_no_time() {
    const DEPTH: usize = 50_000;
    let inner = format!(";@ (:seen {}{})", "(".repeat(DEPTH), ")".repeat(DEPTH));
    let outer = format!("{}\n{inner}\n{}", "(and\n;@ (:a)\n".repeat(DEPTH), ")".repeat(DEPTH));
    let found = read(&outer);
    assert_eq!(found.len(), DEPTH + 1);
    assert_eq!(found[DEPTH].expression.to_string(), inner[3..]);
    read(&";@ (".repeat(DEPTH));
    read(&format!("(define (domain d) {}", ";@ (:seen\n".repeat(DEPTH)));
}

proptest! {
    #[test]
    fn any_text_is_read(pieces in prop::collection::vec(prop::sample::select(vec![
        "(", ")", " ", "\n", "\r\n", ";@", ";@ (:seen", ";@ :causal \"f\"", ";", "\"", "\"a b\"", "?x", "é", "\u{a0}", "-", ":outcome (= a 1)", "(:observed", "define", "(domain d)", "(:action",
    ]), 0..60)) {
        for one in read(&pieces.concat()) {
            // What is printed is read as the same again.
            let text = format!(";@ {}", one.expression);
            let again = read(&text);
            prop_assert_eq!(again.len(), 1);
            prop_assert_eq!(again[0].expression.to_string(), one.expression.to_string());
        }
    }
}

#[test]
fn the_page_for_users_lists_the_kinds_and_its_example_is_right() {
    let page = include_str!("../../../docs/annotations.md");
    for kind in &super::KINDS {
        let row = format!("| `{}` | {} | ", kind.name, kind.summary);
        assert!(page.contains(&row), "the page has no row {row}");
    }
    let example = page.split("```lisp\n").nth(1).and_then(|rest| rest.split("```").next());
    let example = example.expect("the page begins with an example");
    let mut sources = Sources::default();
    let id = sources.add("example", example);
    let (_, diagnostics) = crate::read_domain(&sources, id);
    assert_eq!(crate::render::concise(&diagnostics, &sources), "");
    assert_eq!(annotations(&sources, id).0.len(), 4);
    assert_eq!(crate::format::format(example).as_deref(), Some(example));
}
