//! What `caveat simulate` prints is kept as a person reads it: the list of worlds, and refusals.

use std::fmt::Write as _;

use cli::exit::Exit;

use super::{demo, keep};
use crate::desk::Desk;

#[test]
fn the_worlds_are_listed() {
    let printed = Desk::new().ends(Exit::Done, "caveat simulate list");
    keep("the worlds", "caveat simulate list", &printed);
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let desk = Desk::new();
    desk.write("x.plan", "(fly)\n");
    desk.write("wrong.plan", "(put red-cube\n");
    desk.write("none.json", "[]");
    desk.write("wrong.json", "{\"points\": 3}");
    let wrong = [
        "demo kichen -o demo.jsonl",
        "demo moon -o demo.jsonl",
        "demo bottle --task stack-one -o demo.jsonl",
        "demo cubes --task fly -o demo.jsonl",
        "demo cubes -o nowhere/demo.jsonl",
        "run cubes --goal fly --routines none.json x.plan",
        "run cubes --routines none.json wrong.plan",
        "run cubes --routines none.json nowhere.plan",
        "run cubes --routines wrong.json x.plan",
        "run cubes --routines nowhere.json x.plan",
    ];
    let mut shown = String::new();
    for arguments in wrong {
        let command = format!("caveat simulate {arguments}");
        let run = desk.run(&command);
        assert_eq!((run.exit, run.data.as_str()), (Exit::Failed, ""), "{command}: {}", run.talk);
        let _ = writeln!(shown, "$ {command}\n{}", run.talk);
    }
    keep("refused by simulate", "caveat simulate", &shown);
}

#[test]
fn a_plan_without_way_points_reaches_nothing_and_says_why() {
    let desk = Desk::new();
    desk.write("x.plan", "(fly)\n");
    desk.write("none.json", "[]");
    let command = "caveat simulate run cubes --routines none.json x.plan";
    keep("a plan without way points", command, &desk.shown(Exit::Findings, command));
}

#[test]
fn the_same_person_shows_the_same_again_and_another_one_something_else() {
    let desk = demo("cubes --person 3 --seed 4");
    desk.ends(Exit::Done, "caveat simulate demo cubes --person 3 --seed 4 -o again.jsonl");
    assert_eq!(desk.file("demo.jsonl"), desk.file("again.jsonl"));
    assert_eq!(desk.file("demo.truth.jsonl"), desk.file("again.truth.jsonl"));
    desk.ends(Exit::Done, "caveat simulate demo cubes --person 4 --seed 4 -o other.jsonl");
    assert_ne!(desk.file("demo.jsonl"), desk.file("other.jsonl"));
}
