//! Scripts go in; the operators of algorithm 4 of the thesis, taken to the letter, come out.

use learner::operators::letter;
use learner::rule::Rule;
use learner::segment::Tree;
use learner::write;

use super::words::{records, warnings};

/// A plate is put into a drawer, with both hands idle in between.
const PUT: &str = "things blue - drawer red - cube table - table
    holds (closed blue) (on-top red table)
    1.0 right takes blue
    1.4 - (closed blue) right holding
    1.4 + (open blue) right holding
    1.9 right lets go
    3.0 left takes red
    3.2 - (on-top red table) left holding
    5.0 + (inside red blue) left holding
    5.2 left lets go";

#[test]
fn each_activity_of_a_hand_is_an_operator() {
    let learned = letter::learn(&records(&[PUT]), None, "letter", &Tree::published());
    let text = write::text(&learned);
    insta::with_settings!({ description => PUT, omit_expression => true }, {
        insta::assert_snapshot!("algorithm 4", text);
    });
    assert_eq!(warnings(&text), [""; 0]);
    assert_eq!(learned.rule, Rule::Changed);
}

#[test]
fn the_printed_rule_demands_nothing_of_the_surroundings_that_does_not_change() {
    let learned = letter::learn(&records(&[PUT]), None, "letter", &Tree::published());
    let text = write::text(&learned);
    // Nothing asks for an open drawer where something is put into it: the weakness that the safe rule cures.
    let puts = text.split("(:action put-cube").nth(1).expect("a cube is put somewhere");
    let (demands, does) = puts.split_once(":effect").expect("each action has an effect");
    assert!(does.contains("(inside ?cube ?drawer)"), "{text}");
    assert!(!demands.contains("(open "), "{text}");
}

#[test]
fn equal_operators_are_counted_and_others_are_numbered() {
    let twice = letter::learn(&records(&[PUT, PUT]), None, "letter", &Tree::published());
    let once = letter::learn(&records(&[PUT]), None, "letter", &Tree::published());
    assert_eq!(twice.actions.len(), once.actions.len());
    for (two, one) in twice.actions.iter().zip(&once.actions) {
        assert_eq!(two.count, 2 * one.count);
        assert_eq!(
            (&two.required, &two.adds, &two.deletes),
            (&one.required, &one.adds, &one.deletes)
        );
        assert_eq!(two.sources.len(), 2);
    }
    let names: Vec<&str> = twice
        .actions
        .iter()
        .map(|one| twice.domain.actions[one.action.index()].name.text.as_str())
        .collect();
    let mut different = names.clone();
    different.sort_unstable();
    different.dedup();
    assert_eq!(different.len(), names.len(), "{names:?}");
}

#[test]
fn a_stray_change_is_no_part_of_an_operator() {
    let stray = format!("{PUT}\n6.0 - (open blue) right 0.4\n6.0 + (closed blue) right 0.4");
    let with = letter::learn(&records(&[&stray]), None, "letter", &Tree::published());
    let without = letter::learn(&records(&[PUT]), None, "letter", &Tree::published());
    assert_eq!(write::text(&with), write::text(&without));
}
