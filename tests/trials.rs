//! `caveat simulate stack` from the command line to the files that it leaves: the same trials whatever the threads and the format, and clear refusals.

use cli::exit::Exit;

use crate::desk::{Desk, shipped};

#[test]
fn a_sheet_says_what_the_trials_are() {
    let desk = Desk::new();
    let said = desk.ends(Exit::Done, "caveat simulate stack --cubes 2 --samples 20 -o t.csv");
    let head: String =
        desk.file("t.csv").lines().take(3).fold(String::new(), |head, line| head + line + "\n");
    insta::assert_snapshot!(format!("{said}\n{head}\n{}", desk.file("t.sheet.json")));
}

/// A trial is drawn by its number and the seed: more trials begin as fewer do, and Parquet says what CSV says.
#[test]
fn trials_are_the_same_in_every_file() {
    let desk = Desk::new();
    for (samples, file) in [(60, "few.csv"), (90, "more.csv"), (60, "few.parquet")] {
        desk.ends(
            Exit::Done,
            &format!("caveat simulate stack --samples {samples} --seed 5 -o {file}"),
        );
    }
    assert!(desk.file("more.csv").starts_with(&desk.file("few.csv")));
    let learned = |file: &str, to: &str| {
        let fit = format!("caveat causal fit {file} --arcs xOff:onTop -o {to}");
        desk.ends(Exit::Done, &fit);
        let json: serde_json::Value = serde_json::from_str(&desk.file(to)).expect("it is JSON");
        (json["variables"].clone(), json["tables"].clone())
    };
    assert_eq!(learned("few.csv", "a.cbn.json"), learned("few.parquet", "b.cbn.json"));
}

#[test]
fn worlds_that_cannot_be_are_refused() {
    let desk = Desk::new();
    desk.write("odd.json", "{\"edge\": 5, \"weight\": 3}");
    let lines = [
        "--cubes 0 -o t.csv",
        "--cubes 99 -o t.csv",
        "--size -3 -o t.csv",
        "--restitution 1.5 -o t.csv",
        "--noise -1 -o t.csv",
        "--world odd.json -o t.csv",
        "--world nowhere.json -o t.csv",
        "--samples many -o t.csv",
        "--samples 5 -o nowhere/t.csv",
    ];
    let all = desk.told(lines.iter().map(|line| format!("caveat simulate stack {line}")));
    assert_eq!(all.matches("[exit code 2]").count(), lines.len(), "{all}");
    assert!(!desk.path("t.csv").exists());
    insta::assert_snapshot!(all);
}

/// Nothing that ships is a file of which nobody knows any more how it was made.
#[test]
fn the_trials_that_ship_are_run_again() {
    let desk = Desk::new();
    let world = "domains/one-cube/world.json";
    desk.ends(Exit::Done, &format!("caveat simulate stack --world {world} --samples 300 -o t.csv"));
    assert!(shipped("one-cube/trials.csv").starts_with(&desk.file("t.csv")));
}
