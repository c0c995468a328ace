//! Scripts go in; the operators that are learned from them come out, as a person reads them.

use learner::observe::Vocabulary;
use learner::operators::words::Words;
use learner::operators::{Options, learn};
use learner::rule::{self, Rule};

use super::words::{domain, names, options, records, taught, text, warnings};

const STACK: &str = "types plate - item
    things red blue - cube table - table
    holds (on-top red table) (on-top blue table) (clear red) (clear blue) (hand-empty left) (hand-empty right)
    1.0 left takes red
    1.2 - (on-top red table) left holding
    3.0 + (on-top red blue) left holding
    3.0 - (clear blue) left holding
    3.2 left lets go";

/// The same with other things, another hand and other names.
const OTHER: &str = "things bench - table one two three - cube
    holds (on-top one bench) (on-top two bench) (on-top three bench) (clear one) (clear two) (clear three)
    holds (hand-empty left) (hand-empty right)
    2.0 right takes three
    2.1 - (on-top three bench) right holding
    4.0 + (on-top three one) right holding
    4.0 - (clear one) right holding
    4.4 right lets go";

const KITCHEN: &str = "types plate - item
    things blue - drawer plate1 - plate table - table
    holds (closed blue) (on-top plate1 table) (clear plate1) (hand-empty left) (hand-empty right)
    1.0 right takes blue
    1.4 - (closed blue) right holding
    1.4 + (open blue) right holding
    1.9 right lets go
    3.0 left takes plate1
    3.2 - (on-top plate1 table) left holding
    5.0 + (inside plate1 blue) left holding
    5.2 left lets go";

#[test]
fn operators_of_a_kitchen() {
    let text = text(&taught(&[KITCHEN], &options()));
    insta::with_settings!({ description => KITCHEN, omit_expression => true }, {
        insta::assert_snapshot!("operators of a kitchen", text);
    });
}

#[test]
fn operators_are_one_if_they_are_equal_up_to_names_and_each_time_counts() {
    let taught = taught(&[STACK, OTHER], &options());
    assert_eq!(names(&taught), ["take-cube-from-table 2", "put-cube-on-cube 2"]);
    let take = &taught.learned.actions[0];
    assert_eq!(take.sources, [("monday".to_owned(), 1), ("tuesday".to_owned(), 1)]);
}

#[test]
fn the_same_deed_with_things_of_other_types_is_another_operator() {
    let plates = OTHER.replace("one two three - cube", "one two three - plate");
    let taught = taught(&[STACK, &plates], &options());
    assert_eq!(
        names(&taught),
        [
            "take-cube-from-table 1",
            "put-cube-on-cube 1",
            "take-plate-from-table 1",
            "put-plate-on-plate 1",
        ]
    );
}

#[test]
fn things_of_one_type_are_lifted_to_distinct_parameters() {
    let text = text(&taught(&[STACK], &options()));
    let put = text.split("(:action put-cube-on-cube").nth(1).expect("it is there");
    assert!(put.contains("?hand - hand ?cube1 ?cube2 - cube"), "{put}");
    assert!(put.contains("(on-top ?cube1 ?cube2)"), "{put}");
}

#[test]
fn what_ends_again_before_a_deed_is_over_is_no_effect_and_no_part_of_the_name() {
    let brushed = STACK.replace(
        "3.0 + (on-top red blue)",
        "2.9 + (on-top red table) left holding
        2.95 - (on-top red table) left holding
        3.0 + (on-top red blue)",
    );
    assert_eq!(
        text(&taught(&[&brushed], &options())),
        text(&taught(&[STACK], &options())),
        "brushing the table changes nothing"
    );
}

#[test]
fn the_safe_rule_demands_more_than_the_rule_of_what_changes() {
    let with = |rule| {
        let rule = rule::Options { rule, ..rule::Options::default() };
        taught(&[KITCHEN], &Options { rule, ..options() })
    };
    let (changed, safe, both) = (with(Rule::Changed), with(Rule::Safe), with(Rule::Both));
    let demands = |text: &str, atom: &str| {
        let put = text.split("(:action put-plate-in-drawer").nth(1).expect("it is there");
        put.split(":effect").next().expect("it has a precondition").contains(atom)
    };
    let (changed, safe, both) = (text(&changed), text(&safe), text(&both));
    assert!(!demands(&changed, "(open ?drawer)"), "{changed}");
    assert!(demands(&safe, "(open ?drawer)"), "{safe}");
    assert!(demands(&both, "(open ?drawer)"), "{both}");
    assert!(demands(&changed, "(in-hand ?plate ?hand)"), "{changed}");
    assert!(!safe.contains("Perhaps not needed"), "{safe}");
    assert!(both.contains("(open ?drawer) held 1 of 1 times"), "{both}");
}

/// A domain whose words say nothing of hands.
const KNOWN: &str = "(define (domain robot)
  (:requirements :strips :typing)
  (:types item drawer table)
  (:predicates (hand-clear) (holding ?item - item) (on ?item - item ?table - table) (inside ?item - item ?drawer - drawer)
    (open ?drawer - drawer) (closed ?drawer - drawer)))";

fn handless() -> Vocabulary {
    let pattern = |text: &str| text.parse().expect("the pattern is well formed");
    Vocabulary {
        on_top: pattern("(on ?above ?below)"),
        in_hand: pattern("(holding ?object)"),
        hand_empty: pattern("(hand-clear)"),
        ..Vocabulary::default()
    }
}

#[test]
fn words_without_hands_say_of_each_deed_what_its_own_hand_does() {
    // The left hand holds a plate all the while; the drawer is still opened by an empty hand.
    let script = "types plate - item
        things blue - drawer plate1 - plate table - table
        holds (closed blue) (on-top plate1 table) (hand-empty left) (hand-empty right)
        1.0 left takes plate1
        1.2 - (on-top plate1 table) left holding
        3.0 right takes blue
        3.4 - (closed blue) right holding
        3.4 + (open blue) right holding
        3.9 right lets go
        5.0 + (inside plate1 blue) left holding
        5.2 left lets go";
    let known = domain(KNOWN);
    let mut demonstrations = records(&[script]);
    demonstrations[0].1.vocabulary = handless();
    let taught = learn(&demonstrations, Some(&known), &options());
    assert_eq!(
        names(&taught),
        ["take-plate-from-table 1", "open-drawer 1", "put-plate-in-drawer 1"]
    );
    let text = learner::write::text(&taught.learned);
    insta::with_settings!({ description => script, omit_expression => true }, {
        insta::assert_snapshot!("words without hands", text);
    });
    assert_eq!(warnings(&text), [""; 0]);
}

#[test]
fn words_that_a_domain_does_not_have_are_named_and_left_out() {
    let known = domain(KNOWN);
    let mut demonstrations = records(&[STACK]);
    demonstrations[0].1.vocabulary = handless();
    let taught = learn(&demonstrations, Some(&known), &options());
    assert_eq!(taught.missing, ["the type `cube`"]);
    // Everything that could be seen was about cubes, of which the domain does not know.
    assert_eq!(names(&taught), [""; 0]);
    assert_eq!(taught.lines[0].1.mute, ["move-cube-on-cube"]);
    let script = STACK.replace("- cube", "- item").replace("(clear red)", "");
    let mut demonstrations = records(&[&script]);
    demonstrations[0].1.vocabulary = handless();
    let taught = learn(&demonstrations, Some(&known), &options());
    assert_eq!(taught.missing, ["the predicate `clear`"]);
    assert_eq!(names(&taught), ["take-item-from-table 1", "put-item-on-item 1"]);
}

#[test]
fn hands_act_under_the_names_of_the_map_and_those_not_named_are_left_out() {
    let mut demonstrations = records(&[KITCHEN]);
    demonstrations[0].1.actors = vec![Some("robot".to_owned()), None];
    let taught = learn(&demonstrations, None, &options());
    assert_eq!(names(&taught), ["take-plate-from-table 1", "put-plate-in-drawer 1"]);
    let line = &taught.lines[0].1;
    let objects: Vec<&str> =
        line.trace.objects.iter().map(|object| object.name.text.as_str()).collect();
    assert_eq!(objects, ["blue", "plate1", "table", "robot"]);
    // What the other hand did is no effect of what this one does: there is a gap between the states.
    let opened = line.trace.steps.iter().filter(|step| !step.whole).count();
    assert_eq!(opened, 0, "the drawer was open before the first deed");
    let renamed = Words { actors: vec![Some("arm".to_owned()); 2], ..demonstrations[0].1.clone() };
    demonstrations[0].1 = renamed;
    let taught = learn(&demonstrations, None, &options());
    assert_eq!(taught.learned.actions.len(), 3, "both hands act as one arm");
}

#[test]
fn names_say_what_is_done_to_what_and_where() {
    let takes =
        |what: &str, change: &str| format!("1.0 left takes {what}\n1.2 {change} left holding");
    let cases = [
        ("(on-top red table)", takes("red", "- (on-top red table)"), "take-cube-from-table"),
        ("(inside red pink)", takes("red", "- (inside red pink)"), "take-cube-out-of-drawer"),
        ("(at red tray)", takes("red", "- (at red tray)"), "take-cube-from-spot"),
        ("(closed pink)", takes("pink", "+ (open pink)"), "open-drawer"),
        ("(open pink)", takes("pink", "+ (closed pink)"), "close-drawer"),
        ("(blocks chair pink)", takes("chair", "- (blocks chair pink)"), "move-chair-from-drawer"),
        ("(clear red)", takes("chair", "+ (blocks chair pink)"), "move-chair-before-drawer"),
        (
            "(blocks chair pink)",
            "1.0 - (blocks chair pink) left touching".to_owned(),
            "push-chair-from-drawer",
        ),
        (
            "(at left tray)",
            "1.0 - (at left tray) left 0\n1.4 + (at left shelf) left 0".to_owned(),
            "move",
        ),
        ("(clear red)", "1.0 + (at left shelf) left 0".to_owned(), "enter"),
        ("(at left tray)", "1.0 - (at left tray) left 0".to_owned(), "leave"),
    ];
    for (before, script, name) in cases {
        let script = format!(
            "things red - cube pink - drawer chair - chair table - table tray shelf - spot
            holds (hand-empty left) {before}
            {script}"
        );
        let taught = taught(&[&script], &options());
        assert_eq!(names(&taught), [format!("{name} 1")], "{script}");
    }
}
