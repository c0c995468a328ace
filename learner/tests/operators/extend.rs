//! A domain as text and scripts in its words go in; what is new in them stands in the text that comes out, and everything else stays as it was.

use learner::extend::{Extension, extend};
use learner::observe::Vocabulary;
use learner::operators::learn;

use super::words::{domain, options, records, warnings};

const ROBOT: &str = "; A robot that can pick plates up.
(define (domain robot)
  (:requirements :strips :typing)
  (:types plate drawer table)
  (:predicates
    (hand-clear)                                 ; the hand is free
    (holding ?plate - plate)
    (on ?plate - plate ?table - table)
    (inside ?plate - plate ?drawer - drawer)
    (open ?drawer - drawer)
    (closed ?drawer - drawer)
    (clean ?plate - plate))

  ;; It only takes what is clean.
  (:action pick
    :parameters (?plate - plate ?table - table)
    :precondition (and
      (hand-clear)                               ; one thing at a time
      (clean ?plate)                             ; an old habit
      (on ?plate ?table))
    :effect (and
      (holding ?plate)
      (not (hand-clear))
      (not (on ?plate ?table)))))
";

const PICK: &str = "things blue - drawer red - plate table - table
    holds (on-top red table) (hand-empty left)
    1.0 left takes red
    1.2 - (on-top red table) left holding";

const OPEN: &str = "things blue - drawer red - plate table - table
    holds (closed blue) (on-top red table) (hand-empty left)
    1.0 left takes blue
    1.4 - (closed blue) left holding
    1.4 + (open blue) left holding
    1.9 left lets go";

/// What becomes of a domain by a script.
#[track_caller]
fn extended(text: &str, script: &str) -> Extension {
    let known = domain(text);
    let pattern = |text: &str| text.parse().expect("the pattern is well formed");
    let mut demonstrations = records(&[script]);
    demonstrations[0].1.vocabulary = Vocabulary {
        on_top: pattern("(on ?above ?below)"),
        in_hand: pattern("(holding ?object)"),
        hand_empty: pattern("(hand-clear)"),
        ..Vocabulary::default()
    };
    let taught = learn(&demonstrations, Some(&known), &options());
    let extension = extend(text, &known, &taught.learned);
    domain(&extension.text);
    extension
}

/// A domain in which the habit is gone and everything is of use.
fn clean() -> String {
    ROBOT
        .replace("      (clean ?plate)                             ; an old habit\n", "")
        .replace("\n    (clean ?plate - plate)", "")
        .replace("(:predicates", "; caveat: allow(unused-predicate)\n  (:predicates")
}

#[test]
fn what_is_known_leaves_the_text_as_it_was() {
    let text = clean();
    let extension = extended(&text, PICK);
    assert_eq!(extension.known, [("pick".to_owned(), 1)]);
    assert_eq!(extension.text, text);
    assert_eq!((extension.added.len(), extension.refined.len()), (0, 0));
    assert_eq!(extension.conflicts, [""; 0]);
}

#[test]
fn what_was_done_without_a_precondition_takes_it_away_and_keeps_the_comments() {
    let extension = extended(ROBOT, PICK);
    assert_eq!(extension.refined, [("pick".to_owned(), vec!["(clean ?plate)".to_owned()])]);
    let expected = ROBOT.replace(
        "\n      (clean ?plate)                             ; an old habit",
        "                               ; an old habit",
    );
    let bare = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(bare(&extension.text), bare(&expected));
    for comment in
        ["; A robot that can", ";; It only takes", "; one thing at a time", "; the hand is free"]
    {
        assert!(extension.text.contains(comment), "{}", extension.text);
    }
}

#[test]
fn what_is_new_is_added_at_the_end_and_the_rest_stays() {
    let text = clean();
    let extension = extended(&text, OPEN);
    assert_eq!(extension.added, ["open-drawer"]);
    insta::with_settings!({ description => OPEN, omit_expression => true }, {
        insta::assert_snapshot!("a domain that was extended", extension.text);
    });
    let kept = text.trim_end().strip_suffix(')').expect("a domain ends with a parenthesis");
    assert!(extension.text.starts_with(kept), "{}", extension.text);
    assert_eq!(warnings(&extension.text), [""; 0]);
    // Whoever has seen it knows it.
    let again = extended(&extension.text, OPEN);
    assert_eq!(again.text, extension.text);
    assert_eq!(again.known, [("open-drawer".to_owned(), 1)]);
}

#[test]
fn a_text_that_was_evenly_laid_out_stays_so() {
    let even = lang::format::format(ROBOT).expect("it can be laid out");
    for script in [PICK, OPEN] {
        let extension = extended(&even, script);
        assert_ne!(extension.text, even);
        assert_eq!(lang::format::format(&extension.text).as_deref(), Some(extension.text.as_str()));
    }
}

#[test]
fn a_name_that_means_something_else_gets_a_number() {
    let text = clean().replace("(:action pick", "(:action open-drawer");
    let extension = extended(&text, OPEN);
    assert_eq!(extension.added, ["open-drawer-2"]);
    assert_eq!(
        extension.conflicts,
        [
            "there is an action `open-drawer` that does something else; what was shown is called `open-drawer-2`"
        ]
    );
    assert!(extension.text.contains("(:action open-drawer-2"), "{}", extension.text);
}

#[test]
fn an_action_that_adds_the_same_and_deletes_something_else_is_a_rival() {
    let text = clean().replace("\n      (not (hand-clear))", "");
    let extension = extended(&text, PICK);
    assert_eq!(extension.added, ["take-plate-from-table"]);
    assert_eq!(
        extension.conflicts,
        [
            "`take-plate-from-table` makes the same true as `pick`, but not the same false; both are kept"
        ]
    );
}

#[test]
fn an_action_is_known_in_whatever_order_its_parameters_stand() {
    let text = clean().replace(
        "(?plate - plate ?table - table)\n    :pre",
        "(?table - table ?plate - plate)\n    :pre",
    );
    assert_ne!(text, clean());
    assert_eq!(extended(&text, PICK).known, [("pick".to_owned(), 1)]);
}

#[test]
fn the_only_precondition_leaves_an_empty_one() {
    let text = clean().replace(
        ":precondition (and
      (hand-clear)                               ; one thing at a time
      (on ?plate ?table))",
        ":precondition (open-hand)",
    );
    let text = text.replace(
        "(hand-clear)                                 ; the hand",
        "(open-hand) (hand-clear) ; the hand",
    );
    let extension = extended(&text, PICK);
    assert_eq!(extension.refined, [("pick".to_owned(), vec!["(open-hand)".to_owned()])]);
    assert!(extension.text.contains(":precondition ()"), "{}", extension.text);
}
