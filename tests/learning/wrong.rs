//! Logs with a mistake go in; each gets a clear answer, with the line where there is one.

use std::fmt::Write as _;

use cli::exit::Exit;
use serde_json::Value;

use super::{demo, keep};
use crate::desk::Desk;

/// A desk with the log of an opened drawer, and its lines.
fn opened() -> (Desk, Vec<String>) {
    let desk = demo("kitchen --task guided");
    let lines = desk.file("demo.jsonl").lines().map(str::to_owned).collect();
    (desk, lines)
}

#[test]
fn logs_that_cannot_be_read_are_refused_with_the_line() {
    let (desk, lines) = opened();
    let log = |name: &str, lines: &[String]| desk.write(name, &(lines.join("\n") + "\n"));
    let changed = |number: usize, from: &str, to: &str| {
        let mut lines = lines.clone();
        let new = lines[number - 1].replacen(from, to, 1);
        assert_ne!(new, lines[number - 1], "nothing was changed");
        lines[number - 1] = new;
        lines
    };
    desk.write("empty.jsonl", "");
    log("header.jsonl", &lines[..1]);
    log("headless.jsonl", &lines[1..]);
    let mut back = lines.clone();
    back.swap(5, 6);
    log("backwards.jsonl", &back);
    let mut twice = lines.clone();
    twice[7] = twice[6].clone();
    log("twice.jsonl", &twice);
    log("unknown.jsonl", &changed(9, "\"red-plate\"", "\"rod-plate\""));
    log("hand.jsonl", &changed(9, "\"left-hand\"", "\"lift-hand\""));
    log("nan.jsonl", &changed(9, "\"pose\":[", "\"pose\":[NaN,"));
    log("huge.jsonl", &changed(9, "\"pose\":[", "\"pose\":[1e999,"));
    log("short.jsonl", &changed(9, "\"pose\":[", "\"pose\":[0,"));
    log("broken.jsonl", &changed(9, "{", ""));
    log("newer.jsonl", &changed(1, "\"caveat-log\":1", "\"caveat-log\":9"));
    desk.write("wrong.csv", "# no header\n1,2,3\n");
    let names = [
        "empty.jsonl",
        "header.jsonl",
        "headless.jsonl",
        "backwards.jsonl",
        "twice.jsonl",
        "unknown.jsonl",
        "hand.jsonl",
        "nan.jsonl",
        "huge.jsonl",
        "short.jsonl",
        "broken.jsonl",
        "newer.jsonl",
        "wrong.csv",
        "nowhere.jsonl",
    ];
    let mut shown = String::new();
    for name in names {
        let command = format!("caveat learn {name}");
        let run = desk.run(&command);
        assert_ne!(run.exit, Exit::Done, "{command}: {}", run.talk);
        assert_eq!(run.data, "", "{command}: nothing is learned from it");
        let _ = writeln!(shown, "$ {command}\n{}[exit code {}]\n", run.talk, run.exit.code());
    }
    keep("logs that cannot be read", "caveat learn", &shown);
}

#[test]
fn bad_lines_are_named_and_left_out_when_asked() {
    let (desk, mut lines) = opened();
    for line in &mut lines[10..18] {
        *line = line.replacen("\"red-plate\"", "\"rod-plate\"", 1);
    }
    lines.swap(30, 31);
    desk.write("bad.jsonl", &lines.join("\n"));
    let command = "caveat learn --bad-lines skip -o learned.pddl bad.jsonl";
    keep("bad lines", command, &desk.shown(Exit::Findings, command));
    desk.ends(Exit::Done, "caveat learn -o whole.pddl demo.jsonl");
    let learned = desk.file("learned.pddl").replace("bad.jsonl", "demo.jsonl");
    assert_eq!(learned, desk.file("whole.pddl"), "a few frames more or less change nothing");
    desk.ends(Exit::Findings, "caveat learn bad.jsonl");
}

#[test]
fn a_demonstration_in_which_nothing_happens_teaches_nothing() {
    let desk = demo("cubes --task nothing");
    let command = "caveat learn demo.jsonl";
    keep("nothing happens", command, &desk.shown(Exit::Findings, command));
}

/// A log without a hand after so many lines.
fn vanished(lines: &[String], hand: &str, after: usize) -> String {
    let mut text = String::new();
    for (number, line) in lines.iter().enumerate() {
        let mut value: Value = serde_json::from_str(line).expect("each line is a document");
        if number > after {
            let hands = value["hands"].as_object_mut().expect("a frame has hands");
            hands.remove(hand).expect("the hand is in each frame");
        }
        text.push_str(&value.to_string());
        text.push('\n');
    }
    text
}

#[test]
fn a_hand_that_vanishes_for_good_is_credited_with_nothing_afterwards() {
    let (desk, lines) = opened();
    // It vanishes before it is near the drawer, which then opens as if by itself.
    desk.write("gone.jsonl", &vanished(&lines, "right-hand", 100));
    let command = "caveat learn gone.jsonl";
    keep("a hand that vanishes", command, &desk.shown(Exit::Findings, command));
    // Who is gone after the deed has done it all the same.
    desk.write("late.jsonl", &vanished(&lines, "right-hand", lines.len() - 60));
    let said = desk.ends(Exit::Done, "caveat learn late.jsonl");
    assert!(said.contains("(:action open-drawer"), "{said}");
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let (desk, lines) = opened();
    let configs = [
        ("pattern.json", r#"{"vocabulary": {"on-top": "(on ?above ?below"}}"#),
        ("roles.json", r#"{"vocabulary": {"on-top": "(on ?a ?b ?c)"}}"#),
        ("same.json", r#"{"vocabulary": {"open": "(it ?object)", "closed": "(it ?object)"}}"#),
        ("field.json", r#"{"vocabulry": {}}"#),
        ("number.json", r#"{"credit": -1}"#),
        ("array.json", "[1"),
    ];
    for (name, text) in configs {
        desk.write(name, text);
    }
    desk.write("some.trace", "(:trajectory (:state (a)) (:action (go)) (:state (b)))\n");
    desk.write("wrong.trace", "(:trajectory (:state (a)) (:action (go)) (:state (b))\n");
    desk.write("broken.pddl", "(define (domain broken) (:predicates (a ?x - thing)))\n");
    desk.write("short.jsonl", &lines[..40].join("\n"));
    let wrong = [
        "--map lift-hand=robot demo.jsonl",
        "--map left-hand demo.jsonl",
        "--tolerance 0.5 demo.jsonl",
        "--rule best demo.jsonl",
        "--synergy some demo.jsonl",
        "--config pattern.json demo.jsonl",
        "--config roles.json demo.jsonl",
        "--config field.json demo.jsonl",
        "--config number.json demo.jsonl",
        "--config array.json demo.jsonl",
        "--config nowhere.json demo.jsonl",
        "demo.jsonl some.trace",
        "--truth demo.truth.jsonl demo.jsonl demo.jsonl",
        "--truth demo.jsonl demo.jsonl",
        "--segments-svg x.svg demo.jsonl demo.jsonl",
        "--goal (open) demo.jsonl",
        "--extend broken.pddl demo.jsonl",
        "--extend nowhere.pddl demo.jsonl",
        "--extend domains/closed-drawer/domain.pddl --agents demo.jsonl",
        "--domain nowhere.pddl some.trace",
        "wrong.trace",
        "-o nowhere/learned.pddl demo.jsonl",
    ];
    let mut shown = String::new();
    for arguments in wrong {
        let command = format!("caveat learn {arguments}");
        let run = desk.run(&command);
        assert_ne!(run.exit, Exit::Done, "{command}: {}", run.talk);
        assert_eq!(run.data, "", "{command}: {}", run.talk);
        let _ = writeln!(shown, "$ {command}\n{}[exit code {}]\n", run.talk, run.exit.code());
    }
    keep("refused by learn", "caveat learn", &shown);
}
