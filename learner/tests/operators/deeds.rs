//! Times in which hands hold something go in; what comes out is cut into taking, using and putting down where the thing leaves what it rests on.

use super::words::told;

/// What the left hand does with a cube on a table.
const STACKED: &str = "things red blue - cube table - table
    holds (on-top red table) (on-top blue table) (clear red) (clear blue) (hand-empty left)
    1.0 left takes red
    1.2 - (on-top red table) left holding
    3.0 + (on-top red blue) left holding
    3.0 - (clear blue) left 0.1
    3.2 left lets go";

#[test]
fn what_is_lifted_is_taken_and_put() {
    assert_eq!(
        told(STACKED),
        [
            "left take red -(hand-empty left) +(in-hand red left) -(on-top red table)",
            "left put red +(hand-empty left) -(in-hand red left) +(on-top red blue) -(clear blue)",
        ]
    );
}

#[test]
fn what_is_never_put_down_is_only_taken() {
    let script = STACKED.split("3.0").next().expect("there is a beginning");
    let lines = told(script);
    assert_eq!(lines.len(), 1, "{lines:#?}");
    assert!(lines[0].starts_with("left take red"), "{lines:#?}");
}

#[test]
fn what_rests_on_something_else_for_a_moment_while_it_is_carried_is_still_put_once() {
    let script = STACKED.replace(
        "3.0 + (on-top red blue)",
        "2.9 + (on-top red table) left holding
        2.95 - (on-top red table) left holding
        3.0 + (on-top red blue)",
    );
    let lines = told(&script);
    let verbs: Vec<&str> = lines.iter().filter_map(|line| line.split(' ').nth(1)).collect();
    assert_eq!(verbs, ["take", "put"], "{lines:#?}");
}

#[test]
fn what_is_dropped_and_taken_again_is_put_and_taken_twice() {
    let script = "things red blue - cube table - table
        holds (on-top red table) (on-top blue table)
        1.0 left takes red
        1.2 - (on-top red table) left holding
        2.0 left lets go
        2.3 + (on-top red table) left holding
        4.0 left takes red
        4.2 - (on-top red table) left holding
        6.0 + (on-top red blue) left holding
        6.1 left lets go";
    let lines = told(script);
    let starts: Vec<&str> =
        ["left take red", "left put red", "left take red", "left put red"].into();
    assert_eq!(lines.len(), 4, "{lines:#?}");
    for (line, start) in lines.iter().zip(starts) {
        assert!(line.starts_with(start), "{lines:#?}");
    }
    assert!(lines[1].ends_with("+(on-top red table)"), "{lines:#?}");
    assert!(lines[3].ends_with("+(on-top red blue)"), "{lines:#?}");
}

#[test]
fn what_cannot_be_lifted_is_handled_from_grip_to_release() {
    let script = "things blue - drawer
        holds (closed blue)
        1.0 right takes blue
        1.5 - (closed blue) right holding
        1.5 + (open blue) right holding
        2.0 right lets go";
    assert_eq!(told(script), ["right handle blue -(closed blue) +(open blue)"]);
}

#[test]
fn what_is_moved_without_a_grip_is_pushed() {
    let script = "things chair - chair blue - drawer
        1.0 - (blocks chair blue) left touching
        1.2 + (unblocked blue) left touching
        3.0 + (blocks chair blue) left touching";
    assert_eq!(
        told(script),
        [
            "left push chair -(blocks chair blue) +(unblocked blue)",
            "left push chair +(blocks chair blue)",
        ]
    );
}

#[test]
fn what_is_changed_with_a_tool_is_use_of_the_tool() {
    let script = "things stick - tool table - table blue - drawer
        holds (on-top stick table) (closed blue)
        1.0 left takes stick
        1.2 - (on-top stick table) left holding
        3.0 - (closed blue) left holding
        3.0 + (open blue) left holding
        5.0 + (on-top stick table) left holding
        5.2 left lets go";
    // A hand that holds the stick is credited; the change is about the drawer.
    let (mut record, _) = super::words::deeds(script);
    let stick = record.header.object("stick").expect("it is there");
    for turn in &mut record.changes {
        if !turn.objects.contains(&stick) && !turn.credits.is_empty() {
            turn.objects.push(stick);
        }
    }
    let found = learner::operators::deed::deeds(&record, |_, _| true);
    let lines = super::script::lines(&record, &found);
    assert_eq!(lines[1], "left use stick -(closed blue) +(open blue)", "{lines:#?}");
    assert!(lines[0].starts_with("left take stick"), "{lines:#?}");
    assert!(lines[2].starts_with("left put stick"), "{lines:#?}");
    assert_eq!(lines.len(), 3);
}

#[test]
fn hands_move_from_place_to_place_or_enter_or_leave() {
    let script = "things tray shelf - spot
        1.0 + (at left tray)
        2.0 - (at left tray)
        2.8 + (at left shelf)
        4.0 - (at left shelf)
        7.0 + (at left tray)";
    assert_eq!(
        told(script),
        [
            "left go +(at left tray)",
            "left go -(at left tray) +(at left shelf)",
            "left go -(at left shelf)",
            "left go +(at left tray)",
        ]
    );
}

#[test]
fn two_hands_at_work_at_the_same_time_each_have_their_own_deeds() {
    let script = "things red blue - cube table - table
        holds (on-top red table) (on-top blue table)
        1.0 left takes red
        1.1 right takes blue
        1.3 - (on-top red table) left holding right 0.1
        1.4 - (on-top blue table) right holding left 0.1
        3.0 + (on-top red table) left holding
        3.1 + (on-top blue table) right holding
        3.2 left lets go
        3.3 right lets go";
    let lines = told(script);
    let starts = ["left take red", "right take blue", "left put red", "right put blue"];
    assert_eq!(lines.len(), 4, "{lines:#?}");
    for (line, start) in lines.iter().zip(starts) {
        assert!(line.starts_with(start), "{lines:#?}");
        assert!(!line.contains("with"), "{lines:#?}");
        let other = if start.contains("red") { "blue" } else { "red" };
        assert!(!line.contains(other), "{lines:#?}");
    }
}
