//! Changes with hands near and far go in; each belongs to the hand that held, touched or was near what changed, and to none where no hand was.

use super::script;
use super::words::{deeds, told};

const ROOM: &str = "things blue - drawer chair - chair red - cube table - table\n";

/// The deeds of one change in a room.
fn after(change: &str) -> Vec<String> {
    told(&format!("{ROOM}1.0 {change}"))
}

#[test]
fn a_change_with_no_hand_near_is_nobodys() {
    let script = format!("{ROOM}1.0 + (open blue) left 0.3 right 0.2");
    let (record, found) = deeds(&script);
    assert_eq!(script::lines(&record, &found), [""; 0]);
    assert_eq!(found.strays, record.changes);
    // Not even where there is only one hand in sight.
    let (_, found) = deeds(&format!("{ROOM}1.0 + (open blue) right 0.16"));
    assert_eq!((found.deeds.len(), found.strays.len()), (0, 1));
    let (_, found) = deeds(&format!("{ROOM}1.0 + (open blue)"));
    assert_eq!((found.deeds.len(), found.strays.len()), (0, 1));
}

#[test]
fn the_nearest_hand_that_is_near_enough_did_it() {
    assert_eq!(after("+ (open blue) left 0.14 right 0.1"), ["right push blue +(open blue)"]);
    assert_eq!(after("+ (open blue) left 0.1 right 0.14"), ["left push blue +(open blue)"]);
}

#[test]
fn touching_counts_before_nearness_and_holding_before_touching() {
    assert_eq!(after("+ (open blue) left 0.01 right touching"), ["right push blue +(open blue)"]);
    let script = "0.5 right takes blue\n1.0 + (open blue) left touching right holding";
    assert_eq!(told(&format!("{ROOM}{script}")), ["right handle blue +(open blue)"]);
}

#[test]
fn a_change_belongs_to_the_grip_that_ended_shortly_before_it() {
    let script = "0.5 right takes blue\n1.0 right lets go\n1.7 + (open blue) right holding";
    assert_eq!(told(&format!("{ROOM}{script}")), ["right handle blue +(open blue)"]);
    let late = "0.5 right takes blue\n1.0 right lets go\n2.0 + (open blue) right 0.1";
    assert_eq!(
        told(&format!("{ROOM}{late}")),
        ["right handle blue", "right push blue +(open blue)"]
    );
}

#[test]
fn what_becomes_clear_or_unblocked_belongs_to_who_took_away_what_was_there() {
    // The left hand is near the drawer, but it was the right one that moved the chair.
    let script = "holds (blocks chair blue)
        0.5 right takes chair
        1.0 - (blocks chair blue) right holding
        1.05 + (unblocked blue) left touching";
    let expected = ["right handle chair -(blocks chair blue) +(unblocked blue)"];
    assert_eq!(told(&format!("{ROOM}{script}")), expected);
    // Without what covered it, nobody knows better.
    assert_eq!(after("+ (unblocked blue) left touching"), ["left push blue +(unblocked blue)"]);
}

#[test]
fn the_hand_that_holds_what_a_relation_is_about_does_it_and_the_other_helps() {
    let script = "things bottle - bottle lid - lid
        0.5 left takes bottle
        1.0 right takes lid
        2.0 - (on-top lid bottle) left holding right holding
        2.5 right lets go
        3.0 left lets go";
    let lines = told(script);
    assert!(
        lines.contains(
            &"right take lid +(in-hand lid right) -(hand-empty right) -(on-top lid bottle) with left"
                .replace("+(in-hand lid right) -(hand-empty right)", "-(hand-empty right) +(in-hand lid right)")
        ),
        "{lines:#?}"
    );
    assert!(lines.contains(&"left hold bottle with right".to_owned()), "{lines:#?}");
    let hold = lines.iter().position(|line| line.starts_with("left hold"));
    let take = lines.iter().position(|line| line.starts_with("right take"));
    assert!(hold < take, "who holds does so before: {lines:#?}");
}

#[test]
fn who_has_let_go_helps_no_more() {
    let script = "things bottle - bottle lid - lid
        0.5 left takes bottle
        1.0 right takes lid
        1.8 left lets go
        2.0 - (on-top lid bottle) left holding right holding";
    let lines = told(script);
    assert!(lines.iter().all(|line| !line.contains("hold bottle")), "{lines:#?}");
}
