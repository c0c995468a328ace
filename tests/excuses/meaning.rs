//! What an excuse means: no edit leads to an impossible world, ties are all shown, and what may be edited is up to who asks.

use cli::exit::Exit;
use serde_json::Value;

use super::{Desk, changes, worlds};

/// The changes of all excuses that a command finds.
#[track_caller]
fn found(desk: &Desk, arguments: &str) -> Vec<Vec<String>> {
    list(&answer(desk, arguments)).iter().map(changes).collect()
}

#[track_caller]
fn answer(desk: &Desk, arguments: &str) -> Value {
    desk.json(&format!("caveat excuse --output-format json {arguments}"))
}

fn list(answer: &Value) -> Vec<Value> {
    answer["excuses"].as_array().cloned().unwrap_or_default()
}

/// The facts of a predicate that hold after an excuse, of `initial` ones.
fn after(changes: &[String], initial: &[&str], predicate: &str) -> Vec<String> {
    let mut facts: Vec<String> = initial.iter().map(|&fact| fact.to_owned()).collect();
    for change in changes {
        let (from, to) = change.split_once(" -> ").expect("no new objects are needed");
        facts.retain(|fact| fact != from);
        facts.push(to.to_owned());
    }
    facts.retain(|fact| fact.starts_with(&format!("({predicate} ")));
    facts
}

#[test]
fn a_ferry_that_cannot_sail_is_still_in_one_place() {
    let desk = Desk::with(&[("ferry.pddl", worlds::FERRY), ("crossing.pddl", worlds::CROSSING)]);
    let found = found(&desk, "--all ferry.pddl crossing.pddl");
    assert!(!found.is_empty());
    for excuse in &found {
        assert_eq!(after(excuse, &["(ferry-at east)"], "ferry-at").len(), 1, "{excuse:?}");
    }
    // The car is on the ferry, the ferry where the car shall be, and the deck no longer free.
    assert_eq!(
        found,
        [[
            "(waits-at red north) -> (aboard red)",
            "(ferry-at east) -> (ferry-at south)",
            "(deck-free) -> none"
        ]]
    );
}

#[test]
fn where_nothing_is_presumed_the_edits_are_bare_atoms_and_said_to_be_so() {
    let desk = Desk::with(&[("ferry.pddl", worlds::FERRY), ("crossing.pddl", worlds::CROSSING)]);
    let answer = answer(&desk, "--presume-nothing ferry.pddl crossing.pddl");
    let first = &list(&answer)[0];
    assert_eq!(changes(first), ["none -> (ferry-at north)", "none -> (ferry-at south)"]);
    assert_eq!(first["edits"][0]["group"], "none");
    let said = desk.ends(Exit::Done, "caveat excuse --presume-nothing ferry.pddl crossing.pddl");
    assert!(said.contains("+ (ferry-at north)   ; a bare atom"), "{said}");
}

#[test]
fn two_cars_cannot_leave_a_ferry_at_two_landings() {
    let two = worlds::CROSSING
        .replace("red - car", "red blue - car")
        .replace("(waits-at red north)", "(waits-at red north) (waits-at blue north)")
        .replace("(waits-at red south)", "(and (waits-at red south) (waits-at blue east))");
    let desk = Desk::with(&[("ferry.pddl", worlds::FERRY), ("two.pddl", &two)]);
    let answer = answer(&desk, "ferry.pddl two.pddl");
    assert_eq!((&answer["status"], &answer["presumed"]), (&"none".into(), &true.into()));
    desk.ends(Exit::Done, "caveat excuse --presume-nothing ferry.pddl two.pddl");
}

#[test]
fn no_box_is_open_and_closed() {
    let desk = Desk::with(&[("boxes.pddl", worlds::BOXES), ("box.pddl", worlds::BOX)]);
    let answer = answer(&desk, "boxes.pddl box.pddl");
    let excuses = list(&answer);
    assert_eq!(excuses.len(), 1);
    assert_eq!(changes(&excuses[0]), ["(closed small) -> (open small)"]);
    assert_eq!(excuses[0]["edits"][0]["group"], "presumed");
    let mended = "caveat excuse --apply mended.pddl boxes.pddl box.pddl";
    desk.ends(Exit::Done, mended);
    let problem = desk.file("mended.pddl");
    assert!(problem.contains("(open small)") && !problem.contains("closed"), "{problem}");
}

#[test]
fn groups_from_a_file_are_used() {
    let other = |text: &str| text.replace("open", "ajar").replace("closed", "latched");
    let desk = Desk::with(&[
        ("boxes.pddl", &other(worlds::BOXES)),
        ("box.pddl", &other(worlds::BOX)),
        ("groups.txt", "; A box is one of both.\n(:exactly-one (ajar ?box) (latched ?box))\n"),
    ]);
    assert_eq!(found(&desk, "boxes.pddl box.pddl"), [["none -> (ajar small)"]]);
    let answer = answer(&desk, "--groups groups.txt boxes.pddl box.pddl");
    assert_eq!(changes(&list(&answer)[0]), ["(latched small) -> (ajar small)"]);
    assert_eq!(list(&answer)[0]["edits"][0]["group"], "declared");
}

#[test]
fn a_group_without_a_fact_gets_one() {
    let desk = Desk::with(&[("painter.pddl", worlds::PAINTER), ("nowhere.pddl", worlds::NOWHERE)]);
    let answer = answer(&desk, "--all painter.pddl nowhere.pddl");
    let excuses = list(&answer);
    for excuse in &excuses {
        assert_eq!(excuse["edits"][0]["group"], "actions");
        assert_eq!(after(&changes(excuse), &[], "robot-in").len(), 1);
    }
    // From the cellar the robot gets everywhere, and nobody gets there.
    assert_eq!(changes(&excuses[0]), ["none -> (robot-in cellar)"]);
    let levels: Vec<&Value> = excuses.iter().map(|excuse| &excuse["level"]).collect();
    assert_eq!(levels, [0, 1, 1]);
    assert_eq!((&excuses[1]["deeper"], &excuses[2]["deeper"]), (&[1].into(), &[1].into()));
}

#[test]
fn ties_are_all_shown() {
    let desk = Desk::with(&[("fuses.pddl", worlds::FUSES), ("blown.pddl", worlds::BLOWN)]);
    let all = ["none -> (whole left)", "none -> (whole middle)", "none -> (whole right)"];
    let mut found = found(&desk, "fuses.pddl blown.pddl").concat();
    found.sort();
    assert_eq!(found, all);
    let levels: Vec<Value> = list(&answer(&desk, "fuses.pddl blown.pddl"))
        .iter()
        .map(|excuse| excuse["level"].clone())
        .collect();
    assert_eq!(levels, [0, 0, 0]);
    for (options, shown, complete) in [("", 3, true), ("--limit 1", 1, false), ("--all", 3, true)] {
        let answer = answer(&desk, &format!("{options} fuses.pddl blown.pddl"));
        assert_eq!((list(&answer).len(), &answer["proven"]), (shown, &true.into()));
        assert_eq!(answer["complete"], complete, "{options}");
        let command = format!("caveat excuse {options} fuses.pddl blown.pddl");
        let said = desk.ends(Exit::Done, &command);
        let end = if complete {
            "No excuse costs less than 1, and no others of the same cost.\n"
        } else {
            "No excuse costs less than 1; there may be more of the same cost.\n"
        };
        assert!(said.ends_with(end), "{said}");
    }
    let command = "caveat excuse fuses.pddl blown.pddl";
    super::keep("ties", command, &desk.ends(Exit::Done, command));
}

#[test]
fn the_goal_is_edited_only_where_that_is_allowed() {
    let desk = Desk::with(&[("lamps.pddl", worlds::LAMPS), ("dark.pddl", worlds::DARK)]);
    assert_eq!(found(&desk, "--all lamps.pddl dark.pddl"), [["none -> (wired hall)"]]);
    assert_eq!(
        found(&desk, "--all --edit-goal lamps.pddl dark.pddl"),
        [["none -> (wired hall)"], ["none -> (lit hall)"]]
    );
}

#[test]
fn new_objects_are_made_only_where_they_are_allowed() {
    let desk = Desk::with(&[]);
    let cranes = "domains/cranes/p01.pddl";
    assert_eq!(answer(&desk, &format!("--new-objects 0 {cranes}"))["status"], "none");
    assert_eq!(answer(&desk, cranes)["cost"], 8);
    assert_eq!(answer(&desk, &format!("--object-cost 2 {cranes}"))["cost"], 5);
}

#[test]
fn costs_and_choices_of_predicates_are_kept() {
    let desk = Desk::with(&[("grid.pddl", worlds::GRID), ("mast.pddl", worlds::MAST)]);
    let of = |options: &str| answer(&desk, &format!("{options} grid.pddl mast.pddl"));
    // A wire relates two things; a source is what stands for a type where there are none.
    assert_eq!((&of("")["cost"], list(&of("")).len()), (&3.into(), 2));
    assert_eq!(changes(&list(&of("--protect wire"))[0]), ["none -> (source lamp)"]);
    assert_eq!(changes(&list(&of("--only source"))[0]), ["none -> (source lamp)"]);
    assert_eq!(of("--cost source=2")["cost"], 2);
    assert_eq!(of("--cost wire=4,source=4")["cost"], 4);
    assert_eq!(list(&of("--cost wire=4,source=4")).len(), 3);
}
