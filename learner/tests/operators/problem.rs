//! Scripts go in; problems come out that begin where the demonstrations began, and whose goals are what the demonstrations made true.

use lang::source::Sources;
use learner::observe::Vocabulary;
use learner::problem;

use super::words::{domain, options, records, taught, text};

const OPEN: &str = "types plate - item
    things blue - drawer red - plate table - table
    holds (closed blue) (on-top red table) (hand-empty left) (hand-empty right)
    1.0 left takes blue
    1.4 - (closed blue) left holding
    1.4 + (open blue) left holding
    1.9 left lets go";

#[test]
fn a_demonstration_is_a_problem() {
    let written = text(&taught(&[OPEN], &options()));
    let model = domain(&written);
    let (record, words) = &records(&[OPEN])[0];
    let begin = problem::beginning(&model, record, words);
    let end = problem::end(&model, record, words);
    let goal = problem::achieved(&begin, &end);
    assert_eq!(goal, "(open blue)");
    let text = problem::text(&model, "shown", &begin, &goal);
    insta::with_settings!({ description => OPEN, omit_expression => true }, {
        insta::assert_snapshot!("a demonstration as a problem", text);
    });
    let mut sources = Sources::default();
    let id = sources.add("shown.pddl", text);
    let (_, found) = lang::read_problem(&sources, id, &model);
    assert_eq!(lang::render::concise(&found, &sources), "");
}

#[test]
fn what_the_domain_has_no_words_for_is_left_out() {
    let model = domain(
        "(define (domain small) (:requirements :strips :typing) (:types item drawer)
        (:predicates (shut ?drawer - drawer) (open ?drawer - drawer)))",
    );
    let (record, words) = &mut records(&[OPEN])[0];
    words.vocabulary = Vocabulary {
        closed: "(shut ?object)".parse().expect("the pattern is well formed"),
        ..Vocabulary::default()
    };
    let begin = problem::beginning(&model, record, words);
    let facts: Vec<String> = begin
        .facts
        .iter()
        .map(|fact| format!("{} {}", fact.predicate, fact.arguments.join(" ")))
        .collect();
    assert_eq!(facts, ["shut blue"]);
    // A plate is an item, as the header says; of tables and hands the domain does not know.
    let of = |name: &str, kind: &str| (name.to_owned(), kind.to_owned());
    assert_eq!(begin.objects, [of("blue", "drawer"), of("red", "item")]);
}

#[test]
fn several_facts_are_a_conjunction_and_none_is_an_empty_one() {
    let model = domain(&text(&taught(&[OPEN], &options())));
    let (record, words) = &records(&[OPEN])[0];
    let begin = problem::beginning(&model, record, words);
    assert_eq!(problem::achieved(&begin, &begin), "(and )");
    let nothing = problem::Situation::default();
    let all = problem::achieved(&nothing, &begin);
    assert!(all.starts_with("(and (") && all.contains("(closed blue)"), "{all}");
}
